// TUM RGB-D: real data, its layout in small, and what goes wrong.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include <functional>
#include <sstream>

#include "format_case.h"
#include "test_data.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)
using gslam::tumFactory;

// Four images of 16 x 12, with depth 5 ms later.
class TumFolder {
 public:
  explicit TumFolder(const std::string& recording = "rgbd_dataset_freiburg2_desk") {
    std::string rgb = "# color images\n# file: '" + recording + ".bag'\n# timestamp filename\n";
    std::string depth = "# depth maps\n";
    std::string truth = "# ground truth trajectory\n";
    for (int i = 0; i < 4; ++i) {
      const std::string stamp = "100." + std::to_string(i), later = stamp + "05";
      writeImage(folder / ("rgb/" + stamp + ".png"), numbered(16, 12, i, CV_8UC3));
      writeImage(folder / ("depth/" + later + ".png"), numbered(16, 12, i, CV_16UC1));
      rgb += stamp + " rgb/" + stamp + ".png\n";
      depth += later + " depth/" + later + ".png\n";
      truth += stamp + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
    }
    writeText(folder / "rgb.txt", rgb);
    writeText(folder / "depth.txt", depth);
    writeText(folder / "groundtruth.txt", truth);
  }
  std::string operator/(const std::string& name) const { return folder / name; }
  const std::string& path() const { return folder.path(); }
  std::string error(const Svar& parameters = Svar()) const {
    return errorOf(tumFactory(), path(), parameters);
  }

  TempFolder folder;
};

std::string realRpy() {
  return test_data::folder() + "sequences/tum_rgbd_freiburg1_rpy";
}

// The most pairs within a tolerance, by augmenting paths.
std::size_t mostPairs(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b,
                      std::int64_t tolerance) {
  std::vector<int> partner(b.size(), -1);
  std::vector<bool> seen;
  std::function<bool(std::size_t)> augment = [&](std::size_t i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (seen[j] || std::abs(a[i] - b[j]) > tolerance) continue;
      seen[j] = true;
      if (partner[j] >= 0 && !augment(std::size_t(partner[j]))) continue;
      partner[j] = int(i);
      return true;
    }
    return false;
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    seen.assign(b.size(), false);
    if (augment(i)) ++count;
  }
  return count;
}

std::vector<std::int64_t> stampsIn(const std::string& list) {
  std::vector<std::int64_t> stamps;
  for (const auto& row : export_case::readTable(list)) {
    stamps.push_back(export_case::stampOf(row[0]));
  }
  return stamps;
}

TEST(readTum, RealRecording) {
  NEEDS_TEST_DATA();
  EXPECT_EQ(gslam::datasetFormatOf(realRpy()), "tum");
  const auto dataset = open(tumFactory(), realRpy());
  const gslam::DatasetInfo& info = dataset->info();
  EXPECT_EQ(info.licence, "CC BY 4.0");
  ASSERT_EQ(info.sensors.cameras.size(), 2U);
  EXPECT_EQ(
      info.sensors.cameras[0].camera.parameters(),
      (std::vector<double>{517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633}));
  EXPECT_EQ(info.sensors.cameras[1].camera, info.sensors.cameras[0].camera);
  EXPECT_EQ(info.sensors.cameras[1].depth_scale, 1.0 / 5000);
  EXPECT_EQ(info.ground_truth.size(), 2742U);
  EXPECT_EQ(info.ground_truth[0].stamp, 1305031225933400000);
  EXPECT_FALSE(info.sensors.has_imu);
  EXPECT_TRUE(says(info.remarks, "14070 accelerations"));
  EXPECT_TRUE(says(info.remarks, "freiburg1"));
  const auto frames = allFrames(*dataset);
  EXPECT_EQ(frames[0]->stamp, 1305031234861873000);
  EXPECT_EQ(frames[0]->images[0].kind, ImageKind::bgr);
  const cv::Mat colour = export_case::readImage(realRpy() + "/rgb/1305031234.893760.png");
  EXPECT_TRUE(export_case::samePixels<std::uint8_t>(colour, frames[1]->images[0].image, {0, 1, 2}));
}

