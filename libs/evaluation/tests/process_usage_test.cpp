#include <gslam/base/error.h>
#include <gslam/evaluation/process_usage.h>
#include <gtest/gtest.h>
#include <linux/sched.h>
#include <sys/syscall.h>
#include <time.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <thread>

#include "fake_files.h"
#include "spender_child.h"

namespace {

using gslam::ProcessTree;
using gslam::ProcessTreeOptions;
using gslam::ProcessUsage;

ProcessTreeOptions treeOf(long root) {
  ProcessTreeOptions options;
  options.root = root;
  return options;
}

// A process in a fake /proc; ticks are 10 ms.
struct FakeProcess {
  long number = 100, parent = 1;
  std::string name = "slam";
  char state = 'S';
  int user = 0, system = 0, reaped_user = 0, reaped_system = 0;
  int minor = 0, reaped_minor = 0, major = 0, reaped_major = 0, threads = 1, start = 5;
  std::string status = "VmHWM:\t 2000 kB\nVmRSS:\t 1000 kB\nRssAnon:\t 600 kB\n";
  std::string children;
  std::string switches = "voluntary_ctxt_switches:\t7\nnonvoluntary_ctxt_switches:\t3\n";
};

class FakeProc : public FakeFiles {
 public:
  void put(const FakeProcess& p) const {
    const std::string folder = std::to_string(p.number);
    const auto n = [](long value) { return ' ' + std::to_string(value); };
    write(folder + "/stat", folder + " (" + p.name + ") " + p.state + n(p.parent) +
                                " 1 1 0 -1 4194560" + n(p.minor) + n(p.reaped_minor) + n(p.major) +
                                n(p.reaped_major) + n(p.user) + n(p.system) + n(p.reaped_user) +
                                n(p.reaped_system) + " 20 0" + n(p.threads) + " 0" + n(p.start) +
                                " 1000000 250 18446744073709551615 0 0\n");
    write(folder + "/status", "Name:\t" + p.name + "\n" + p.status);
    write(folder + "/task/" + folder + "/status", "Name:\t" + p.name + "\n" + p.switches);
    if (p.children != "none") write(folder + "/task/" + folder + "/children", p.children);
  }
  ProcessTreeOptions options() const {
    ProcessTreeOptions options = treeOf(100);
    options.proc = root();
    return options;
  }
};

TEST(ProcessUsage, parsesByNamesWhateverTheLine) {
  FakeProc proc;
  FakeProcess p;
  // What looks like the fields in a name is none; their order is any.
  p.name = "VmRSS: 5 kB";
  p.status =
      "RssAnon:\t  600 kB\nxVmRSS:\t 9 kB\nVmRSSx:\t 9 kB\nSomething: new\nVmRSS:\t1000 kB\n"
      "Threads:\t4\nVmHWM:\t2000 kB\n";
  proc.put(p);
  ProcessTree tree(proc.options());
  const ProcessUsage usage = tree.read();
  EXPECT_EQ(usage.rss_bytes, 1000u * 1024);
  EXPECT_EQ(usage.peak_rss_bytes, 2000u * 1024);
  EXPECT_EQ(usage.private_bytes, 600u * 1024);
  EXPECT_EQ(usage.voluntary_switches, 7u);
  EXPECT_EQ(usage.involuntary_switches, 3u);
}

TEST(ProcessUsage, takesNamesWithBlanksAndBrackets) {
  for (const char* name : {"plain", "two words", "a) R 1 2 3", "(((", ")))", ") (", "", "x\\ny"}) {
    FakeProc proc;
    FakeProcess p;
    p.name = name;
    p.user = 150;
    p.system = 50;
    p.minor = 11;
    p.major = 2;
    p.threads = 3;
    proc.put(p);
    ProcessTree tree(proc.options());
    const ProcessUsage usage = tree.read();
    EXPECT_NEAR(usage.user_seconds, 1.5, 1e-9) << name;
    EXPECT_NEAR(usage.system_seconds, 0.5, 1e-9) << name;
    EXPECT_NEAR(usage.cpu_seconds, 2, 1e-9) << name;
    EXPECT_EQ(usage.threads, 3u) << name;
    EXPECT_EQ(usage.processes, 1u) << name;
    EXPECT_EQ(usage.minor_faults, 11u) << name;
    EXPECT_EQ(usage.major_faults, 2u) << name;
  }
}

TEST(ProcessUsage, sumsUpATree) {
  FakeProc proc;
  FakeProcess root, child, grandchild, stranger;
  root.children = "101 ";
  root.user = 100;
  child.number = 101;
  child.parent = 100;
  child.children = "102 ";
  child.user = 30;
  grandchild.number = 102;
  grandchild.parent = 101;
  grandchild.system = 7;
  stranger.number = 103;
  stranger.user = 100000;
  for (const FakeProcess& p : {root, child, grandchild, stranger}) proc.put(p);
  ProcessTree tree(proc.options());
  const ProcessUsage usage = tree.read();
  EXPECT_EQ(usage.processes, 3u);
  EXPECT_NEAR(usage.cpu_seconds, 1.37, 1e-9);
  EXPECT_EQ(usage.rss_bytes, 3u * 1000 * 1024);
  EXPECT_EQ(usage.peak_rss_bytes, 3u * 1000 * 1024);  // above the record of each
}

// Where the system does not tell children, all processes are asked for their parents.
TEST(ProcessUsage, findsChildrenByTheirParents) {
  FakeProc proc;
  FakeProcess root, grandchild, child, stranger;
  root.children = child.children = grandchild.children = stranger.children = "none";
  grandchild.number = 101;  // before its parent
  grandchild.parent = 102;
  child.number = 102;
  child.parent = 100;
  stranger.number = 103;
  for (const FakeProcess& p : {root, child, grandchild, stranger}) proc.put(p);
  ProcessTree tree(proc.options());
  EXPECT_EQ(tree.read().processes, 3u);
}

TEST(ProcessUsage, keepsWhatAnEndedChildUsed) {
  FakeProc proc;
  FakeProcess root, child;
  root.children = "101 ";
  root.user = 100;
  child.number = 101;
  child.parent = 100;
  child.user = 40;
  child.minor = 9;
  proc.put(root);
  proc.put(child);
  ProcessTree tree(proc.options());
  EXPECT_NEAR(tree.read().cpu_seconds, 1.4, 1e-9);
  // Its parent was told of 50 ticks.
  proc.remove("101");
  root.children = "";
  root.reaped_user = 50;
  root.reaped_minor = 12;
  proc.put(root);
  ProcessUsage usage = tree.read();
  EXPECT_NEAR(usage.cpu_seconds, 1.5, 1e-9);
  EXPECT_EQ(usage.minor_faults, 12u);
  EXPECT_EQ(usage.voluntary_switches, 14u);
  EXPECT_EQ(usage.processes, 1u);
  EXPECT_NEAR(tree.read().cpu_seconds, 1.5, 1e-9);
}

// Also of a short life, whose ticks could be rounding.
TEST(ProcessUsage, keepsWhatNobodyWasToldOf) {
  for (const int ticks : {0, 1, 2, 40}) {
    FakeProc proc;
    FakeProcess root, child;
    root.children = "101 ";
    child.number = 101;
    child.parent = 100;
    child.user = ticks;
    child.minor = 9;
    proc.put(root);
    proc.put(child);
    ProcessTree tree(proc.options());
    proc.remove("101");
    for (int i = 0; i < 3; ++i) {
      const ProcessUsage usage = tree.read();
      EXPECT_NEAR(usage.cpu_seconds, 0.01 * ticks, 1e-9);
      EXPECT_EQ(usage.minor_faults, 9u);
    }
  }
}

// A middle process ends with its child: the root is told of both.
TEST(ProcessUsage, followsWhatIsToldOverTwoSteps) {
  FakeProc proc;
  FakeProcess root, child, grandchild;
  root.children = "101 ";
  child.number = 101;
  child.parent = 100;
  child.user = 10;
  child.children = "102 ";
  grandchild.number = 102;
  grandchild.parent = 101;
  grandchild.user = 20;
  for (const FakeProcess& p : {root, child, grandchild}) proc.put(p);
  ProcessTree tree(proc.options());
  proc.remove("101");
  proc.remove("102");
  root.children = "";
  root.reaped_user = 31;
  proc.put(root);
  EXPECT_NEAR(tree.read().cpu_seconds, 0.31, 1e-9);
}

TEST(ProcessUsage, takesAReusedNumberForAnotherProcess) {
  FakeProc proc;
  FakeProcess root, child;
  root.children = "101 ";
  child.number = 101;
  child.parent = 100;
  child.user = 40;
  proc.put(root);
  proc.put(child);
  ProcessTree tree(proc.options());
  child.start = 6;
  child.user = 1;
  child.parent = 1;  // it is nobody's
  proc.put(child);
  root.children = "";
  proc.put(root);
  const ProcessUsage usage = tree.read();
  EXPECT_EQ(usage.processes, 1u);
  EXPECT_NEAR(usage.cpu_seconds, 0.4, 1e-9);
}

TEST(ProcessUsage, countsThreadsThatEnded) {
  FakeProc proc;
  FakeProcess root;
  root.threads = 2;
  proc.put(root);
  proc.write("100/task/107/status",
             "voluntary_ctxt_switches:\t1000\nnonvoluntary_ctxt_switches:\t100\n");
  ProcessTree tree(proc.options());
  EXPECT_EQ(tree.read().voluntary_switches, 1007u);
  proc.remove("100/task/107");
  const ProcessUsage usage = tree.read();
  EXPECT_EQ(usage.voluntary_switches, 1007u);
  EXPECT_EQ(usage.involuntary_switches, 103u);
}

TEST(ProcessUsage, survivesBrokenFiles) {
  FakeProc proc;
  FakeProcess root;
  root.user = 20;
  proc.put(root);
  ProcessTree tree(proc.options());
  const std::string stat = proc.read("100/stat");
  for (std::size_t size = 0; size < stat.size(); ++size) {
    proc.write("100/stat", stat.substr(0, size));
    EXPECT_GE(tree.read().cpu_seconds, 0.2 - 1e-9) << size;
  }
  for (const char* text : {"", "VmRSS:", "VmRSS:\t kB\n", "VmRSS: x kB\n", "\n\n\n",
                           "VmRSS: 99999999999999999999999999 kB\n"}) {
    proc.put(root);
    proc.write("100/status", text);
    tree.read();
  }
  proc.remove("100");
  EXPECT_EQ(tree.read().processes, 0u);
}

TEST(ProcessUsage, refusesWhatIsNoProcess) {
  FakeProc proc;
  EXPECT_THROW(ProcessTree tree(proc.options()), gslam::FileError);
  proc.write("100/stat", "nothing");
  EXPECT_THROW(ProcessTree tree(proc.options()), gslam::FileError);
  EXPECT_THROW(ProcessTree tree(treeOf(2000000000)), gslam::FileError);
}

TEST(ProcessUsage, measuresTwoThreadsThatBurn) {
  spender::Child child({"burn", "0.3", "2"});
  ProcessTree tree(treeOf(child.number()));
  const ProcessUsage before = tree.read();
  const std::int64_t clock = tree.cpuTime();
  child.go();
  EXPECT_EQ(child.line(), "done");
  const ProcessUsage used = gslam::usedBetween(before, tree.read());
  EXPECT_GE(used.cpu_seconds, 0.6);
  EXPECT_LE(used.cpu_seconds, 0.7);
  EXPECT_NEAR(1e-9 * double(tree.cpuTime() - clock), used.cpu_seconds, 0.01);
  EXPECT_NEAR(used.user_seconds + used.system_seconds, used.cpu_seconds, 0.04);
}

TEST(ProcessUsage, measuresProgramsOfAnyName) {
  const FakeFiles folder;
  const std::string path = folder.root() + "/a) R 0 (b c";
  std::filesystem::copy_file(GSLAM_TEST_SPENDER, path);
  spender::Child child({"burn", "0.1", "1"}, path);
  ProcessTree tree(treeOf(child.number()));
  child.go();
  EXPECT_EQ(child.line(), "done");
  const ProcessUsage usage = tree.read();
  EXPECT_GE(usage.cpu_seconds, 0.1);
  EXPECT_LE(usage.cpu_seconds, 0.3);
  EXPECT_GE(usage.threads, 1u);
  EXPECT_LE(usage.threads, 1u + spender::kOtherThreads);
}

TEST(ProcessUsage, measuresMemoryThatIsTouched) {
  spender::Child child({"touch", "200"});
  ProcessTree tree(treeOf(child.number()));
  const ProcessUsage before = tree.read();
  child.go();
  EXPECT_EQ(child.line(), "touched 1");
  const ProcessUsage touched = tree.read();
  child.go();
  EXPECT_EQ(child.line(), "done");
  const ProcessUsage after = tree.read();
  // The thread sanitizer has four times as much beside it.
  const double most = spender::canCount() ? 204e6 : 5 * 204e6;
  EXPECT_GE(double(touched.rss_bytes - before.rss_bytes), 196e6);
  EXPECT_LE(double(touched.rss_bytes - before.rss_bytes), most);
  EXPECT_GE(double(touched.private_bytes - before.private_bytes), 196e6);
  EXPECT_LE(double(touched.private_bytes - before.private_bytes), most);
  EXPECT_GE(touched.minor_faults - before.minor_faults, 90u);  // where pages are huge
  if (spender::canCount()) {                                   // a sanitizer gives nothing back
    EXPECT_LE(double(after.rss_bytes - before.rss_bytes), 4e6);
  }
  EXPECT_GE(double(after.peak_rss_bytes), double(before.rss_bytes) + 196e6);
}

TEST(ProcessUsage, dividesSharedMemoryWhereAsked) {
  spender::Child child({"touch", "50"});
  ProcessTreeOptions options = treeOf(child.number());
  EXPECT_EQ(ProcessTree(options).read().pss_bytes, 0u);
  options.has_pss = true;
  ProcessTree tree(options);
  child.go();
  child.line();
  const ProcessUsage usage = tree.read();
  EXPECT_GE(usage.pss_bytes, 50000000u);
  EXPECT_LE(usage.pss_bytes, usage.rss_bytes);
}

// The processes that others start and that end meanwhile count once, whoever was told of them.
TEST(ProcessUsage, countsShortLivedChildrenOnce) {
  for (const char* how : {"children", "ignored"}) {
    spender::Child child({how, "4", "0.1"});
    ProcessTree tree(treeOf(child.number()));
    const ProcessUsage before = tree.read();
    std::atomic<bool> is_done(false);
    double last = 0;
    std::thread reader([&] {
      while (!is_done) {
        const double now = tree.read().cpu_seconds;
        EXPECT_GE(now, last);
        last = now;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
    child.go();
    EXPECT_EQ(child.line(), "done");
    is_done = true;
    reader.join();
    const ProcessUsage used = gslam::usedBetween(before, tree.read());
    // Nobody is told of what those who are ignored do after they were read last.
    EXPECT_GE(used.cpu_seconds, std::string(how) == "ignored" ? 0.2 : 0.38) << how;
    EXPECT_LE(used.cpu_seconds, 0.55) << how;
    EXPECT_EQ(used.processes, 1u);
  }
}

// Of children of 15 ms, too, each of which could be rounding.
TEST(ProcessUsage, countsManyShortLivesThatNobodyIsToldOf) {
  spender::Child child({"ignored", "40", "0.015"});
  ProcessTree tree(treeOf(child.number()));
  const ProcessUsage before = tree.read();
  std::atomic<bool> is_done(false);
  std::thread reader([&] {
    while (!is_done) {
      tree.read();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  child.go();
  EXPECT_EQ(child.line(), "done");
  is_done = true;
  reader.join();
  const ProcessUsage used = gslam::usedBetween(before, tree.read());
  EXPECT_GE(used.cpu_seconds, 0.25);
  EXPECT_LE(used.cpu_seconds, 0.75);
}

void burn(double seconds) {
  timespec time = {};
  const auto used = [&time] {
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  };
  const double end = used() + seconds;
  while (used() < end) {
  }
}

// As fork(), with a number that is free; -1 where that is not allowed.
pid_t forkAs(pid_t number) {
  clone_args how = {};
  how.exit_signal = SIGCHLD;
  how.set_tid = reinterpret_cast<std::uintptr_t>(&number);
  how.set_tid_size = 1;
  return pid_t(syscall(SYS_clone3, &how, sizeof how));
}

// A process of this one with a child that burns 50 ms, and ends and is waited for when it is told.
class ParentOfOne {
 public:
  ParentOfOne() {
    int in[2], out[2];
    if (pipe(in) != 0 || pipe(out) != 0) ADD_FAILURE() << "no pipe";
    number_ = fork();
    if (number_ == 0) {
      const pid_t child = fork();
      if (child == 0) {
        burn(0.05);
        pause();
        _exit(0);
      }
      char byte = 0;
      if (write(out[1], &child, sizeof child) < 0 || read(in[0], &byte, 1) < 0) _exit(1);
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
      if (write(out[1], &byte, 1) < 0) _exit(1);
      pause();
      _exit(0);
    }
    close(in[0]);
    close(out[1]);
    in_ = in[1];
    out_ = out[0];
    EXPECT_EQ(read(out_, &child_, sizeof child_), ssize_t(sizeof child_));
  }
  ParentOfOne(const ParentOfOne&) = delete;
  ParentOfOne& operator=(const ParentOfOne&) = delete;
  ~ParentOfOne() {
    kill(number_, SIGKILL);
    waitpid(number_, nullptr, 0);
    close(in_);
    close(out_);
  }
  void endChild() const {
    char byte = 0;
    EXPECT_EQ(write(in_, &byte, 1), 1);
    EXPECT_EQ(read(out_, &byte, 1), 1);
  }
  pid_t number() const { return number_; }
  pid_t child() const { return child_; }

 private:
  pid_t number_ = -1, child_ = -1;
  int in_ = -1, out_ = -1;
};

// A stranger that gets the number of a child that ended is not followed.
TEST(ProcessUsage, followsNoStrangerOfTheSameNumber) {
  const ParentOfOne parent;
  ProcessTree tree(treeOf(parent.number()));
  const auto begin = std::chrono::steady_clock::now();
  while (tree.cpuTime() < 50000000 && spender::secondsSince(begin) < 5) usleep(1000);
  parent.endChild();
  const pid_t stranger = forkAs(parent.child());
  if (stranger == 0) {
    usleep(100000);
    burn(0.3);
    pause();
    _exit(0);
  }
  if (stranger < 0) GTEST_SKIP() << "this user may not choose the number of a process";
  const std::int64_t before = tree.cpuTime();
  usleep(700000);
  EXPECT_LT(tree.cpuTime() - before, 20000000);
  EXPECT_LT(tree.read().cpu_seconds, 0.1);
  kill(stranger, SIGKILL);
  waitpid(stranger, nullptr, 0);
}

TEST(ProcessUsage, keepsOrphans) {
  spender::Child child({"orphan", "0.2"});
  ProcessTree tree(treeOf(child.number()));
  child.go();
  std::size_t most = 0;
  const auto begin = std::chrono::steady_clock::now();
  while (most < 3 && spender::secondsSince(begin) < 5) {
    most = std::max(most, tree.read().processes);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(most, 3u);
  double used = 0;
  while (spender::secondsSince(begin) < 5 && tree.read().processes > 1) {
    used = tree.read().cpu_seconds;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(used, 0.19);
  EXPECT_GE(tree.read().cpu_seconds, used);
  EXPECT_EQ(child.line(), "done");
}

TEST(ProcessUsage, countsWaits) {
  spender::Child child({"switch", "500"});
  ProcessTree tree(treeOf(child.number()));
  const ProcessUsage before = tree.read();
  child.go();
  EXPECT_EQ(child.line(), "done");
  const ProcessUsage used = gslam::usedBetween(before, tree.read());
  EXPECT_GE(used.voluntary_switches, 500u);
  EXPECT_LE(used.voluntary_switches, 600u);
}

TEST(ProcessUsage, knowsItsOwnProcess) {
  ProcessTree tree;
  EXPECT_EQ(tree.root(), long(getpid()));
  const ProcessUsage before = tree.read();
  const std::int64_t clock = tree.cpuTime();
  std::thread waiting([] {
    for (int i = 0; i < 200; ++i) usleep(100);
  });
  waiting.join();
  volatile double sum = 0;
  const auto begin = std::chrono::steady_clock::now();
  while (spender::secondsSince(begin) < 0.1) sum = sum + 1;
  const ProcessUsage used = gslam::usedBetween(before, tree.read());
  EXPECT_GE(used.voluntary_switches, 200u);  // of a thread that has ended
  EXPECT_GT(used.cpu_seconds, 0.01);
  EXPECT_GT(tree.cpuTime(), clock);
}

TEST(ProcessUsage, isZeroAfterTheEnd) {
  spender::Child child({"burn", "0.05", "1"});
  ProcessTree tree(treeOf(child.number()));
  child.go();
  child.line();
  const ProcessUsage last = tree.read();
  child.end();
  const ProcessUsage gone = tree.read();
  EXPECT_EQ(gone.processes, 0u);
  EXPECT_EQ(gone.rss_bytes, 0u);
  EXPECT_GE(gone.cpu_seconds, last.cpu_seconds);
  EXPECT_EQ(gone.peak_rss_bytes, last.peak_rss_bytes);
}

}  // namespace
