#include <cmath>

#include "export_case.h"
#include "test_data.h"

namespace {

using namespace export_case;  // NOLINT(google-build-using-namespace)
using gslam::exportDataset;
using gslam::ExportReport;

Case stereoInertial(const std::string& model) {
  Case c;
  c.models = {model, model};
  c.is_rectified = false;
  c.has_imu = true;
  c.has_gnss = true;
  return c;
}

TEST(ExportEuroc, ImagesAndStampsReadBack) {
  const NewFolder folder;
  const auto dataset = stereoInertial("radtan4").dataset();
  const ExportReport report = exportDataset(*dataset, folder / "euroc", "euroc");
  EXPECT_EQ(report.frames, 5U);
  for (std::size_t camera = 0; camera < 2; ++camera) {
    const std::string name = "euroc/mav0/cam" + std::to_string(camera);
    const auto rows = readTable(folder / (name + "/data.csv"), ",");
    ASSERT_EQ(rows.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      const auto frame = frameAt(*dataset, i);
      EXPECT_EQ(std::stoll(rows[i][0]), frame->stamp);
      EXPECT_EQ(rows[i][1], rows[i][0] + ".png");
      const cv::Mat file = readImage(folder / (name + "/data/" + rows[i][1]));
      EXPECT_TRUE(samePixels<std::uint8_t>(file, frame->images[camera].image, {0}));
    }
  }
  EXPECT_TRUE(says(report.left_out, "satellite positions"));
}

TEST(ExportEuroc, CalibrationReadsBack) {
  const NewFolder folder;
  const Case c = stereoInertial("radtan4");
  exportDataset(*c.dataset(), folder / "euroc", "euroc");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string text =
        readText(folder / ("euroc/mav0/cam" + std::to_string(i) + "/sensor.yaml"));
    EXPECT_EQ(text.rfind("%YAML:1.0\n", 0), 0U);
    EXPECT_EQ(yamlValue(text, "sensor_type"), " camera");
    EXPECT_EQ(numbers(yamlValue(text, "rate_hz")), std::vector<double>{20});
    EXPECT_EQ(numbers(yamlValue(text, "resolution")), (std::vector<double>{kWidth, kHeight}));
    EXPECT_EQ(yamlValue(text, "camera_model"), " pinhole");
    EXPECT_EQ(numbers(yamlValue(text, "intrinsics")), (std::vector<double>{31, 32, 19.25, 14.75}));
    EXPECT_EQ(yamlValue(text, "distortion_model"), " radial-tangential");
    EXPECT_EQ(numbers(yamlValue(text, "distortion_coefficients")),
              (std::vector<double>{-0.28, 0.07, 0.0002, 1.76e-05}));
    EXPECT_TRUE(yamlPose(text).isApprox(c.poseOfCamera(i), 1e-14));
  }
  const std::string imu = readText(folder / "euroc/mav0/imu0/sensor.yaml");
  EXPECT_TRUE(yamlPose(imu).isApprox(Case::poseOfImu(), 1e-14));
  EXPECT_EQ(numbers(yamlValue(imu, "rate_hz")), std::vector<double>{200});
  EXPECT_EQ(numbers(yamlValue(imu, "gyroscope_noise_density")), std::vector<double>{1.7e-4});
  EXPECT_EQ(numbers(yamlValue(imu, "gyroscope_random_walk")), std::vector<double>{1.9e-5});
  EXPECT_EQ(numbers(yamlValue(imu, "accelerometer_noise_density")), std::vector<double>{2e-3});
  EXPECT_EQ(numbers(yamlValue(imu, "accelerometer_random_walk")), std::vector<double>{3e-3});
}

