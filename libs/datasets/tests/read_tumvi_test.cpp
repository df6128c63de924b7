// TUM VI: what export writes, read back; and folders that lack something.
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>

#include "format_case.h"
#include "test_data.h"

namespace {

using namespace format_case;  // NOLINT(google-build-using-namespace)

class ExportedTumVi {
 public:
  ExportedTumVi() {
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
  const ExportedTumVi exported;
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
  const ExportedTumVi exported;
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
  const ExportedTumVi exported;
  zipFolder(exported.path(), exported.folder() / "seq.zip", "room1_512_16/");
  const auto folder = openTumVi(exported.path()),
             archive = openTumVi(exported.folder() / "seq.zip");
  expectSame(*folder, *archive);
  EXPECT_EQ(archive->info().name, "room1_512_16");
  EXPECT_EQ(gslam::datasetFormatOf(exported.folder() / "seq.zip"), "tumvi");
}

TEST(readTumVi, TheFolderMav0HasDsoBesideIt) {
  const ExportedTumVi exported;
  const auto expected = openTumVi(exported.path());
  for (const std::string end : {"", "/", "/."}) {
    const auto found = openTumVi(exported.path("mav0") + end);
    expected->seek(0);
    expectSame(*expected, *found);
    found->seek(0);
    EXPECT_GT(found->next()->images[0].exposure, 0);
    EXPECT_EQ(found->info().name, "room1_512_16");
    EXPECT_FALSE(says(found->info().remarks, "there is no dso"));
  }
  fs::rename(exported.path("mav0"), exported.folder() / "alone");  // called otherwise, it is alone
  EXPECT_TRUE(says(openTumVi(exported.folder() / "alone")->info().remarks, "there is no dso/cam"));
}

TEST(readTumVi, TheLicenceIsThatOfTumViOnly) {
  const ExportedTumVi exported;
  EXPECT_EQ(openTumVi(exported.path())->info().licence, "");
  fs::rename(exported.path(), exported.folder() / "dataset-room1_512_16");
  EXPECT_TRUE(
      has(openTumVi(exported.folder() / "dataset-room1_512_16")->info().licence, "CC BY 4.0"));
}

// Rows in the form of the published archives, whatever export makes of it: dso/cam0/times.txt in
// ns, s and ms, and mav0/mocap0/data.csv in ns with w first (see vision.in.tum.de/data/datasets/
// visual-inertial-dataset).
TEST(readTumVi, ReadsRowsAsTheyArePublished) {
  const TempFolder folder;
  const std::string stamps[] = {"1520530308199447626", "1520530308249448626"};
  std::string images = "#timestamp [ns],filename\n";
  for (int i = 0; i < 2; ++i) {
    images += stamps[i] + "," + stamps[i] + ".png\n";
    writeImage(folder / ("mav0/cam0/data/" + stamps[i] + ".png"), numbered(8, 6, i, CV_16UC1));
  }
  writeText(folder / "mav0/cam0/data.csv", images);
  writeText(folder / "dso/cam0/times.txt",
            "# timestamp[ns]\ttimestamp[s]\texposure_time[ms]\n"
            "1520530308199447626 1520530308.199447632 6.2084\n"
            "1520530308249448626 1520530308.249448538 0.5\n");
  writeText(folder / "mav0/mocap0/data.csv",
            "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], "
            "q_RS_y [], q_RS_z []\n"
            "1520530308206883817,0.5,-0.25,1.5,0.8,0,0,0.6\n"
            "1520530308215282817,0.75,-0.25,1.5,0.8,0,0,0.6\n");
  const auto dataset = openTumVi(folder.path());
  const auto first = dataset->next(), second = dataset->next();
  EXPECT_EQ(first->stamp, 1520530308199447626);
  EXPECT_EQ(first->images[0].exposure, 6208400);
  EXPECT_EQ(second->images[0].exposure, 500000);
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[0].stamp, 1520530308206883817);
  // w = 0.8, z = 0.6: x turns to (0.8^2 - 0.6^2, 2 0.8 0.6, 0).
  EXPECT_LT((truth[0].pose * Vec3d{{1, 0, 0}} - Vec3d{{0.78, 0.71, 1.5}}).norm(), 1e-12);
}

TEST(readTumVi, ImagesWithoutExposuresAreSaid) {
  const ExportedTumVi exported;
  const std::string times = exported.text("dso/cam0/times.txt");
  const std::string stamp = std::to_string(frameAt(exported.world(), 2)->stamp);
  const std::size_t line = times.find(stamp), end = times.find('\n', line) + 1;
  ASSERT_NE(line, std::string::npos);
  writeText(exported.path("dso/cam0/times.txt"), times.substr(0, line) + times.substr(end));
  const auto dataset = openTumVi(exported.path());
  EXPECT_TRUE(says(dataset->info().remarks,
                   "skipped 1 exposures that dso/cam0/times.txt does not have: mav0/cam0/data/" +
                       stamp + ".png"));
  const auto frames = allFrames(*dataset);
  EXPECT_EQ(frames[2]->images[0].exposure, 0);
  EXPECT_GT(frames[2]->images[1].exposure, 0);
  EXPECT_GT(frames[3]->images[0].exposure, 0);
}

// Where no nanoseconds are those of an image, its seconds are, within a microsecond.
TEST(readTumVi, ExposuresBySeconds) {
  const ExportedTumVi exported;
  std::string times;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::int64_t stamp = frameAt(exported.world(), i)->stamp;
    const std::int64_t rounded = stamp + (i < 4 ? 900 : 1100);
    times += std::to_string(stamp + 7777) + " " + std::to_string(rounded / 1000000000) + "." +
             padded(std::size_t(rounded % 1000000000), 9) + " 1.5\n";
  }
  writeText(exported.path("dso/cam1/times.txt"), times);
  const auto dataset = openTumVi(exported.path());
  EXPECT_TRUE(says(dataset->info().remarks, "the nanoseconds of dso/cam1/times.txt are not those"));
  EXPECT_TRUE(says(dataset->info().remarks, "1 exposures that dso/cam1/times.txt does not have"));
  const auto frames = allFrames(*dataset);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(frames[i]->images[1].exposure, i < 4 ? 1500000 : 0);
  }
}

