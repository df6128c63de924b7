// Strecha's multi-view benchmark: real data, its layout in small, and what goes wrong. That matches
// lie on epipolar lines is tested in tests/opencv.
#include <gslam/datasets/formats.h>

#include "format_case.h"
#include "test_data.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)
using gslam::strechaFactory;

const char* const kCameraFile =
    "20 0 15.5 \n0 21 11.5 \n0 0 1 \n0 0 0\n0 0 1 \n1 0 0 \n0 1 0 \n-7 -8 0.5 \n32 24\n";

void writeFolder(const TempFolder& folder) {
  for (const char* name : {"0000.jpg", "0001.jpg", "0002.jpg"}) {
    writeImage(folder / ("images/" + std::string(name)), numbered(16, 12, name[3], CV_8UC3));
    writeText(folder / ("gt_dense_cameras/" + std::string(name) + ".camera"), kCameraFile);
  }
}

TEST(readStrecha, RealFountain) {
  NEEDS_TEST_DATA();
  const std::string root = test_data::folder() + "sfm/strecha_fountain_P11";
  EXPECT_EQ(gslam::datasetFormatOf(root), "strecha");
  const auto dataset = open(strechaFactory(), root);
  const gslam::DatasetInfo& info = dataset->info();
  EXPECT_EQ(info.frame_count, 11U);
  ASSERT_EQ(info.sensors.cameras.size(), 1U);
  const gslam::Camera& camera = info.sensors.cameras[0].camera;
  EXPECT_EQ(camera, gslam::Camera::fromParameters("pinhole", 1536, 1024,
                                                  {1379.74, 1382.08, 760.095, 503.155}));
  EXPECT_FALSE(says(info.remarks, "differs"));  // K.txt is what scaling gives
  ASSERT_EQ(info.ground_truth.size(), 11U);
  const SE3d& first = info.ground_truth[0].pose;
  EXPECT_TRUE(first.translation() == (Vec3d{-7.28137, -7.57667, 0.204446}));
  EXPECT_NEAR(first.rotation().matrix()(0, 2), -0.887537, 1e-5);
  EXPECT_TRUE(says(info.remarks, "1 s apart"));
  dataset->seek(7);
  const auto frame = dataset->next();
  EXPECT_EQ(frame->stamp, 7000000000);
  const cv::Mat file = export_case::readImage(root + "/images/0007.jpg");
  EXPECT_TRUE(export_case::samePixels<std::uint8_t>(file, frame->images[0].image, {0, 1, 2}));
}

TEST(readStrecha, CamerasAreScaledToTheImages) {
  const TempFolder folder;
  writeFolder(folder);
  const auto dataset = open(strechaFactory(), folder.path());
  const gslam::Camera& camera = dataset->info().sensors.cameras[0].camera;
  // Borders stay borders: half of 15.5 + 0.5, less 0.5.
  EXPECT_EQ(camera, gslam::Camera::fromParameters("pinhole", 16, 12, {10, 10.5, 7.5, 5.5}));
  EXPECT_TRUE(says(dataset->info().remarks, "scaled"));
  // X_camera = R^T (X - centre): the camera's z axis is the third column of R.
  const SE3d& pose = dataset->info().ground_truth[1].pose;
  EXPECT_LT((pose * Vec3d{0, 0, 2} - Vec3d{-5, -8, 0.5}).norm(), 1e-14);

  writeText(folder / "images/K.txt", "13 0 7\r\n0 10.5 5\r\n0 0 1\r\n");
  const auto given = open(strechaFactory(), folder.path());
  EXPECT_EQ(given->info().sensors.cameras[0].camera,
            gslam::Camera::fromParameters("pinhole", 16, 12, {13, 10.5, 7, 5}));
  EXPECT_TRUE(says(given->info().remarks, "differs from the cameras by up to 3"));
  writeText(folder / "images/K.txt", "-13 0 7\r\n0 10.5 5\r\n0 0 1\r\n");
  EXPECT_TRUE(has(errorOf(strechaFactory(), folder.path()), "K.txt:1"));
}

TEST(readStrecha, OtherPlacesAndArchives) {
  const TempFolder folder, flat;
  writeFolder(folder);
  for (const char* name : {"0000.png", "0001.png"}) {
    writeImage(flat / name, numbered(32, 24, name[3]));
    writeText(flat / (std::string(name) + ".camera"), kCameraFile);
  }
  EXPECT_EQ(gslam::datasetFormatOf(flat.path()), "strecha");
  const auto dataset = open(strechaFactory(), flat.path());
  EXPECT_EQ(dataset->info().frame_count, 2U);
  EXPECT_EQ(dataset->info().sensors.cameras[0].camera,
            gslam::Camera::fromParameters("pinhole", 32, 24, {20, 21, 15.5, 11.5}));
  const TempFolder zips;
  zipFolder(folder.path(), zips / "fountain.zip", "fountain/");
  EXPECT_EQ(gslam::datasetFormatOf(zips / "fountain.zip"), "strecha");
  const auto a = open(strechaFactory(), folder.path());
  const auto b = open(strechaFactory(), zips / "fountain.zip");
  expectSame(*a, *b);
}

TEST(readStrecha, FilesThatAreWrong) {
  const TempFolder folder;
  writeFolder(folder);
  const std::string file = folder / "gt_dense_cameras/0001.jpg.camera", whole = kCameraFile;
  const auto errorWith = [&](const std::string& text) {
    writeText(file, text);
    return errorOf(strechaFactory(), folder.path());
  };
  EXPECT_TRUE(has(errorWith(whole + "1"), "0001.jpg.camera:10:1"));
  EXPECT_TRUE(has(errorWith(whole.substr(0, whole.size() - 3)), "0001.jpg.camera:9"));
  EXPECT_TRUE(has(errorWith("nan" + whole), "0001.jpg.camera:1:1"));
  EXPECT_TRUE(has(errorWith("1 2 3 4 5 6 7 8 9" + whole.substr(whole.find("\n0 0 0\n"))), "no K"));
  std::string text = whole;
  EXPECT_TRUE(has(errorWith(text.replace(text.find("\n0 0 0\n"), 7, "\n0 1 0\n")), ".camera:4"));
  text = whole;
  EXPECT_TRUE(has(errorWith(text.replace(text.find("\n0 1 0 \n"), 8, "\n0 2 0 \n")), ".camera:5"));
  text = whole;
  EXPECT_TRUE(has(errorWith(text.replace(text.find("32 24"), 5, "32.5 24")), ".camera:9"));
  text = whole;
  errorWith(text.replace(0, 2, "25"));
  const auto other = open(strechaFactory(), folder.path());
  EXPECT_EQ(other->info().frame_count, 2U);
  EXPECT_TRUE(says(other->info().remarks, "another camera"));
  fs::remove(file);
  const auto missing = open(strechaFactory(), folder.path());
  EXPECT_EQ(missing->info().frame_count, 2U);
  EXPECT_TRUE(says(missing->info().remarks, "0001.jpg"));
  cutInHalf(folder / "images/0002.jpg");
  const auto cut = open(strechaFactory(), folder.path());
  ASSERT_NE(cut->next(), nullptr);
  EXPECT_THROW(cut->next(), gslam::FileError);
  fs::remove_all(folder / "images");
  EXPECT_TRUE(has(errorOf(strechaFactory(), folder.path()), "has no images"));
  const TempFolder empty;
  EXPECT_TRUE(has(errorOf(strechaFactory(), empty.path()), "has no <image>.camera"));
}

}  // namespace
