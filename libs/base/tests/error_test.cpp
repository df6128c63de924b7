#include <gslam/base/error.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <type_traits>

namespace {

using gslam::ArgumentError;
using gslam::Error;
using gslam::FileError;
using gslam::ParseError;

TEST(Error, IsCaughtAsRuntimeError) {
  try {
    throw gslam::FileError("map.bin", "is empty");
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "map.bin: is empty");
  }
}

TEST(Error, CopiesWithoutThrowing) {
  EXPECT_TRUE(std::is_nothrow_copy_constructible<Error>::value);
  EXPECT_TRUE(std::is_nothrow_copy_constructible<ArgumentError>::value);
  EXPECT_TRUE(std::is_nothrow_copy_constructible<FileError>::value);
  EXPECT_TRUE(std::is_nothrow_copy_constructible<ParseError>::value);
}

TEST(ArgumentError, NamesTheArgument) {
  const ArgumentError error("--fps", "is -3, expected 1 or more");
  EXPECT_STREQ(error.what(), "--fps is -3, expected 1 or more");
  EXPECT_EQ(error.argument(), "--fps");
}

TEST(FileError, AddsTheReasonOfTheSystem) {
  const FileError error("a/b.txt", "cannot be opened", ENOENT);
  EXPECT_STREQ(error.what(), "a/b.txt: cannot be opened: No such file or directory");
  EXPECT_EQ(error.path(), "a/b.txt");
}

TEST(ParseError, PointsAtThePlace) {
  const ParseError error("c.json", 3, 14, "expected ',', found 'x'");
  EXPECT_STREQ(error.what(), "c.json:3:14: expected ',', found 'x'");
  EXPECT_EQ(error.source(), "c.json");
  EXPECT_EQ(error.line(), 3u);
  EXPECT_EQ(error.column(), 14u);
}

TEST(ParseError, LeavesOutWhatIsUnknown) {
  EXPECT_STREQ(ParseError("c.csv", 3, 0, "two fields").what(), "c.csv:3: two fields");
  EXPECT_STREQ(ParseError("c.bin", 0, 0, "bad magic").what(), "c.bin: bad magic");
  EXPECT_STREQ(ParseError("c.bin", 0, 9, "bad magic").what(), "c.bin: bad magic");
}

}  // namespace
