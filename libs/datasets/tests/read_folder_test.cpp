#include <gslam/core/geodesy.h>
#include <gslam/datasets/formats.h>

#include "reading_case.h"

namespace {

using reading_case::hasRemark;
using reading_case::messageOf;
using reading_case::openWith;
using reading_case::TempFolder;

const char* const kDescription = R"(name: my run
licence: mine
body: the IMU
clock: seconds since the start
stamps: seconds
tolerance: 0.004
cameras:
  - name: left
    images: left.csv
    camera: pinhole 16x12 10 10 7.5 5.5
    T_body_camera: [0.1, 0, 0, 0, 0, 0, 1]
  - name: right
    images: right
    calibration: right.yaml
  - name: depth
    images: depth.csv
    kind: depth
    depth_scale: 0.0002
imu:
  samples: imu.csv
  T_body_imu: [1, 0, 0, 0.5,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1]
  gyro_noise: 0.001
gnss:
  samples: gnss.csv
  antenna: [0, 0, 1]
ground_truth: truth.txt
)";

void write(const TempFolder& folder) {
  folder.write("run/dataset.yaml", kDescription);
  folder.write("run/left.csv", "#stamp,file\n1.0,left/a.png\n1.1,left/b.png\n1.2,left/c.png\n");
  folder.write("run/depth.csv", "1.001 d/a.png\n1.099 d/b.png\n1.3 d/c.png\n");
  for (const char* name : {"a", "b", "c"}) {
    folder.writeImage(std::string("run/left/") + name + ".png", name[0]);
    folder.writeImage(std::string("run/d/") + name + ".png", name[0] + 50, CV_16UC1);
  }
  folder.writeImage("run/right/1.002.png", 1, CV_8UC3, 20, 10);
  folder.writeImage("run/right/1.102.png", 2, CV_8UC3, 20, 10);
  folder.write("run/right.yaml",
               "cam0:\n  camera_model: pinhole\n  distortion_model: radtan\n"
               "  intrinsics: [15, 15, 9.5, 4.5]\n  distortion_coeffs: [0.1, 0.01, 0, 0]\n"
               "  resolution: [20, 10]\n");
  folder.write("run/imu.csv", "0.95,0,0,0.1,0,0,9.8\n1.05,0,0,0.2,0,0,9.8\n");
  folder.write("run/gnss.csv", "1.0 34.2 108.7 500\n1.1 34.3 108.7 500 1 2 3\n");
  folder.write("run/truth.txt", "1.0 0 0 0 0 0 0 1\n1.2 1 0 0 0 0 0 1\n");
}

TEST(read_folder, everything_arrives) {
  const TempFolder folder;
  write(folder);
  reading_case::zipFolder(folder / "run", folder / "run.zip", "packed/");
  for (const char* name : {"run", "run.zip"}) {
    EXPECT_EQ(gslam::datasetFormatOf(folder / name), "folder");
    const auto dataset = openWith(gslam::folderFactory(), folder / name);
    const gslam::DatasetInfo& info = dataset->info();
    EXPECT_EQ(info.name, "my run");
    EXPECT_EQ(info.licence, "mine");
    EXPECT_EQ(info.body, "the IMU");
    EXPECT_EQ(info.frame_count, 2U);
    EXPECT_EQ(info.sensors.cameras[0].T_body_camera.translation()[0], 0.1);
    EXPECT_EQ(info.sensors.cameras[1].camera.modelName(), "radtan");
    EXPECT_EQ(info.sensors.cameras[1].camera.width(), 20);
    EXPECT_EQ(info.sensors.imu.T_body_imu.translation()[0], 0.5);
    EXPECT_EQ(info.sensors.imu.gyro_noise, 0.001);
    EXPECT_EQ(info.sensors.gnss_antenna[2], 1);
    EXPECT_EQ(info.ground_truth.size(), 2U);
    EXPECT_TRUE(hasRemark(info, "left/c.png"));
    EXPECT_TRUE(hasRemark(info, "d/c.png"));
    const auto first = dataset->next(), second = dataset->next();
    EXPECT_EQ(dataset->next(), nullptr);
    EXPECT_EQ(second->stamp, 1100000000);
    ASSERT_EQ(second->images.size(), 3U);
    EXPECT_EQ(second->images[2].kind, gslam::ImageKind::depth);
    EXPECT_EQ(second->images[2].depth_scale, 0.0002);
    EXPECT_EQ(second->images[1].kind, gslam::ImageKind::bgr);
    EXPECT_TRUE(reading_case::isSame(second->images[2].image,
                                     cv::imread(folder / "run/d/b.png", cv::IMREAD_UNCHANGED)));
    ASSERT_EQ(second->imu.size(), 1U);
    EXPECT_EQ(second->imu[0].gyro[2], 0.2);
    ASSERT_EQ(second->gnss.size(), 1U);
    EXPECT_EQ(second->gnss[0].covariance(1, 1), 4);
    EXPECT_NEAR(gslam::degreesOfRadians(second->gnss[0].position.latitude), 34.3, 1e-12);
  }
}

