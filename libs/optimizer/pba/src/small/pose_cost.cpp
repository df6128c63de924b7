#include "small/pose_cost.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "factors/loss.h"
#include "factors/reprojection.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kUnusable = std::numeric_limits<double>::infinity();

// The numbers of a camera whose formula has a kernel; false for other models.
struct FormulaOf {
  using Result = bool;
  PoseCamera& camera;
  PoseFormula& formula;

  template <class Model>
  bool operator()(const Model&) const {
    return false;
  }
  static bool none() { return false; }
  bool operator()(const PinholeCamera<double>& model) const {
    formula = PoseFormula::Pinhole;
    return set(model, nullptr, 0);
  }
  bool operator()(const RadtanCamera<double, 4>& model) const { return setRadtan<4>(model); }
  bool operator()(const RadtanCamera<double, 5>& model) const { return setRadtan<5>(model); }

  template <std::size_t N>
  bool setRadtan(const RadtanCamera<double, N>& model) const {
    double c[N];
    for (std::size_t i = 0; i < N; ++i) c[i] = model.projection().parameter(i);
    formula = PoseFormula::Radtan;
    return set(model, c, N);
  }
  template <class Model>
  bool set(const Model& model, const double* c, std::size_t count) const {
    camera.fx = model.fx(), camera.fy = model.fy(), camera.cx = model.cx(), camera.cy = model.cy();
    double* const to[] = {&camera.k1, &camera.k2, &camera.p1, &camera.p2, &camera.k3};
    for (std::size_t i = 0; i < 5; ++i) *to[i] = i < count ? c[i] : 0;
    return true;
  }
};

// Adds the observations of a tile by the formulas of a model, point by point.
struct AddPoints {
  using Result = bool;
  const PoseProblem& problem;
  const SE3d& T_camera_world;
  const RobustLoss& loss;
  const PoseCurvature curvature;
  PoseBlock& block;
  const std::size_t count;
  PoseValue& sum;

  template <class Model>
  bool operator()(const Model& model) const {
    for (std::size_t k = 0; k < count; ++k) {
      block.inlier[k] = 0;
      if (!(block.weight[k] >= 0)) continue;
      ++sum.seen;
      const Vec3d point = T_camera_world * Vec3d{block.x[k], block.y[k], block.z[k]};
      if (!addPoint(model, k, point)) {
        sum.cost = kUnusable;
      } else if (block.inlier[k] > 0) {
        ++sum.inliers;
      }
    }
    return true;
  }
  bool none() const {
    std::fill_n(block.inlier, count, 0.0);
    return true;
  }

 private:
  template <class Model>
  bool addPoint(const Model& model, std::size_t k, const Vec3d& point) const {
    Vec2d pixel{};
    Mat<double, 2, 3> slope;
    if (!ProjectEverywhere{point, pixel, &slope, nullptr}(model)) return false;
    Vec3d r = {pixel[0] - block.u[k], pixel[1] - block.v[k], 0};
    Vec3d row_right{};
    if (!problem.right_u.empty() && block.right[k] > kNoRight) {
      Mat<double, 2, 3> slope_right;
      const Vec3d moved = {point[0] - problem.baseline, point[1], point[2]};
      if (!ProjectEverywhere{moved, pixel, &slope_right, nullptr}(model)) return false;
      r[2] = pixel[0] - block.right[k];
      row_right = slope_right.row(0);
    }
    const double information = block.weight[k];
    const LossValue value = lossAt(loss, information * r.squaredNorm());
    sum.cost += 0.5 * value.rho;
    if (value.first >= 0.5 && isProjectedBefore(model, point)) block.inlier[k] = 1;
    addEquations({slope.row(0), slope.row(1), row_right}, r, information, value, point);
    return true;
  }

  // What has been projected is before its camera, but for models that see all.
  template <class Model>
  static bool isProjectedBefore(const Model&, const Vec3d&) {
    return true;
  }
  static bool isProjectedBefore(const PinholeCamera<double>&, const Vec3d& point) {
    return point[2] > 0;
  }
  template <std::size_t N>
  static bool isProjectedBefore(const RadtanCamera<double, N>&, const Vec3d& point) {
    return point[2] > 0;
  }

  // A step (t, w) of the camera moves a point p by p x w - t.
  void addEquations(const Vec3d (&rows)[3], const Vec3d& r, double information,
                    const LossValue& value, const Vec3d& p) const {
    const double weight = information * value.first;
    const Vec3d pulled = r[0] * rows[0] + r[1] * rows[1] + r[2] * rows[2];
    const double bend =
        curvature == PoseCurvature::Full ? 2 * value.second * information * information : 0;
    SmallEquations<6>& e = sum.equations;
    Vec3d turned[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d m =
          weight * (rows[0][i] * rows[0] + rows[1][i] * rows[1] + rows[2][i] * rows[2]) +
          bend * pulled[i] * pulled;
      turned[i] = m.cross(p);
      for (std::size_t j = i; j < 3; ++j) e.hessian(i, j) += m[j];
      for (std::size_t j = 0; j < 3; ++j) e.hessian(i, 3 + j) -= turned[i][j];
    }
    const Vec3d turned_pull = pulled.cross(p);
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3d column = Vec3d{turned[0][j], turned[1][j], turned[2][j]}.cross(p);
      for (std::size_t i = 0; i <= j; ++i) e.hessian(3 + i, 3 + j) += column[i];
      e.gradient[j] -= weight * pulled[j];
      e.gradient[3 + j] += weight * turned_pull[j];
    }
  }
};

