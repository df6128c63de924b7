// JSON files: loading, saving, and what is left where that fails.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "error_text.h"

namespace {

using gslam::FileError;
using gslam::loadJson;
using gslam::ParseError;
using gslam::saveJson;
using gslam::Svar;

// A file in the folder of the test that is gone afterwards. Tests run at the same time, so each
// takes another name.
class TestFile {
 public:
  explicit TestFile(const std::string& name) : path_(testing::TempDir() + "gslam_json_" + name) {
    std::remove(path_.c_str());
  }
  ~TestFile() { std::remove(path_.c_str()); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;

  const std::string& path() const { return path_; }
  void write(const std::string& text) const {
    std::FILE* const file = std::fopen(path_.c_str(), "wb");
    ASSERT_NE(file, nullptr);
    EXPECT_EQ(std::fwrite(text.data(), 1, text.size(), file), text.size());
    std::fclose(file);
  }
  std::string read() const { return gslam::detail::readFile(path_); }

 private:
  std::string path_;
};

TEST(JsonFile, IsLoaded) {
  const TestFile file("loaded.json");
  file.write("{\n  \"fps\": 30, // frames a second\n  \"k\": [535.4, 1]\n}\n");
  gslam::JsonOptions options;
  options.comments = true;
  EXPECT_EQ(loadJson(file.path(), options),
            Svar::object({{"fps", 30}, {"k", Svar::array({535.4, 1})}}));
  EXPECT_EQ(errorText<ParseError>([&] { loadJson(file.path()); }),
            file.path() +
                ":2:14: expected a name in quotes, found '/' (comments are accepted on "
                "request only)");
}

TEST(JsonFile, MayBeLong) {
  const TestFile file("long.json");
  for (const std::size_t size : {65534u, 65535u, 65536u, 65537u, 196608u, 1000000u}) {
    file.write("\"" + std::string(size - 2, 'x') + "\"");
    EXPECT_EQ(loadJson(file.path()), Svar(std::string(size - 2, 'x')));
  }
}

TEST(JsonFile, ThatCannotBeReadIsAnError) {
  const TestFile file("missing.json");
  EXPECT_THROW(loadJson(file.path()), FileError);
  EXPECT_EQ(errorText<FileError>([&] { loadJson(file.path()); }),
            file.path() + ": cannot be opened: No such file or directory");
  const std::string folder = testing::TempDir();
  EXPECT_THROW(loadJson(folder), FileError);
  EXPECT_NE(errorText<FileError>([&] { loadJson(folder); }).find("Is a directory"),
            std::string::npos);
}

TEST(JsonFile, ThatIsEmptyIsAnError) {
  const TestFile file("empty.json");
  file.write("");
  EXPECT_EQ(errorText<ParseError>([&] { loadJson(file.path()); }),
            file.path() + ":1:1: the text is empty, expected a value");
}

TEST(JsonFile, IsSaved) {
  const TestFile file("saved.json");
  const Svar value = Svar::object({{"stamp", 1305031102.175304}, {"list", Svar::array({1})}});
  saveJson(file.path(), value);
  EXPECT_EQ(file.read(), "{\n  \"stamp\": 1305031102.175304,\n  \"list\": [\n    1\n  ]\n}\n");
  EXPECT_EQ(loadJson(file.path()), value);
  saveJson(file.path(), Svar(1), 0);
  EXPECT_EQ(file.read(), "1\n");
}

TEST(JsonFile, StaysWhereSavingFails) {
  const TestFile file("stays.json");
  file.write("1");
  Svar wrong = Svar::array({"\xFF"});
  EXPECT_THROW(saveJson(file.path(), wrong), gslam::SvarError);
  EXPECT_EQ(file.read(), "1");
}

TEST(JsonFile, ThatCannotBeWrittenIsAnError) {
  const std::string path = testing::TempDir() + "no_such_folder_of_gslam/a.json";
  EXPECT_THROW(saveJson(path, 1), FileError);
  EXPECT_EQ(errorText<FileError>([&] { saveJson(path, 1); }),
            path + ": cannot be written: No such file or directory");
}

TEST(JsonFile, SavingWorksBesideWhatAnotherLeft) {
  const TestFile file("beside.json"), left("beside.json.0.tmp");
  left.write("left");
  saveJson(file.path(), 2);
  EXPECT_EQ(file.read(), "2\n");
  EXPECT_EQ(left.read(), "left");
  EXPECT_THROW(gslam::detail::readFile(file.path() + ".1.tmp"), FileError);  // none of ours is left
}

TEST(JsonFile, SavingIntoAFolderIsAnErrorThatLeavesNothing) {
  const std::string folder = testing::TempDir() + ".";
  EXPECT_THROW(saveJson(folder, 1), FileError);
  EXPECT_THROW(gslam::detail::readFile(folder + ".0.tmp"), FileError);
}

}  // namespace
