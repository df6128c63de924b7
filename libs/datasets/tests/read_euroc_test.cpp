// EuRoC MAV: the real excerpt, against its own files and OpenCV, and what export writes.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "format_case.h"
#include "test_data.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)

std::string realV101() {
  return test_data::folder() + "sequences/euroc_V1_01_easy";
}

std::unique_ptr<Dataset> openEuroc(const std::string& path, const Svar& parameters = Svar()) {
  return open(gslam::eurocFactory(), path, parameters);
}

TEST(readEuroc, RealFramesAreThoseOfTheirFiles) {
  NEEDS_TEST_DATA();
  const auto dataset = openEuroc(realV101());
  const gslam::DatasetInfo& info = dataset->info();
  EXPECT_EQ(info.name, "euroc_V1_01_easy");
  EXPECT_EQ(info.format, "euroc");
  EXPECT_EQ(info.frame_count, 30U);
  EXPECT_EQ(info.first_stamp, 1403715273262142976);
  EXPECT_TRUE(has(info.body, "the IMU (imu0)"));
  ASSERT_EQ(info.sensors.cameras.size(), 2U);
  EXPECT_EQ(info.sensors.cameras[1].name, "cam1");
  EXPECT_EQ(info.sensors.cameras[1].kind, ImageKind::grey);
  EXPECT_EQ(info.sensors.cameras[1].rate, 20);
  EXPECT_EQ(info.sensors.cameras[1].camera.parameter("fx"), 457.587);
  EXPECT_NEAR(info.sensors.cameras[1].T_body_camera.translation()[1], 0.0453689425024, 1e-12);
  EXPECT_EQ(info.sensors.imu.rate, 200);
  EXPECT_EQ(info.sensors.imu.accel_bias_walk, 3e-3);
  const auto frames = allFrames(*dataset);
  ASSERT_EQ(frames.size(), 30U);
  for (const auto& frame : frames) {
    ASSERT_EQ(frame->images.size(), 2U);
    for (const auto& image : frame->images) {
      const cv::Mat file = export_case::readImage(realV101() + "/mav0/" + image.name + "/data/" +
                                                  std::to_string(frame->stamp) + ".png");
      EXPECT_TRUE(export_case::samePixels<std::uint8_t>(file, image.image, {0}));
    }
  }
}

TEST(readEuroc, RealSamplesAreAllThere) {
  NEEDS_TEST_DATA();
  const auto dataset = openEuroc(realV101());
  // 29 120 rows, of which those up to the last frame go out; the others are said.
  std::size_t rows = 0, until_last = 0;
  std::ifstream file(realV101() + "/mav0/imu0/data.csv");
  for (std::string line; std::getline(file, line);) {
    if (line[0] == '#') continue;
    ++rows;
    until_last += std::stoll(line) <= dataset->info().last_stamp ? 1 : 0;
  }
  EXPECT_EQ(rows, 29120U);
  std::size_t given = 0;
  const auto frames = allFrames(*dataset);
  for (const auto& frame : frames) given += frame->imu.size();
  EXPECT_EQ(given, until_last);
  EXPECT_TRUE(says(dataset->info().remarks, std::to_string(rows - until_last) + " of 29120"));
  ASSERT_EQ(frames[0]->imu.size(), 1U);
  EXPECT_EQ(frames[0]->imu[0].stamp, 1403715273262142976);
  EXPECT_EQ(frames[0]->imu[0].gyro[1], 0.017453292519943295);
  EXPECT_EQ(frames[0]->imu[0].accel[2], -3.6938381666666662);
  EXPECT_EQ(frames[1]->imu.size(), 10U);
  // At rest the specific force is gravity's.
  EXPECT_NEAR(frames[0]->imu[0].accel.norm(), 9.81, 0.1);
}

