#include <gslam/datasets/formats.h>

#include <cmath>
#include <opencv2/videoio.hpp>

#include "../src/formats/natural_order.h"
#include "reading_case.h"

namespace {

using gslam::Svar;
using reading_case::hasRemark;
using reading_case::messageOf;
using reading_case::openWith;
using reading_case::TempFolder;

TEST(read_cvmono, numbers_in_names_count) {
  using gslam::reading::isBeforeNaturally;
  const std::vector<std::string> ordered = {
      "a",  "a1.png", "a2.png", "a02.png" + std::string("x"), "a10.png", "a010b", "b",
      "b9", "b10",    "b10a"};
  std::vector<std::string> shuffled(ordered.rbegin(), ordered.rend());
  std::sort(shuffled.begin(), shuffled.end(), isBeforeNaturally);
  EXPECT_EQ(shuffled[1], "a1.png");
  EXPECT_EQ(shuffled[4], "a10.png");
  EXPECT_EQ(shuffled[8], "b10");
  for (const std::string& a : ordered) {  // a strict weak order
    EXPECT_FALSE(isBeforeNaturally(a, a));
    for (const std::string& b : ordered) {
      EXPECT_FALSE(isBeforeNaturally(a, b) && isBeforeNaturally(b, a)) << a << ' ' << b;
      EXPECT_EQ(a != b, isBeforeNaturally(a, b) || isBeforeNaturally(b, a)) << a << ' ' << b;
    }
  }
}

TEST(read_cvmono, folders_patterns_and_archives_of_images) {
  const TempFolder folder;
  std::vector<cv::Mat> pixels;
  for (int i = 8; i <= 11; ++i) {
    pixels.push_back(folder.writeImage("seq/f" + std::to_string(i) + ".png", i));
  }
  folder.writeImage("seq/other.jpg", 5);
  folder.write("seq/notes.txt", "text");
  reading_case::zipFolder(folder / "seq", folder / "seq.zip");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "seq"), "cvmono");
  EXPECT_EQ(gslam::datasetFormatOf(folder / "seq.zip"), "cvmono");
  for (const char* name : {"seq", "seq/f*.png", "seq.zip", "seq/f?*.p*g"}) {
    const auto dataset = openWith(gslam::cvMonoFactory(), folder / name);
    const bool is_pattern = std::string(name).find('*') != std::string::npos;
    EXPECT_EQ(dataset->info().frame_count, is_pattern ? 4U : 5U) << name;
    EXPECT_TRUE(hasRemark(dataset->info(), "no stamps"));
    for (const cv::Mat& expected : pixels) {
      EXPECT_TRUE(reading_case::isSame(dataset->next()->images.at(0).image, expected)) << name;
    }
  }
}

TEST(read_cvmono, a_folder_may_have_a_number_as_its_name) {
  const TempFolder folder;
  folder.writeImage("00/a.png", 1);
  const reading_case::fs::path here = reading_case::fs::current_path();
  reading_case::fs::current_path(folder.path());
  const auto dataset = openWith(gslam::cvMonoFactory(), "00");
  reading_case::fs::current_path(here);
  EXPECT_FALSE(dataset->info().is_live);
  EXPECT_EQ(dataset->info().frame_count, 1U);
}

TEST(read_cvmono, other_folders_with_images_are_said) {
  const TempFolder folder;
  folder.writeImage("100MEDIA/a.png", 1);
  folder.writeImage("101MEDIA/b.png", 2);
  const auto dataset = openWith(gslam::cvMonoFactory(), folder.path());
  EXPECT_EQ(dataset->info().frame_count, 1U);
  EXPECT_TRUE(hasRemark(dataset->info(), "not those of 101MEDIA"));
}

TEST(read_cvmono, rate_and_every_and_camera) {
  const TempFolder folder;
  for (int i = 0; i < 10; ++i) folder.writeImage("f" + std::to_string(i) + ".png", i);
  const auto dataset =
      openWith(gslam::cvMonoFactory(), folder.path(),
               Svar::object({{"rate", 4.0}, {"every", 3}, {"camera", "pinhole 16x12 9 9 8 6"}}));
  EXPECT_EQ(dataset->info().frame_count, 4U);
  EXPECT_EQ(dataset->info().last_stamp, 2250000000);
  EXPECT_EQ(dataset->info().sensors.cameras[0].camera.parameter("fx"), 9);
  for (const Svar& bad : {Svar::object({{"rate", -1.0}}), Svar::object({{"every", 0}}),
                          Svar::object({{"camera", "pinhole"}}),
                          Svar::object({{"calibration", folder / "none.yaml"}})}) {
    EXPECT_THROW(openWith(gslam::cvMonoFactory(), folder.path(), bad), gslam::Error);
  }
}

