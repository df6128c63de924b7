#include "export_case.h"
#include "test_data.h"

namespace {

using namespace export_case;  // NOLINT(google-build-using-namespace)
using gslam::exportDataset;
using gslam::ExportReport;

Case stereo() {
  Case c;
  c.models = {"pinhole", "pinhole"};
  return c;
}

std::vector<double> numbersOf(const std::vector<std::string>& row, std::size_t first) {
  std::vector<double> result;
  for (std::size_t i = first; i < row.size(); ++i) result.push_back(std::stod(row[i]));
  return result;
}

TEST(ExportKitti, ImagesAndStampsReadBack) {
  const NewFolder folder;
  const auto dataset = stereo().dataset();
  gslam::ExportOptions options;
  options.sequence = "06";
  const ExportReport report = exportDataset(*dataset, folder / "kitti", "kitti", options);
  const auto times = readTable(folder / "kitti/sequences/06/times.txt");
  ASSERT_EQ(times.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto frame = frameAt(*dataset, i);
    EXPECT_EQ(stampOf(times[i].at(0)), frame->stamp - kFirstStamp);
    for (std::size_t camera = 0; camera < 2; ++camera) {
      const std::string name = "kitti/sequences/06/image_" + std::to_string(camera) + "/00000" +
                               std::to_string(i) + ".png";
      EXPECT_TRUE(
          samePixels<std::uint8_t>(readImage(folder / name), frame->images[camera].image, {0}));
    }
  }
  EXPECT_TRUE(says(report.remarks, "1403715273.262142976"));
}

TEST(ExportKitti, PosesAreRelativeToTheFirstCamera) {
  const NewFolder folder;
  const auto dataset = stereo().dataset();
  exportDataset(*dataset, folder / "kitti", "kitti");
  const auto rows = readTable(folder / "kitti/poses/00.txt");
  ASSERT_EQ(rows.size(), 5U);
  const SE3d T_body_camera = stereo().poseOfCamera(0);
  const SE3d first = poseAt(kFirstStamp) * T_body_camera;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::vector<double> v = numbersOf(rows[i], 0);
    ASSERT_EQ(v.size(), 12U);
    const SE3d now = poseAt(kFirstStamp + std::int64_t(i) * kPeriod) * T_body_camera;
    const gslam::Mat<double, 3, 4> expected = (first.inverse() * now).matrix3x4();
    for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(v[k], expected(k / 4, k % 4), 1e-11);
  }
}

// A point's pixels by the matrices are those by the cameras.
TEST(ExportKitti, ProjectionsAreThoseOfTheCameras) {
  const NewFolder folder;
  const Case c = stereo();
  const auto dataset = c.dataset();
  exportDataset(*dataset, folder / "kitti", "kitti");
  const auto rows = readTable(folder / "kitti/sequences/00/calib.txt");
  ASSERT_EQ(rows.size(), 4U);
  const gslam::Vec3d point = {{0.3, -0.2, 2}};  // left camera
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i][0], "P" + std::to_string(i) + ":");
    const std::vector<double> p = numbersOf(rows[i], 1);
    ASSERT_EQ(p.size(), 12U);
    double h[3];
    for (std::size_t k = 0; k < 3; ++k) {
      h[k] = p[4 * k] * point[0] + p[4 * k + 1] * point[1] + p[4 * k + 2] * point[2] + p[4 * k + 3];
    }
    const CameraSensor& camera = dataset->info().sensors.cameras[i % 2];
    gslam::Vec2d pixel;
    ASSERT_TRUE(
        camera.camera.project(camera.T_body_camera.inverse() * (c.poseOfCamera(0) * point), pixel));
    EXPECT_NEAR(h[0] / h[2], pixel[0], 1e-9);
    EXPECT_NEAR(h[1] / h[2], pixel[1], 1e-9);
  }
}

TEST(ExportKitti, OneColourCamera) {
  const NewFolder folder;
  Case c;
  c.kind = ImageKind::bgr;
  c.has_depth = true;
  c.has_imu = true;
  const ExportReport report = exportDataset(*c.dataset(), folder / "kitti", "kitti");
  EXPECT_EQ(readImage(folder / "kitti/sequences/00/image_0/000000.png").type(), CV_8UC1);
  EXPECT_FALSE(fs::exists(folder / "kitti/sequences/00/image_1"));
  EXPECT_TRUE(says(report.left_out, "camera 'depth'"));
  EXPECT_TRUE(says(report.left_out, "inertial samples"));
  EXPECT_TRUE(says(report.remarks, "colour was made grey"));
}

