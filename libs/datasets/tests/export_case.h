// A small dataset in memory, and readers of text that share nothing with the writers.
#ifndef GSLAM_DATASETS_TESTS_EXPORT_CASE_H
#define GSLAM_DATASETS_TESTS_EXPORT_CASE_H

#include <gslam/core/memory_dataset.h>
#include <gslam/datasets/export_dataset.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "frame_at.h"
#include "new_folder.h"
#include "words.h"

namespace export_case {

namespace fs = std::filesystem;
using gslam::CameraImage;
using gslam::CameraSensor;
using gslam::Frame;
using gslam::Image;
using gslam::ImageKind;
using gslam::PixelType;
using gslam::SE3d;
using gslam::SO3d;

constexpr int kWidth = 40, kHeight = 30;
constexpr std::int64_t kFirstStamp = 1403715273262142976;
constexpr std::int64_t kPeriod = 50000001;  // no whole microsecond
constexpr std::int64_t kImuPeriod = 5000003;

inline Image randomImage(std::mt19937& random, PixelType type, int channels) {
  Image image(kWidth, kHeight, type, channels);
  for (int y = 0; y < kHeight; ++y) {
    for (std::size_t i = 0; i < image.rowBytes(); ++i) {
      image.bytes(y)[i] = static_cast<std::uint8_t>(random());
    }
  }
  return image;
}

inline SE3d poseAt(std::int64_t stamp) {
  const double t = double(stamp - kFirstStamp) * 1e-9;
  return SE3d(SO3d::exp({{0.3 * t, 0.5 - 0.2 * t, 1 + t}}),
              {{1 + 2 * t, 0.5 * t * t, -3 + std::sin(t)}});
}

/// What of a dataset a test wants, and the dataset.
struct Case {
  std::vector<std::string> models = {"pinhole"};  ///< of the photographic cameras; "" is no model
  ImageKind kind = ImageKind::grey;
  PixelType type = PixelType::u8;
  bool has_depth = false;
  PixelType depth_type = PixelType::u16;
  double depth_scale = 0.001;
  bool has_imu = false;
  bool has_gnss = false;
  bool has_truth = true;
  bool is_rectified = true;
  std::size_t frames = 5;
  std::int64_t exposure = 1710000;
  std::int64_t first_stamp = kFirstStamp;

  static int channels(ImageKind kind) {
    if (kind == ImageKind::rgb || kind == ImageKind::bgr) return 3;
    return kind == ImageKind::rgba || kind == ImageKind::bgra ? 4 : 1;
  }
  static gslam::Camera model(const std::string& name) {
    std::vector<double> p = {31, 32, 19.25, 14.75};
    if (name.empty()) return gslam::Camera();
    if (name == "radtan4") p.insert(p.end(), {-0.28, 0.07, 0.0002, 1.76e-05});
    if (name == "radtan5") p.insert(p.end(), {-0.28, 0.07, 0.0002, 1.76e-05, 0.01});
    if (name == "radtan5flat") p.insert(p.end(), {-0.28, 0.07, 0.0002, 1.76e-05, 0});
    if (name == "kannala_brandt") p.insert(p.end(), {0.0035, 0.0007, -0.002, 0.0002});
    if (name == "fov") p.push_back(0.93);
    if (name == "eucm") p.insert(p.end(), {0.6, 1.1});
    const std::string word = name.rfind("radtan", 0) == 0 ? "radtan" : name;
    return gslam::Camera::fromParameters(word, kWidth, kHeight, p);
  }
  SE3d poseOfCamera(std::size_t i) const {
    const SE3d first(SO3d::exp({{0.1, -0.2, 1.5}}), {{-0.02, -0.06, 0.01}});
    const SE3d right(SO3d::exp(is_rectified ? gslam::Vec3d{} : gslam::Vec3d{{0.01, 0.02, 0}}),
                     {{0.11 * double(i), 0, 0}});
    return i == 0 ? first : first * right;
  }
  static SE3d poseOfImu() { return SE3d(SO3d::exp({{0, 0.3, 0}}), {{0.01, 0.02, 0.03}}); }