// A video whose frames have their number as brightness.
bool writeVideo(const std::string& path, int frames) {
  cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, cv::Size(64, 48));
  for (int i = 0; i < frames; ++i) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(i * 5)));
  return writer.isOpened();
}

int brightness(const gslam::Frame& frame) {
  const gslam::Image& image = frame.images.at(0).image;
  return int(std::lround(image.at<std::uint8_t>(32, 24, 1) / 5.0));
}

TEST(read_cvmono, videos_go_forwards_and_can_be_wound) {
  const TempFolder folder;
  if (!writeVideo(folder / "v.avi", 40)) GTEST_SKIP() << "OpenCV cannot write videos here";
  EXPECT_EQ(gslam::datasetFormatOf(folder / "v.avi"), "cvmono");
  const auto dataset = openWith(gslam::cvMonoFactory(), folder / "v.avi");
  EXPECT_EQ(dataset->info().frame_count, 40U);
  EXPECT_EQ(dataset->info().sensors.cameras[0].rate, 25);
  for (int i = 0; i < 40; ++i) {
    const auto frame = dataset->next();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(brightness(*frame), i);
    EXPECT_EQ(frame->stamp, i * 40000000);
  }
  EXPECT_EQ(dataset->next(), nullptr);
  for (const std::size_t place : {5U, 30U, 31U, 2U}) {
    dataset->seek(place);
    EXPECT_EQ(brightness(*dataset->next()), int(place));
  }
  const auto some =
      openWith(gslam::cvMonoFactory(), folder / "v.avi", Svar::object({{"every", 7}}));
  EXPECT_EQ(some->info().frame_count, 6U);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(brightness(*some->next()), 7 * i);
}

// The number of frames in an AVI's head: dwTotalFrames of avih, and dwLength of strh.
void stateFrames(const std::string& path, std::uint32_t count) {
  std::string bytes = reading_case::textOf(path);
  for (const auto& [chunk, offset] :
       {std::pair<const char*, std::size_t>{"avih", 24}, {"strh", 40}}) {
    const std::size_t at = bytes.find(chunk) + offset;
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = char(count >> (8 * i));
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(read_cvmono, a_video_that_states_a_huge_number_of_frames_is_refused) {
  const TempFolder folder;
  if (!writeVideo(folder / "v.avi", 20)) GTEST_SKIP() << "OpenCV cannot write videos here";
  stateFrames(folder / "v.avi", 900000000);
  EXPECT_THROW(openWith(gslam::cvMonoFactory(), folder / "v.avi"), gslam::FileError);
}

TEST(read_cvmono, a_video_that_ends_early_says_so) {
  const TempFolder folder;
  if (!writeVideo(folder / "v.avi", 20)) GTEST_SKIP() << "OpenCV cannot write videos here";
  stateFrames(folder / "v.avi", 23);
  const auto dataset = openWith(gslam::cvMonoFactory(), folder / "v.avi");
  if (dataset->info().frame_count != 23) GTEST_SKIP() << "this OpenCV counts frames itself";
  for (int i = 0; i < 20; ++i) EXPECT_EQ(brightness(*dataset->next()), i);
  for (int i = 0; i < 3; ++i) EXPECT_THROW(dataset->next(), gslam::FileError);
  EXPECT_EQ(dataset->next(), nullptr);
}

TEST(read_cvmono, frames_stay_as_they_are) {
  const TempFolder folder;
  if (!writeVideo(folder / "v.avi", 20)) GTEST_SKIP() << "OpenCV cannot write videos here";
  const auto dataset = openWith(gslam::cvMonoFactory(), folder / "v.avi");
  const auto frames = reading_case::allFrames(*dataset);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(brightness(*frames[std::size_t(i)]), i);
}

TEST(read_cvmono, errors_say_what_cannot_be_opened) {
  const TempFolder folder;
  folder.write("broken.avi", "no video");
  folder.write("empty.mp4", "");
  reading_case::fs::create_directory(folder / "empty");
  for (const char* name : {"broken.avi", "empty.mp4", "empty", "none*.png", "nowhere/x*.png"}) {
    const std::string message =
        messageOf([&] { (void)openWith(gslam::cvMonoFactory(), folder / name); });
    EXPECT_NE(message.find(folder.path()), std::string::npos) << name << ": " << message;
  }
}

TEST(read_cvmono, devices_that_are_not_there_are_errors) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "what OpenCV asks for devices (libusb) leaks memory";
#endif
  EXPECT_THROW(openWith(gslam::cvMonoFactory(), "99"), gslam::Error);
  EXPECT_THROW(openWith(gslam::cvMonoFactory(), "/dev/no_such_camera"), gslam::Error);
}

}  // namespace