TEST(readEuroc, RealGroundTruthIsTheFiles) {
  NEEDS_TEST_DATA();
  const auto dataset = openEuroc(realV101());
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  ASSERT_EQ(truth.size(), 2895U);
  EXPECT_EQ(truth[0].stamp, 1403715273262142976);
  EXPECT_LT((truth[0].pose.translation() - Vec3d{{0.878895, 2.1834, 0.948427}}).norm(), 1e-15);
  const SO3d first = SO3d::fromQuaternion(-0.824237, -0.106942, -0.551702, 0.069433);
  EXPECT_LT((truth[0].pose.rotation().inverse() * first).angle(), 1e-12);
  // The poses of its authors, w last, are in another world: what moves in a second agrees.
  const auto rows = export_case::readTable(realV101() + "/groundtruth_original_ASL_as_TUM.txt");
  std::size_t compared = 0;
  double way = 0, apart = 0;
  for (std::size_t i = 0; i + 200 < rows.size(); i += 20) {
    SE3d from, to;
    if (!truth.interpolate(export_case::stampOf(rows[i][0]), from) ||
        !truth.interpolate(export_case::stampOf(rows[i + 200][0]), to)) {
      continue;
    }
    const SE3d found = from.inverse() * to;
    const SE3d expected = export_case::poseOf(rows[i], 1, false).inverse() *
                          export_case::poseOf(rows[i + 200], 1, false);
    // (Theirs are of the Vicon marker, 0.14 m from the IMU.)
    apart += (found.translation() - expected.translation()).norm();
    ASSERT_LT((found.rotation().inverse() * expected.rotation()).angle(), 0.04) << i;
    way += found.translation().norm() / 10;
    ++compared;
  }
  EXPECT_GT(compared, 1000U);
  EXPECT_GT(way, 40);
  EXPECT_LT(apart / double(compared), 0.05);
}

// Turns of the gyroscope from one stamp on, all samples of the file: first order in each step.
SO3d integrated(const std::vector<gslam::ImuSample>& samples, std::int64_t from, std::int64_t to,
                const Vec3d& bias) {
  SO3d rotation;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i - 1].stamp < from || samples[i].stamp > to) continue;
    const double step = double(samples[i].stamp - samples[i - 1].stamp) * 1e-9;
    rotation = rotation * SO3d::exp(step * (0.5 * (samples[i - 1].gyro + samples[i].gyro) - bias));
  }
  return rotation;
}

// The stream of the whole sequence, which goes out with one frame at its end: a list of the first
// and a late image does that.
TEST(readEuroc, TheRealGyroscopeTurnsAsTheGroundTruth) {
  NEEDS_TEST_DATA();
  const TempFolder folder;
  fs::create_directories(folder / "mav0/cam0/data");
  const std::string from = realV101() + "/mav0/";
  fs::copy(from + "imu0", folder / "mav0/imu0", fs::copy_options::recursive);
  fs::copy(from + "state_groundtruth_estimate0", folder / "mav0/state_groundtruth_estimate0",
           fs::copy_options::recursive);
  writeText(folder / "mav0/cam0/data.csv",
            "1403715273262142976,a.png\n1403715418000000000,b.png\n");
  writeImage(folder / "mav0/cam0/data/a.png", numbered(8, 6, 1));
  writeImage(folder / "mav0/cam0/data/b.png", numbered(8, 6, 2));
  const auto dataset = openEuroc(folder.path());
  const auto frames = allFrames(*dataset);
  ASSERT_EQ(frames.size(), 2U);
  const std::vector<gslam::ImuSample>& samples = frames[1]->imu;
  EXPECT_GT(samples.size(), 28000U);
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  const Vec3d bias{{-0.00224703, 0.0215352, 0.0770299}};  // of the file's first pose
  double turned = 0, worst = 0, worst_back = 0;
  for (std::size_t i = 400; i + 100 < truth.size(); i += 400) {  // 5 s at 20 Hz
    const SO3d expected = truth[i].pose.rotation().inverse() * truth[i + 100].pose.rotation();
    const SO3d found = integrated(samples, truth[i].stamp, truth[i + 100].stamp, bias);
    turned += expected.angle();
    worst = std::max(worst, (expected.inverse() * found).angle());
    worst_back = std::max(worst_back, (expected * found).angle());
  }
  EXPECT_GT(turned, 1);  // it does fly
  EXPECT_LT(worst, 0.03);
  EXPECT_GT(worst_back, 0.3);  // the other way round does not fit
}

