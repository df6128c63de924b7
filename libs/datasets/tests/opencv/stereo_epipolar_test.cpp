// What the two cameras of EuRoC see lies on the lines that their calibration says, and does not
// with another: models, extrinsics and the pairing of images are right together.
#include <gslam/core/parameters.h>
#include <gslam/datasets/formats.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <string>
#include <vector>

#include "test_data.h"
#include "view.h"

namespace {

using gslam::CameraImage;
using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

struct StereoMatch {
  Vec2d left, right;
};

std::vector<StereoMatch> matchesOf(const gslam::Image& left, const gslam::Image& right) {
  const auto orb = cv::ORB::create(1500);
  std::vector<cv::KeyPoint> keys[2];
  cv::Mat descriptors[2];
  orb->detectAndCompute(view(left), cv::noArray(), keys[0], descriptors[0]);
  orb->detectAndCompute(view(right), cv::noArray(), keys[1], descriptors[1]);
  std::vector<std::vector<cv::DMatch>> found;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(descriptors[0], descriptors[1], found, 2);
  std::vector<StereoMatch> matches;
  for (const auto& pair : found) {
    if (pair.size() < 2 || pair[0].distance > 0.75F * pair[1].distance) continue;
    const cv::Point2f a = keys[0][std::size_t(pair[0].queryIdx)].pt;
    const cv::Point2f b = keys[1][std::size_t(pair[0].trainIdx)].pt;
    matches.push_back({{{a.x, a.y}}, {{b.x, b.y}}});
  }
  return matches;
}

// Median angle between the ray of the right camera and the plane through both centres and the ray
// of the left one, times the focal length: pixels, in the middle of the image.
double medianDistance(const std::vector<StereoMatch>& matches, const CameraImage& left,
                      const CameraImage& right, const SE3d& T_left_right) {
  std::vector<double> distances;
  for (const StereoMatch& match : matches) {
    Vec3d a, b;
    if (!left.camera.unproject(match.left, a) || !right.camera.unproject(match.right, b)) continue;
    const Vec3d normal = T_left_right.translation().cross(a);
    const double sine = normal.dot(T_left_right.rotation() * b) / normal.norm();
    distances.push_back(std::fabs(std::asin(std::max(-1.0, std::min(1.0, sine)))) *
                        left.camera.parameter("fx"));
  }
  EXPECT_GT(distances.size(), 100U);
  if (distances.empty()) return 1e9;
  std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(distances.size() / 2),
                   distances.end());
  return distances[distances.size() / 2];
}

TEST(readEuroc, StereoMatchesLieOnEpipolarLines) {
  NEEDS_TEST_DATA();
  const gslam::DatasetFactory factory = gslam::eurocFactory();
  const auto dataset = factory.open(test_data::folder() + "sequences/euroc_V1_01_easy",
                                    gslam::completeParameters(factory.parameters, gslam::Svar()));
  std::vector<double> right_way, turned, shifted, uncalibrated;
  for (std::size_t i = 0; i < 30; i += 6) {
    dataset->seek(i);
    const auto frame = dataset->next();
    const CameraImage &left = frame->images[0], &right = frame->images[1];
    const std::vector<StereoMatch> matches = matchesOf(left.image, right.image);
    const SE3d T_left_right = left.T_body_camera.inverse() * right.T_body_camera;
    right_way.push_back(medianDistance(matches, left, right, T_left_right));
    // One degree about x; T_BS the other way round; the model of the other camera.
    const SE3d turn(gslam::SO3d::exp({{0.0175, 0, 0}}), Vec3d{});
    turned.push_back(medianDistance(matches, left, right, T_left_right * turn));
    shifted.push_back(
        medianDistance(matches, left, right, left.T_body_camera * right.T_body_camera.inverse()));
    CameraImage wrong = right;
    wrong.camera = left.camera;
    uncalibrated.push_back(medianDistance(matches, left, wrong, T_left_right));
  }
  EXPECT_LT(*std::max_element(right_way.begin(), right_way.end()), 1.5);
  EXPECT_GT(*std::min_element(turned.begin(), turned.end()), 4);
  EXPECT_GT(*std::min_element(shifted.begin(), shifted.end()), 4);
  EXPECT_GT(*std::min_element(uncalibrated.begin(), uncalibrated.end()), 3);
}

}  // namespace
