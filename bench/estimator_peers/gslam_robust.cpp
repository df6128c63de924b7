// Our own robust functions.
#include <gslam/estimator.h>
#include <gslam/geometry/camera.h>

#include <cstddef>

#include "measure.h"

namespace {

using gslam::EstimateOptions;

Numbers numbersOf(const gslam::Mat3d& m) {
  return Numbers(m.values, m.values + 9);
}

Numbers numbersOf(const gslam::SE3d& pose) {
  Numbers numbers = numbersOf(pose.rotation().matrix());
  for (std::size_t i = 0; i < 3; ++i) numbers.push_back(pose.translation()[i]);
  return numbers;
}

EstimateOptions options() {
  EstimateOptions result;
  result.threshold = kThreshold;
  result.confidence = kConfidence;
  result.max_iterations = kIterations;
  return result;
}

const gslam::Camera& camera() {
  static const gslam::Camera result = gslam::Camera::fromParameters(
      "pinhole", kWidth, kHeight, {kFocal, kFocal, kCentreX, kCentreY});
  return result;
}

struct TakesScene {
  static Scene prepare(const Scene& scene) { return scene; }
};

template <class Estimate>
Found foundBy(const Estimate& estimate) {
  Found found;
  if (!estimate.ok()) return found;
  found.model = numbersOf(estimate.model);
  if (estimate.alternative) found.other = numbersOf(*estimate.alternative);
  return found;
}

struct RelativePose : TakesScene {
  static Found run(const Scene& in) {
    return foundBy(gslam::estimateRelativePose(in.first, in.second, camera(), camera(), options()));
  }
};
struct Fundamental : TakesScene {
  static Found run(const Scene& in) {
    return foundBy(gslam::estimateFundamental(in.first, in.second, options()));
  }
};
struct Homography : TakesScene {
  static Found run(const Scene& in) {
    return foundBy(gslam::estimateHomography(in.first, in.second, options()));
  }
};
struct AbsolutePose : TakesScene {
  static Found run(const Scene& in) {
    const auto estimate = gslam::estimateAbsolutePose(in.second, camera(), in.points, options());
    return estimate.ok() ? Found{numbersOf(estimate.model.inverse()), {}} : Found();
  }
};
const bool kRobust = addRobustRows<RelativePose, Fundamental, Homography, AbsolutePose>("gslam");

}  // namespace
