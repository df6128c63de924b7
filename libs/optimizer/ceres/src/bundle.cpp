#include <algorithm>
#include <exception>

#include "block_covariance.h"
#include "bundle_model.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

bool hasFreePoints(const BundleProblem& problem) {
  const auto is_free = [](std::uint8_t fixed) { return fixed == 0; };
  return problem.point_fixed.empty()
             ? !problem.points.empty()
             : std::any_of(problem.point_fixed.begin(), problem.point_fixed.end(), is_free);
}

// Part of a covariance: rows and columns from `first` on, size of them.
std::vector<double> partOf(const std::vector<double>& whole, std::size_t width, std::size_t first,
                           std::size_t size) {
  std::vector<double> part;
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t c = 0; c < size; ++c) part.push_back(whole[(first + r) * width + first + c]);
  }
  return part;
}

template <std::size_t N>
Mat<double, N, N> cornerOf(const std::vector<double>& whole, std::size_t width) {
  Mat<double, N, N> corner;
  const std::vector<double> part = partOf(whole, width, 0, N);
  std::copy(part.begin(), part.end(), corner.data());
  return corner;
}

// The blocks that hold what was asked for, in its order; null for what is fixed.
struct WantedBlocks {
  std::vector<Block> poses, points, cameras;

  std::vector<double*> data() const {
    std::vector<double*> all;
    for (const std::vector<Block>* part : {&poses, &points, &cameras}) {
      for (const Block& block : *part) {
        if (block.data != nullptr) all.push_back(block.data);
      }
    }
    return all;
  }
};

WantedBlocks wantedBlocks(const BundleVariables& variables, Span<const std::uint32_t> poses,
                          Span<const std::uint32_t> points, Span<const std::uint32_t> cameras) {
  WantedBlocks wanted;
  for (const std::uint32_t i : poses) wanted.poses.push_back(variables.pose(i));
  for (const std::uint32_t i : points) wanted.points.push_back(variables.point(i));
  for (const std::uint32_t i : cameras) {
    const std::size_t fused = variables.fusedPose(i);
    const bool is_fused = fused != kNoBlock;
    wanted.cameras.push_back(is_fused ? variables.pose(fused) : variables.camera(i));
  }
  return wanted;
}

// What was found, in the order of what is wanted; zero for what is fixed.
void setCovariances(const BundleVariables& variables, const WantedBlocks& wanted,
                    Span<const std::uint32_t> points, const BlockCovariances& found,
                    BundleCovariance& result) {
  auto next = found.blocks.begin();
  for (const Block& block : wanted.poses) {
    const auto width = static_cast<std::size_t>(block.tangent);
    const bool is_free = block.data != nullptr;
    result.poses.push_back(is_free ? cornerOf<6>(*next++, width) : Mat<double, 6, 6>{});
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool is_free = wanted.points[k].data != nullptr;
    Mat3d covariance = is_free ? cornerOf<3>(*next++, 3) : Mat3d{};
    if (variables.isAnchored(points[k])) {
      const Mat3d slope = variables.pointJacobian(points[k]);
      covariance = slope * covariance * slope.transpose();
    }
    result.points.push_back(covariance);
  }
  for (const Block& block : wanted.cameras) {
    const bool is_fused = block.ambient > block.tangent;  // a pose comes first
    const auto width = static_cast<std::size_t>(block.tangent);
    const std::size_t first = is_fused ? 6 : 0;
    result.cameras.emplace_back();
    if (block.data == nullptr) continue;
    result.cameras.back() = partOf(*next++, width, first, width - first);
  }
}

}  // namespace

OptimizerSummary solveBundle(const BundleProblem& problem, const OptimizerOptions& options) {
  const Clock::time_point start = Clock::now();
  checkSolverOptions(options, hasFreePoints(problem));
  BundleModel model(problem, options);
  model.holdFarPoints();
  SearchPlan plan = model.plan();
  plan.start = start;
  SearchResult result = search(model.problem(), plan, options);
  if (result.summary.is_usable) {
    model.variables().writeBack();
  } else {
    model.variables().restore();
  }
  if (result.thrown) std::rethrow_exception(result.thrown);
  model.fillCounts(result.summary);
  result.summary.times.total = secondsSince(start);
  return result.summary;
}

BundleCovariance solveBundleCovariance(const BundleProblem& problem,
                                       Span<const std::uint32_t> poses,
                                       Span<const std::uint32_t> points,
                                       Span<const std::uint32_t> cameras,
                                       const OptimizerOptions& options) {
  BundleModel model(problem, options);
  const BundleVariables& variables = model.variables();
  BundleCovariance result;
  for (const std::uint32_t i : points) {
    if (!variables.isPointFree(i) || model.isPointUsed(i)) continue;
    result.message = "points[" + std::to_string(i) + "] is seen by nobody.";
    return result;
  }
  const WantedBlocks wanted = wantedBlocks(variables, poses, points, cameras);
  const BlockCovariances found =
      blockCovariances(model.problem(), model.freeBlocks(), wanted.data());
  result.is_valid = found.is_valid;
  result.message = found.message;
  if (found.is_valid) setCovariances(variables, wanted, points, found, result);
  return result;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
