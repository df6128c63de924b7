// What the tests of poses share.
#ifndef GSLAM_OPTIMIZER_PBA_TESTS_POSE_TOOLS_H
#define GSLAM_OPTIMIZER_PBA_TESTS_POSE_TOOLS_H

#include <gslam/optimizer/options.h>

#include "pose_scene.h"
#include "solvers.h"

namespace pose_tools {

constexpr gslam::LossKind kLosses[] = {gslam::LossKind::Squared, gslam::LossKind::Huber,
                                       gslam::LossKind::Cauchy, gslam::LossKind::Tukey,
                                       gslam::LossKind::GemanMcClure};

inline gslam::OptimizerOptions withLoss(gslam::LossKind kind, double scale = 2) {
  gslam::OptimizerOptions options;
  options.loss = {kind, scale};
  return options;
}

inline double distance(const gslam::SE3d& a, const gslam::SE3d& b) {
  return (a.inverse() * b).log().norm();
}

}  // namespace pose_tools

#endif  // GSLAM_OPTIMIZER_PBA_TESTS_POSE_TOOLS_H