TEST(readEuroc, FilesThatDoNotExistAreCounted) {
  NEEDS_TEST_DATA();
  const auto dataset = openEuroc(realV101(), Svar::object({{"list", "data_full.csv"}}));
  EXPECT_EQ(dataset->info().frame_count, 30U);
  const std::vector<std::string>& remarks = dataset->info().remarks;
  EXPECT_TRUE(says(remarks, "65 images that mav0/cam0/data_full.csv lists and that do not exist"));
  EXPECT_TRUE(says(remarks, "69 images that mav0/cam1/data_full.csv lists and that do not exist"));
  EXPECT_TRUE(has(errorOf(gslam::eurocFactory(), realV101(), Svar::object({{"list", "no.csv"}})),
                  "mav0/cam0/no.csv"));
}

TEST(readEuroc, CamerasAreChosen) {
  NEEDS_TEST_DATA();
  const auto right = openEuroc(realV101(), Svar::object({{"cameras", "1"}}));
  ASSERT_EQ(right->info().sensors.cameras.size(), 1U);
  EXPECT_EQ(right->info().sensors.cameras[0].name, "cam1");
  const auto turned = openEuroc(realV101(), Svar::object({{"cameras", "1,0"}}));
  EXPECT_EQ(turned->info().sensors.cameras[0].name, "cam1");
  EXPECT_EQ(turned->next()->images[1].name, "cam0");
  for (const char* wrong : {"2", "0,0", "a", "0,", "-1", "1000"}) {
    EXPECT_TRUE(has(errorOf(gslam::eurocFactory(), realV101(), Svar::object({{"cameras", wrong}})),
                    "cameras is '" + std::string(wrong) + "', expected "))
        << wrong;
  }
}

TEST(readEuroc, ACalibrationInPlaceOfItsOwn) {
  NEEDS_TEST_DATA();
  const auto dataset = openEuroc(
      realV101(), Svar::object({{"calibration", test_data::folder() +
                                                    "calibrations/basalt/euroc_ds_calib.json"}}));
  EXPECT_EQ(dataset->info().sensors.cameras[1].camera.modelName(), "double_sphere");
  EXPECT_NEAR(dataset->info().sensors.cameras[1].T_body_camera.translation()[1], 0.0412627204046637,
              1e-12);
}

TEST(readEuroc, TheLicenceIsThatOfEuroc) {
  NEEDS_TEST_DATA();
  EXPECT_TRUE(has(openEuroc(realV101())->info().licence, "EuRoC MAV, ASL, ETH Zurich"));
}

// What export writes of a computed world, in a folder.
class ExportedEuroc {
 public:
  ExportedEuroc() {
    gslam::SyntheticOptions options;
    options.frames = 6;
    options.width = 64;
    options.height = 48;
    options.sensors = "stereo";
    world_ = gslam::openSynthetic(options);
    gslam::exportDataset(*world_, folder_ / "seq", "euroc");
  }
  std::string path(const std::string& name = "") const {
    return folder_ / (name.empty() ? "seq" : "seq/" + name);
  }
  std::string text(const std::string& name) const { return export_case::readText(path(name)); }
  void replace(const std::string& name, const std::string& part, const std::string& other) const {
    std::string all = text(name);
    const std::size_t at = all.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    writeText(path(name), all.replace(at, part.size(), other));
  }
  std::string error() const { return errorOf(gslam::eurocFactory(), path()); }
  const TempFolder& folder() const { return folder_; }
  Dataset& world() const { return *world_; }

 private:
  TempFolder folder_;
  std::unique_ptr<Dataset> world_;
};

