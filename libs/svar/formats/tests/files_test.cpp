// Files whose suffix says that they are YAML or XML.
#include <gslam/svar/config.h>
#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace {

using gslam::Svar;

TEST(Files, AreLoadedAndSavedBySuffix) {
  const Svar value = Svar::object({{"fps", 30}, {"camera", Svar::object({{"fx", 535.4}})}});
  for (const char* name : {"gslam_files.yaml", "gslam_files.yml", "gslam_files.xml"}) {
    const std::string path = testing::TempDir() + name;
    value.save(path);
    EXPECT_EQ(Svar::load(path), value) << name;
    std::remove(path.c_str());
  }
}

TEST(Files, AreTakenByPrograms) {
  const std::string path = testing::TempDir() + "gslam_program.yaml";
  gslam::saveYaml(path, Svar::object({{"camera", Svar::object({{"fx", 535.4}})}}));
  gslam::Config config("", "", "");
  config.arg<double>("camera.fx", 500, "focal length in pixels");
  config.parse({"--config", path});
  EXPECT_EQ(config.get<double>("camera.fx"), 535.4);
  EXPECT_EQ(config.origin("camera.fx"), path);
  std::remove(path.c_str());
}

TEST(Files, KeepTheErrorsOfTheirFormat) {
  EXPECT_THROW(Svar::load("/no/such/file.yaml"), gslam::FileError);
  EXPECT_THROW(Svar::load("/no/such/file.xml"), gslam::FileError);
}

}  // namespace
