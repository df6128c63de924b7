#include <gslam/base/error.h>
#include <gslam/evaluation/limits.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <atomic>
#include <thread>

#include "fake_files.h"
#include "spender_child.h"

namespace {

using gslam::MemoryLimit;
using gslam::MemoryLimitOptions;

TEST(Limits, parseListsOfCores) {
  using List = std::vector<int>;
  EXPECT_EQ(gslam::parseCpuList("0"), (List{0}));
  EXPECT_EQ(gslam::parseCpuList("0,1"), (List{0, 1}));
  EXPECT_EQ(gslam::parseCpuList("0-3,8"), (List{0, 1, 2, 3, 8}));
  EXPECT_EQ(gslam::parseCpuList("7,3-5,4"), (List{3, 4, 5, 7}));
  EXPECT_EQ(gslam::parseCpuList("1023"), (List{1023}));
  for (const char* text : {"", ",", "0,", ",0", "a", "0-", "-1", "3-1", "0,,1", "0 ,1", " 0",
                           "1024", "0-99999999999999999999", "0x1", "1.5", "0-1-2"}) {
    try {
      gslam::parseCpuList(text, "--cores");
      FAIL() << text;
    } catch (const gslam::ArgumentError& error) {
      EXPECT_EQ(error.argument(), "--cores");
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos);
    }
  }
}

TEST(Limits, parseSizes) {
  EXPECT_EQ(gslam::parseMemorySize("4G"), std::uint64_t(4) << 30);
  EXPECT_EQ(gslam::parseMemorySize("1.5G"), std::uint64_t(3) << 29);
  EXPECT_EQ(gslam::parseMemorySize("512M"), std::uint64_t(512) << 20);
  EXPECT_EQ(gslam::parseMemorySize("512MiB"), std::uint64_t(512) << 20);
  EXPECT_EQ(gslam::parseMemorySize("512MB"), std::uint64_t(512) << 20);
  EXPECT_EQ(gslam::parseMemorySize("7k"), 7u * 1024);
  EXPECT_EQ(gslam::parseMemorySize("1T"), std::uint64_t(1) << 40);
  EXPECT_EQ(gslam::parseMemorySize("12345"), 12345u);
  EXPECT_EQ(gslam::parseMemorySize("0.25K"), 256u);
  EXPECT_EQ(gslam::parseMemorySize(".5K"), 512u);
  for (const char* text :
       {"",    "G",   "0",    "0G",           "-1G", "4 G", "4X",     "4GG", "4Gi", "1.2.3G", "nan",
        "inf", "1e9", "0x10", "99999999999T", ".",   ".G",  "0.0001", "4iB", "\v",  "4\v"}) {
    try {
      gslam::parseMemorySize(text, "--ram");
      FAIL() << text;
    } catch (const gslam::ArgumentError& error) {
      EXPECT_EQ(error.argument(), "--ram") << text;
    }
  }
}

class Affinity : public testing::Test {
 protected:
  Affinity() : before_(gslam::cpuAffinity()) {}
  ~Affinity() override { gslam::setCpuAffinity(before_); }
  const std::vector<int> before_;
};

TEST_F(Affinity, holdsForAllThreadsAndChildren) {
  const std::vector<int> one = {before_.back()};
  std::atomic<bool> is_set(false);
  std::vector<int> of_thread, of_later;
  std::thread other([&] {
    while (!is_set) std::this_thread::yield();
    of_thread = gslam::cpuAffinity();
  });
  gslam::setCpuAffinity(one);
  is_set = true;
  other.join();
  std::thread later([&] { of_later = gslam::cpuAffinity(); });
  later.join();
  EXPECT_EQ(gslam::cpuAffinity(), one);
  EXPECT_EQ(of_thread, one);
  EXPECT_EQ(of_later, one);
  EXPECT_EQ(sched_getcpu(), one[0]);
  spender::Child child({"affinity"});
  child.go();
  EXPECT_EQ(child.line(), std::to_string(one[0]) + ' ');
}

TEST_F(Affinity, namesWhatIsNotThere) {
  for (const std::vector<int>& cpus :
       {std::vector<int>{}, std::vector<int>{1023}, std::vector<int>{before_[0], 1023},
        std::vector<int>{-1}, std::vector<int>{1024}}) {
    EXPECT_THROW(gslam::setCpuAffinity(cpus, "--cpus"), gslam::ArgumentError);
    EXPECT_EQ(gslam::cpuAffinity(), before_);
  }
  try {
    gslam::setCpuAffinity({before_[0], 1022, 1023}, "--cpus");
    FAIL();
  } catch (const gslam::ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find("1022-1023"), std::string::npos) << error.what();
    EXPECT_EQ(error.argument(), "--cpus");
  }
}

rlim_t dataLimit() {
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  return limit.rlim_cur;
}

