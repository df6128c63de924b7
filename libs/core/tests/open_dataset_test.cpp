#include <gmock/gmock.h>
#include <gslam/core/open_dataset.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "scripted_slam.h"

namespace {

using gslam::DatasetFactory;
using gslam::openDataset;
using gslam::Svar;

// Plugins that know one kind of dataset for each suffix, and remember what was opened.
class OpenDataset : public testing::Test {
 protected:
  void SetUp() override {
    add("one", ".one");
    add("two", ".two");
    add("also_two", ".two");
  }

  void add(const std::string& name, const std::string& suffix) {
    DatasetFactory factory;
    factory.name = name;
    factory.parameters = Svar::object({{"rate", 20}});
    factory.recognizes = [suffix](const std::string& path) {
      return path.size() > suffix.size() && path.substr(path.size() - suffix.size()) == suffix;
    };
    factory.open = [this, name](const std::string& path, const Svar& parameters) {
      opened_ = name + " " + path + " " + std::to_string(parameters.get<int>("rate"));
      return std::unique_ptr<gslam::Dataset>(scripted::dataset(1).release());
    };
    plugins_.add(factory);
  }

  std::string open(const std::string& what, const Svar& parameters = Svar()) {
    opened_ = "nothing";
    EXPECT_NE(openDataset(plugins_, what, parameters), nullptr);
    return opened_;
  }

  std::string refusalOf(const std::string& what) {
    try {
      openDataset(plugins_, what);
    } catch (const gslam::Error& error) {
      return error.what();
    }
    return "none";
  }

  static std::string file(const std::string& name) {
    const std::string path = testing::TempDir() + name;
    std::ofstream(path) << "x";
    return path;
  }

  gslam::Plugins plugins_{std::vector<std::string>()};
  std::string opened_;
};

TEST_F(OpenDataset, ByItsFile) {
  const std::string path = file("a.one");
  EXPECT_EQ(open(path), "one " + path + " 20");
  std::remove(path.c_str());
  EXPECT_THAT(refusalOf(path), testing::HasSubstr("does not exist"));
}

TEST_F(OpenDataset, ByItsKindWhereSeveralRecognizeIt) {
  const std::string path = file("a.two");
  EXPECT_THAT(refusalOf(path), testing::HasSubstr("two, also_two"));
  EXPECT_EQ(open("also_two:" + path), "also_two " + path + " 20");
  std::remove(path.c_str());
}

TEST_F(OpenDataset, ByNameOrUrl) {
  EXPECT_EQ(open("one"), "one one 20");
  EXPECT_EQ(open("one://room?seed=1"), "one one://room?seed=1 20");
  EXPECT_EQ(open("one", Svar::object({{"rate", 5}})), "one one 5");
}

TEST_F(OpenDataset, AFileWithTheNameOfAKindDoesNotHideIt) {
  const std::string path = file("one");
  ASSERT_EQ(chdir(testing::TempDir().c_str()), 0);
  EXPECT_EQ(open("one"), "one one 20");
  std::remove(path.c_str());
}

TEST_F(OpenDataset, AFactoryThatOpensNoneIsAnError) {
  DatasetFactory factory;
  factory.name = "none";
  factory.open = [](const std::string&, const Svar&) { return std::unique_ptr<gslam::Dataset>(); };
  plugins_.add(factory);
  EXPECT_THAT(refusalOf("none"), testing::HasSubstr("opened none"));
}

TEST_F(OpenDataset, SaysWhatIsWrong) {
  EXPECT_THAT(refusalOf("on"), testing::HasSubstr("one"));
  EXPECT_THAT(refusalOf("three://room"), testing::HasSubstr("three"));
  EXPECT_THAT(refusalOf("/nowhere/at/all"), testing::HasSubstr("does not exist"));
  EXPECT_NE(refusalOf(""), "none");
  EXPECT_THROW(openDataset(plugins_, "one", Svar::object({{"rat", 5}})), gslam::SvarError);
}

}  // namespace
