// Robust poses of all pairs (i, i + 1) and (i, i + 5) of real sequences against their true poses,
// each in 11 orders of the matches. What is not within the bounds is listed here, with the reason.
#include <gslam/estimator.h>
#include <gslam/estimator/solvers/triangulate_optimal.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "exceptions.h"
#include "test_data.h"
#include "views.h"

namespace {

using gslam::SE3d;
using gslam::Vec2d;
using gslam::Vec3d;

constexpr unsigned kOrders = 11;

template <class T>
std::vector<T> inOrder(const std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> result;
  for (const std::size_t i : order) result.push_back(values[i]);
  return result;
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vec3d pointAt(const View& view, std::size_t feature, double depth) {
  Vec3d bearing{};
  EXPECT_TRUE(view.camera.unproject(view.pixels[feature], bearing));
  return view.T_world_camera * (bearing * (depth / bearing[2]));
}

// How one pair came out, over all orders of its matches.
struct Outcome {
  std::string failure;  // of the last order that gave no model
  double rotation = 0;  // largest error, degrees
  double other = 0;     // largest error of the direction, degrees, or of the place, metres
  std::size_t matches = 0;
  double cost = 0;  // of the first order: sum of squared residuals, cut off at the threshold, as
                    // parts of the variance of the inliers
  double of_truth = 0;  // the same of the true pose

  bool isWithin(double most_rotation, double most_other) const {
    return failure.empty() && rotation < most_rotation && other < most_other;
  }
  std::string text() const {
    std::ostringstream out;
    out << failure << " rotation off by " << rotation << " degrees, direction or place by " << other
        << "; " << matches << " matches cost " << cost << ", by the true pose " << of_truth;
    return out.str();
  }
};

// Which pairs were not within the bounds. Those known must be explained by the data: the matches
// speak against the true pose by more than four standard deviations, so that no better search finds
// it.
class Report {
 public:
  Report(const char* name, std::set<std::string> known) : name_(name), known_(std::move(known)) {}
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;
  ~Report() {
    for (const std::string& pair : known_) {
      ADD_FAILURE() << name_ << " " << pair << ": within the bounds, no exception any more";
    }
  }

  void add(const std::string& pair, const Outcome& outcome, double rotation, double other) {
    ++pairs_;
    if (outcome.isWithin(rotation, other)) return;
    if (known_.erase(pair) == 0) ADD_FAILURE() << name_ << " " << pair << ": " << outcome.text();
    EXPECT_TRUE(outcome.failure.empty()) << name_ << " " << pair << ": " << outcome.failure;
    EXPECT_GT(outcome.of_truth, outcome.cost + 16)
        << name_ << " " << pair << ": " << outcome.text();
  }
  std::size_t pairs() const { return pairs_; }

 private:
  const char* name_;
  std::set<std::string> known_;
  std::size_t pairs_ = 0;
};

std::string nameOf(const View& first, const View& second) {
  return first.name + "-" + second.name;
}

double cutOff(double residual, double threshold) {
  return std::isfinite(residual) ? std::min(residual * residual, threshold * threshold)
                                 : threshold * threshold;
}

double reprojectionCost(const SE3d& T_world_camera, const gslam::Camera& camera,
                        const std::vector<Vec2d>& pixels, const std::vector<Vec3d>& points) {
  const SE3d T_camera_world = T_world_camera.inverse();
  double cost = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    Vec2d seen{};
    const bool is_seen = camera.project(T_camera_world * points[i], seen);
    cost += cutOff(is_seen ? (seen - pixels[i]).norm() : 1e9, gslam::kAbsolutePosePixelThreshold);
  }
  return cost;
}

// The pose of a view from points whose place is known.
Outcome absolutePose(const View& view, const std::vector<Vec2d>& pixels,
                     const std::vector<Vec3d>& points) {
  Outcome outcome;
  outcome.matches = pixels.size();
  for (unsigned k = 0; k < kOrders; ++k) {
    const auto order = orderOf(pixels.size(), k);
    const auto estimate =
        gslam::estimateAbsolutePose(inOrder(pixels, order), view.camera, inOrder(points, order));
    if (!estimate.ok()) {
      outcome.failure = estimate.message;
      continue;
    }
    if (k == 0) {
      const double variance = estimate.rms * estimate.rms / 2;  // of a coordinate
      outcome.cost = reprojectionCost(estimate.model, view.camera, pixels, points) / variance;
      outcome.of_truth =
          reprojectionCost(view.T_world_camera, view.camera, pixels, points) / variance;
    }
    outcome.rotation = std::max(outcome.rotation, rotationDegrees(estimate.model.rotation(),
                                                                  view.T_world_camera.rotation()));
    outcome.other = std::max(
        outcome.other, (estimate.model.translation() - view.T_world_camera.translation()).norm());
  }
  return outcome;
}

// Sampson's distance of a match in pixels of a pinhole camera.
double epipolarDistance(const SE3d& T_second_first, double focal, const Vec3d& first,
                        const Vec3d& second) {
  const Vec3d x = first / first[2], y = second / second[2];
  const gslam::Mat3d r = T_second_first.rotation().matrix();
  const Vec3d t = T_second_first.translation();
  const Vec3d ex = t.cross(r * x), ey = r.transpose() * y.cross(t);
  return focal * std::fabs(y.dot(ex)) /
         std::sqrt(ex[0] * ex[0] + ex[1] * ex[1] + ey[0] * ey[0] + ey[1] * ey[1]);
}

double epipolarCost(const SE3d& T_second_first, const View& first, const View& second,
                    const std::vector<Match>& matches) {
  double cost = 0;
  for (const Match& match : matches) {
    Vec3d x{}, y{};
    const bool is_seen = first.camera.unproject(first.pixels[match.first], x) &&
                         second.camera.unproject(second.pixels[match.second], y);
    const double distance =
        is_seen ? epipolarDistance(T_second_first, first.camera.parameter("fx"), x, y) : 1e9;
    cost += cutOff(distance, gslam::kRelativePosePixelThreshold);
  }
  return cost;
}

// The relative pose. The direction of the translation counts where the baseline is more than 5 % of
// the depth; where it is less, a rotation alone will do.
Outcome relativePose(const View& first, const View& second, const std::vector<Match>& matches,
                     double depth) {
  const SE3d T_second_first = second.T_world_camera.inverse() * first.T_world_camera;
  const bool has_baseline = T_second_first.translation().norm() > 0.05 * depth;
  Outcome outcome;
  outcome.matches = matches.size();
  std::vector<Vec2d> first_pixels, second_pixels;
  for (const Match& match : matches) {
    first_pixels.push_back(first.pixels[match.first]);
    second_pixels.push_back(second.pixels[match.second]);
  }
  for (unsigned k = 0; k < kOrders; ++k) {
    const auto order = orderOf(matches.size(), k);
    const auto estimate = gslam::estimateRelativePose(
        inOrder(first_pixels, order), inOrder(second_pixels, order), first.camera, second.camera);
    const bool is_rotation = estimate.degeneracy == gslam::Degeneracy::PureRotation;
    if (!estimate.ok() && (has_baseline || !is_rotation)) {
      outcome.failure = estimate.message;
      continue;
    }
    if (k == 0) {
      const double variance = estimate.rms * estimate.rms;
      outcome.cost = epipolarCost(estimate.model, first, second, matches) / variance;
      outcome.of_truth = epipolarCost(T_second_first, first, second, matches) / variance;
    }
    outcome.rotation = std::max(
        outcome.rotation, rotationDegrees(estimate.model.rotation(), T_second_first.rotation()));
    if (!has_baseline) continue;
    outcome.other = std::max(outcome.other, directionDegrees(estimate.model.translation(),
                                                             T_second_first.translation()));
  }
  return outcome;
}

// Depth of each feature by the other view, whose pose is known; 0 where there is none.
std::vector<double> depthsBy(const View& view, const View& other,
                             const std::vector<Match>& matches) {
  const SE3d T_other_view = other.T_world_camera.inverse() * view.T_world_camera;
  std::vector<double> depths(view.pixels.size(), 0.0);
  for (const Match& match : matches) {
    Vec3d first{}, second{}, point{};
    Vec2d seen{};
    if (!view.camera.unproject(view.pixels[match.first], first) ||
        !other.camera.unproject(other.pixels[match.second], second) ||
        gslam::triangulateOptimal(T_other_view, first, second, point) == 0 ||
        !other.camera.project(T_other_view * point, seen) ||
        (seen - other.pixels[match.second]).norm() > 2) {
      continue;
    }
    depths[match.first] = point[2];
  }
  return depths;
}

double medianDepth(const std::vector<double>& depths) {
  std::vector<double> known;
  std::copy_if(depths.begin(), depths.end(), std::back_inserter(known),
               [](double depth) { return depth > 0; });
  return medianOf(known);
}

// The pose of the second view from points of the first.
Outcome poseByDepths(const View& first, const std::vector<double>& depths, const View& second,
                     const std::vector<Match>& matches) {
  std::vector<Vec2d> pixels;
  std::vector<Vec3d> points;
  for (const Match& match : matches) {
    if (depths[match.first] <= 0) continue;
    points.push_back(pointAt(first, match.first, depths[match.first]));
    pixels.push_back(second.pixels[match.second]);
  }
  return absolutePose(second, pixels, points);
}

TEST(RealPose, OfStrecha) {
  NEEDS_TEST_DATA();
  const std::vector<View> views = viewsOf("sfm/strecha_fountain_P11", 0, 8000);
  ASSERT_EQ(views.size(), 11u);
  Report relative("relative", {}), absolute("absolute", {});
  for (std::size_t i = 0; i + 1 < views.size(); ++i) {
    const std::vector<double> depths =
        depthsBy(views[i], views[i + 1], matchesOf(views[i], views[i + 1]));
    for (const std::size_t j : {i + 1, i + 2, i + 5}) {
      if (j >= views.size()) continue;
      const std::vector<Match> matches = matchesOf(views[i], views[j]);
      const std::string pair = nameOf(views[i], views[j]);
      if (j == i + 2) {
        absolute.add(pair, poseByDepths(views[i], depths, views[j], matches), 0.3, 0.02);
      } else {
        relative.add(pair, relativePose(views[i], views[j], matches, medianDepth(depths)), 0.3, 2);
      }
    }
  }
  EXPECT_EQ(relative.pairs(), 16u);
  EXPECT_EQ(absolute.pairs(), 9u);
}

TEST(RealPose, OfKitti) {
  NEEDS_TEST_DATA();
  const std::vector<View> left = viewsOf("sequences/kitti_06", 0, 3000);
  const std::vector<View> right = viewsOf("sequences/kitti_06", 1, 3000);
  ASSERT_EQ(left.size(), 51u);
  Report stereo("stereo", exceptions::listOf(exceptions::kKittiStereo));
  Report relative("relative", exceptions::listOf(exceptions::kKittiRelative));
  std::set<std::string> known = exceptions::listOf(exceptions::kKittiTurned);
  known.merge(exceptions::listOf(exceptions::kKittiDepths));
  Report absolute("absolute", known);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const std::vector<Match> across = matchesOf(left[i], right[i]);
    const std::vector<double> depths = depthsBy(left[i], right[i], across);
    const double depth = medianDepth(depths);
    stereo.add(left[i].name, relativePose(left[i], right[i], across, depth), 0.3, 2);
    for (const std::size_t j : {i + 1, i + 5}) {
      if (j >= left.size()) continue;
      const std::vector<Match> matches = matchesOf(left[i], left[j]);
      const std::string pair = nameOf(left[i], left[j]);
      relative.add(pair, relativePose(left[i], left[j], matches, depth), 0.3, 2);
      absolute.add(pair, poseByDepths(left[i], depths, left[j], matches), 0.3, 0.02);
    }
  }
  EXPECT_EQ(stereo.pairs(), 51u);
  EXPECT_EQ(relative.pairs(), 96u);
}

TEST(RealPose, OfRedKitchen) {
  NEEDS_TEST_DATA();
  const std::vector<View> views = kitchenViews();
  ASSERT_EQ(views.size(), 300u);
  Report absolute("absolute", exceptions::listOf(exceptions::kKitchen));
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const std::size_t j : {i + 1, i + 5}) {
      if (j >= views.size()) continue;
      absolute.add(nameOf(views[i], views[j]),
                   poseByDepths(views[i], views[i].depths, views[j], matchesOf(views[i], views[j])),
                   0.5, 0.03);
    }
  }
  EXPECT_EQ(absolute.pairs(), 594u);
}

}  // namespace