// Eight numbers without a word are EquiDistant here; where the camera is, dso/ says.
TEST(readTumVi, DsosBareCalibrationOfTheUser) {
  const ExportedTumVi exported;
  const std::string file = exported.folder() / "camera.txt";
  writeText(file, "0.37 0.37 0.49 0.50 0.0034 0.0007 -0.002 0.0002\n64 64\ncrop\n64 64\n");
  const gslam::SensorRig own = openTumVi(exported.path())->info().sensors;
  const Svar parameters = Svar::object({{"calibration", file}, {"cameras", "0"}});
  const gslam::SensorRig found = openTumVi(exported.path(), parameters)->info().sensors;
  EXPECT_EQ(found.cameras[0].camera.modelName(), "kannala_brandt");
  EXPECT_EQ(found.cameras[0].camera.parameter("fx"), 0.37 * 64);
  EXPECT_TRUE(found.cameras[0].T_body_camera.isApprox(own.cameras[0].T_body_camera, 1e-12));
  EXPECT_EQ(found.imu.gyro_noise, own.imu.gyro_noise);
  // What it replaces may be wrong.
  writeText(exported.path("dso/camchain.yaml"), "cam0:\n  camera_model: pinhole\n");
  EXPECT_TRUE(has(errorOf(gslam::tumViFactory(), exported.path()), "dso/camchain.yaml: cam0 / "));
  EXPECT_TRUE(says(openTumVi(exported.path(), parameters)->info().remarks,
                   "a file that the parameter calibration replaces was not used: "));
}

TEST(readTumVi, ASensorsFileThatKalibrsReplaces) {
  const ExportedTumVi exported;
  writeText(exported.path("mav0/cam0/sensor.yaml"), "%YAML:1.0\nsensor_type: camera\n");
  const auto dataset = openTumVi(exported.path());
  EXPECT_EQ(dataset->info().sensors.cameras[0].camera,
            exported.world().info().sensors.cameras[0].camera);
  EXPECT_TRUE(says(dataset->info().remarks, "that another calibration replaces"));
  fs::remove(exported.path("dso/camchain.yaml"));
  EXPECT_TRUE(has(errorOf(gslam::tumViFactory(), exported.path()), "resolution is missing"));
}

TEST(readTumVi, WithoutDso) {
  const ExportedTumVi exported;
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
  const ExportedTumVi exported;
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
    const ExportedTumVi exported;
    writeText(exported.path(each.file), each.text);
    const std::string error = errorOf(gslam::tumViFactory(), exported.path());
    EXPECT_TRUE(has(error, each.message)) << "'" << error << "' has no '" << each.message << "'";
  }
}

TEST(readTumVi, GroundTruthOfAPartIsSaid) {
  const ExportedTumVi exported;
  std::string truth = exported.text("mav0/mocap0/data.csv");
  const std::string stamp = std::to_string(frameAt(exported.world(), 2)->stamp);
  writeText(exported.path("mav0/mocap0/data.csv"),
            truth.substr(0, truth.find("\n" + stamp)) + "\n");
  const auto dataset = openTumVi(exported.path());
  EXPECT_TRUE(says(dataset->info().remarks, "of 5 frames are not in the time of the ground truth"));
}

}  // namespace