TEST(readTum, AssociatesAsManyAsCanBe) {
  NEEDS_TEST_DATA();
  const auto rgb = stampsIn(realRpy() + "/rgb.txt"), depth = stampsIn(realRpy() + "/depth.txt");
  EXPECT_EQ(rgb.size(), 60U);
  EXPECT_EQ(depth.size(), 61U);
  for (const double tolerance : {0.02, 0.01, 0.009, 0.005}) {
    const auto nanoseconds = std::int64_t(std::llround(tolerance * 1e9));
    const auto dataset = open(tumFactory(), realRpy(), Svar::object({{"tolerance", tolerance}}));
    EXPECT_EQ(dataset->info().frame_count, mostPairs(rgb, depth, nanoseconds)) << tolerance;
    EXPECT_TRUE(says(dataset->info().remarks, "without one of each other camera"));
  }
}

TEST(readTum, DepthAndPosesFitTogether) {
  NEEDS_TEST_DATA();
  const auto dataset = open(tumFactory(), realRpy());
  const auto frames = allFrames(*dataset);
  for (const std::size_t i : {0U, 20U, 40U}) {
    const Frame &a = *frames[i], &b = *frames[i + 8];
    const SE3d T_b_a = truthBetween(*dataset, a, b);
    ASSERT_GT(T_b_a.rotation().angle(), 0.05) << "else it tells nothing";
    const Warp right = warp(a, b, T_b_a), inverse = warp(a, b, T_b_a.inverse());
    const Warp none = warp(a, b, SE3d());
    EXPECT_GT(right.points, 1000);
    EXPECT_LT(right.depth_error, 0.02);
    EXPECT_LT(right.depth_error, 0.5 * none.depth_error) << i;
    EXPECT_LT(right.depth_error, 0.5 * inverse.depth_error) << i;
    EXPECT_LT(right.grey_error, 0.6 * none.grey_error);
    EXPECT_LT(right.grey_error, 0.6 * inverse.grey_error);
    RecordProperty("frame" + std::to_string(i), std::to_string(right.depth_error) + " " +
                                                    std::to_string(right.grey_error) + " none " +
                                                    std::to_string(none.depth_error) + " " +
                                                    std::to_string(none.grey_error) + " inverse " +
                                                    std::to_string(inverse.grey_error));
  }
}

TEST(readTum, CalibrationByName) {
  const auto cameraOf = [](const std::string& recording) {
    const TumFolder tum(recording);
    const auto dataset = open(tumFactory(), tum.path());
    const gslam::Camera camera = dataset->info().sensors.cameras[0].camera;
    EXPECT_EQ(camera.width(), 16);
    EXPECT_EQ(says(dataset->info().remarks, "a guess"), !has(recording, "freiburg"));
    return camera;
  };
  const auto published = [](const std::vector<double>& values) {
    return gslam::Camera::fromParameters(values.size() > 4 ? "radtan" : "pinhole", 640, 480, values)
        .resized(16, 12);
  };
  EXPECT_EQ(cameraOf("rgbd_dataset_freiburg2_desk"),
            published({520.9, 521.0, 325.1, 249.7, 0.2312, -0.7849, -0.0033, -0.0001, 0.9172}));
  EXPECT_EQ(cameraOf("rgbd_dataset_freiburg3_office"), published({535.4, 539.2, 320.1, 247.6}));
  EXPECT_EQ(cameraOf("kitchen"), published({525, 525, 319.5, 239.5}));
}

TEST(readTum, TheRecordingIsBelievedBeforeTheFolder) {
  const auto published = [](const std::string& folder, const std::string& recording) {
    const TumFolder tum(recording);
    const TempFolder around;
    fs::copy(tum.path(), around / folder, fs::copy_options::recursive);
    const auto dataset = open(tumFactory(), around / folder);
    for (int i = 1; i <= 3; ++i) {
      if (says(dataset->info().remarks, "published one of freiburg" + std::to_string(i))) return i;
    }
    EXPECT_TRUE(says(dataset->info().remarks, "a guess"));
    EXPECT_EQ(dataset->info().licence, "");
    return 0;
  };
  EXPECT_EQ(published("fr1_backup", "rgbd_dataset_freiburg3_office"), 3);
  EXPECT_EQ(published("my_fr3", "kitchen"), 3);
  EXPECT_EQ(published("fr2", "kitchen"), 2);
  for (const char* name : {"fr10", "my_fr12", "freiburg11", "fr1234_x"}) {
    EXPECT_EQ(published(name, "kitchen"), 0) << name;
    EXPECT_EQ(published("x", name), 0) << name;
  }
  EXPECT_EQ(published("fr10_fr2", "kitchen"), 2);
}