TEST(ExportEuroc, OpenCvReadsTheYaml) {
  const NewFolder folder;
  exportDataset(*stereoInertial("pinhole").dataset(), folder / "euroc", "euroc");
  for (const char* name : {"cam0/sensor.yaml", "imu0/sensor.yaml", "body.yaml",
                           "state_groundtruth_estimate0/sensor.yaml"}) {
    EXPECT_NO_THROW({
      const cv::FileStorage file(folder / ("euroc/mav0/" + std::string(name)),
                                 cv::FileStorage::READ);
      EXPECT_TRUE(file.isOpened()) << name;
      EXPECT_FALSE(file["comment"].empty()) << name;
    });
  }
  const cv::FileStorage file(folder / "euroc/mav0/cam0/sensor.yaml", cv::FileStorage::READ);
  EXPECT_EQ(double(file["distortion_coefficients"][3]), 0);
  EXPECT_EQ(file["T_BS"]["data"].size(), 16U);
}

TEST(ExportEuroc, OtherModels) {
  const struct {
    const char* model;
    const char* word;
    std::vector<double> coefficients;
  } cases[] = {{"pinhole", " radial-tangential", {0, 0, 0, 0}},
               {"radtan5flat", " radial-tangential", {-0.28, 0.07, 0.0002, 1.76e-05}},
               {"kannala_brandt", " equidistant", {0.0035, 0.0007, -0.002, 0.0002}}};
  for (const auto& each : cases) {
    const NewFolder folder;
    exportDataset(*stereoInertial(each.model).dataset(), folder / "euroc", "euroc");
    const std::string text = readText(folder / "euroc/mav0/cam1/sensor.yaml");
    EXPECT_EQ(yamlValue(text, "distortion_model"), each.word);
    EXPECT_EQ(numbers(yamlValue(text, "distortion_coefficients")), each.coefficients);
  }
}

void expectSamples(const std::vector<std::vector<std::string>>& rows, gslam::Dataset& dataset) {
  std::size_t row = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    for (const gslam::ImuSample& sample : frameAt(dataset, i)->imu) {
      ASSERT_LT(row, rows.size());
      ASSERT_EQ(rows[row].size(), 7U);
      EXPECT_EQ(std::stoll(rows[row][0]), sample.stamp);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(std::stod(rows[row][1 + k]), sample.gyro[k]);
        EXPECT_EQ(std::stod(rows[row][4 + k]), sample.accel[k]);
      }
      ++row;
    }
  }
  EXPECT_EQ(row, rows.size());
}

TEST(ExportEuroc, InertialSamplesReadBack) {
  const NewFolder folder;
  const auto dataset = stereoInertial("pinhole").dataset();
  exportDataset(*dataset, folder / "euroc", "euroc");
  expectSamples(readTable(folder / "euroc/mav0/imu0/data.csv", ","), *dataset);
}

TEST(ExportEuroc, GroundTruthOfTheBodyWithVelocities) {
  const NewFolder folder;
  const auto dataset = stereoInertial("pinhole").dataset();
  const ExportReport report = exportDataset(*dataset, folder / "euroc", "euroc");
  const auto rows = readTable(folder / "euroc/mav0/state_groundtruth_estimate0/data.csv", ",");
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  ASSERT_EQ(rows.size(), truth.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 17U);
    EXPECT_EQ(std::stoll(rows[i][0]), truth[i].stamp);
    EXPECT_TRUE(poseOf(rows[i], 1, true).isApprox(truth[i].pose, 1e-14));
    const double t = double(truth[i].stamp - kFirstStamp) * 1e-9;
    EXPECT_NEAR(std::stod(rows[i][8]), 2, 1e-9);
    EXPECT_NEAR(std::stod(rows[i][9]), t, 1e-9) << "exact for parabolas";
    EXPECT_NEAR(std::stod(rows[i][10]), std::cos(t), 5e-4);
    for (std::size_t k = 11; k < 17; ++k) EXPECT_EQ(std::stod(rows[i][k]), 0);
  }
  EXPECT_TRUE(says(report.remarks, "velocities are differences"));
  EXPECT_TRUE(says(report.remarks, "biases"));
  EXPECT_TRUE(says(report.remarks, "take the IMU of EuRoC for the body"));
}

