#include <gslam/base/parallel.h>
#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/check.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "check_input.h"
#include "factors/bundle_terms.h"
#include "factors/loss.h"
#include "factors/reprojection.h"
#include "findings.h"

// The cost of a bundle by the plain formulas. An observation that its camera does not see costs
// nothing.

namespace gslam {
inline namespace v1 {
namespace {

// r^T W r
template <std::size_t N>
double weightedSquare(const Vec<double, N>& r, const Mat<double, N, N>& information) {
  return r.dot(information * r);
}

double observationCost(const BundleProblem& problem, std::size_t i, const RobustLoss& loss) {
  const std::uint32_t camera = detail::cameraOf(problem, i);
  const detail::ReprojectionObservation observation = detail::observationAt(problem, i);
  Vec3d r;
  if (!detail::reprojectionResidual(
          problem.T_world_body[problem.observation_pose[i]],
          problem.T_body_camera.empty() ? SE3d() : problem.T_body_camera[camera],
          problem.cameras[camera], problem.points[problem.observation_point[i]], observation, r)) {
    return 0;
  }
  const Vec3d w = problem.information.empty() ? Vec3d{1, 0, 1} : problem.information[i];
  const double right = observation.has_right ? w[0] * r[2] * r[2] : 0;
  const double s = w[0] * r[0] * r[0] + 2 * w[1] * r[0] * r[1] + w[2] * r[1] * r[1] + right;
  return 0.5 * detail::lossAt(loss, s).rho;
}

double windowCost(const BundleProblem& problem, const WindowPrior& prior) {
  const std::size_t n = 6 * prior.poses.size();
  std::vector<double> d(n);
  for (std::size_t i = 0; i < prior.poses.size(); ++i) {
    const SE3d error = prior.T_linear[i].inverse() * problem.T_world_body[prior.poses[i]];
    const SE3d::Tangent tangent = error.log();
    for (std::size_t k = 0; k < 6; ++k) d[6 * i + k] = tangent[k];
  }
  double cost = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0;
    for (std::size_t j = 0; j < n; ++j) row += prior.information[i * n + j] * d[j];
    cost += d[i] * (0.5 * row + prior.gradient[i]);
  }
  return cost;
}

double priorCosts(const BundleProblem& problem) {
  const Span<SE3d> poses = problem.T_world_body;
  double cost = 0;
  for (const PositionPrior& prior : problem.position_priors) {
    const Vec3d r = poses[prior.pose].translation() - prior.position;
    cost += 0.5 * weightedSquare(r, prior.information);
  }
  for (const AbsolutePosePrior& prior : problem.pose_priors) {
    const SE3d error = prior.T_world_body.inverse() * poses[prior.pose];
    cost += 0.5 * weightedSquare(error.log(), prior.information);
  }
  for (const RelativePosePrior& prior : problem.relative_priors) {
    const SE3d error = prior.T_from_to.inverse() * poses[prior.from].inverse() * poses[prior.to];
    cost += 0.5 * weightedSquare(error.log(), prior.information);
  }
  for (const WindowPrior& prior : problem.window_priors) cost += windowCost(problem, prior);
  return cost;
}

}  // namespace

double bundleCost(const BundleProblem& problem, const RobustLoss& loss) {
  detail::checkLoss(loss, "loss");
  detail::throwFirstError(checkBundle(problem));
  // By chunks, so that the sum of millions keeps its digits.
  ParallelOptions chunks;
  chunks.grain = 4096;
  chunks.threads = 1;
  const double cost = parallelReduce(
      0, problem.pixels.size(), 0.0,
      [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t i = first; i < last; ++i) sum += observationCost(problem, i, loss);
        return sum;
      },
      [](double a, double b) { return a + b; }, chunks);
  return cost + priorCosts(problem);
}

}  // namespace v1
}  // namespace gslam