TEST(ExportKitti, AFrameWithoutPoseMeansNoPoses) {
  const NewFolder folder;
  Case c = stereo();
  c.has_truth = false;
  gslam::DatasetInfo info = c.info();
  info.ground_truth.add(kFirstStamp, SE3d());
  info.ground_truth.add(kFirstStamp + 2 * kPeriod, SE3d());
  gslam::MemoryDataset dataset(info, c.makeFrames(info));
  const ExportReport report = exportDataset(dataset, folder / "kitti", "kitti");
  EXPECT_EQ(report.frames, 5U);
  EXPECT_FALSE(fs::exists(folder / "kitti/poses/00.txt"));
  EXPECT_TRUE(says(report.left_out, "it has none of frame 3"));
}

TEST(ExportKitti, AFrameWithoutOneImageIsLeftOut) {
  const NewFolder folder;
  const Case c = stereo();
  const gslam::DatasetInfo info = c.info();
  auto frames = c.makeFrames(info);
  const auto changed = std::make_shared<Frame>(*frames[2]);
  changed->images.pop_back();
  frames[2] = changed;
  gslam::MemoryDataset dataset(info, frames);
  const ExportReport report = exportDataset(dataset, folder / "kitti", "kitti");
  EXPECT_EQ(report.frames, 4U);
  EXPECT_TRUE(says(report.left_out, "frame 2: there is no image of camera 'cam1'"));
  EXPECT_EQ(countFiles(folder / "kitti/sequences/00/image_0"), 4U);
  EXPECT_EQ(readTable(folder / "kitti/poses/00.txt").size(), 4U);
  EXPECT_EQ(stampOf(readTable(folder / "kitti/sequences/00/times.txt")[2][0]), 3 * kPeriod);
}

TEST(ExportKitti, FilesAreThoseOfTheRealOne) {
  NEEDS_TEST_DATA();
  const std::string real = test_data::folder() + "sequences/kitti_06/";
  const NewFolder folder;
  gslam::ExportOptions options;
  options.sequence = "06";
  exportDataset(*stereo().dataset(), folder / "kitti", "kitti", options);
  for (const char* name : {"sequences/06/calib.txt", "sequences/06/times.txt", "poses/06.txt",
                           "sequences/06/image_0/000000.png", "sequences/06/image_1/000000.png"}) {
    EXPECT_TRUE(fs::exists(real + name)) << name;
    EXPECT_TRUE(fs::exists(folder / ("kitti/" + std::string(name)))) << name;
  }
  const auto ours = readTable(folder / "kitti/sequences/06/calib.txt");
  const auto theirs = readTable(real + "sequences/06/calib.txt");
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    EXPECT_EQ(ours.at(i).size(), theirs[i].size());
    EXPECT_EQ(ours[i][0], theirs[i][0]);
    EXPECT_EQ(ours[i][1].size(), theirs[i][1].size()) << "digits";
  }
  EXPECT_LT(std::stod(ours.at(1).at(4)), 0);
  EXPECT_LT(std::stod(theirs.at(1).at(4)), 0) << "the right camera has the minus";
  EXPECT_EQ(readTable(folder / "kitti/poses/06.txt").at(0).size(),
            readTable(real + "poses/06.txt").at(0).size());
  EXPECT_EQ(readImage(real + "sequences/06/image_0/000000.png").type(),
            readImage(folder / "kitti/sequences/06/image_0/000000.png").type());
}