TEST(ExportEuroc, VelocitiesOfFewPoses) {
  for (int poses = 1; poses <= 2; ++poses) {
    const NewFolder folder;
    Case c;
    c.has_truth = false;
    gslam::DatasetInfo info = c.info();
    for (std::int64_t i = 0; i < poses; ++i) {
      info.ground_truth.add(kFirstStamp + i * 500000000, SE3d(SO3d(), {{double(i), 0, 0}}));
    }
    gslam::MemoryDataset dataset(info, c.makeFrames(info));
    exportDataset(dataset, folder / "euroc", "euroc");
    const auto rows = readTable(folder / "euroc/mav0/state_groundtruth_estimate0/data.csv", ",");
    ASSERT_EQ(rows.size(), std::size_t(poses));
    for (const auto& row : rows) EXPECT_NEAR(std::stod(row[8]), poses == 1 ? 0 : 2, 1e-12);
  }
}

TEST(ExportEuroc, ColourAndWideGreyBecomeGrey) {
  Case c;
  c.kind = ImageKind::rgb;
  {
    const NewFolder folder;
    const auto dataset = c.dataset();
    const ExportReport report = exportDataset(*dataset, folder / "euroc", "euroc");
    const cv::Mat file =
        readImage(folder / ("euroc/mav0/cam0/data/" + std::to_string(kFirstStamp) + ".png"));
    ASSERT_EQ(file.type(), CV_8UC1);
    const Image& image = frameAt(*dataset, 0)->images[0].image;
    for (int x = 0; x < kWidth; ++x) {
      const double luma = 0.299 * image.at<std::uint8_t>(x, 3, 0) +
                          0.587 * image.at<std::uint8_t>(x, 3, 1) +
                          0.114 * image.at<std::uint8_t>(x, 3, 2);  // ITU-R BT.601
      EXPECT_NEAR(file.at<std::uint8_t>(3, x), luma, 1);
    }
    EXPECT_TRUE(says(report.remarks, "colour was made grey"));
  }
  c.kind = ImageKind::grey;
  c.type = PixelType::u16;
  const NewFolder folder;
  const auto dataset = c.dataset();
  exportDataset(*dataset, folder / "euroc", "euroc");
  const cv::Mat file =
      readImage(folder / ("euroc/mav0/cam0/data/" + std::to_string(kFirstStamp) + ".png"));
  const Image& image = frameAt(*dataset, 0)->images[0].image;
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_EQ(file.at<std::uint8_t>(3, x), image.at<std::uint16_t>(x, 3) / 256);
  }
}

TEST(ExportEuroc, RatesThatAreNotKnownAreMeasured) {
  const NewFolder folder;
  const Case c = stereoInertial("pinhole");
  gslam::DatasetInfo info = c.info();
  for (CameraSensor& camera : info.sensors.cameras) camera.rate = 0;
  info.sensors.imu.rate = 0;
  gslam::MemoryDataset dataset(info, c.makeFrames(info));
  exportDataset(dataset, folder / "euroc", "euroc");
  const std::string camera = readText(folder / "euroc/mav0/cam1/sensor.yaml");
  EXPECT_NEAR(numbers(yamlValue(camera, "rate_hz")).at(0), 20, 1e-5);
  const std::string imu = readText(folder / "euroc/mav0/imu0/sensor.yaml");
  EXPECT_NEAR(numbers(yamlValue(imu, "rate_hz")).at(0), 200, 1e-3);
}