TEST(readEuroc, ReadsWhatWasExported) {
  const ExportedEuroc exported;
  const auto dataset = openEuroc(exported.path());
  const gslam::DatasetInfo &info = dataset->info(), &expected = exported.world().info();
  ASSERT_EQ(info.sensors.cameras.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(info.sensors.cameras[i].camera, expected.sensors.cameras[i].camera);
    EXPECT_TRUE(info.sensors.cameras[i].T_body_camera.isApprox(
        expected.sensors.cameras[i].T_body_camera, 1e-12));
  }
  EXPECT_TRUE(info.sensors.imu.T_body_imu.isApprox(expected.sensors.imu.T_body_imu, 1e-12));
  EXPECT_EQ(info.sensors.imu.gyro_noise, expected.sensors.imu.gyro_noise);
  ASSERT_EQ(info.ground_truth.size(), expected.ground_truth.size());
  EXPECT_TRUE(info.ground_truth.back().pose.isApprox(expected.ground_truth.back().pose, 1e-12));
  for (std::size_t i = 0; i < 6; ++i) {
    const auto frame = dataset->next(), same = frameAt(exported.world(), i);
    EXPECT_EQ(frame->stamp, same->stamp);
    ASSERT_EQ(frame->imu.size(), same->imu.size());
    if (!frame->imu.empty()) {
      EXPECT_EQ(frame->imu.back().stamp, same->imu.back().stamp);
      EXPECT_LT((frame->imu.back().accel - same->imu.back().accel).norm(), 1e-12);
    }
    EXPECT_EQ(frame->images[1].image, same->images[1].image);
  }
  EXPECT_EQ(dataset->next(), nullptr);
}

TEST(readEuroc, TheFolderMav0AndArchivesAreTheSame) {
  const ExportedEuroc exported;
  zipFolder(exported.path(), exported.folder() / "plain.zip");
  zipFolder(exported.path(), exported.folder() / "seq2.zip", "V1_07/");
  zipFolder(exported.path("mav0"), exported.folder() / "mav.zip");
  for (const std::string& path :
       {exported.path("mav0"), exported.folder().path(), exported.folder() / "plain.zip",
        exported.folder() / "seq2.zip", exported.folder() / "mav.zip"}) {
    const auto expected = openEuroc(exported.path()), found = openEuroc(path);
    expectSame(*expected, *found);
    EXPECT_TRUE(gslam::eurocFactory().recognizes(path)) << path;
  }
  EXPECT_EQ(openEuroc(exported.path("mav0"))->info().name, "seq");
  EXPECT_EQ(openEuroc(exported.folder().path())->info().name, "seq");
  EXPECT_EQ(openEuroc(exported.folder() / "seq2.zip")->info().name, "V1_07");
  EXPECT_EQ(openEuroc(exported.folder() / "plain.zip")->info().name, "plain");
}

TEST(readEuroc, OthersInTheSameLayoutHaveNotItsLicence) {
  const ExportedEuroc exported;
  EXPECT_EQ(openEuroc(exported.path())->info().licence, "");
  fs::rename(exported.path(), exported.folder() / "MH_03_medium");
  EXPECT_TRUE(has(openEuroc(exported.folder().path())->info().licence, "EuRoC MAV"));
}

// A pinhole in OpenCV's file, for images of 64 x 48.
std::string pinholeOf(double focal, bool is_sized) {
  const std::string f = std::to_string(focal);
  return std::string("%YAML:1.0\n---\n") + (is_sized ? "image_width: 64\nimage_height: 48\n" : "") +
         "camera_matrix: !!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n  data: [" + f +
         ", 0., 31.5, 0., " + f + ", 23.5, 0., 0., 1.]\n";
}

void expectPlaces(const gslam::SensorRig& rig, const SE3d& cam0, const SE3d& cam1) {
  EXPECT_TRUE(rig.cameras[0].T_body_camera.isApprox(cam0, 1e-9));
  EXPECT_TRUE(rig.cameras[1].T_body_camera.isApprox(cam1, 1e-9));
}