TEST(readTum, WhatEth3dHasMoreIsSaid) {
  const TumFolder tum;
  const auto before = open(tumFactory(), tum.path());
  EXPECT_FALSE(says(before->info().remarks, "was not read"));
  writeText(tum / "imu.txt", "100.0 1 2 3 4 5 6\n");
  fs::create_directories(tum / "rgb2");
  const auto dataset = open(tumFactory(), tum.path());
  EXPECT_TRUE(says(dataset->info().remarks, "imu.txt was not read"));
  EXPECT_TRUE(says(dataset->info().remarks, "rgb2, the second colour camera, was not read"));
}

TEST(readTum, CalibrationByFileOrParameter) {
  const TumFolder tum;
  writeText(tum / "calibration.txt", "15.5 15.25 7.5 5.5 0.1 0 0 0 0\r\n");
  const auto by_file = open(tumFactory(), tum.path());
  EXPECT_EQ(
      by_file->info().sensors.cameras[0].camera,
      gslam::Camera::fromParameters("radtan", 16, 12, {15.5, 15.25, 7.5, 5.5, 0.1, 0, 0, 0, 0}));
  const Svar words = Svar::object({{"camera", "pinhole 16x12 20 21 8 6"}});
  const auto by_parameter = open(tumFactory(), tum.path(), words);
  EXPECT_EQ(by_parameter->info().sensors.cameras[1].camera,
            gslam::Camera::fromParameters("pinhole", 16, 12, {20, 21, 8, 6}));
  EXPECT_TRUE(has(tum.error(Svar::object({{"camera", "pinhole 20x12 20 21 8 6"}})), "16 x 12"));
  writeText(tum / "calibration.txt", "15.5 15.25 7.5\n");
  EXPECT_TRUE(has(tum.error(), "calibration.txt:1:1"));
  writeText(tum / "calibration.txt", "\n");
  EXPECT_TRUE(has(tum.error(), "calibration.txt"));
}

TEST(readTum, WithoutDepth) {
  const TumFolder tum;
  const auto mono = open(tumFactory(), tum.path(), Svar::object({{"depth", false}}));
  EXPECT_EQ(mono->info().sensors.cameras.size(), 1U);
  fs::remove(tum / "depth.txt");
  const auto missing = open(tumFactory(), tum.path());
  EXPECT_EQ(missing->info().sensors.cameras.size(), 1U);
  EXPECT_EQ(missing->info().frame_count, 4U);
  EXPECT_TRUE(says(missing->info().remarks, "no depth.txt"));
}

TEST(readTum, ArchiveReadsTheSame) {
  const TumFolder tum;
  const TempFolder zips;
  zipFolder(tum.path(), zips / "a.zip");
  zipFolder(tum.path(), zips / "b.zip", "rgbd_dataset_freiburg2_desk/");
  for (const char* name : {"a.zip", "b.zip"}) {
    EXPECT_EQ(gslam::datasetFormatOf(zips / name), "tum");
    const auto folder = open(tumFactory(), tum.path()), zip = open(tumFactory(), zips / name);
    expectSame(*folder, *zip);
  }
}

TEST(readTum, ListsThatAreOutOfOrder) {
  const TumFolder tum;
  writeText(tum / "rgb.txt",
            "\xEF\xBB\xBF# x\r\n100.2 rgb/100.2.png\r\n100.0 rgb/100.0.png\r\n"
            "100.2 rgb/100.3.png\r\n100.25 rgb/none.png\r\n");
  const auto dataset = open(tumFactory(), tum.path());
  EXPECT_EQ(dataset->info().frame_count, 2U);
  EXPECT_EQ(dataset->info().first_stamp, 100000000000);
  EXPECT_TRUE(says(dataset->info().remarks, "sorted"));
  EXPECT_TRUE(says(dataset->info().remarks, "rgb/none.png (rgb.txt:5)"));
  EXPECT_TRUE(says(dataset->info().remarks, "rgb/100.3.png (rgb.txt:4)"));
  EXPECT_TRUE(says(dataset->info().remarks, "2 images of camera 'depth'"));
}