TEST(ExportEuroc, FilesAreThoseOfTheRealOne) {
  NEEDS_TEST_DATA();
  const std::string real = test_data::folder() + "sequences/euroc_V1_01_easy/";
  const NewFolder folder;
  exportDataset(*stereoInertial("radtan4").dataset(), folder / "euroc", "euroc");
  for (const auto& entry : fs::recursive_directory_iterator(real + "mav0")) {
    const std::string name = fs::relative(entry.path(), real).string();
    if (name.find(".png") != std::string::npos || name.find("_full") != std::string::npos) continue;
    EXPECT_TRUE(fs::exists(folder / ("euroc/" + name))) << name;
  }
  for (const char* name : {"mav0/cam0/data.csv", "mav0/cam1/data.csv", "mav0/imu0/data.csv"}) {
    const auto ours = readLines(folder / ("euroc/" + std::string(name)));
    const auto theirs = readLines(real + name);
    EXPECT_EQ(ours.at(0), theirs.at(0)) << name;
    EXPECT_EQ(fields(ours.at(1), ",").size(), fields(theirs.at(1), ",").size()) << name;
  }
  const std::string truth = "mav0/state_groundtruth_estimate0/data.csv";
  EXPECT_EQ(readTable(folder / ("euroc/" + truth), ",").at(0).size(),
            readTable(real + truth, ",").at(0).size());
  // Every key of the real files, in the same order.
  for (const char* name : {"mav0/cam0/sensor.yaml", "mav0/imu0/sensor.yaml", "mav0/body.yaml",
                           "mav0/state_groundtruth_estimate0/sensor.yaml"}) {
    const auto keys = [](const std::string& path) {
      std::vector<std::string> found;
      for (const std::string& line : readLines(path)) {
        const std::size_t colon = line.find(": ");
        if (line.empty() || line[0] == '#' || line[0] == '%') continue;
        if (colon != std::string::npos) found.push_back(line.substr(0, colon));
      }
      return found;
    };
    EXPECT_EQ(keys(folder / ("euroc/" + std::string(name))), keys(real + name)) << name;
  }
}

TEST(ExportTumvi, SixteenBitsAndTheSameImagesForDso) {
  const NewFolder folder;
  const auto dataset = stereoInertial("kannala_brandt").dataset();
  const ExportReport report = exportDataset(*dataset, folder / "tumvi", "tumvi");
  EXPECT_TRUE(says(report.remarks, "upper 8 of 16"));
  for (std::size_t camera = 0; camera < 2; ++camera) {
    const std::string name = "cam" + std::to_string(camera);
    const auto rows = readTable(folder / ("tumvi/mav0/" + name + "/data.csv"), ",");
    const auto times = readTable(folder / ("tumvi/dso/" + name + "/times.txt"));
    ASSERT_EQ(rows.size(), 5U);
    ASSERT_EQ(times.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      const auto frame = frameAt(*dataset, i);
      EXPECT_EQ(times[i][0], rows[i][0]);
      EXPECT_EQ(stampOf(times[i][1]), frame->stamp);
      EXPECT_EQ(std::stod(times[i][2]), 1.71);
      const cv::Mat wide = readImage(folder / ("tumvi/mav0/" + name + "/data/" + rows[i][1]));
      const std::string dso = "tumvi/dso/" + name + "/images/" + times[i][0] + ".png";
      ASSERT_EQ(wide.type(), CV_16UC1);
      EXPECT_EQ(cv::norm(wide, readImage(folder / dso), cv::NORM_INF), 0);
      // Readers that want 8 bits get the pixels as they were.
      EXPECT_TRUE(samePixels<std::uint8_t>(cv::imread(folder / dso, cv::IMREAD_GRAYSCALE),
                                           frame->images[camera].image, {0}));
    }
  }
}

TEST(ExportTumvi, WideGreyIsUnchanged) {
  const NewFolder folder;
  Case c;
  c.models = {"kannala_brandt"};
  c.type = PixelType::u16;
  const auto dataset = c.dataset();
  exportDataset(*dataset, folder / "tumvi", "tumvi");
  EXPECT_TRUE(samePixels<std::uint16_t>(
      readImage(folder / ("tumvi/mav0/cam0/data/" + std::to_string(kFirstStamp) + ".png")),
      frameAt(*dataset, 0)->images[0].image, {0}));
  EXPECT_FALSE(fs::exists(folder / "tumvi/dso/imu.txt"));
}

// Four numbers in each of the four rows behind a key.
SE3d kalibrPose(const std::vector<std::string>& lines, std::size_t key_line) {
  SE3d::Matrix m;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<double> row = numbers(lines.at(key_line + 1 + i).substr(4));
    for (std::size_t k = 0; k < 4; ++k) m(i, k) = row.at(k);
  }
  return SE3d::fromMatrix(m);
}

