// Files whose suffix says what they are.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace {

using gslam::FileError;
using gslam::Svar;

std::string errorOfLoad(const std::string& path) {
  try {
    Svar::load(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Load, PicksTheFormatBySuffix) {
  const Svar value = Svar::object({{"fps", 30}, {"list", Svar::array({1.5, "x"})}});
  for (const char* name : {"gslam_load.json", "gslam_load.x.JSON"}) {
    const std::string path = testing::TempDir() + name;
    value.save(path);
    EXPECT_EQ(Svar::load(path), value);
    EXPECT_EQ(gslam::loadJson(path), value);
    std::remove(path.c_str());
  }
}

TEST(Load, SaysWhichFormatsThereAre) {
  EXPECT_EQ(errorOfLoad("a.toml"), "a.toml: has the unknown suffix .toml; known are .json");
  EXPECT_EQ(errorOfLoad("dir.json/a"), "dir.json/a: has no suffix; known are .json");
  EXPECT_EQ(errorOfLoad(""), ": has no suffix; known are .json");
  EXPECT_EQ(errorOfLoad("a.yaml"),
            "a.yaml: has the unknown suffix .yaml; known are .json; for this one include "
            "<gslam/svar_formats.h> and link GSLAM::svar_formats");
  EXPECT_NE(errorOfLoad("/no/such/file.json"), "no error");
  EXPECT_THROW(Svar(1).save("a.toml"), FileError);
  EXPECT_THROW(Svar(1).save("/no/such/folder/a.json"), FileError);
}

Svar loadOne(const std::string&) {
  return 1;
}
void saveNothing(const std::string&, const Svar&) {}

TEST(Load, LearnsFormats) {
  gslam::detail::FileFormats::ofProgram().add({".test", &loadOne, &saveNothing});
  EXPECT_EQ(Svar::load("x.test"), 1);
  EXPECT_NO_THROW(Svar().save("x.test"));
}

}  // namespace
