#include "views.h"

#include <gslam/core/opencv.h>
#include <gslam/datasets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "test_data.h"

using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

namespace {

cv::Mat greyOf(const gslam::CameraImage& image) {
  const cv::Mat pixels = gslam::toOpenCv(image.image);
  if (pixels.channels() == 1) return pixels;
  cv::Mat grey;
  cv::cvtColor(pixels, grey,
               image.kind == gslam::ImageKind::rgb ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
  return grey;
}

void addFeatures(const cv::Mat& grey, cv::Feature2D& detector, View& view) {
  std::vector<cv::KeyPoint> keypoints;
  detector.detectAndCompute(grey, cv::noArray(), keypoints, view.descriptors);
  for (const cv::KeyPoint& keypoint : keypoints) {
    view.pixels.push_back({keypoint.pt.x, keypoint.pt.y});
  }
}

// Calls use(frame, T_world_body) for each frame that has a true pose.
template <class Use>
void forEachFrame(const std::string& path, const Use& use) {
  const auto dataset = gslam::openDataset(test_data::folder() + path);
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  while (const auto frame = dataset->next()) {
    const auto found = std::find_if(truth.begin(), truth.end(),
                                    [&](const auto& pose) { return pose.stamp == frame->stamp; });
    if (found != truth.end()) use(*frame, found->pose);
  }
}

// Where a ray of the colour camera meets the depth image: its length along the axis, 0 for nowhere.
double depthAlong(const Vec3d& ray, const gslam::CameraImage& depth) {
  const cv::Mat values = gslam::toOpenCv(depth.image);
  Vec2d pixel{};
  if (!depth.camera.project(ray, pixel) || !depth.camera.isInImage(pixel)) return 0;
  const std::uint16_t value = values.at<std::uint16_t>(static_cast<int>(std::lround(pixel[1])),
                                                       static_cast<int>(std::lround(pixel[0])));
  return value == 65535 ? 0 : value * depth.depth_scale;
}

}  // namespace

std::vector<View> viewsOf(const std::string& path, std::size_t image, int features) {
  const cv::Ptr<cv::Feature2D> detector = cv::SIFT::create(features, 3, 0.02);
  std::vector<View> views;
  forEachFrame(path, [&](const gslam::Frame& frame, const SE3d& T_world_body) {
    View view;
    view.name = std::to_string(frame.id);
    view.camera = frame.images.at(image).camera;
    view.T_world_camera = T_world_body * frame.images[image].T_body_camera;
    addFeatures(greyOf(frame.images[image]), *detector, view);
    views.push_back(view);
  });
  return views;
}

std::vector<View> kitchenViews() {
  const cv::Ptr<cv::Feature2D> detector = cv::ORB::create(1500);
  std::vector<View> views;
  const auto add = [&](const gslam::Frame& frame, const SE3d& T_world_body) {
    View view;
    view.name = std::to_string(frame.id);
    view.camera = gslam::Camera::fromParameters("pinhole", 640, 480, {525, 525, 320, 240});
    view.T_world_camera = T_world_body;
    addFeatures(greyOf(frame.images.at(0)), *detector, view);
    const gslam::CameraImage* const depth = findImage(frame, gslam::ImageKind::depth);
    for (const Vec2d& pixel : view.pixels) {
      Vec3d ray{};
      const bool is_seen = depth != nullptr && view.camera.unproject(pixel, ray);
      view.depths.push_back(is_seen ? depthAlong(ray, *depth) : 0);
    }
    views.push_back(view);
  };
  forEachFrame("sequences/7scenes_redkitchen", add);
  return views;
}

std::vector<Match> matchesOf(const View& first, const View& second) {
  const int norm = first.descriptors.type() == CV_8U ? cv::NORM_HAMMING : cv::NORM_L2;
  const cv::BFMatcher matcher(norm);
  std::vector<std::vector<cv::DMatch>> there;
  std::vector<cv::DMatch> back;
  matcher.knnMatch(first.descriptors, second.descriptors, there, 2);
  matcher.match(second.descriptors, first.descriptors, back);
  std::vector<Match> matches;
  for (const auto& nearest : there) {
    if (nearest.size() < 2 || nearest[0].distance > 0.8F * nearest[1].distance) continue;
    const cv::DMatch& match = nearest[0];
    if (back[static_cast<std::size_t>(match.trainIdx)].trainIdx != match.queryIdx) continue;
    matches.push_back(
        {static_cast<std::size_t>(match.queryIdx), static_cast<std::size_t>(match.trainIdx)});
  }
  return matches;
}

std::vector<std::size_t> orderOf(std::size_t n, unsigned k) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::mt19937 generator(k);
  for (std::size_t i = n; k > 0 && i > 1; --i) std::swap(order[i - 1], order[generator() % i]);
  return order;
}

namespace {
double degrees(double radians) {
  return radians * 180 / std::acos(-1.0);
}
}  // namespace

double rotationDegrees(const gslam::SO3d& a, const gslam::SO3d& b) {
  return degrees((a.inverse() * b).log().norm());
}

double directionDegrees(const Vec3d& a, const Vec3d& b) {
  return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}
