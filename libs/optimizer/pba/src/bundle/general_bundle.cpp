#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "bundle/general_equations.h"
#include "bundle/general_reduced.h"
#include "bundle/general_structure.h"
#include "factors/bundle_terms.h"
#include "solvers.h"
#include "trust_region.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kGeneralDamping = 1e-4;

class GeneralBundle : public TrustRegionProblem {
 public:
  GeneralBundle(const BundleProblem& problem, const OptimizerOptions& options)
      : problem_(problem),
        structure_(generalStructure(problem, neededFill(options))),
        equations_(problem, structure_, options.loss, options.threads),
        solver_(makeReducedSolver(structure_, options)),
        values_(bundleValues(problem, structure_.blocks)),
        candidate_(values_),
        point_step_(3 * problem.points.size()) {}

  double linearize() override {
    const double cost = equations_.linearize(values_);
    equations_.holdFarthest(values_);
    return cost;
  }

  double gradientMax() const override {
    double largest = 0;
    const auto take = [&largest](double g) {
      if (!(std::fabs(g) <= largest)) largest = std::fabs(g);  // NaN is handed on
    };
    for (const double g : equations_.gradient()) take(g);
    forEachPointGroup([&](std::size_t group) {
      for (const double g : equations_.pointGradient(group).values) take(g);
    });
    return largest;
  }

  LinearStep solve(double damping) override {
    LinearStep step;
    solver_->solve(equations_, damping, solution_);
    step.linear_iterations = solution_.iterations;
    if (!solution_.is_solved) return step;
    equations_.substitute(solution_.x.data(), point_step_.data());
    measure(damping, endBeforeInfinity(), step);
    step.is_solved = std::isfinite(step.step_norm) && std::isfinite(step.model_decrease);
    return step;
  }

