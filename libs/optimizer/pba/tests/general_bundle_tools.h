// What tests of the general bundle adjuster share.
#ifndef GSLAM_OPTIMIZER_PBA_TESTS_GENERAL_BUNDLE_TOOLS_H
#define GSLAM_OPTIMIZER_PBA_TESTS_GENERAL_BUNDLE_TOOLS_H

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "bundle_scene.h"
#include "solvers.h"

namespace general_bundle {

using bundle_scene::Scene;
using gslam::OptimizerOptions;
using gslam::OptimizerSummary;

inline OptimizerOptions thorough() {
  OptimizerOptions options;
  options.max_iterations = 100;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  return options;
}

/// Distances of what was found from the truth.
inline void expectTruth(const Scene& scene, double tolerance) {
  for (std::size_t i = 0; i < scene.truth.T_world_body.size(); ++i) {
    EXPECT_TRUE(scene.bundle.T_world_body[i].isApprox(scene.truth.T_world_body[i], tolerance)) << i;
  }
  for (std::size_t i = 0; i < scene.truth.points.size(); ++i) {
    const gslam::Vec3d& x = scene.truth.points[i];
    EXPECT_LT((scene.bundle.points[i] - x).norm(), tolerance * (1 + x.norm())) << i;
  }
}

inline OptimizerSummary solveToTheEnd(Scene& scene, const OptimizerOptions& options = thorough()) {
  const OptimizerSummary summary = gslam::detail::pba::solveGeneralBundle(scene.problem(), options);
  EXPECT_TRUE(summary.is_usable);
  EXPECT_LT(summary.final_cost, 1e-12) << summary.message;
  return summary;
}

}  // namespace general_bundle

#endif  // GSLAM_OPTIMIZER_PBA_TESTS_GENERAL_BUNDLE_TOOLS_H