TEST(read_folder, a_folder_with_a_rate_needs_no_stamps) {
  const TempFolder folder;
  folder.write("dataset.yaml", "cameras: [{images: img, rate: 10}]\n");
  for (const char* name : {"img/f2.png", "img/f10.png", "img/f1.png"}) {
    folder.writeImage(name, int(std::string(name).size()));
  }
  const auto dataset = openWith(gslam::folderFactory(), folder.path());
  EXPECT_EQ(dataset->info().frame_count, 3U);
  EXPECT_EQ(dataset->info().last_stamp, 200000000);
  (void)dataset->next();
  (void)dataset->next();
  const cv::Mat last = cv::imread(folder / "img/f10.png", cv::IMREAD_UNCHANGED);
  EXPECT_TRUE(reading_case::isSame(dataset->next()->images[0].image, last));
}

TEST(read_folder, a_description_wins_over_what_a_folder_looks_like) {
  const TempFolder folder;
  folder.write("dataset.yaml", "cameras: [{images: ./cam0/data/, rate: 10}]\n");
  folder.write("cam0/data.csv", "");
  folder.write("other/rgb.txt", "");
  folder.writeImage("cam0/data/1.png", 1);
  EXPECT_EQ(gslam::datasetFormatOf(folder.path()), "folder");
  EXPECT_EQ(gslam::openDataset(folder.path())->info().frame_count, 1U);
  EXPECT_EQ(gslam::openDataset("cvmono:" + (folder / "cam0/data"))->info().format, "cvmono");
  EXPECT_THROW(gslam::openDataset(folder / "nowhere"), gslam::FileError);
  EXPECT_THROW(gslam::openDataset(folder.path(), gslam::Svar::object({{"colour", 1}})),
               gslam::SvarError);
  folder.write("broken.zip", "no archive");
  const std::string message = messageOf([&] { (void)gslam::openDataset(folder / "broken.zip"); });
  EXPECT_NE(message.find("zip archive"), std::string::npos) << message;
}

TEST(read_folder, errors_say_what_to_mend) {
  struct Case {
    const char *file, *text, *message;
  };
  for (const Case& one :
       {Case{"dataset.yaml", "cameras: 3\n", "expected array, found int"},
        {"dataset.yaml", "", "dataset.yaml"},
        {"dataset.yaml", "name: x\n", "has no cameras"},
        {"dataset.yaml", "camras: []\n", "cameras"},
        {"dataset.yaml", "cameras: [{images: left, colour: red}]\n", "cameras.0: colour"},
        {"dataset.yaml", "cameras: [{images: nowhere}]\n", "'nowhere', which does not exist"},
        {"dataset.yaml", "cameras: [{name: x}]\n", "cameras.0.images is missing"},
        {"dataset.yaml", "cameras: [{images: left}]\n", "left/a.png: its name is no stamp"},
        {"dataset.yaml", "stamps: days\ncameras: [{images: left.csv}]\n", "stamps is 'days'"},
        {"dataset.yaml", "cameras: [{images: left.csv, camera: pinhole}]\nstamps: seconds\n",
         "cameras.0.camera is 'pinhole'"},
        {"dataset.yaml", "cameras: [{images: left.csv, T_body_camera: [1, 2]}]\nstamps: seconds\n",
         "T_body_camera has 2 numbers"},
        {"dataset.yaml", "cameras: [{images: left.csv, kind: sonar}]\nstamps: seconds\n",
         "kind is 'sonar'"},
        {"left.csv", "1.0\n", "left.csv:1:"},
        {"left.csv", "", "has no images"},
        {"imu.csv", "0.95,0,0,nan,0,0,9.8\n", "imu.csv:1:"},
        {"imu.csv", "0.95,0,0,0,0,0\n", "imu.csv:1:"},
        {"gnss.csv", "0.95 108.7 34.2 500\n", "gnss.csv:1:1: is no place"},
        {"truth.txt", "1.0 0 0 0 0 0 0 5\n", "truth.txt:1:"},
        {"right.yaml", "nothing: 1\n", "right.yaml"}}) {
    const TempFolder folder;
    write(folder);
    folder.write(std::string("run/") + one.file, one.text);
    const std::string message =
        messageOf([&] { (void)openWith(gslam::folderFactory(), folder / "run"); });
    EXPECT_NE(message.find(one.message), std::string::npos) << one.text << ": " << message;
  }
}

}  // namespace
