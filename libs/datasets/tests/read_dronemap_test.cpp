// The layouts are those of the original GSLAM's DatasetNPUDroneMap.cpp; no data of it is at hand.
#include <gslam/core/geodesy.h>
#include <gslam/datasets/formats.h>

#include "reading_case.h"

namespace {

using reading_case::hasRemark;
using reading_case::messageOf;
using reading_case::openWith;
using reading_case::TempFolder;

const char* const kConfig =
    "# a comment\r\n"
    "GPS.Origin = 108.7 34.2 500 // degrees\r\n"
    "Camera.Paraments=[16 12 10 11 7.5 5.5]\r\n"
    "Plane = 0 0 0 0 0 0 1\r\n"
    "echo something\r\n";

// Keyframes with poses.
void writeKeyframes(const TempFolder& folder) {
  folder.write("seq/config.cfg", kConfig);
  folder.write("seq/trajectory.txt",
               "1000.25 1 2 50 0.9238795 0.3826834 0 0\n"
               "1001.5 2 2 50 0.9238795 0.3826834 0 0\n"
               "1002.75 3 2 50 0.9238795 0.3826834 0 0\n");
  folder.writeImage("seq/rgb/1000.25.jpg", 1, CV_8UC3);
  folder.writeImage("seq/rgb/1002.75.jpg", 2, CV_8UC3);
}

// All frames, with positions.
void writeUnified(const TempFolder& folder) {
  folder.write("seq/config.cfg",
               "Video.CameraInName = GoPro\nGoPro.Paraments ?= [16,12,0.5,0.6,0.5,0.5,0.9]\n");
  folder.write("seq/frames.txt", "10.5,rgb/a.jpg\n10.75,rgb/b.jpg\n");
  folder.write("seq/gps.txt",
               "10.4,108.7,34.25,500,0\n10.6,108.8,34.25,501,0\n11.5,108.9,34.25,501,0\n");
  folder.writeImage("seq/rgb/a.jpg", 1, CV_8UC3);
  folder.writeImage("seq/rgb/b.jpg", 2, CV_8UC3);
  folder.write("seq/all.npudronemap", "");
  folder.write("seq/mono.npudronemap", "");
}

TEST(read_dronemap, keyframes_have_the_poses_of_the_trajectory) {
  const TempFolder folder;
  writeKeyframes(folder);
  EXPECT_EQ(gslam::datasetFormatOf(folder / "seq"), "dronemap");
  const auto dataset = openWith(gslam::droneMapFactory(), folder / "seq");
  const gslam::DatasetInfo& info = dataset->info();
  EXPECT_EQ(info.frame_count, 2U);
  EXPECT_EQ(info.first_stamp, 1000250000000);
  ASSERT_EQ(info.ground_truth.size(), 3U);
  EXPECT_EQ(info.ground_truth[1].pose.translation()[0], 2);
  EXPECT_FALSE(info.sensors.has_gnss);
  EXPECT_EQ(info.sensors.cameras[0].camera,
            gslam::Camera::fromParameters("pinhole", 16, 12, {10, 11, 7.5, 5.5}));
  EXPECT_TRUE(hasRemark(info, "that do not exist: rgb/1001.5.jpg (trajectory.txt:2)"));
  EXPECT_TRUE(hasRemark(info, "108.7 34.2 500"));
  const auto frame = dataset->next();
  const cv::Mat expected = cv::imread(folder / "seq/rgb/1000.25.jpg", cv::IMREAD_UNCHANGED);
  EXPECT_TRUE(reading_case::isSame(frame->images.at(0).image, expected));
}

TEST(read_dronemap, all_frames_have_positions_but_those_of_mono) {
  const TempFolder folder;
  writeUnified(folder);
  EXPECT_EQ(gslam::datasetFormatOf(folder / "seq/all.npudronemap"), "dronemap");
  for (const char* name : {"seq", "seq/all.npudronemap", "seq/mono.npudronemap"}) {
    const bool is_mono = std::string(name).find("mono") != std::string::npos;
    const auto dataset = openWith(gslam::droneMapFactory(), folder / name);
    EXPECT_EQ(dataset->info().sensors.has_gnss, !is_mono);
    const gslam::Camera& camera = dataset->info().sensors.cameras[0].camera;
    EXPECT_EQ(camera.modelName(), "fov");
    EXPECT_DOUBLE_EQ(camera.parameter("fy"), 0.6 * 12);
    EXPECT_DOUBLE_EQ(camera.parameter("w"), 0.9);
    const auto first = dataset->next(), second = dataset->next();
    ASSERT_EQ(first->gnss.size(), is_mono ? 0U : 1U);
    if (is_mono) continue;
    EXPECT_NEAR(gslam::degreesOfRadians(second->gnss.at(0).position.longitude), 108.8, 1e-12);
    EXPECT_NEAR(gslam::degreesOfRadians(second->gnss[0].position.latitude), 34.25, 1e-12);
    EXPECT_EQ(second->gnss[0].stamp, 10600000000);
  }
}

TEST(read_dronemap, positions_with_one_stamp_are_taken_once) {
  const TempFolder folder;
  writeUnified(folder);
  folder.write("seq/gps.txt", "10.4,108.7,34.2,500\n10.4,108.9,34.2,500\n10.6,108.8,34.25,500\n");
  const auto dataset = openWith(gslam::droneMapFactory(), folder / "seq");
  std::size_t count = 0;
  for (const auto& frame : reading_case::allFrames(*dataset)) count += frame->gnss.size();
  EXPECT_EQ(count, 2U);
  EXPECT_TRUE(hasRemark(dataset->info(),
                        "skipped 1 samples of gps.txt that have the stamp of another: 10.4"));
}

TEST(read_dronemap, an_archive_reads_the_same) {
  const TempFolder folder;
  writeUnified(folder);
  reading_case::zipFolder(folder / "seq", folder / "seq.zip", "gopro-npu/");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "seq.zip"), "dronemap");
  const auto dataset = openWith(gslam::droneMapFactory(), folder / "seq.zip");
  EXPECT_EQ(dataset->info().frame_count, 2U);
  EXPECT_EQ(reading_case::allFrames(*dataset).size(), 2U);
}