  double evaluateStep() override {
    if (!stepValues(structure_.blocks, values_, solution_.x.data(), point_step_.data(),
                    candidate_)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    return equations_.cost(candidate_);
  }

  void acceptStep() override { std::swap(values_, candidate_); }

  void writeBack() const {
    const BundleBlocks& blocks = structure_.blocks;
    for (std::size_t i = 0; i < blocks.pose.size(); ++i) {
      if (blocks.pose[i] != kNoBlock) problem_.T_world_body[i] = values_.T_world_body[i];
    }
    for (std::size_t i = 0; i < blocks.point_free.size(); ++i) {
      if (blocks.point_free[i] != 0) problem_.points[i] = values_.points[i];
    }
    for (std::size_t c = 0; c < problem_.cameras.size(); ++c) {
      if (blocks.intrinsic[c] != kNoBlock) problem_.cameras[c] = values_.cameras[c];
      if (blocks.extrinsic[c] != kNoBlock) problem_.T_body_camera[c] = values_.T_body_camera[c];
    }
  }

  void describe(OptimizerSummary& summary) const {
    summary.backend = "pba";
    summary.linear_solver = solver_->name();
    summary.left_out = structure_.left_out;
    summary.observations = structure_.groups.observation.size();
    summary.parameters = structure_.blocks.tangentSize();
    for (const std::uint8_t is_free : structure_.blocks.point_free) {
      summary.parameters += is_free != 0 ? 3 : 0;
    }
    summary.residuals = 3 * problem_.position_priors.size() + 6 * problem_.pose_priors.size() +
                        6 * problem_.relative_priors.size();
    for (const WindowPrior& prior : problem_.window_priors) {
      summary.residuals += 6 * prior.poses.size();
    }
    for (const std::uint32_t i : structure_.groups.observation) {
      summary.residuals += observationAt(problem_, i).has_right ? 3 : 2;
    }
  }

  std::size_t inliers() const { return equations_.inliers(values_); }

 private:
  template <class Visit>
  void forEachPointGroup(const Visit& visit) const {
    for (std::size_t group = 0; group < structure_.groups.count(); ++group) {
      if (structure_.groups.point[group] != kNoBlock) visit(group);
    }
  }

  // Where an inverse distance would step beyond its end, it steps to it, and the direction takes
  // the step that is best then. With V the damped matrix of the point, h its gradient and e what
  // is added to the step d = -V^-1 (h + ..), of which e V e = e_2^2 / (V^-1)_22: the sum of
  // e V e - h e, which measure() needs.
  double endBeforeInfinity() {
    double sum = 0;
    if (structure_.blocks.anchor.empty()) return sum;
    forEachPointGroup([&](std::size_t group) {
      const std::size_t point = structure_.groups.point[group];
      if (structure_.blocks.anchor[point] == kNoBlock) return;
      const Vec4d& anchored = values_.anchored[point];
      const Mat3d& inverse = equations_.pointInverse(group);
      double* const d = &point_step_[3 * point];
      const double missing = leastInverse(anchored) - anchored[3] - d[2];
      if (!(missing > 0 && inverse(2, 2) > 0)) return;
      const double factor = missing / inverse(2, 2);
      sum += factor * missing;
      for (std::size_t i = 0; i < 3; ++i) {
        const double e = factor * inverse(i, 2);
        d[i] += e;
        sum -= equations_.pointGradient(group)[i] * e;
      }
    });
    return sum;
  }

  // Lengths, and how much the model falls. With (H + damping D) d = -g - r, r what conjugate
  // gradients left: -g d - d H d / 2 = (damping d D d - g d + r d) / 2. For a d + e with d the best
  // step of the points, it is less by (e V e - h e) / 2 beside that.
  void measure(double damping, double twice_lost, LinearStep& step) const {
    double squared = 0, twice_decrease = -twice_lost;
    for (std::size_t i = 0; i < solution_.x.size(); ++i) {
      const double d = solution_.x[i];
      const double rest = solution_.residual.empty() ? 0 : solution_.residual[i];
      squared += d * d;
      twice_decrease +=
          d * (damping * equations_.diagonal(i) * d - equations_.gradient()[i] + rest);
    }
    forEachPointGroup([&](std::size_t group) {
      const double* const d = &point_step_[3 * std::size_t(structure_.groups.point[group])];
      for (std::size_t i = 0; i < 3; ++i) {
        const double diagonal = GeneralEquations::bounded(equations_.pointHessian(group)(i, i));
        squared += d[i] * d[i];
        twice_decrease += d[i] * (damping * diagonal * d[i] - equations_.pointGradient(group)[i]);
      }
    });
    step.step_norm = std::sqrt(squared);
    step.model_decrease = 0.5 * twice_decrease;
    step.variable_norm = variableNorm();
  }

  double variableNorm() const {
    const BundleBlocks& blocks = structure_.blocks;
    double squared = 0;
    for (std::size_t i = 0; i < blocks.pose.size(); ++i) {
      if (blocks.pose[i] == kNoBlock) continue;
      squared += values_.T_world_body[i].translation().squaredNorm() + 1;
    }
    for (std::size_t i = 0; i < blocks.point_free.size(); ++i) {
      if (blocks.point_free[i] == 0) continue;
      squared += blocks.anchorOf(i) != kNoBlock
                     ? 1 + values_.anchored[i][3] * values_.anchored[i][3]
                     : values_.points[i].squaredNorm();
    }
    for (std::size_t c = 0; c < blocks.intrinsic.size(); ++c) {
      if (blocks.extrinsic[c] != kNoBlock) {
        squared += values_.T_body_camera[c].translation().squaredNorm() + 1;
      }
      if (blocks.intrinsic[c] == kNoBlock) continue;
      const std::vector<double> parameters = values_.cameras[c].parameters();
      for (const std::uint32_t k : blocks.freedom[c].parameters) {
        squared += parameters[k] * parameters[k];
      }
    }
    return std::sqrt(squared);
  }

  const BundleProblem& problem_;
  const GeneralStructure structure_;
  GeneralEquations equations_;
  const std::unique_ptr<ReducedSolver> solver_;
  BundleValues values_, candidate_;
  ReducedSolution solution_;
  std::vector<double> point_step_;
};

}  // namespace

OptimizerSummary solveGeneralBundle(const BundleProblem& problem, const OptimizerOptions& options) {
  const Clock::time_point start = Clock::now();
  OptimizerSummary summary;
  GeneralBundle bundle(problem, options);
  bundle.describe(summary);
  try {
    runTrustRegion(bundle, options, kGeneralDamping, start, summary);
  } catch (...) {
    bundle.writeBack();
    throw;
  }
  if (summary.is_usable) bundle.writeBack();
  summary.inliers = bundle.inliers();
  summary.times.total = secondsSince(start);
  return summary;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