TEST(readTum, FilesThatAreWrong) {
  const TumFolder tum;
  EXPECT_TRUE(has(tum.error(Svar::object({{"tolerance", -1.0}})), "tolerance is -1"));
  EXPECT_TRUE(has(tum.error(Svar::object({{"depth_factor", 0.0}})), "depth_factor is 0"));
  EXPECT_TRUE(has(tum.error(Svar::object({{"tolerance", 0.001}})), "no frame"));
  writeText(tum / "groundtruth.txt", "100.0 0 0 0 0 0 0 1\n100.1 nan 0 0 0 0 0 1\n");
  EXPECT_TRUE(has(tum.error(), "groundtruth.txt:2:7"));
  writeText(tum / "groundtruth.txt", "100.0 0 0 0 0 0 1\n");
  EXPECT_TRUE(has(tum.error(), "groundtruth.txt:1"));
  writeText(tum / "groundtruth.txt", "100.0 0 0 0 0 0 0 1\n100.0 1 0 0 0 0 0 1\n");
  const auto twins = open(tumFactory(), tum.path());
  EXPECT_EQ(twins->info().ground_truth.size(), 1U);
  EXPECT_TRUE(says(twins->info().remarks, "in 1 line, skipped"));
  writeText(tum / "groundtruth.txt", "# nothing\n");
  EXPECT_TRUE(says(open(tumFactory(), tum.path())->info().remarks, "has no pose"));
  fs::remove(tum / "groundtruth.txt");
  EXPECT_TRUE(says(open(tumFactory(), tum.path())->info().remarks, "no groundtruth.txt"));
  writeText(tum / "accelerometer.txt", "100.0 1 2 3\n100.1 1 2\n");  // which nobody gets
  const auto faulty = open(tumFactory(), tum.path());
  EXPECT_TRUE(says(faulty->info().remarks, "accelerometer.txt:2"));
  EXPECT_EQ(faulty->info().frame_count, 4U);
  writeText(tum / "depth.txt", "100.0 rgb/100.0.png\n");
  EXPECT_TRUE(has(tum.error(), "rgb/100.0.png: is no depth image"));
  writeText(tum / "rgb.txt", "100.0\n");
  EXPECT_TRUE(has(tum.error(), "rgb.txt:1"));
  writeText(tum / "rgb.txt", "");
  EXPECT_TRUE(has(tum.error(), "rgb.txt"));
  const TempFolder empty;
  EXPECT_TRUE(has(errorOf(tumFactory(), empty.path()), "has no rgb.txt"));
}

TEST(readTum, ImagesThatAreBroken) {
  const TumFolder tum;
  cutInHalf(tum / "depth/100.105.png");
  const auto dataset = open(tumFactory(), tum.path());
  ASSERT_NE(dataset->next(), nullptr);
  EXPECT_THROW(dataset->next(), gslam::FileError);
  EXPECT_NE(dataset->next(), nullptr);
  cutInHalf(tum / "rgb/100.0.png");
  EXPECT_TRUE(has(tum.error(), "rgb/100.0.png"));
}

TEST(readTum, ReadsWhatIsExported) {
  const TempFolder folder;
  gslam::SyntheticOptions options;
  options.width = 80;
  options.height = 60;
  options.frames = 4;
  options.colour = true;
  const auto source = gslam::openSynthetic(options);
  gslam::exportDataset(*source, folder / "tum", "tum");
  const auto read = open(tumFactory(), folder / "tum");
  const auto frames = allFrames(*read);
  ASSERT_EQ(frames.size(), 4U);
  const SE3d T_body_camera = source->info().sensors.cameras[0].T_body_camera;
  for (std::size_t i = 0; i < 4; ++i) {
    source->seek(i);
    const auto original = source->next();
    EXPECT_EQ(frames[i]->stamp, original->stamp);
    EXPECT_EQ(frames[i]->images[0].camera, original->images[0].camera);
    SE3d expected, found;
    ASSERT_TRUE(source->info().ground_truth.interpolate(original->stamp, expected));
    ASSERT_TRUE(read->info().ground_truth.interpolate(original->stamp, found));
    EXPECT_TRUE(found.isApprox(expected * T_body_camera, 1e-9));
    for (const int x : {3, 40, 77}) {
      const double metres = depthAt(original->images[1], x, 30);
      EXPECT_NEAR(depthAt(frames[i]->images[1], x, 30), metres, 1e-3);
      for (int c = 0; c < 3; ++c) {  // written as rgb, read as bgr
        EXPECT_EQ(frames[i]->images[0].image.at<std::uint8_t>(x, 30, 2 - c),
                  original->images[0].image.at<std::uint8_t>(x, 30, c));
      }
    }
  }
}

}  // namespace
