// Features that match between two images of a real dataset lie on each other's epipolar lines,
// where poses and calibration are right, and do not where they are wrong.
#include <gslam/datasets/formats.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <string>
#include <utility>
#include <vector>

#include "test_data.h"
#include "view.h"

namespace {

using gslam::Frame;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

struct Match {
  Vec2d a, b;
};

Vec2d placeOf(const cv::KeyPoint& key) {
  return {double(key.pt.x), double(key.pt.y)};
}

// SIFT, where the second best of neighbours is clearly worse.
std::vector<Match> matches(const gslam::Image& a, const gslam::Image& b) {
  const auto sift = cv::SIFT::create(3000);
  std::vector<cv::KeyPoint> keys_a, keys_b;
  cv::Mat descriptors_a, descriptors_b;
  sift->detectAndCompute(view(a), cv::noArray(), keys_a, descriptors_a);
  sift->detectAndCompute(view(b), cv::noArray(), keys_b, descriptors_b);
  std::vector<std::vector<cv::DMatch>> pairs;
  cv::BFMatcher(cv::NORM_L2).knnMatch(descriptors_a, descriptors_b, pairs, 2);
  std::vector<Match> result;
  for (const std::vector<cv::DMatch>& pair : pairs) {
    if (pair.size() < 2 || pair[0].distance > 0.7F * pair[1].distance) continue;
    result.push_back({placeOf(keys_a[std::size_t(pair[0].queryIdx)]),
                      placeOf(keys_b[std::size_t(pair[0].trainIdx)])});
  }
  return result;
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return 1e9;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Pixels from the matches in b to the epipolar lines of those in a, the median.
double epipolarError(const std::vector<Match>& pairs, const gslam::Camera& camera_a,
                     const gslam::Camera& camera_b, const SE3d& T_b_a) {
  const std::vector<double> k = camera_b.parameters();  // pinhole
  std::vector<double> distances;
  for (const Match& match : pairs) {
    Vec3d bearing;
    if (!camera_a.unproject(match.a, bearing)) continue;
    // The line through the epipole and the direction, in the plane z = 1, then in pixels.
    const Vec3d n = T_b_a.translation().cross(T_b_a.rotation() * bearing);
    const Vec3d line = {n[0] / k[0], n[1] / k[1], n[2] - n[0] * k[2] / k[0] - n[1] * k[3] / k[1]};
    const double at = line[0] * match.b[0] + line[1] * match.b[1] + line[2];
    distances.push_back(std::fabs(at) / std::hypot(line[0], line[1]));
  }
  return medianOf(distances);
}

std::unique_ptr<gslam::Dataset> open(const gslam::DatasetFactory& factory,
                                     const std::string& path) {
  return factory.open(test_data::folder() + path, factory.parameters);
}

std::shared_ptr<const Frame> frameAt(gslam::Dataset& dataset, std::size_t i) {
  dataset.seek(i);
  return dataset.next();
}

SE3d truthAt(const gslam::Dataset& dataset, const Frame& frame) {
  SE3d pose;
  EXPECT_TRUE(dataset.info().ground_truth.interpolate(frame.stamp, pose));
  return pose;
}

struct Errors {
  std::size_t matches;
  double right, inverse, turned;
};

// Of the camera `i` in frame a and `j` in frame b: with the poses as they are, turned round, and
// with the camera one degree off.
Errors errorsOf(const gslam::Dataset& dataset, const Frame& a, std::size_t i, const Frame& b,
                std::size_t j) {
  const gslam::CameraImage &image_a = a.images[i], &image_b = b.images[j];
  const SE3d T_w_a = truthAt(dataset, a) * image_a.T_body_camera;
  const SE3d T_w_b = truthAt(dataset, b) * image_b.T_body_camera;
  const SE3d T_b_a = T_w_b.inverse() * T_w_a;
  const SE3d turn(gslam::SO3d::exp({{0.0175, 0.0175, 0}}), Vec3d{});
  const std::vector<Match> pairs = matches(image_a.image, image_b.image);
  return {pairs.size(), epipolarError(pairs, image_a.camera, image_b.camera, T_b_a),
          epipolarError(pairs, image_a.camera, image_b.camera, T_b_a.inverse()),
          epipolarError(pairs, image_a.camera, image_b.camera, turn * T_b_a)};
}

void record(const std::string& name, const Errors& errors) {
  testing::Test::RecordProperty(
      name, std::to_string(errors.matches) + " " + std::to_string(errors.right) + " inverse " +
                std::to_string(errors.inverse) + " turned " + std::to_string(errors.turned));
}

TEST(readEpipolar, Strecha) {
  NEEDS_TEST_DATA();
  const auto dataset = open(gslam::strechaFactory(), "sfm/strecha_fountain_P11");
  for (const std::size_t i : {2U}) {
    const Errors errors =
        errorsOf(*dataset, *frameAt(*dataset, i), 0, *frameAt(*dataset, i + 1), 0);
    record("strecha" + std::to_string(i), errors);
    EXPECT_GT(errors.matches, 200U);
    EXPECT_LT(errors.right, 0.6);
    EXPECT_GT(errors.inverse, 10 * errors.right);
    EXPECT_GT(errors.turned, 10 * errors.right);
  }
}

TEST(readEpipolar, KittiFromFrameToFrame) {
  NEEDS_TEST_DATA();
  const auto dataset = open(gslam::kittiFactory(), "sequences/kitti_06");
  for (const std::size_t i : {40U}) {
    const Errors errors =
        errorsOf(*dataset, *frameAt(*dataset, i), 0, *frameAt(*dataset, i + 1), 0);
    record("kitti" + std::to_string(i), errors);
    EXPECT_GT(errors.matches, 100U);
    EXPECT_LT(errors.right, 0.6);
    EXPECT_GT(errors.turned, 5 * errors.right);
  }
}

// Depth by the baseline goes with the poses to the next frame: the scale of both is right.
TEST(readEpipolar, KittiStereoAndPosesHaveOneScale) {
  NEEDS_TEST_DATA();
  const auto dataset = open(gslam::kittiFactory(), "sequences/kitti_06");
  const auto a = frameAt(*dataset, 10), b = frameAt(*dataset, 14);
  const gslam::CameraSensor &left = dataset->info().sensors.cameras[0],
                            &right = dataset->info().sensors.cameras[1];
  const double baseline = right.T_body_camera.translation()[0];
  const double fx = left.camera.parameter("fx");
  const SE3d T_b_a = truthAt(*dataset, *b).inverse() * truthAt(*dataset, *a);
  const std::vector<Match> stereo = matches(a->images[0].image, a->images[1].image);
  const std::vector<Match> time = matches(a->images[0].image, b->images[0].image);
  std::vector<double> rows;
  std::vector<std::pair<Vec3d, Vec2d>> points;  // in a, by stereo, and where b sees them
  for (const Match& s : stereo) {
    rows.push_back(std::fabs(s.a[1] - s.b[1]));
    const double disparity = s.a[0] - s.b[0];
    if (disparity < 3) continue;
    for (const Match& t : time) {
      Vec3d bearing;
      if (!(t.a == s.a) || !left.camera.unproject(s.a, bearing)) continue;
      points.emplace_back(bearing * (fx * baseline / disparity / bearing[2]), t.b);
    }
  }
  ASSERT_GT(points.size(), 50U);
  const auto errorAt = [&](double scale) {
    std::vector<double> errors;
    for (const auto& point : points) {
      Vec2d pixel;
      if (left.camera.project(T_b_a * (point.first * scale), pixel)) {
        errors.push_back((pixel - point.second).norm());
      }
    }
    return medianOf(errors);
  };
  double best = 0;
  for (double scale = 0.7; scale < 1.4; scale += 0.01) {
    if (best == 0 || errorAt(scale) < errorAt(best)) best = scale;
  }
  RecordProperty("stereo", std::to_string(medianOf(rows)) + " " + std::to_string(errorAt(1)) +
                               " at " + std::to_string(best) + " " + std::to_string(errorAt(best)));
  EXPECT_LT(medianOf(rows), 0.5);
  EXPECT_LT(errorAt(1), 3);
  EXPECT_GT(errorAt(1.5), 3 * errorAt(1));
  EXPECT_NEAR(best, 1, 0.05);
}

}  // namespace