  gslam::DatasetInfo info() const {
    gslam::DatasetInfo info;
    info.name = "random";
    for (std::size_t i = 0; i < models.size(); ++i) {
      CameraSensor camera;
      camera.name = "cam" + std::to_string(i);
      camera.kind = kind;
      camera.camera = model(models[i]);
      camera.T_body_camera = poseOfCamera(i);
      camera.rate = 20;
      info.sensors.cameras.push_back(camera);
    }
    if (has_depth) {
      CameraSensor depth;
      depth.name = "depth";
      depth.kind = ImageKind::depth;
      depth.camera = model(models[0]);
      depth.T_body_camera = poseOfCamera(0);
      depth.depth_scale = depth_scale;
      info.sensors.cameras.push_back(depth);
    }
    info.sensors.has_imu = has_imu;
    info.sensors.imu.T_body_imu = poseOfImu();
    info.sensors.imu.rate = 200;
    info.sensors.imu.gyro_noise = 1.7e-4;
    info.sensors.imu.accel_noise = 2e-3;
    info.sensors.imu.gyro_bias_walk = 1.9e-5;
    info.sensors.imu.accel_bias_walk = 3e-3;
    info.sensors.has_gnss = has_gnss;
    if (!has_truth) return info;
    const std::int64_t last = first_stamp + std::int64_t(frames) * kPeriod;
    for (std::int64_t t = first_stamp - kPeriod; t <= last; t += kPeriod) {
      info.ground_truth.add(t, poseAt(t));
      info.ground_truth.add(t + kPeriod / 3, poseAt(t + kPeriod / 3));
    }
    return info;
  }

  std::vector<std::shared_ptr<const Frame>> makeFrames(const gslam::DatasetInfo& info) const {
    std::mt19937 random(7);
    std::vector<std::shared_ptr<const Frame>> result;
    std::int64_t imu_stamp = first_stamp - 7000000;
    for (std::size_t i = 0; i < frames; ++i) {
      const auto frame = std::make_shared<Frame>();
      frame->id = i;
      frame->stamp = first_stamp + std::int64_t(i) * kPeriod;
      for (const CameraSensor& sensor : info.sensors.cameras) {
        CameraImage image;
        const bool is_depth = sensor.kind == ImageKind::depth;
        image.image = is_depth && depth_type == PixelType::f32
                          ? Image(kWidth, kHeight, PixelType::f32)
                          : randomImage(random, is_depth ? depth_type : type,
                                        is_depth ? 1 : channels(sensor.kind));
        if (is_depth && depth_type == PixelType::f32) {
          for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
              image.image.at<float>(x, y) = float(random() % 10000) * 0.001F;
            }
          }
        }
        image.camera = sensor.camera;
        image.T_body_camera = sensor.T_body_camera;
        image.exposure = exposure;
        image.depth_scale = sensor.depth_scale;
        image.kind = sensor.kind;
        image.name = sensor.name;
        frame->images.push_back(image);
      }
      if (has_imu) {
        for (; imu_stamp <= frame->stamp; imu_stamp += kImuPeriod) {
          const double t = double(imu_stamp - first_stamp) * 1e-9;
          frame->imu.push_back({imu_stamp, {{t, 2 * t, 0.1}}, {{1, t, 9.81}}});
        }
      }
      result.push_back(frame);
    }
    return result;
  }

  std::unique_ptr<gslam::MemoryDataset> dataset() const {
    const gslam::DatasetInfo known = info();
    return std::make_unique<gslam::MemoryDataset>(known, makeFrames(known));
  }
};

