// TUM VI: what export writes, read back; and folders that lack something.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include "format_case.h"
#include "test_data.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)
using export_case::frameAt;

class Exported {
 public:
  Exported() {
    gslam::SyntheticOptions options;
    options.frames = 5;
    options.width = 64;
    options.height = 64;
    options.sensors = "stereo";
    options.model = "kannala_brandt";
    world_ = gslam::openSynthetic(options);
    gslam::exportDataset(*world_, path(), "tumvi");
    // Where there are links, dso/cam0/images is one into mav0.
    for (const char* camera : {"dso/cam0/images", "dso/cam1/images"}) fs::remove_all(path(camera));
  }
  std::string path(const std::string& name = "") const {
    return folder_ / (name.empty() ? "room1_512_16" : "room1_512_16/" + name);
  }
  std::string text(const std::string& name) const { return export_case::readText(path(name)); }
  const TempFolder& folder() const { return folder_; }
  Dataset& world() const { return *world_; }

 private:
  TempFolder folder_;
  std::unique_ptr<Dataset> world_;
};

std::unique_ptr<Dataset> openTumVi(const std::string& path, const Svar& parameters = Svar()) {
  return open(gslam::tumViFactory(), path, parameters);
}

// T_imu_camera, which is what the layout keeps: its body is the IMU.
SE3d placeByImu(const gslam::SensorRig& rig, std::size_t i) {
  return rig.imu.T_body_imu.inverse() * rig.cameras[i].T_body_camera;
}

TEST(readTumVi, ReadsWhatWasExported) {
  const Exported exported;
  const auto dataset = openTumVi(exported.path());
  const gslam::DatasetInfo &info = dataset->info(), &expected = exported.world().info();
  EXPECT_EQ(info.format, "tumvi");
  EXPECT_EQ(info.name, "room1_512_16");
  EXPECT_EQ(info.body, "the IMU");
  EXPECT_EQ(gslam::datasetFormatOf(exported.path()), "tumvi");
  ASSERT_EQ(info.sensors.cameras.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(info.sensors.cameras[i].camera, expected.sensors.cameras[i].camera);
    EXPECT_TRUE(placeByImu(info.sensors, i).isApprox(placeByImu(expected.sensors, i), 1e-12));
    EXPECT_EQ(info.sensors.cameras[i].kind, ImageKind::grey);
  }
  EXPECT_EQ(info.sensors.imu.gyro_noise, expected.sensors.imu.gyro_noise);
  EXPECT_EQ(info.sensors.imu.accel_bias_walk, expected.sensors.imu.accel_bias_walk);
  EXPECT_EQ(info.sensors.imu.rate, 200);
  ASSERT_EQ(info.ground_truth.size(), expected.ground_truth.size());
  for (std::size_t i = 0; i < info.ground_truth.size(); ++i) {
    const SE3d of_imu = expected.ground_truth[i].pose * expected.sensors.imu.T_body_imu;
    EXPECT_TRUE(info.ground_truth[i].pose.isApprox(of_imu, 1e-12));
  }
  for (std::size_t i = 0; i < 5; ++i) {
    const auto frame = dataset->next(), same = frameAt(exported.world(), i);
    EXPECT_EQ(frame->stamp, same->stamp);
    EXPECT_EQ(frame->imu.size(), same->imu.size());
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(frame->images[k].exposure, same->images[k].exposure);
      EXPECT_GT(frame->images[k].exposure, 0);
      ASSERT_EQ(frame->images[k].image.type(), PixelType::u16);
      for (int x = 0; x < 64; x += 7) {  // export puts 8 bits into the upper half of 16
        EXPECT_EQ(frame->images[k].image.at<std::uint16_t>(x, x) >> 8,
                  same->images[k].image.at<std::uint8_t>(x, x));
      }
    }
  }
}

TEST(readTumVi, ImagesOfEightBits) {
  const Exported exported;
  for (const char* camera : {"cam0", "cam1"}) {
    const std::string folder = exported.path("mav0/" + std::string(camera) + "/data");
    for (const auto& entry : fs::directory_iterator(folder)) {
      cv::Mat image = cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED), small;
      image.convertTo(small, CV_8U, 1 / 257.0);
      writeImage(entry.path().string(), small);
    }
  }
  EXPECT_EQ(openTumVi(exported.path())->next()->images[0].image.type(), PixelType::u8);
}