TEST(readEuroc, ACalibrationWithoutPlacesLeavesCamerasWhereTheyAre) {
  const ExportedEuroc exported;
  const gslam::SensorRig own = openEuroc(exported.path())->info().sensors;
  ASSERT_GT(own.cameras[0].T_body_camera.translation().norm() +
                own.cameras[0].T_body_camera.rotation().angle(),
            0.01);
  const std::string file = exported.folder() / "mono.yaml";
  const Svar parameters = Svar::object({{"calibration", file}});
  for (const bool is_sized : {true, false}) {  // without a size it is that of the images
    writeText(file, pinholeOf(50, is_sized));
    const auto dataset = openEuroc(exported.path(), parameters);
    const gslam::SensorRig& rig = dataset->info().sensors;
    EXPECT_EQ(rig.cameras[0].camera.parameter("fx"), 50);
    EXPECT_EQ(rig.cameras[0].camera.width(), 64);
    EXPECT_EQ(rig.cameras[1].camera, own.cameras[1].camera);
    expectPlaces(rig, own.cameras[0].T_body_camera, own.cameras[1].T_body_camera);
    EXPECT_TRUE(says(dataset->info().remarks, "they stay where the dataset has them"));
    EXPECT_TRUE(says(dataset->info().remarks, "has no camera 1"));
  }
  // COLMAP has models of both, and says of neither where it is.
  writeText(file, "1 PINHOLE 64 48 50 50 32 24\n2 PINHOLE 64 48 60 60 32 24\n");
  const auto dataset = openEuroc(exported.path(), parameters);
  EXPECT_EQ(dataset->info().sensors.cameras[1].camera.parameter("fx"), 60);
  expectPlaces(dataset->info().sensors, own.cameras[0].T_body_camera, own.cameras[1].T_body_camera);
}

TEST(readEuroc, ACalibrationOfAPairMovesTheSecond) {
  const ExportedEuroc exported;
  const SE3d first = openEuroc(exported.path())->info().sensors.cameras[0].T_body_camera;
  const std::string file = exported.folder() / "pair.yaml";
  writeText(file,
            "%YAML:1.0\n---\nimage_width: 64\nimage_height: 48\n"
            "K1: [[50., 0., 31.5], [0., 50., 23.5], [0., 0., 1.]]\nD1: [0., 0., 0., 0.]\n"
            "K2: [[60., 0., 31.5], [0., 60., 23.5], [0., 0., 1.]]\nD2: [0., 0., 0., 0.]\n"
            "R: [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]]\nT: [-0.25, 0., 0.]\n");
  const auto dataset = openEuroc(exported.path(), Svar::object({{"calibration", file}}));
  const SE3d right(SO3d(), Vec3d{{0.25, 0, 0}});
  expectPlaces(dataset->info().sensors, first, first * right);
  EXPECT_TRUE(says(dataset->info().remarks, "cam0 stays where the dataset has it"));
  // The same where the first camera is not read.
  const SE3d second = openEuroc(exported.path())->info().sensors.cameras[1].T_body_camera;
  const auto alone =
      openEuroc(exported.path(), Svar::object({{"calibration", file}, {"cameras", "1"}}));
  EXPECT_TRUE(alone->info().sensors.cameras[0].T_body_camera.isApprox(second, 1e-12));
}

TEST(readEuroc, WhatACalibrationReplacesMayBeWrong) {
  const ExportedEuroc exported;
  const gslam::SensorRig own = openEuroc(exported.path())->info().sensors;
  const std::string file = exported.folder() / "mono.yaml";
  writeText(file, pinholeOf(50, true));
  exported.replace("mav0/cam0/sensor.yaml", "resolution", "resolutoin");
  EXPECT_TRUE(has(exported.error(), "cam0/sensor.yaml: resolution is missing"));
  const auto dataset = openEuroc(exported.path(), Svar::object({{"calibration", file}}));
  EXPECT_EQ(dataset->info().sensors.cameras[0].camera.parameter("fx"), 50);
  expectPlaces(dataset->info().sensors, own.cameras[0].T_body_camera, own.cameras[1].T_body_camera);
  EXPECT_TRUE(says(dataset->info().remarks, "its T_BS was taken, since"));
  writeText(exported.path("mav0/cam0/sensor.yaml"), "sensor_type: [\n");
  const auto other = openEuroc(exported.path(), Svar::object({{"calibration", file}}));
  EXPECT_TRUE(says(other->info().remarks, "its T_BS was taken to be the identity, since"));
  EXPECT_EQ(allFrames(*other).size(), 6U);
}