TEST(MemoryLimit, refusesNothing) {
  EXPECT_THROW(MemoryLimit(0), gslam::ArgumentError);
}

TEST(MemoryLimit, limitsEachProcessWithoutGroups) {
  if (!spender::canCount()) GTEST_SKIP() << "sanitizers need more memory than there would be";
  const rlim_t before = dataLimit();
  MemoryLimitOptions options;
  options.may_use_cgroup = false;
  {
    const MemoryLimit limit(300000000, options);
    EXPECT_FALSE(limit.isCgroup());
    EXPECT_NE(limit.text().find("RLIMIT_DATA"), std::string::npos) << limit.text();
    EXPECT_NE(limit.text().find("0.28 GiB"), std::string::npos) << limit.text();
    EXPECT_EQ(dataLimit(), 300000000u);
    spender::Child large({"demand", "400"});
    large.go();
    EXPECT_EQ(large.line(), "refused");
    spender::Child small({"demand", "100"});
    small.go();
    EXPECT_EQ(small.line(), "got");
    // Of what is in the process already, this much is not left.
    EXPECT_THROW(std::vector<char>(400000000), std::bad_alloc);
  }
  EXPECT_EQ(dataLimit(), before);
  spender::Child large({"demand", "400"});
  large.go();
  EXPECT_EQ(large.line(), "got");
}

// A tree of files that stands for cgroup v2.
class FakeGroups : public FakeFiles {
 public:
  explicit FakeGroups(const std::string& own) {
    write("proc/self/mountinfo",
          "24 30 0:22 / /sys rw - sysfs sysfs rw\n"
          "29 24 0:26 / " +
              root() + "/groups rw,nosuid shared:4 master:1 - cgroup2 cgroup2 rw\n");
    write("proc/self/cgroup", "4:memory:/old\n0::" + own + "\n");
  }
  MemoryLimitOptions options() const {
    MemoryLimitOptions options;
    options.proc = root() + "/proc";
    return options;
  }
};

TEST(MemoryLimit, makesAGroupBesideItsOwn) {
  const FakeGroups files("/user/app.scope");
  files.write("groups/user/cgroup.subtree_control", "cpu memory pids\n");
  files.write("groups/user/app.scope/cgroup.procs", "");
  const std::string number = std::to_string(getpid());
  const std::string group = "groups/user/gslam-" + number;
  const rlim_t before = dataLimit();
  {
    const MemoryLimit limit(std::uint64_t(4) << 30, files.options());
    EXPECT_TRUE(limit.isCgroup()) << limit.text();
    EXPECT_NE(limit.text().find("4.00 GiB"), std::string::npos);
    EXPECT_NE(limit.text().find(group), std::string::npos) << limit.text();
    EXPECT_EQ(files.read(group + "/memory.max"), "4294967296");
    EXPECT_EQ(files.read(group + "/cgroup.procs"), number);
    EXPECT_EQ(files.read("groups/user/app.scope/cgroup.procs"), "");
    EXPECT_EQ(dataLimit(), before);
    // The system removes the files of a group with it.
    files.remove(group + "/memory.max");
    files.remove(group + "/cgroup.procs");
  }
  EXPECT_EQ(files.read("groups/user/app.scope/cgroup.procs"), number);  // it went home
  EXPECT_FALSE(std::filesystem::exists(files.root() + '/' + group));
}

TEST(MemoryLimit, makesAGroupBelowTheRoot) {
  const FakeGroups files("/");
  files.write("groups/cgroup.subtree_control", "cpu\n");
  const std::string group = "groups/gslam-" + std::to_string(getpid());
  {
    const MemoryLimit limit(1000000000, files.options());
    EXPECT_TRUE(limit.isCgroup()) << limit.text();
    EXPECT_EQ(files.read("groups/cgroup.subtree_control").substr(0, 7), "+memory");
    EXPECT_EQ(files.read(group + "/memory.max"), "1000000000");
  }
  EXPECT_EQ(files.read("groups/cgroup.subtree_control").substr(0, 7), "-memory");
}

// A number that no process has.
std::string goneProcess() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return std::to_string(child);
}

// Those who had too much memory cannot remove theirs, and may have had our number.
TEST(MemoryLimit, removesGroupsOfTheDead) {
  const FakeGroups files("/user/app.scope");
  files.write("groups/user/cgroup.subtree_control", "memory\n");
  const std::string own = "groups/user/gslam-" + std::to_string(getpid());
  const std::string gone = "groups/user/gslam-" + goneProcess();
  const std::string living = "groups/user/gslam-" + std::to_string(getppid());
  const auto isThere = [&](const std::string& path) {
    return std::filesystem::exists(files.root() + '/' + path);
  };
  for (const std::string& left : {own, gone, gone + "-2", living}) {
    std::filesystem::create_directories(files.root() + '/' + left);
  }
  files.write("groups/user/gslam-other/x", "");
  {
    const MemoryLimit limit(1000000000, files.options());
    EXPECT_EQ(limit.group(), files.root() + '/' + own);
    EXPECT_FALSE(isThere(gone));
    EXPECT_FALSE(isThere(gone + "-2"));
    EXPECT_TRUE(isThere(living));
    EXPECT_TRUE(isThere("groups/user/gslam-other"));
    // A second finds the first one's, which somebody is in.
    const MemoryLimit second(900000000, files.options());
    EXPECT_EQ(second.group(), files.root() + '/' + own + "-2");
    EXPECT_EQ(files.read(own + "-2/memory.max"), "900000000");
  }
  std::filesystem::create_directories(files.root() + '/' + gone);
  gslam::removeEndedMemoryGroups(files.options());
  EXPECT_FALSE(isThere(gone));
  EXPECT_TRUE(isThere(living));
}

