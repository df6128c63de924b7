#include <gslam/optimizer/two_view_problem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "factors/is_before.h"
#include "factors/loss.h"
#include "factors/reprojection.h"
#include "small/dense.h"
#include "solvers.h"
#include "trust_region.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kTwoViewDamping = 1e-6;
constexpr double kLeastDepthDamping = 1e-6;  // of the largest diagonal element of a depth

// Inverse depths stand in normal equations alone with the pose, so each one is eliminated by a
// division: H = [Hpp h_i; h_i^T d_i]. Those that are zero and would become negative are held.
struct DepthEquations {
  Vec<double, 6> coupling{};  // h_i
  double diagonal = 0;        // d_i; 0: held, or nothing depends on it
  double gradient = 0;
};

// T_second_first, ready for points p / depth: the place of depth times the point, which is seen at
// the same pixel and exists at infinity too.
struct FromFirst {
  Mat3d rotation;
  Vec3d shift;  // by the inverse depth

  explicit FromFirst(const SE3d& T_first_second)
      : rotation(T_first_second.rotation().matrix().transpose()),
        shift(-(rotation * T_first_second.translation())) {}
  Vec3d operator()(const Vec3d& bearing, double depth) const {
    return rotation * bearing + depth * shift;
  }
};

class TwoViewTrustRegion final : public TrustRegionProblem {
 public:
  TwoViewTrustRegion(const TwoViewProblem& problem, const SE3d& start, const RobustLoss& loss)
      : problem_(problem),
        loss_(loss),
        T_(start),
        candidate_(start),
        depths_(problem.inverse_depths.begin(), problem.inverse_depths.end()),
        means_(depths_),
        candidate_depths_(depths_),
        bearings_(depths_.size()),
        is_used_(depths_.size()),
        equations_of_(depths_.size()),
        step_of_(depths_.size()) {
    for (const double information : problem.depth_information) {
      has_scale_ = has_scale_ || information > 0;
    }
    const FromFirst view(start);
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      is_used_[i] = problem.first_camera.unproject(problem.first[i], bearings_[i]) &&
                            isBefore(problem.second_camera, view(bearings_[i], depths_[i]))
                        ? 1
                        : 0;
      used_ += is_used_[i];
    }
  }

  const SE3d& pose() const { return T_; }
  const std::vector<double>& depths() const { return depths_; }
  std::size_t used() const { return used_; }
  std::size_t inliers() const { return inliers_; }
  bool hasScale() const { return has_scale_; }

  double linearize() override {
    equations_ = {};
    inliers_ = 0;
    most_diagonal_ = 0;
    const FromFirst view(T_);
    double cost = 0;
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      equations_of_[i] = {};
      if (is_used_[i] != 0) cost += addMatch(i, view);
      cost += addMean(i, depths_[i], &equations_of_[i]);
      DepthEquations& own = equations_of_[i];
      if (depths_[i] <= 0 && own.gradient >= 0) own.diagonal = 0;
      if (!(own.diagonal > std::numeric_limits<double>::min())) own = {};
      most_diagonal_ = std::max(most_diagonal_, own.diagonal);
    }
    setBasis();
    return cost;
  }

  double gradientMax() const override {
    double most = has_scale_ ? equations_.gradientMax() : onSphere(equations_).gradientMax();
    for (const DepthEquations& own : equations_of_) {
      if (!(std::fabs(own.gradient) <= most)) most = std::fabs(own.gradient);
    }
    return most;
  }

  LinearStep solve(double damping) override {
    LinearStep result;
    const SmallEquations<6> reduced = eliminated(damping);
    Vec<double, 6> step{};
    result.is_solved = solveForPose(reduced, damping, step);
    if (!result.is_solved) return result;
    step_ = step;
    double squared = step.squaredNorm(), variables = 1 + T_.translation().squaredNorm();
    result.model_decrease = equations_.decrease(step);
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      const DepthEquations& own = equations_of_[i];
      step_of_[i] = 0;
      if (!(own.diagonal > 0)) continue;
      const double coupled = own.coupling.dot(step);
      const double wanted = -(own.gradient + coupled) / damped(own, damping);
      step_of_[i] = std::max(wanted, -depths_[i]);  // not beyond infinity
      result.model_decrease -=
          step_of_[i] * (own.gradient + coupled + 0.5 * own.diagonal * step_of_[i]);
      squared += step_of_[i] * step_of_[i];
      variables += depths_[i] * depths_[i];
    }
    result.step_norm = std::sqrt(squared);
    result.variable_norm = std::sqrt(variables);
    result.is_solved = std::isfinite(squared);
    return result;
  }

  double evaluateStep() override {
    constexpr double kMostStep = 1e3;
    for (std::size_t i = 3; i < 6; ++i) {
      if (!(std::fabs(step_[i]) < kMostStep)) return std::numeric_limits<double>::infinity();
    }
    candidate_ = T_ * SE3d::exp(step_);
    if (!has_scale_) {
      const double length = T_.translation().norm(), now = candidate_.translation().norm();
      if (!(now > 0)) return std::numeric_limits<double>::infinity();
      candidate_.setTranslation(length / now * candidate_.translation());
    }
    const FromFirst view(candidate_);
    double cost = 0;
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      candidate_depths_[i] = std::max(0.0, depths_[i] + step_of_[i]);
      if (is_used_[i] != 0) {
        Vec2d r;
        if (!residual(i, view(bearings_[i], candidate_depths_[i]), r, nullptr)) {
          return std::numeric_limits<double>::infinity();
        }
        cost += 0.5 * lossAt(loss_, information(i) * r.squaredNorm()).rho;
      }
      cost += addMean(i, candidate_depths_[i], nullptr);
    }
    return cost;
  }

  void acceptStep() override {
    T_ = candidate_;
    depths_.swap(candidate_depths_);
  }

  // Of the pose, the depths marginalised out.
  bool covariance(Mat<double, 6, 6>& result) const {
    const SmallEquations<6> reduced = eliminated(0);
    if (has_scale_) return invertSmall(reduced.hessian, result);
    Mat<double, 5, 5> inverse;
    if (!invertSmall(onSphere(reduced).hessian, inverse)) return false;
    result = basis_ * inverse * basis_.transpose();
    return true;
  }

 private:
  double information(std::size_t i) const {
    return problem_.information.empty() ? 1 : problem_.information[i];
  }

  bool residual(std::size_t i, const Vec3d& q, Vec2d& r, Mat<double, 2, 3>* slope) const {
    Vec2d pixel{};
    if (!projectEverywhere(problem_.second_camera, q, pixel, slope)) {
      return false;
    }
    r = pixel - problem_.second[i];
    return true;
  }

  // d q = -depth rho - omega x q + shift d depth, for the tangent (rho, omega) on the right.
  double addMatch(std::size_t i, const FromFirst& view) {
    Mat<double, 2, 3> slope;
    Vec2d r{};
    const Vec3d q = view(bearings_[i], depths_[i]);
    if (!residual(i, q, r, &slope)) return std::numeric_limits<double>::infinity();
    const LossValue loss = lossAt(loss_, information(i) * r.squaredNorm());
    if (loss.first >= 0.5) ++inliers_;
    const double weight = information(i) * loss.first;
    DepthEquations& own = equations_of_[i];
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3d a = slope.row(k), turned = a.cross(q);
      const double d = depths_[i];
      const Vec<double, 6> row = {-d * a[0], -d * a[1], -d * a[2], turned[0], turned[1], turned[2]};
      const double own_row = a.dot(view.shift);
      equations_.addRow(row.data(), weight, weight * r[k]);
      own.coupling += weight * own_row * row;
      own.diagonal += weight * own_row * own_row;
      own.gradient += weight * own_row * r[k];
    }
    return 0.5 * loss.rho;
  }

  double addMean(std::size_t i, double depth, DepthEquations* own) const {
    if (problem_.depth_information.empty()) return 0;
    const double weight = problem_.depth_information[i], r = depth - means_[i];
    if (own != nullptr) {
      own->diagonal += weight;
      own->gradient += weight * r;
    }
    return 0.5 * weight * r * r;
  }

  double damped(const DepthEquations& own, double damping) const {
    return own.diagonal + damping * std::max(own.diagonal, kLeastDepthDamping * most_diagonal_);
  }

  SmallEquations<6> eliminated(double damping) const {
    SmallEquations<6> reduced = equations_;
    for (const DepthEquations& own : equations_of_) {
      if (!(own.diagonal > 0)) continue;
      const double inverse = 1 / damped(own, damping);
      reduced.addRow(own.coupling.data(), -inverse, -inverse * own.gradient);
    }
    return reduced;
  }

  // Columns: two directions across the translation, three of rotation.
  void setBasis() {
    const Vec3d t = T_.rotation().inverse() * T_.translation();
    const double length = t.norm();
    const Vec3d along = length > 0 ? t / length : Vec3d{0, 0, 1};
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::fabs(along[i]) < std::fabs(along[least])) least = i;
    }
    Vec3d axis{};
    axis[least] = 1;
    const Vec3d first = along.cross(axis).normalized(), second = along.cross(first);
    basis_ = {};
    for (std::size_t i = 0; i < 3; ++i) {
      basis_(i, 0) = first[i];
      basis_(i, 1) = second[i];
      basis_(3 + i, 2 + i) = 1;
    }
  }

  // The equations where the length of the translation is kept.
  SmallEquations<5> onSphere(const SmallEquations<6>& equations) const {
    Mat<double, 6, 6> whole = equations.hessian;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < i; ++j) whole(i, j) = whole(j, i);
    }
    SmallEquations<5> result;
    result.hessian = basis_.transpose() * whole * basis_;
    result.gradient = basis_.transpose() * equations.gradient;
    return result;
  }

  bool solveForPose(const SmallEquations<6>& reduced, double damping, Vec<double, 6>& step) const {
    if (has_scale_) return solveDetermined(reduced, damping, step);
    Vec<double, 5> part{};
    if (!solveDetermined(onSphere(reduced), damping, part)) return false;
    step = basis_ * part;
    return true;
  }

  const TwoViewProblem& problem_;
  const RobustLoss& loss_;
  SE3d T_, candidate_;
  std::vector<double> depths_, means_, candidate_depths_;
  std::vector<Vec3d> bearings_;
  std::vector<std::uint8_t> is_used_;
  std::vector<DepthEquations> equations_of_;
  std::vector<double> step_of_;
  Vec<double, 6> step_{};
  SmallEquations<6> equations_;
  Mat<double, 6, 5> basis_{};
  double most_diagonal_ = 0;
  std::size_t used_ = 0;
  std::size_t inliers_ = 0;
  bool has_scale_ = false;
};

}  // namespace