TEST(readEuroc, WhatIsMissingIsSaid) {
  const ExportedEuroc exported;
  fs::remove(exported.path("mav0/cam1/sensor.yaml"));
  fs::remove_all(exported.path("mav0/imu0"));
  fs::remove_all(exported.path("mav0/state_groundtruth_estimate0"));
  const auto dataset = openEuroc(exported.path());
  const std::vector<std::string>& remarks = dataset->info().remarks;
  EXPECT_TRUE(says(remarks, "there is no mav0/imu0/data.csv"));
  EXPECT_TRUE(says(remarks, "there is no ground truth"));
  EXPECT_TRUE(says(remarks, "camera cam1 is not calibrated"));
  EXPECT_FALSE(dataset->info().sensors.has_imu);
  EXPECT_FALSE(dataset->info().sensors.cameras[1].camera.isValid());
  EXPECT_EQ(allFrames(*dataset).size(), 6U);
}

TEST(readEuroc, ImagesOfUnequalStamps) {
  const ExportedEuroc exported;
  const std::string stamp = std::to_string(frameAt(exported.world(), 0)->stamp);
  const std::string late = std::to_string(frameAt(exported.world(), 0)->stamp + 2000000);
  exported.replace("mav0/cam1/data.csv", stamp + ",", late + ",");
  const auto strict = openEuroc(exported.path());
  EXPECT_EQ(strict->info().frame_count, 5U);
  EXPECT_TRUE(says(strict->info().remarks, "1 images of camera 'cam1' without one of each other"));
  const auto loose = openEuroc(exported.path(), Svar::object({{"tolerance", 0.003}}));
  EXPECT_EQ(loose->info().frame_count, 6U) << testing::PrintToString(loose->info().remarks);
  EXPECT_TRUE(
      has(errorOf(gslam::eurocFactory(), exported.path(), Svar::object({{"tolerance", -1.0}})),
          "tolerance is -1"));
}

TEST(readEuroc, TruthOfOtherSensors) {
  const ExportedEuroc exported;
  const std::string first = std::to_string(frameAt(exported.world(), 0)->stamp);
  // The marker is 1 m in front of the body, turned by a quarter about z; T_BS takes it there.
  writeText(exported.path("mav0/vicon0/data.csv"), first + ",2,3,4,1,0,0,0\n");
  writeText(exported.path("mav0/vicon0/sensor.yaml"),
            "%YAML:1.0\nsensor_type: pose\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0, -1, 0, 1, 1, "
            "0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n");
  writeText(exported.path("mav0/leica0/data.csv"),
            "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m]\n" + first + ",5,6,7\n" +
                first + ",5,6,8\n");
  const auto usual = openEuroc(exported.path());
  EXPECT_TRUE(says(usual->info().remarks, "vicon0 has poses, too"));
  EXPECT_TRUE(says(usual->info().remarks, "leica0 has positions"));
  const auto vicon = openEuroc(exported.path(), Svar::object({{"truth", "vicon0"}}));
  ASSERT_EQ(vicon->info().ground_truth.size(), 1U);
  // The body's origin is (-1, 0, 0) back in its own axes, which is (0, 1, 0) in the marker's.
  const Vec3d body = vicon->info().ground_truth[0].pose * Vec3d{{0, 0, 0}};
  EXPECT_LT((body - Vec3d{{2, 4, 4}}).norm(), 1e-12);
  const auto leica = openEuroc(exported.path(), Svar::object({{"truth", "leica0"}}));
  ASSERT_EQ(leica->info().ground_truth.size(), 1U);
  EXPECT_EQ(leica->info().ground_truth[0].pose.translation()[2], 7);
  EXPECT_TRUE(says(leica->info().remarks, "has no rotations"));
  EXPECT_TRUE(says(leica->info().remarks, "1 positions that have the stamp of another"));
  EXPECT_TRUE(
      has(errorOf(gslam::eurocFactory(), exported.path(), Svar::object({{"truth", "vicon1"}})),
          "vicon1/data.csv: does not exist"));
}