TEST(read_dronemap, errors_name_file_and_line) {
  struct Case {
    const char *file, *text, *message;
  };
  for (const Case& one :
       {Case{"config.cfg", "\n\nCamera.Paraments=[16 12 x 11 7.5 5.5]\n", "config.cfg:3:"},
        {"config.cfg", "Camera.Paraments=[16 12 10]\n", "config.cfg:1: Camera.Par"},
        {"config.cfg", "Camera.Paraments=0 12 10 10 1 1\n", "no size of images"},
        {"config.cfg", "Camera.Paraments=16 12 -10 10 1 1\n", "is no camera"},
        {"config.cfg", "Camera.Paraments=17 12 10 10 1 1\n", "is for 17 x 12"},
        {"trajectory.txt", "1000.25 1 2 3\n", "trajectory.txt:1:"},
        {"trajectory.txt", "1000.25 1 2 nan 0 0 0 1\n", "trajectory.txt:1:"},
        {"trajectory.txt", "", "trajectory.txt"},
        {"trajectory.txt", "5 1 2 3 0 0 0 1\n", "no frame"}}) {
    const TempFolder folder;
    writeKeyframes(folder);
    folder.write(std::string("seq/") + one.file, one.text);
    const std::string message =
        messageOf([&] { (void)openWith(gslam::droneMapFactory(), folder / "seq"); });
    EXPECT_NE(message.find(one.message), std::string::npos) << one.text << ": " << message;
  }
  const TempFolder folder;
  writeUnified(folder);
  folder.write("seq/gps.txt", "10.4,34.25,108.7,500,0\n");
  EXPECT_NE(messageOf([&] {
              (void)openWith(gslam::droneMapFactory(), folder / "seq");
            }).find("gps.txt:1:1: is no place"),
            std::string::npos);
  const TempFolder empty;
  EXPECT_THROW(openWith(gslam::droneMapFactory(), empty.path()), gslam::FileError);
}

TEST(read_dronemap, what_is_missing_is_said) {
  const TempFolder folder;
  writeUnified(folder);
  reading_case::fs::remove(folder / "seq/gps.txt");
  reading_case::fs::remove(folder / "seq/config.cfg");
  const auto dataset = openWith(gslam::droneMapFactory(), folder / "seq");
  EXPECT_TRUE(hasRemark(dataset->info(), "no gps.txt"));
  EXPECT_TRUE(hasRemark(dataset->info(), "not calibrated"));
}

}  // namespace
