#include <gslam/base/detail/new_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

using gslam::detail::NewFile;

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

class ANewFile : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/new_file_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    for (const char* const file : {"/file", "/link"}) std::remove((folder_ + file).c_str());
    EXPECT_EQ(rmdir(folder_.c_str()), 0) << "something was left behind";
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

 private:
  std::string folder_;
};

TEST_F(ANewFile, AppearsWhenItIsCommitted) {
  gslam::detail::writeTextFile(path("file"), "old");
  {
    NewFile file(path("file"));
    file.write("new", 3);
    EXPECT_EQ(contentOf(path("file")), "old");
    file.commit();
  }
  EXPECT_EQ(contentOf(path("file")), "new");
}

TEST_F(ANewFile, LeavesNothingWithoutCommit) {
  gslam::detail::writeTextFile(path("file"), "old");
  { NewFile(path("file")).write("new", 3); }
  EXPECT_EQ(contentOf(path("file")), "old");
}

TEST_F(ANewFile, GoesWhereALinkLeads) {
  gslam::detail::writeTextFile(path("file"), "old");
  ASSERT_EQ(symlink("file", path("link").c_str()), 0);
  gslam::detail::writeTextFile(path("link"), "new");
  EXPECT_EQ(contentOf(path("file")), "new");
}

// What processes leave that were ended while they wrote.
TEST_F(ANewFile, IsNotHinderedByWhatOthersLeft) {
  std::vector<std::string> left;
  for (int i = 0; i < 200; ++i) left.push_back(path("file.") + std::to_string(i) + ".tmp");
  for (const std::string& name : left) std::ofstream(name) << "half";
  gslam::detail::writeTextFile(path("file"), "new");
  EXPECT_EQ(contentOf(path("file")), "new");
  for (const std::string& name : left) {
    EXPECT_EQ(contentOf(name), "half");
    std::remove(name.c_str());
  }
}

TEST_F(ANewFile, SaysWhyItCannotBe) {
  try {
    NewFile file(path("no/folder"));
    FAIL();
  } catch (const gslam::FileError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
}

}  // namespace
