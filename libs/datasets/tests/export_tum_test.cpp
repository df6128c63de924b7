#include <cmath>

#include "export_case.h"
#include "test_data.h"

namespace {

using namespace export_case;  // NOLINT(google-build-using-namespace)
using gslam::exportDataset;
using gslam::ExportReport;

Case rgbd() {
  Case c;
  c.models = {"radtan5"};
  c.kind = ImageKind::rgb;
  c.has_depth = true;
  c.has_imu = true;
  return c;
}

TEST(ExportTum, ImagesAndStampsReadBack) {
  const NewFolder folder;
  const auto dataset = rgbd().dataset();
  const ExportReport report = exportDataset(*dataset, folder / "tum", "tum");
  EXPECT_EQ(report.frames, 5U);
  const auto rgb = readTable(folder / "tum/rgb.txt"), depth = readTable(folder / "tum/depth.txt");
  ASSERT_EQ(rgb.size(), 5U);
  ASSERT_EQ(depth.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto frame = frameAt(*dataset, i);
    EXPECT_EQ(stampOf(rgb[i][0]), frame->stamp);
    EXPECT_EQ(stampOf(depth[i][0]), frame->stamp);
    EXPECT_EQ(rgb[i][1], "rgb/" + rgb[i][0] + ".png");
    const cv::Mat colour = readImage(folder / ("tum/" + rgb[i][1]));
    EXPECT_EQ(colour.type(), CV_8UC3);
    EXPECT_TRUE(samePixels<std::uint8_t>(colour, frame->images[0].image, {2, 1, 0}));
    const cv::Mat metres = readImage(folder / ("tum/" + depth[i][1]));
    ASSERT_EQ(metres.type(), CV_16UC1);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const int millimetres = frame->images[1].image.at<std::uint16_t>(x, y);
        EXPECT_EQ(metres.at<std::uint16_t>(y, x), millimetres > 13107 ? 0 : 5 * millimetres);
      }
    }
  }
}

TEST(ExportTum, PosesAreThoseOfTheCamera) {
  const NewFolder folder;
  const auto dataset = rgbd().dataset();
  exportDataset(*dataset, folder / "tum", "tum");
  const auto rows = readTable(folder / "tum/groundtruth.txt");
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  ASSERT_EQ(rows.size(), truth.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 8U);
    EXPECT_EQ(stampOf(rows[i][0]), truth[i].stamp);
    const SE3d expected = truth[i].pose * rgbd().poseOfCamera(0);
    EXPECT_TRUE(poseOf(rows[i], 1, false).isApprox(expected, 1e-14));
  }
}

TEST(ExportTum, AccelerationAndCalibration) {
  const NewFolder folder;
  const auto dataset = rgbd().dataset();
  const ExportReport report = exportDataset(*dataset, folder / "tum", "tum");
  const auto rows = readTable(folder / "tum/accelerometer.txt");
  std::size_t row = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    for (const gslam::ImuSample& sample : frameAt(*dataset, i)->imu) {
      ASSERT_LT(row, rows.size());
      EXPECT_EQ(stampOf(rows[row][0]), sample.stamp);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(std::stod(rows[row].at(1 + k)), sample.accel[k]);
      }
      ++row;
    }
  }
  EXPECT_EQ(row, rows.size());
  EXPECT_TRUE(says(report.left_out, "angular velocities"));
  EXPECT_EQ(numbers(readText(folder / "tum/calibration.txt")),
            (std::vector<double>{31, 32, 19.25, 14.75, -0.28, 0.07, 0.0002, 1.76e-05, 0.01}));
  EXPECT_FALSE(fs::exists(folder / "tum/associate.txt")) << "the original has none";
}

TEST(ExportTum, ReportCountsWhatIsThere) {
  const NewFolder folder;
  const ExportReport report = exportDataset(*rgbd().dataset(), folder / "tum", "tum");
  std::size_t files = 0, bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "tum")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    bytes += entry.file_size();
  }
  EXPECT_EQ(report.files, files);
  EXPECT_EQ(report.bytes, bytes);
  EXPECT_TRUE(says(report.left_out, "depth pixels")) << "those beyond 13.107 m";
}

TEST(ExportTum, EveryOrderOfColours) {
  const struct {
    ImageKind kind;
    std::vector<int> order;  // of the file's blue, green, red in the image
  } cases[] = {{ImageKind::rgb, {2, 1, 0}},  {ImageKind::bgr, {0, 1, 2}},
               {ImageKind::rgba, {2, 1, 0}}, {ImageKind::bgra, {0, 1, 2}},
               {ImageKind::grey, {0, 0, 0}}, {ImageKind::infrared, {0, 0, 0}}};
  for (const auto& each : cases) {
    SCOPED_TRACE(gslam::imageKindName(each.kind));
    const NewFolder folder;
    Case c;
    c.kind = each.kind;
    const auto dataset = c.dataset();
    exportDataset(*dataset, folder / "tum", "tum");
    const auto rgb = readTable(folder / "tum/rgb.txt");
    const cv::Mat colour = readImage(folder / ("tum/" + rgb.at(0)[1]));
    EXPECT_TRUE(
        samePixels<std::uint8_t>(colour, frameAt(*dataset, 0)->images[0].image, each.order));
    EXPECT_FALSE(fs::exists(folder / "tum/depth.txt"));
  }
}