TEST(readEuroc, WindowsLineEndsAndByteOrderMarks) {
  const ExportedEuroc exported;
  const auto expected = openEuroc(exported.path());
  const auto frames = allFrames(*expected);
  for (const char* name : {"cam0/data.csv", "cam0/sensor.yaml", "imu0/data.csv", "imu0/sensor.yaml",
                           "state_groundtruth_estimate0/data.csv"}) {
    const std::string file = std::string("mav0/") + name;
    std::string text = "\xEF\xBB\xBF";
    for (char c : exported.text(file)) text += c == '\n' ? "\r\n" : std::string(1, c);
    writeText(exported.path(file), text);
  }
  const auto again = openEuroc(exported.path()), once = openEuroc(exported.path());
  EXPECT_EQ(again->info().ground_truth.size(), expected->info().ground_truth.size());
  EXPECT_EQ(again->info().sensors.cameras[0].camera, expected->info().sensors.cameras[0].camera);
  EXPECT_EQ(allFrames(*again).size(), frames.size());
}

TEST(readEuroc, OrderAndTwinsAreSaid) {
  const ExportedEuroc exported;
  std::string list = exported.text("mav0/cam0/data.csv");
  list += list.substr(list.find('\n') + 1);  // all a second time
  writeText(exported.path("mav0/cam0/data.csv"), list);
  const std::string imu = exported.text("mav0/imu0/data.csv");
  const std::size_t last = imu.rfind('\n', imu.size() - 2) + 1;
  writeText(exported.path("mav0/imu0/data.csv"), imu.substr(last) + imu.substr(0, last));
  std::string truth = exported.text("mav0/state_groundtruth_estimate0/data.csv");
  truth += truth.substr(truth.rfind('\n', truth.size() - 2) + 1);
  writeText(exported.path("mav0/state_groundtruth_estimate0/data.csv"), truth);
  const auto dataset = openEuroc(exported.path());
  const std::vector<std::string>& remarks = dataset->info().remarks;
  EXPECT_EQ(dataset->info().frame_count, 6U);
  EXPECT_TRUE(says(remarks, "6 images that have the stamp of another in mav0/cam0/data.csv"));
  EXPECT_TRUE(says(remarks, "1 lines of mav0/imu0/data.csv have an earlier stamp"));
  EXPECT_FALSE(says(remarks, "samples of mav0/imu0/data.csv"));
  EXPECT_TRUE(says(remarks, "1 poses of mav0/state_groundtruth_estimate0/data.csv"));
}

TEST(readEuroc, InertialSamplesWithOneStampAreTakenOnce) {
  const ExportedEuroc exported;
  std::size_t expected = 0, found = 0;
  for (const auto& frame : allFrames(*openEuroc(exported.path()))) expected += frame->imu.size();
  const std::string imu = exported.text("mav0/imu0/data.csv");
  const std::size_t second = imu.find('\n', imu.find('\n') + 1) + 1;
  const std::string line = imu.substr(second, imu.find('\n', second) + 1 - second);
  writeText(exported.path("mav0/imu0/data.csv"),
            imu.substr(0, second) + line + line + imu.substr(second));
  const auto dataset = openEuroc(exported.path());
  for (const auto& frame : allFrames(*dataset)) found += frame->imu.size();
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(says(dataset->info().remarks,
                   "skipped 2 samples of mav0/imu0/data.csv that have the stamp of another"))
      << testing::PrintToString(dataset->info().remarks);
}

