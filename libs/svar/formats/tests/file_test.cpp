// Files: loading, saving, and what is left where that fails.
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace {

using gslam::FileError;
using gslam::Svar;

// A file in the folder of the test that is gone afterwards. Tests run at the same time, so each
// takes another name.
class TestFile {
 public:
  explicit TestFile(const std::string& name) : path_(testing::TempDir() + "gslam_formats_" + name) {
    std::remove(path_.c_str());
  }
  ~TestFile() { std::remove(path_.c_str()); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;

  const std::string& path() const { return path_; }
  void write(const std::string& text) const { gslam::detail::writeTextFile(path_, text); }
  std::string read() const { return gslam::detail::readFile(path_); }

 private:
  std::string path_;
};

template <class F>
std::string errorOf(F call) {
  try {
    call();
  } catch (const gslam::Error& error) {
    return error.what();
  }
  return "(no error)";
}

const Svar kValue = Svar::object({{"stamp", 1305031102.175304}, {"list", Svar::array({1, 2})}});

TEST(YamlFile, IsSavedAndLoaded) {
  const TestFile file("saved.yaml");
  gslam::saveYaml(file.path(), kValue);
  EXPECT_EQ(file.read(), "stamp: 1305031102.175304\nlist: [1, 2]\n");
  EXPECT_EQ(gslam::loadYaml(file.path()), kValue);
}

TEST(YamlFile, OfSeveralDocuments) {
  const TestFile file("documents.yaml");
  file.write("1\n---\n2\n");
  EXPECT_EQ(gslam::loadYamlDocuments(file.path()), (std::vector<Svar>{1, 2}));
  EXPECT_EQ(
      errorOf([&] { gslam::loadYaml(file.path()); }),
      file.path() +
          ":2:1: expected one document, found a second one; parseYamlDocuments() reads them all");
}

TEST(YamlFile, OptionsArePassedOn) {
  const TestFile file("options.yaml");
  file.write("a: 1\na: 2\n");
  gslam::YamlOptions options;
  options.allow_duplicate_names = true;
  EXPECT_EQ(gslam::loadYaml(file.path(), options), Svar::object({{"a", 2}}));
  EXPECT_EQ(gslam::loadYamlDocuments(file.path(), options).size(), 1u);
  EXPECT_EQ(errorOf([&] { gslam::loadYaml(file.path()); }),
            file.path() + ":2:1: expected each name once, found \"a\" also at line 1, column 1");
}

TEST(XmlFile, IsSavedAndLoaded) {
  const TestFile file("saved.xml");
  gslam::saveXml(file.path(), kValue);
  EXPECT_EQ(
      file.read(),
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svar>\n  <stamp>1305031102.175304</stamp>\n"
      "  <list>1</list>\n  <list>2</list>\n</svar>\n");
  EXPECT_EQ(gslam::loadXml(file.path()), kValue);
  gslam::XmlOptions options;
  options.max_depth = 1;
  EXPECT_EQ(errorOf([&] { gslam::loadXml(file.path(), options); }),
            file.path() + ":3:4: expected at most 1 elements inside one another, found one more");
}

TEST(AnyFile, ThatCannotBeReadIsAnError) {
  const TestFile file("missing");
  EXPECT_THROW(gslam::loadYaml(file.path()), FileError);
  EXPECT_THROW(gslam::loadYamlDocuments(file.path()), FileError);
  EXPECT_THROW(gslam::loadXml(file.path()), FileError);
  EXPECT_EQ(errorOf([&] { gslam::loadXml(file.path()); }),
            file.path() + ": cannot be opened: No such file or directory");
}

TEST(AnyFile, StaysWhereSavingFails) {
  const TestFile file("stays");
  file.write("1");
  EXPECT_THROW(gslam::saveYaml(file.path(), "\xFF"), gslam::SvarError);
  EXPECT_THROW(gslam::saveXml(file.path(), "\x01"), gslam::SvarError);
  EXPECT_EQ(file.read(), "1");
  const std::string nowhere = testing::TempDir() + "no_such_folder_of_gslam/a";
  EXPECT_THROW(gslam::saveYaml(nowhere, 1), FileError);
  EXPECT_THROW(gslam::saveXml(nowhere, 1), FileError);
}

TEST(AnyFile, SavingReplacesInOneStep) {
  const TestFile file("beside"), left("beside.0.tmp");
  left.write("left");
  gslam::saveYaml(file.path(), 2);
  gslam::saveXml(file.path(), 3);
  EXPECT_EQ(gslam::loadXml(file.path()), Svar(3));
  EXPECT_EQ(left.read(), "left");
  EXPECT_THROW(gslam::detail::readFile(file.path() + ".1.tmp"), FileError);  // none of ours is left
}

}  // namespace