TEST(ExportTum, DepthInMetresAsFloat) {
  const NewFolder folder;
  Case c = rgbd();
  c.depth_type = PixelType::f32;
  c.depth_scale = 1;
  const gslam::DatasetInfo info = c.info();
  auto frames = c.makeFrames(info);
  auto changed = std::make_shared<Frame>(*frames[0]);
  const float strange[] = {NAN, INFINITY, -1, 0, 13.107F, 14, 1e30F, 1e-5F};
  for (int x = 0; x < 8; ++x) changed->images[1].image.at<float>(x, 0) = strange[x];
  frames[0] = changed;
  gslam::MemoryDataset dataset(info, frames);
  const ExportReport report = exportDataset(dataset, folder / "tum", "tum");
  const auto depth = readTable(folder / "tum/depth.txt");
  const cv::Mat file = readImage(folder / ("tum/" + depth.at(0)[1]));
  const int expected[] = {0, 0, 0, 0, 65535, 0, 0, 0};
  for (int x = 0; x < 8; ++x) EXPECT_EQ(file.at<std::uint16_t>(0, x), expected[x]) << x;
  for (int x = 0; x < kWidth; ++x) {
    const double metres = changed->images[1].image.at<float>(x, 5);
    EXPECT_NEAR(file.at<std::uint16_t>(5, x), 5000 * metres, 0.5001);
  }
  EXPECT_TRUE(says(report.left_out, "2 depth pixels: farther than 13.107 m"));
}

TEST(ExportTum, DepthOfThisFactorIsUnchanged) {
  const NewFolder folder;
  Case c = rgbd();
  c.depth_scale = 1.0 / 5000;
  const auto dataset = c.dataset();
  exportDataset(*dataset, folder / "tum", "tum");
  const auto depth = readTable(folder / "tum/depth.txt");
  EXPECT_TRUE(samePixels<std::uint16_t>(readImage(folder / ("tum/" + depth.at(0)[1])),
                                        frameAt(*dataset, 0)->images[1].image, {0}));
}

TEST(ExportTum, HeadsAreThoseOfTheRealOne) {
  NEEDS_TEST_DATA();
  const std::string real = test_data::folder() + "sequences/tum_rgbd_freiburg1_rpy/";
  const NewFolder folder;
  exportDataset(*rgbd().dataset(), folder / "tum", "tum");
  for (const char* name : {"rgb.txt", "depth.txt", "groundtruth.txt", "accelerometer.txt"}) {
    const auto ours = readLines(folder / ("tum/" + std::string(name)));
    const auto theirs = readLines(real + name);
    ASSERT_GT(ours.size(), 3U);
    EXPECT_EQ(ours[0], theirs[0]) << name;
    EXPECT_EQ(ours[1].substr(0, 9), theirs[1].substr(0, 9)) << name;
    EXPECT_EQ(ours[2], theirs[2]) << name;
    EXPECT_EQ(fields(ours[3], " ").size(), fields(theirs[3], " ").size()) << name;
  }
  const auto rgb = readTable(real + "rgb.txt"), depth = readTable(real + "depth.txt");
  EXPECT_EQ(readImage(real + rgb.at(0)[1]).type(), CV_8UC3);
  EXPECT_EQ(readImage(real + depth.at(0)[1]).type(), CV_16UC1);
}

TEST(ExportIcl, FramesAreNumbered) {
  const NewFolder folder;
  Case c = rgbd();
  c.models = {"pinhole"};
  const auto dataset = c.dataset();
  const ExportReport report = exportDataset(*dataset, folder / "icl", "icl");
  const auto rows = readTable(folder / "icl/associations.txt");
  ASSERT_EQ(rows.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::string n = std::to_string(i);
    EXPECT_EQ(rows[i],
              (std::vector<std::string>{n, "depth/" + n + ".png", n, "rgb/" + n + ".png"}));
    const cv::Mat colour = readImage(folder / ("icl/" + rows[i][3]));
    EXPECT_TRUE(samePixels<std::uint8_t>(colour, frameAt(*dataset, i)->images[0].image, {2, 1, 0}));
    EXPECT_EQ(readImage(folder / ("icl/" + rows[i][1])).type(), CV_16UC1);
  }
  EXPECT_TRUE(says(report.left_out, "stamps"));
  EXPECT_TRUE(says(report.left_out, "inertial"));
  EXPECT_EQ(numbers(readText(folder / "icl/calibration.txt")),
            (std::vector<double>{31, -32, 19.25, 14.75}));
}

// A reader that takes fy as negative sees the points of the images where the dataset has them,
// mirrored: y of the world is the other way round.
TEST(ExportIcl, NegativeFocalLengthAndPosesGoTogether) {
  const NewFolder folder;
  Case c = rgbd();
  c.models = {"pinhole"};
  const auto dataset = c.dataset();
  gslam::ExportOptions options;
  options.sequence = "livingRoom0";
  exportDataset(*dataset, folder / "icl", "icl", options);
  const auto rows = readTable(folder / "icl/livingRoom0.gt.freiburg");
  const std::vector<double> k = numbers(readText(folder / "icl/calibration.txt"));
  ASSERT_EQ(rows.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(rows[i][0], std::to_string(i));
    const double u = 3 + double(i), v = 20, depth = 2;
    const gslam::Vec3d point = {{(u - k[2]) / k[0] * depth, (v - k[3]) / k[1] * depth, depth}};
    const gslam::Vec3d found = poseOf(rows[i], 1, false) * point;
    const auto frame = frameAt(*dataset, i);
    gslam::Vec3d bearing;
    ASSERT_TRUE(frame->images[0].camera.unproject({{u, v}}, bearing));
    const gslam::Vec3d expected =
        poseAt(frame->stamp) * (c.poseOfCamera(0) * ((depth / bearing[2]) * bearing));
    EXPECT_NEAR(found[0], expected[0], 1e-12);
    EXPECT_NEAR(found[1], -expected[1], 1e-12);
    EXPECT_NEAR(found[2], expected[2], 1e-12);
  }
}

}  // namespace