TEST(readEuroc, SaysWhichFileAndLineIsWrong) {
  const struct {
    const char* file;
    std::string text;
    const char* message;
  } cases[] = {
      {"mav0/imu0/data.csv", "#head\n1,2,3,4,5,6\n", "mav0/imu0/data.csv:2:12: the line ends"},
      {"mav0/imu0/data.csv", "1,2,3,4,5,6,7,8\n", "mav0/imu0/data.csv:1:15: the line goes on"},
      {"mav0/imu0/data.csv", "1,2,nan,4,5,6,7\n", "mav0/imu0/data.csv:1:5: "},
      {"mav0/imu0/data.csv", "1.5,2,3,4,5,6,7\n", "is it in seconds?"},
      {"mav0/imu0/data.csv", "99999999999999999999,2,3,4,5,6,7\n", "mav0/imu0/data.csv:1:1"},
      {"mav0/cam0/data.csv", "#head\n1403715273262142976\n", "mav0/cam0/data.csv:2:20: "},
      {"mav0/cam0/data.csv", "x,y.png\n", "mav0/cam0/data.csv:1:1"},
      {"mav0/cam0/data.csv", "", "has no frame"},
      {"mav0/state_groundtruth_estimate0/data.csv", "1,1,2,3,nan,0,0,0\n",
       "state_groundtruth_estimate0/data.csv:1:"},
      {"mav0/state_groundtruth_estimate0/data.csv", "1,1,2,3,0,0,0,0\n",
       "state_groundtruth_estimate0/data.csv:1:"},
      {"mav0/cam0/sensor.yaml", "%YAML:1.0\nsensor_type: camera\n",
       "mav0/cam0/sensor.yaml: resolution is missing"},
      {"mav0/cam0/sensor.yaml", "%YAML:1.0\nsensor_type: [\n", "mav0/cam0/sensor.yaml:"},
      {"mav0/imu0/sensor.yaml", "%YAML:1.0\nsensor_type: imu\n",
       "mav0/imu0/sensor.yaml: T_BS is missing"},
  };
  for (const auto& each : cases) {
    const ExportedEuroc exported;
    writeText(exported.path(each.file), each.text);
    EXPECT_TRUE(has(exported.error(), each.message)) << exported.error() << "\n" << each.message;
  }
}

TEST(readEuroc, ImagesThatAreWrong) {
  const ExportedEuroc exported;
  const std::string third = exported.path("mav0/cam1/data/") +
                            std::to_string(frameAt(exported.world(), 2)->stamp) + ".png";
  cutInHalf(third);
  const auto dataset = openEuroc(exported.path());
  EXPECT_NE(dataset->next(), nullptr);
  EXPECT_NE(dataset->next(), nullptr);
  try {
    dataset->next();
    FAIL() << "half an image was read";
  } catch (const gslam::FileError& error) {
    EXPECT_EQ(error.path(), third);
  }
  EXPECT_EQ(dataset->next()->id, 3U);
  exported.replace("mav0/cam0/sensor.yaml", "[64, 48]", "[640, 480]");
  EXPECT_TRUE(has(exported.error(), "but the calibration of camera 'cam0' is for 640 x 480"));
}

TEST(readEuroc, WhatIsNone) {
  const TempFolder folder;
  EXPECT_TRUE(has(errorOf(gslam::eurocFactory(), folder.path()), "expected mav0 with cam0"));
  EXPECT_FALSE(gslam::eurocFactory().recognizes(folder.path()));
  EXPECT_THROW(openEuroc(folder / "nowhere"), gslam::FileError);
}

// Index files only: 50 000 frames, of which one image per camera is looked at.
TEST(readEuroc, OpensQuickly) {
  const TempFolder folder;
  std::string list;
  for (std::int64_t i = 0; i < 50000; ++i) {
    const std::string stamp = std::to_string(1403715273262142976 + i * 50000000);
    list += stamp + ",a.png\n";
  }
  writeText(folder / "mav0/cam0/data.csv", list);
  writeImage(folder / "mav0/cam0/data/a.png", numbered(8, 6, 1));
  const auto begin = std::chrono::steady_clock::now();
  const auto dataset = openEuroc(folder.path());
  const double ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(dataset->info().frame_count, 50000U);
  RecordProperty("milliseconds", std::to_string(ms));
  EXPECT_LT(ms, 1000);  // 100 in a release build; sanitizers are slower
}

}  // namespace
