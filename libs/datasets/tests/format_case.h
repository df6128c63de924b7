// What tests of formats share: files to write, what opening them says, and frames that are warped
// into each other.
#ifndef GSLAM_DATASETS_TESTS_FORMAT_CASE_H
#define GSLAM_DATASETS_TESTS_FORMAT_CASE_H

#include <gslam/core/dataset.h>
#include <gslam/core/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "export_case.h"
#include "reading_case.h"
#include "words.h"

namespace format_case {

using gslam::Dataset;
using gslam::DatasetFactory;
using gslam::Frame;
using gslam::Image;
using gslam::ImageKind;
using gslam::PixelType;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Svar;
using gslam::Vec2d;
using gslam::Vec3d;
using reading_case::allFrames;
using reading_case::TempFolder;
using reading_case::zipFolder;

namespace fs = std::filesystem;

inline void writeText(const std::string& path, const std::string& text) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  EXPECT_TRUE(file.good()) << path;
}

inline void writeImage(const std::string& path, const cv::Mat& image) {
  fs::create_directories(fs::path(path).parent_path());
  EXPECT_TRUE(cv::imwrite(path, image)) << path;
}

/// An image whose pixels tell its number.
inline cv::Mat numbered(int width, int height, int number, int type = CV_8UC1) {
  cv::Mat image(height, width, type);
  cv::RNG random(static_cast<std::uint64_t>(number) + 1);
  random.fill(image, cv::RNG::UNIFORM, 0, type == CV_16UC1 ? 60000 : 256);
  return image;
}

/// The number with zeros in front.
inline std::string padded(std::size_t number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return std::string(digits - text.size(), '0') + text;
}

inline void cutInHalf(const std::string& path) {
  fs::resize_file(path, fs::file_size(path) / 2);
}

inline std::unique_ptr<Dataset> open(const DatasetFactory& factory, const std::string& path,
                                     const Svar& parameters = Svar()) {
  return reading_case::openWith(factory, path, parameters);
}

/// What opening throws, as text; empty where it throws nothing.
inline std::string errorOf(const DatasetFactory& factory, const std::string& path,
                           const Svar& parameters = Svar()) {
  return reading_case::messageOf([&]() { open(factory, path, parameters); });
}

/// Whether two datasets deliver the same.
inline void expectSame(Dataset& a, Dataset& b) {
  EXPECT_EQ(a.info().sensors.cameras.size(), b.info().sensors.cameras.size());
  for (std::size_t i = 0; i < a.info().sensors.cameras.size(); ++i) {
    EXPECT_EQ(a.info().sensors.cameras[i].camera, b.info().sensors.cameras[i].camera);
  }
  ASSERT_EQ(a.info().ground_truth.size(), b.info().ground_truth.size());
  for (std::size_t i = 0; i < a.info().ground_truth.size(); ++i) {
    EXPECT_EQ(a.info().ground_truth[i].stamp, b.info().ground_truth[i].stamp);
    EXPECT_TRUE(a.info().ground_truth[i].pose.isApprox(b.info().ground_truth[i].pose, 1e-15));
  }
  const auto frames = allFrames(a), others = allFrames(b);
  ASSERT_EQ(frames.size(), others.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i]->stamp, others[i]->stamp);
    EXPECT_EQ(frames[i]->imu.size(), others[i]->imu.size());
    ASSERT_EQ(frames[i]->images.size(), others[i]->images.size());
    for (std::size_t k = 0; k < frames[i]->images.size(); ++k) {
      EXPECT_EQ(frames[i]->images[k].image, others[i]->images[k].image);
    }
  }
}

/// Metres; 0: unknown.
inline double depthAt(const gslam::CameraImage& depth, int x, int y) {
  const Image& image = depth.image;
  return image.type() == PixelType::f32 ? double(image.at<float>(x, y)) * depth.depth_scale
                                        : image.at<std::uint16_t>(x, y) * depth.depth_scale;
}

inline double brightnessAt(const Image& image, int x, int y) {
  double sum = 0;
  for (int c = 0; c < image.channels(); ++c) sum += image.at<std::uint8_t>(x, y, c);
  return sum / image.channels();
}

/// How well the pixels of a frame, at their depths, are found again in another.
struct Warp {
  int points = 0;          ///< that fall into the other image where it has depth
  double depth_error = 0;  ///< median, part of the depth
  double grey_error = 0;   ///< mean, grey levels
};

/// @param T_b_a  takes camera a to camera b
inline Warp warp(const Frame& a, const Frame& b, const SE3d& T_b_a, int step = 4) {
  const gslam::CameraImage *colour_a = &a.images[0], *depth_a = &a.images[1];
  const gslam::CameraImage *colour_b = &b.images[0], *depth_b = &b.images[1];
  std::vector<double> depth_errors;
  Warp result;
  double grey = 0;
  for (int y = 0; y < depth_a->image.height(); y += step) {
    for (int x = 0; x < depth_a->image.width(); x += step) {
      const double z = depthAt(*depth_a, x, y);
      Vec3d bearing;
      Vec2d pixel;
      if (z <= 0 || !depth_a->camera.unproject({double(x), double(y)}, bearing)) continue;
      const Vec3d point = T_b_a * (bearing * (z / bearing[2]));
      if (point[2] <= 0 || !depth_b->camera.project(point, pixel)) continue;
      const int u = int(std::lround(pixel[0])), v = int(std::lround(pixel[1]));
      if (u < 0 || v < 0 || u >= depth_b->image.width() || v >= depth_b->image.height()) continue;
      const double there = depthAt(*depth_b, u, v);
      if (there <= 0) continue;
      ++result.points;
      depth_errors.push_back(std::fabs(there - point[2]) / point[2]);
      grey += std::fabs(brightnessAt(colour_a->image, x, y) - brightnessAt(colour_b->image, u, v));
    }
  }
  if (result.points == 0) return result;
  std::nth_element(depth_errors.begin(), depth_errors.begin() + result.points / 2,
                   depth_errors.end());
  result.depth_error = depth_errors[std::size_t(result.points) / 2];
  result.grey_error = grey / result.points;
  return result;
}

/// T_b_a of two frames by the ground truth of a body that is the camera.
inline SE3d truthBetween(const Dataset& dataset, const Frame& a, const Frame& b) {
  SE3d T_w_a, T_w_b;
  EXPECT_TRUE(dataset.info().ground_truth.interpolate(a.stamp, T_w_a)) << a.stamp;
  EXPECT_TRUE(dataset.info().ground_truth.interpolate(b.stamp, T_w_b)) << b.stamp;
  return T_w_b.inverse() * T_w_a;
}

}  // namespace format_case

#endif  // GSLAM_DATASETS_TESTS_FORMAT_CASE_H
