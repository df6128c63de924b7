// Plain formulas that the fast bundle adjuster is compared with.
#ifndef GSLAM_OPTIMIZER_PBA_TESTS_FAST_REFERENCE_H
#define GSLAM_OPTIMIZER_PBA_TESTS_FAST_REFERENCE_H

#include <cstddef>

#include "../bench/synthetic_bundle.h"
#include "factors/loss.h"
#include "factors/reprojection.h"
#include "solvers.h"

namespace fast_reference {

using gslam::BundleProblem;
using gslam::OptimizerOptions;
using gslam::OptimizerSummary;
using gslam::RobustLoss;
using synthetic_bundle::Arrays;
using synthetic_bundle::Shape;

// Half the sum of rho, summed in long double; pinhole and radtan are projected in it.
long double cost(const BundleProblem& problem, const RobustLoss& loss = {});

// One damped step by dense normal equations in long double; the problem is moved.
void takeStep(const BundleProblem& problem, double damping);

inline Shape tiny(bool bal) {
  Shape shape;
  shape.cameras = 5;
  shape.points = 40;
  shape.observations = 150;
  shape.reach = 5;
  shape.bal = bal;
  return shape;
}

inline OptimizerSummary solve(Arrays& arrays, const OptimizerOptions& options) {
  return gslam::detail::pba::solveFastBundle(arrays.problem(), options);
}

}  // namespace fast_reference

#endif  // GSLAM_OPTIMIZER_PBA_TESTS_FAST_REFERENCE_H