TEST(ExportTumvi, CalibrationIsRelativeToTheImu) {
  const NewFolder folder;
  const Case c = stereoInertial("kannala_brandt");
  exportDataset(*c.dataset(), folder / "tumvi", "tumvi");
  const SE3d T_imu_body = Case::poseOfImu().inverse();
  const auto lines = readLines(folder / "tumvi/dso/camchain.yaml");
  std::size_t camera = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == "cam1:") camera = 1;
    if (lines[i] == "  T_cam_imu:") {
      const SE3d expected = (T_imu_body * c.poseOfCamera(camera)).inverse();
      EXPECT_TRUE(kalibrPose(lines, i).isApprox(expected, 1e-14));
    }
    if (lines[i] == "  T_cn_cnm1:") {
      const SE3d expected = c.poseOfCamera(1).inverse() * c.poseOfCamera(0);
      EXPECT_TRUE(kalibrPose(lines, i).isApprox(expected, 1e-14));
    }
  }
  EXPECT_EQ(camera, 1U);
  const std::string yaml = readText(folder / "tumvi/mav0/cam0/sensor.yaml");
  EXPECT_TRUE(yamlPose(yaml).isApprox(T_imu_body * c.poseOfCamera(0), 1e-14));
  EXPECT_TRUE(yamlPose(readText(folder / "tumvi/mav0/imu0/sensor.yaml")).isApprox(SE3d(), 1e-14));
  const auto dso = readLines(folder / "tumvi/dso/cam0/camera.txt");
  ASSERT_EQ(dso.size(), 4U);
  ASSERT_EQ(dso[0].rfind("EquiDistant ", 0), 0U);
  const std::vector<double> k = numbers(dso[0].substr(12));
  EXPECT_NEAR(k[0] * kWidth, 31, 1e-12);
  EXPECT_NEAR(k[3] * kHeight - 0.5, 14.75, 1e-12);
  EXPECT_EQ(k[7], 0.0002);
}

TEST(ExportTumvi, PosesAreThoseOfTheImu) {
  const NewFolder folder;
  const auto dataset = stereoInertial("kannala_brandt").dataset();
  exportDataset(*dataset, folder / "tumvi", "tumvi");
  const auto mocap = readTable(folder / "tumvi/mav0/mocap0/data.csv", ",");
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  ASSERT_EQ(mocap.size(), truth.size());
  for (std::size_t i = 0; i < mocap.size(); ++i) {
    ASSERT_EQ(mocap[i].size(), 8U);
    const SE3d expected = truth[i].pose * Case::poseOfImu();
    EXPECT_TRUE(poseOf(mocap[i], 1, true).isApprox(expected, 1e-14));
  }
  EXPECT_EQ(readTable(folder / "tumvi/dso/gt_imu.csv", ","), mocap);
}

TEST(ExportTumvi, DsoHasAnInertialSampleAtEachImage) {
  const NewFolder folder;
  const auto dataset = stereoInertial("kannala_brandt").dataset();
  exportDataset(*dataset, folder / "tumvi", "tumvi");
  expectSamples(readTable(folder / "tumvi/mav0/imu0/data.csv", ","), *dataset);
  const auto rows = readTable(folder / "tumvi/dso/imu.txt");
  std::int64_t last = 0;
  std::vector<std::int64_t> stamps;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 7U);
    const std::int64_t stamp = std::stoll(row[0]);
    EXPECT_GT(stamp, last);
    last = stamp;
    stamps.push_back(stamp);
    const double t = double(stamp - kFirstStamp) * 1e-9;  // what is measured is linear in time
    EXPECT_NEAR(std::stod(row[1]), t, 1e-12);
    EXPECT_NEAR(std::stod(row[5]), t, 1e-12);
  }
  for (std::size_t i = 0; i + 1 < 5; ++i) {
    const std::int64_t stamp = kFirstStamp + std::int64_t(i) * kPeriod;
    EXPECT_EQ(std::count(stamps.begin(), stamps.end(), stamp), 1) << i;
  }
}

}  // namespace