inline std::string readText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::vector<std::string> readLines(const std::string& path) {
  std::istringstream text(readText(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// The fields of a line between any of the separators.
inline std::vector<std::string> fields(const std::string& line, const std::string& separators) {
  std::vector<std::string> result;
  std::string field;
  for (char c : line + separators[0]) {
    if (separators.find(c) == std::string::npos) {
      field += c;
    } else if (!field.empty()) {
      result.push_back(field);
      field.clear();
    }
  }
  return result;
}

/// The lines that are no comments, in fields.
inline std::vector<std::vector<std::string>> readTable(const std::string& path,
                                                       const std::string& separators = " ") {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : readLines(path)) {
    if (!line.empty() && line[0] != '#') rows.push_back(fields(line, separators));
  }
  return rows;
}

/// Decimal seconds to nanoseconds, by the digits.
inline std::int64_t stampOf(const std::string& text) {
  const std::size_t point = text.find('.');
  std::string digits = text.substr(point + 1);
  digits.resize(9, '0');
  return std::stoll(text.substr(0, point)) * 1000000000 + std::stoll(digits);
}

/// Pose from the fields from `first` on: tx ty tz and a quaternion that begins with x, or with w.
inline SE3d poseOf(const std::vector<std::string>& row, std::size_t first, bool is_w_first) {
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = std::stod(row.at(first + i));
  return is_w_first ? SE3d(SO3d::fromQuaternion(v[4], v[5], v[6], v[3]), {{v[0], v[1], v[2]}})
                    : SE3d(SO3d::fromQuaternion(v[3], v[4], v[5], v[6]), {{v[0], v[1], v[2]}});
}

/// What stands behind `key:` in a file, with the lines of its brackets.
inline std::string yamlValue(const std::string& text, const std::string& key) {
  const std::size_t place = text.find("\n" + key + ":");
  EXPECT_NE(place, std::string::npos) << key;
  if (place == std::string::npos) return "";
  const std::size_t begin = place + key.size() + 2;
  std::string value = text.substr(begin, text.find('\n', begin) - begin);
  return value;
}

inline std::vector<double> numbers(const std::string& text) {
  std::vector<double> result;
  for (const std::string& field : fields(text, " ,[]\n")) {
    if (field[0] == '#') break;
    result.push_back(std::stod(field));
  }
  return result;
}

inline SE3d yamlPose(const std::string& text) {
  const std::size_t begin = text.find("data: [") + 7;
  const std::vector<double> v = numbers(text.substr(begin, text.find(']', begin) - begin));
  EXPECT_EQ(v.size(), 16U);
  SE3d::Matrix m;
  for (std::size_t i = 0; i < 16; ++i) m(i / 4, i % 4) = v[i];
  return SE3d::fromMatrix(m);
}

/// The pixels of a file as they are in it.
inline cv::Mat readImage(const std::string& path) {
  cv::Mat mat = cv::imread(path, cv::IMREAD_UNCHANGED);
  EXPECT_FALSE(mat.empty()) << path;
  return mat;
}

/// Whether a file has the pixels of an image: channel c of the file is channel order[c] of it.
template <class T>
testing::AssertionResult samePixels(const cv::Mat& file, const Image& image,
                                    const std::vector<int>& order) {
  if (file.cols != image.width() || file.rows != image.height() ||
      file.channels() != int(order.size())) {
    return testing::AssertionFailure() << file.cols << " x " << file.rows << " x "
                                       << file.channels() << " is not " << image.text();
  }
  for (int y = 0; y < file.rows; ++y) {
    for (int x = 0; x < file.cols; ++x) {
      for (int c = 0; c < file.channels(); ++c) {
        const T found = file.ptr<T>(y)[x * file.channels() + c];
        const T expected = image.at<T>(x, y, order[std::size_t(c)]);
        if (found != expected) {
          return testing::AssertionFailure()
                 << "(" << x << ", " << y << ") has " << +found << ", not " << +expected;
        }
      }
    }
  }
  return testing::AssertionSuccess();
}

inline std::size_t countFiles(const std::string& folder) {
  return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace export_case

#endif  // GSLAM_DATASETS_TESTS_EXPORT_CASE_H