TEST(readTumVi, AnArchiveReadsTheSame) {
  const Exported exported;
  zipFolder(exported.path(), exported.folder() / "seq.zip", "room1_512_16/");
  const auto folder = openTumVi(exported.path()),
             archive = openTumVi(exported.folder() / "seq.zip");
  expectSame(*folder, *archive);
  EXPECT_EQ(archive->info().name, "room1_512_16");
  EXPECT_EQ(gslam::datasetFormatOf(exported.folder() / "seq.zip"), "tumvi");
}

TEST(readTumVi, WithoutDso) {
  const Exported exported;
  fs::remove_all(exported.path("dso"));
  for (const char* sensor : {"cam0", "cam1", "imu0"}) {
    fs::remove(exported.path("mav0/" + std::string(sensor) + "/sensor.yaml"));
  }
  EXPECT_EQ(gslam::datasetFormatOf(exported.path()), "tumvi");  // by mocap0
  const auto dataset = openTumVi(exported.path());
  const std::vector<std::string>& remarks = dataset->info().remarks;
  EXPECT_FALSE(dataset->info().sensors.cameras[0].camera.isValid());
  EXPECT_TRUE(says(remarks, "there is no dso/camchain.yaml"));
  EXPECT_TRUE(says(remarks, "there is no dso/imu_config.yaml"));
  EXPECT_TRUE(says(remarks, "there is no dso/cam1/times.txt: exposures are not known"));
  EXPECT_TRUE(says(remarks, "camera cam1 is not calibrated"));
  EXPECT_EQ(allFrames(*dataset).size(), 5U);
}

TEST(readTumVi, ACalibrationOfTheUser) {
  NEEDS_TEST_DATA();
  const Exported exported;
  const std::string file =
      test_data::folder() + "calibrations/kalibr/tum_vi/kalibr_imucam_chain.yaml";
  // It is for 512 x 512; these are smaller, which is said.
  EXPECT_TRUE(
      has(errorOf(gslam::tumViFactory(), exported.path(), Svar::object({{"calibration", file}})),
          "is for 512 x 512"));
  std::string text = export_case::readText(file);
  for (int i = 0; i < 2; ++i) {
    const std::size_t at = text.find("[512, 512]");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 10, "[64, 64]");
  }
  const std::string small = exported.folder() / "small.yaml";
  writeText(small, text);
  const auto dataset =
      openTumVi(exported.path(), Svar::object({{"calibration", small}, {"cameras", "1"}}));
  ASSERT_EQ(dataset->info().sensors.cameras.size(), 1U);
  EXPECT_EQ(dataset->info().sensors.cameras[0].camera.parameter("fx"), 190.44236969414825);
}

TEST(readTumVi, SaysWhichFileAndLineIsWrong) {
  const struct {
    const char* file;
    const char* text;
    const char* message;
  } cases[] = {
      {"dso/cam0/times.txt", "# head\n1 2\n", "dso/cam0/times.txt:2:4: the line ends"},
      {"dso/cam0/times.txt", "1 2 -0.1\n", "dso/cam0/times.txt:1:5: the exposure is negative"},
      {"dso/cam0/times.txt", "1 2 3 4\n", "dso/cam0/times.txt:1:7: the line goes on"},
      {"dso/camchain.yaml", "cam0:\n  camera_model: pinhole\n", "dso/camchain.yaml: cam0 / "},
      {"dso/imu_config.yaml", "update_rate: 200\n", "dso/imu_config.yaml: cam0 or imu0 is missing"},
      {"mav0/mocap0/data.csv", "1,2,3\n", "mav0/mocap0/data.csv:1:"},
      {"mav0/cam1/data.csv", "", "has no frame with an image of each camera"}};
  for (const auto& each : cases) {
    const Exported exported;
    writeText(exported.path(each.file), each.text);
    const std::string error = errorOf(gslam::tumViFactory(), exported.path());
    EXPECT_TRUE(has(error, each.message)) << "'" << error << "' has no '" << each.message << "'";
  }
}

TEST(readTumVi, GroundTruthOfAPartIsSaid) {
  const Exported exported;
  std::string truth = exported.text("mav0/mocap0/data.csv");
  const std::string stamp = std::to_string(frameAt(exported.world(), 2)->stamp);
  writeText(exported.path("mav0/mocap0/data.csv"),
            truth.substr(0, truth.find("\n" + stamp)) + "\n");
  const auto dataset = openTumVi(exported.path());
  EXPECT_TRUE(says(dataset->info().remarks, "of 5 frames are not in the time of the ground truth"));
}

}  // namespace