TEST(MemoryLimit, neverRaisesALimit) {
  if (!spender::canCount()) GTEST_SKIP() << "sanitizers need more memory than there would be";
  rlimit before = {};
  getrlimit(RLIMIT_DATA, &before);
  rlimit soft = before;
  soft.rlim_cur = 2000000000;
  setrlimit(RLIMIT_DATA, &soft);
  MemoryLimitOptions options;
  options.may_use_cgroup = false;
  {
    const MemoryLimit limit(4000000000, options);
    EXPECT_EQ(dataLimit(), 2000000000u);
    EXPECT_NE(limit.text().find("1.86 GiB"), std::string::npos) << limit.text();
    EXPECT_NE(limit.text().find("before"), std::string::npos) << limit.text();
    EXPECT_EQ(limit.group(), "");
  }
  EXPECT_EQ(dataLimit(), 2000000000u);
  setrlimit(RLIMIT_DATA, &before);
}

// What was switched on for a group that could not be made is off again.
TEST(MemoryLimit, leavesNothingBehindWhereItFails) {
  if (!spender::canCount()) GTEST_SKIP() << "sanitizers need more memory than there would be";
  const FakeGroups files("/");
  files.write("groups/cgroup.subtree_control", "cpu\n");
  for (int i = 1; i < 100; ++i) {
    files.write("groups/gslam-" + std::to_string(getpid()) + (i > 1 ? '-' + std::to_string(i) : ""),
                "a file in the way");
  }
  const MemoryLimit limit(8000000000, files.options());
  EXPECT_FALSE(limit.isCgroup());
  EXPECT_EQ(files.read("groups/cgroup.subtree_control").substr(0, 7), "-memory");
}

TEST(MemoryLimit, saysWhyThereIsNoGroup) {
  if (!spender::canCount()) GTEST_SKIP() << "sanitizers need more memory than there would be";
  const rlim_t before = dataLimit();
  const auto reasonOf = [](const FakeGroups& files) {
    const MemoryLimit limit(8000000000, files.options());
    EXPECT_FALSE(limit.isCgroup());
    EXPECT_EQ(dataLimit(), 8000000000u);
    return limit.text();
  };
  {
    const FakeGroups files("/a/b");
    EXPECT_NE(reasonOf(files).find("cannot be read"), std::string::npos);
    files.write("groups/a/cgroup.subtree_control", "cpu memoryless\n");
    EXPECT_NE(reasonOf(files).find("does not pass memory"), std::string::npos);
    files.write("groups/a/cgroup.subtree_control", "memory\n");
    std::filesystem::remove_all(files.root() + "/groups/a");
    files.write("groups/a", "a file in the way");
    EXPECT_NE(reasonOf(files).find("cannot be read"), std::string::npos);
    std::filesystem::remove_all(files.root() + "/groups/a");
    files.write("groups/a/cgroup.subtree_control", "memory\n");
    const std::string group = "groups/a/gslam-" + std::to_string(getpid());
    files.write(group, "a file in the way");
    for (int i = 2; i < 100; ++i) files.write(group + '-' + std::to_string(i), "");
    EXPECT_NE(reasonOf(files).find("cannot be made"), std::string::npos);
  }
  {
    const FakeGroups files("/a/b");
    files.write("proc/self/mountinfo", "nothing");
    EXPECT_NE(reasonOf(files).find("no cgroup v2"), std::string::npos);
  }
  EXPECT_EQ(dataLimit(), before);
}

// On this machine, whichever it is, and with all that stands in its way.
TEST(MemoryLimit, worksHere) {
  if (!spender::canCount()) GTEST_SKIP() << "sanitizers need more memory than there would be";
  const rlim_t before = dataLimit();
  {
    const MemoryLimit limit(std::uint64_t(8) << 30);
    EXPECT_NE(limit.text().find("8.00 GiB"), std::string::npos) << limit.text();
    spender::Child child({"demand", "50"});
    child.go();
    EXPECT_EQ(child.line(), "got");
  }
  EXPECT_EQ(dataLimit(), before);
}

}  // namespace