TEST(ExportTummono, ImagesTimesAndPosesReadBack) {
  const NewFolder folder;
  Case c;
  c.models = {"fov", "fov"};
  const auto dataset = c.dataset();
  const ExportReport report = exportDataset(*dataset, folder / "mono", "tummono");
  EXPECT_TRUE(says(report.left_out, "camera 'cam1': tummono has one camera"));
  const auto times = readTable(folder / "mono/times.txt");
  const auto truth = readTable(folder / "mono/groundtruthSync.txt");
  ASSERT_EQ(times.size(), 5U);
  ASSERT_EQ(truth.size(), 5U);
  EXPECT_EQ(countFiles(folder / "mono/images"), 5U) << "its readers count them";
  for (std::size_t i = 0; i < 5; ++i) {
    const auto frame = frameAt(*dataset, i);
    EXPECT_EQ(times[i].at(0), "0000" + std::to_string(i));
    EXPECT_EQ(stampOf(times[i].at(1)), frame->stamp);
    EXPECT_EQ(std::stod(times[i].at(2)), 1.71);
    EXPECT_EQ(stampOf(truth[i].at(0)), frame->stamp);
    EXPECT_TRUE(
        poseOf(truth[i], 1, false).isApprox(poseAt(frame->stamp) * c.poseOfCamera(0), 1e-14));
    const cv::Mat file = readImage(folder / ("mono/images/" + times[i][0] + ".png"));
    EXPECT_TRUE(samePixels<std::uint8_t>(file, frame->images[0].image, {0}));
  }
}

TEST(ExportTummono, CalibrationsAsItsReadersWantThem) {
  const struct {
    const char* model;
    const char* word;
    std::vector<double> rest;
    const char* mode;
  } cases[] = {{"fov", "", {0.93}, "crop"},
               {"pinhole", "", {0}, "none"},
               {"radtan4", "RadTan ", {-0.28, 0.07, 0.0002, 1.76e-05}, "crop"},
               {"kannala_brandt", "EquiDistant ", {0.0035, 0.0007, -0.002, 0.0002}, "crop"}};
  for (const auto& each : cases) {
    SCOPED_TRACE(each.model);
    const NewFolder folder;
    Case c;
    c.models = {each.model};
    c.exposure = 0;
    const ExportReport report = exportDataset(*c.dataset(), folder / "mono", "tummono");
    const auto lines = readLines(folder / "mono/camera.txt");
    ASSERT_EQ(lines.size(), 4U);
    const std::string word = each.word;
    ASSERT_EQ(lines[0].substr(0, word.size()), word);
    const std::vector<double> k = numbers(lines[0].substr(word.size()));
    ASSERT_EQ(k.size(), 4 + each.rest.size());
    // DSO: pixels are the number times the size, and half a pixel less for the centre.
    EXPECT_NEAR(k[0] * kWidth, 31, 1e-12);
    EXPECT_NEAR(k[1] * kHeight, 32, 1e-12);
    EXPECT_NEAR(k[2] * kWidth - 0.5, 19.25, 1e-12);
    EXPECT_NEAR(k[3] * kHeight - 0.5, 14.75, 1e-12);
    EXPECT_EQ(std::vector<double>(k.begin() + 4, k.end()), each.rest);
    EXPECT_EQ(lines[1], "40 30");
    EXPECT_EQ(lines[2], each.mode);
    EXPECT_EQ(lines[3], "40 30");
    EXPECT_EQ(readTable(folder / "mono/times.txt").at(0).at(2), "0");
    EXPECT_TRUE(says(report.remarks, "exposures"));
    const auto response = readTable(folder / "mono/pcalib.txt");
    ASSERT_EQ(response.size(), 1U);
    ASSERT_EQ(response[0].size(), 256U);
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(std::stod(response[0][i]), double(i));
    const cv::Mat vignette = readImage(folder / "mono/vignette.png");
    EXPECT_EQ(vignette.type(), CV_16UC1);
    EXPECT_EQ(vignette.size(), cv::Size(kWidth, kHeight));
    EXPECT_EQ(cv::countNonZero(vignette != 65535), 0);
  }
}

TEST(ExportTummono, FramesWithoutGroundTruthAreNaN) {
  const NewFolder folder;
  Case c;
  c.has_truth = false;
  gslam::DatasetInfo info = c.info();
  info.ground_truth.add(kFirstStamp, SE3d());
  gslam::MemoryDataset dataset(info, c.makeFrames(info));
  exportDataset(dataset, folder / "mono", "tummono");
  const auto rows = readTable(folder / "mono/groundtruthSync.txt");
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_NE(rows[0][1], "NaN");
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ(rows[i].size(), 8U);
    EXPECT_EQ(rows[i][7], "NaN");
  }
}

}  // namespace