// One evaluation.
class PoseSum {
 public:
  PoseSum(const PoseProblem& problem, PoseTiles& tiles, const SE3d& T_world_body,
          const RobustLoss& loss, PoseCurvature curvature, bool with_flags, PoseValue& value)
      : problem_(problem),
        tiles_(tiles),
        T_world_body_(T_world_body),
        robust_loss_(loss),
        loss_(loss),
        curvature_(curvature),
        with_flags_(with_flags),
        value_(value) {
    loss_.twice_second = curvature == PoseCurvature::Full ? 2 : 0;
  }

  void addCamera(std::size_t c) {
    if (problem_.T_body_camera.empty()) return addObservations(c, T_world_body_.inverse(), value_);
    const SE3d T_camera_body = cameraOfBody(problem_, c);
    PoseValue part;
    addObservations(c, T_camera_body * T_world_body_.inverse(), part);
    value_.cost += part.cost;
    value_.seen += part.seen;
    value_.inliers += part.inliers;
    addTurned(T_camera_body.adjoint(), part.equations);
  }

  void addPrior(const PosePrior& prior) {
    const SE3d::Tangent r = (prior.pose.inverse() * T_world_body_).log();
    const Mat<double, 6, 6> j = SE3d::rightJacobianInverse(r);
    const Mat<double, 6, 6> left = j.transpose() * prior.information;
    value_.cost += 0.5 * r.dot(prior.information * r);
    value_.equations.hessian += left * j;
    value_.equations.gradient += left * r;
  }

 private:
  // Equations are those of the tangent of the camera.
  void addObservations(std::size_t c, const SE3d& T_camera_world, PoseValue& part) {
    PoseFormula formula;
    PoseCamera camera;
    const bool has_right = !problem_.right_u.empty();
    const bool has_kernel = problem_.cameras[c].visit(FormulaOf{camera, formula});
    if (!has_kernel || (has_right && formula == PoseFormula::Radtan)) {
      return addByModel(c, T_camera_world, part);
    }
    if (has_right) formula = PoseFormula::PinholeStereo;
    const Mat<double, 3, 4> p = T_camera_world.matrix3x4();
    std::copy(p.values, p.values + 12, camera.p);
    camera.baseline = problem_.baseline;
    addByKernel(c, camera, poseKernel(formula).active(), part);
  }

  void addByKernel(std::size_t c, const PoseCamera& camera, PoseFunction kernel, PoseValue& part) {
    PoseSums sums{};
    tiles_.forCamera(c, [&](PoseTile& tile) {
      const std::size_t count = (tile.count + kPoseLanes - 1) / kPoseLanes * kPoseLanes;
      kernel(camera, loss_, count, tile.block, sums);
      writeFlags(c, tile);
    });
    total(sums, part);
  }

  void addByModel(std::size_t c, const SE3d& T_camera_world, PoseValue& part) {
    tiles_.forCamera(c, [&](PoseTile& tile) {
      (void)problem_.cameras[c].visit(AddPoints{problem_, T_camera_world, robust_loss_, curvature_,
                                                tile.block, tile.count, part});
      writeFlags(c, tile);
    });
  }

  void writeFlags(std::size_t c, const PoseTile& tile) const {
    if (!with_flags_) return;
    std::size_t k = 0;
    for (std::size_t i = tile.begin; i < tile.end; ++i) {
      if (tiles_.isOf(i, c)) problem_.inliers[i] = tile.block.inlier[k++] > 0 ? 1 : 0;
    }
  }

  static void total(const PoseSums& sums, PoseValue& part) {
    double totals[kPoseSums];
    for (std::size_t i = 0; i < kPoseSums; ++i) totals[i] = sums.lanes[i][0] + sums.lanes[i][1];
    const double* next = totals;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = i; j < 6; ++j) part.equations.hessian(i, j) += *next++;
    }
    for (double& value : part.equations.gradient.values) value += *next++;
    part.cost += 0.5 * totals[kPoseCost];
    part.seen += static_cast<std::size_t>(totals[kPoseSeen]);
    part.inliers += static_cast<std::size_t>(totals[kPoseInliers]);
  }

  // The tangent of the camera is A times that of the body.
  void addTurned(const Mat<double, 6, 6>& a, const SmallEquations<6>& part) {
    Mat<double, 6, 6> h = part.hessian;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < i; ++j) h(i, j) = h(j, i);
    }
    const Mat<double, 6, 6> left = a.transpose();
    value_.equations.hessian += left * h * a;
    value_.equations.gradient += left * part.gradient;
  }

  const PoseProblem& problem_;
  PoseTiles& tiles_;
  const SE3d& T_world_body_;
  const RobustLoss& robust_loss_;
  PoseLoss loss_;
  const PoseCurvature curvature_;
  const bool with_flags_;
  PoseValue& value_;
};

}  // namespace

PoseCost::PoseCost(const PoseProblem& problem, const SE3d& start, const RobustLoss& loss)
    : problem_(problem), robust_loss_(loss), tiles_(problem, start) {}

PoseValue PoseCost::at(const SE3d& T_world_body, PoseCurvature curvature, bool with_flags) {
  PoseValue value;
  PoseSum sum(problem_, tiles_, T_world_body, robust_loss_, curvature,
              with_flags && !problem_.inliers.empty(), value);
  for (std::size_t c = 0; c < problem_.cameras.size(); ++c) sum.addCamera(c);
  if (problem_.prior != nullptr) sum.addPrior(*problem_.prior);
  return value;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