OptimizedTwoView solveTwoView(const TwoViewProblem& problem, const SE3d& T_first_second,
                              const OptimizerOptions& options) {
  const Clock::time_point began = Clock::now();
  OptimizedTwoView result;
  OptimizerSummary& summary = result.summary;
  TwoViewTrustRegion loop(problem, T_first_second, options.loss);
  const auto writeDepths = [&problem, &loop] {
    std::copy(loop.depths().begin(), loop.depths().end(), problem.inverse_depths.begin());
  };
  const std::size_t n = loop.depths().size();
  summary.linear_solver = "dense Cholesky, depths eliminated";
  summary.observations = loop.used();
  summary.left_out = n - loop.used();
  summary.residuals = 2 * loop.used() + problem.depth_information.size();
  summary.parameters = (loop.hasScale() ? 6 : 5) + n;
  result.T_first_second = T_first_second;
  if (loop.used() == 0) {
    summary.message = "the second camera sees no point from where the search starts";
    return result;
  }
  try {
    runTrustRegion(loop, options, kTwoViewDamping, began, summary);
  } catch (...) {  // of the progress function
    writeDepths();
    throw;
  }
  if (!summary.is_usable) return result;
  writeDepths();
  result.T_first_second = loop.pose();
  summary.inliers = loop.inliers();
  if (!loop.covariance(result.covariance)) {
    result.covariance = {};
    summary.warnings.push_back(
        "not all directions are determined, as where all points are far: along the others the pose "
        "is that of the start, and there is no covariance");
  }
  return result;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
