#include <gslam/estimator/solvers/epnp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/check_size.h"
#include "math/jacobi_eigen.h"
#include "math/pnp_small.h"
#include "math/pose_form.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pnp {
namespace {

// The best pose so far.
struct EpnpBest {
  double q[4];
  double cost = std::numeric_limits<double>::infinity();

  // Of few points, whose betas have many minima, the rotations that they lead to are compared only
  // after a descent.
  void offer(const PoseForm& form, Quaternion& next, bool is_descended) noexcept {
    double r[9];
    double next_cost = is_descended ? descend(form, next) : 0;
    columnsOfQuaternion(next, r);
    if (!is_descended) next_cost = form.cost(r);
    if (!(form.meanDepth(r) > 0) || !(next_cost < cost)) return;
    cost = next_cost;
    std::copy(next, next + 4, q);
  }
};

// The C control points beside the centroid, along the principal axes at the standard deviations,
// seen from it in camera coordinates: a = sum of betas times null vectors.
template <int C>
class ControlPoints {
 public:
  static constexpr int kBetas = C == 3 ? 4 : 2;  // fewer than the C (C + 1) / 2 conditions

  ControlPoints(const PoseForm& form, const double* spread, bool is_few) noexcept
      : form_(form), is_few_(is_few) {
    for (int j = 0; j < C; ++j) sigma_[j] = std::sqrt(spread[j]);
    double m[3 * C][3 * C];
    for (int i = 0; i < 3 * C; ++i) {
      for (int k = 0; k < 3 * C; ++k) {
        m[i][k] = form.omega[static_cast<int>(PoseForm::kStride) * i + k] /
                  (sigma_[i / 3] * sigma_[k / 3]);
      }
    }
    const JacobiEigen<3 * C> eigen(m);
    for (int b = 0; b < kBetas; ++b)
      std::copy(eigen.vectors[b], eigen.vectors[b] + 3 * C, null_[b]);
  }

  // From the first null vector alone: its scale is refined like the rest.
  void guessOne(double* beta) const noexcept {
    double lengths = 0, squares = 0;
    for (int j = 0; j < C; ++j) {
      const double square = dot3(null_[0] + 3 * j, null_[0] + 3 * j);
      lengths += std::sqrt(square) * sigma_[j];
      squares += square;
    }
    std::fill(beta, beta + kBetas, 0.0);
    beta[0] = lengths / squares;
  }

  // From the first two, whose products of betas are linear unknowns.
  void guessTwo(double* beta) const noexcept {
    double m[3][3] = {}, b[1][3] = {};
    for (int j = 0; j < C; ++j) {
      for (int k = j; k < C; ++k) {
        const double *uj = null_[0] + 3 * j, *uk = null_[0] + 3 * k;
        const double *vj = null_[1] + 3 * j, *vk = null_[1] + 3 * k;
        const double row[3] = {dot3(uj, uk), dot3(uj, vk) + dot3(vj, uk), dot3(vj, vk)};
        for (int p = 0; p < 3; ++p) {
          for (int q = 0; q < 3; ++q) m[p][q] += row[p] * row[q];
          if (j == k) b[0][p] += row[p] * sigma_[j] * sigma_[j];
        }
      }
    }
    (void)solveSymmetric<3, 1>(m, 1e-14 * (m[0][0] + m[1][1] + m[2][2]), b);
    std::fill(beta, beta + kBetas, 0.0);
    beta[0] = std::sqrt(std::fabs(b[0][0]));
    beta[1] = std::copysign(std::sqrt(std::fabs(b[0][2])), b[0][0] < 0 ? -b[0][1] : b[0][1]);
  }

  // A direction of the betas, with the scale that fits the size of the control points.
  void guessAlong(const double* direction, double* beta) const noexcept {
    double size = 0;
    for (int j = 0; j < C; ++j) size += sigma_[j] * sigma_[j];
    // The null vectors are orthonormal.
    for (int b = 0; b < kBetas; ++b) beta[b] = direction[b] * std::sqrt(size);
  }

  // Gauss-Newton with damping on the inner products of the control points.
  void refine(double* beta) const noexcept {
    double normal[kBetas][kBetas], g[kBetas];
    double cost = linearise(beta, normal, g);
    double damping = 1e-4;
    for (int iteration = 0; iteration < 15 && std::isfinite(cost); ++iteration) {
      double m[kBetas][kBetas], step[1][kBetas], next[kBetas];
      double trace = 0;
      for (int i = 0; i < kBetas; ++i) trace += normal[i][i];
      for (int i = 0; i < kBetas; ++i) {
        std::copy(normal[i], normal[i] + kBetas, m[i]);
        m[i][i] += damping * trace;
        step[0][i] = -g[i];
      }
      (void)solveSymmetric<kBetas, 1>(m, 1e-15 * trace, step);
      double length = 0, size = 0;
      for (int i = 0; i < kBetas; ++i) {
        next[i] = beta[i] + step[0][i];
        length += step[0][i] * step[0][i];
        size += beta[i] * beta[i];
      }
      const double next_cost = linearise(next, m, step[0]);
      if (next_cost < cost) {
        cost = next_cost;
        std::copy(next, next + kBetas, beta);
        std::copy(step[0], step[0] + kBetas, g);
        for (int i = 0; i < kBetas; ++i) std::copy(m[i], m[i] + kBetas, normal[i]);
        damping *= 0.03;
      } else {
        damping *= 30;
      }
      if (length < 1e-16 * size) break;
    }
  }

  // Keeps the rotation of the betas if it is the best.
  void offer(const double* beta, EpnpBest& best) const noexcept {
    double a[3 * C], r[9], rotation[9];
    combine(beta, a);
    for (int i = 0; i < 3 * C; ++i) r[i] = a[i] / sigma_[i / 3];
    double normal[3];
    cross3(r, r + 3, normal);
    for (const double sign : {1.0, -1.0}) {
      if (C == 3 && !(sign * dot3(normal, r + 3 * (C - 1)) > 0)) continue;  // left-handed
      double columns[6];
      for (int i = 0; i < 6; ++i) columns[i] = sign * r[i];
      if (!rotationOfTwoColumns(columns, rotation)) continue;
      if (!(form_.meanDepth(rotation) > 0)) continue;
      double q[4];
      quaternionOfColumns(rotation, q);
      best.offer(form_, q, is_few_);
    }
  }

 private:
  void combine(const double* beta, double* a) const noexcept {
    for (int i = 0; i < 3 * C; ++i) {
      a[i] = 0;
      for (int b = 0; b < kBetas; ++b) a[i] += beta[b] * null_[b][i];
    }
  }

  double linearise(const double* beta, double (&normal)[kBetas][kBetas], double* g) const noexcept {
    double a[3 * C];
    combine(beta, a);
    for (int i = 0; i < kBetas; ++i) {
      g[i] = 0;
      std::fill(normal[i], normal[i] + kBetas, 0.0);
    }
    double cost = 0;
    for (int j = 0; j < C; ++j) {
      for (int k = j; k < C; ++k) {
        const double e = dot3(a + 3 * j, a + 3 * k) - (j == k ? sigma_[j] * sigma_[j] : 0);
        double row[kBetas];
        for (int b = 0; b < kBetas; ++b) {
          row[b] = dot3(null_[b] + 3 * j, a + 3 * k) + dot3(a + 3 * j, null_[b] + 3 * k);
        }
        cost += e * e;
        for (int p = 0; p < kBetas; ++p) {
          g[p] += row[p] * e;
          for (int q = 0; q <= p; ++q) normal[p][q] += row[p] * row[q];
        }
      }
    }
    return cost;
  }

  const PoseForm& form_;
  bool is_few_;
  double sigma_[C];
  double null_[kBetas][3 * C];
};

// Directions of four betas, evenly: half the corners of the 24-cell.
constexpr double kDirections[12][4] = {{1, 0, 0, 0},       {0, 1, 0, 0},       {0, 0, 1, 0},
                                       {0, 0, 0, 1},       {.5, .5, .5, .5},   {.5, .5, .5, -.5},
                                       {.5, .5, -.5, .5},  {.5, .5, -.5, -.5}, {.5, -.5, .5, .5},
                                       {.5, -.5, .5, -.5}, {.5, -.5, -.5, .5}, {.5, -.5, -.5, -.5}};

void searchSolid(const PoseForm& form, const PoseFrame& frame, bool is_few, EpnpBest& best) {
  const ControlPoints<3> control(form, frame.spread, is_few);
  double beta[4];
  control.guessOne(beta);
  control.offer(beta, best);
  control.refine(beta);
  control.offer(beta, best);
  control.guessTwo(beta);
  control.refine(beta);
  control.offer(beta, best);
  if (!is_few) return;
  for (const auto& direction : kDirections) {
    control.guessAlong(direction, beta);
    control.refine(beta);
    control.offer(beta, best);
  }
}

void searchFlat(const PoseForm& form, const PoseFrame& frame, EpnpBest& best) {
  const ControlPoints<2> control(form, frame.spread, false);
  double beta[2];
  control.guessOne(beta);
  control.offer(beta, best);
  control.guessTwo(beta);
  control.refine(beta);
  control.offer(beta, best);
}

// Variances across a plane, of the whole variance, for which the flat and the solid way are tried.
constexpr double kMostFlat = 1e-3;
constexpr double kLeastSolid = 1e-14;

}  // namespace
}  // namespace pnp
}  // namespace detail

std::size_t epnp(Span<const Vec3d> bearings, Span<const Vec3d> points, SE3d& T_camera_world) {
  using namespace detail::pnp;  // NOLINT(google-build-using-namespace)
  detail::checkSizes("bearings", bearings.size(), "points", points.size(), 4);
  const Rays rays = {{}, bearings, points};
  PoseFrame frame;
  PoseForm form;
  if (!frame.set(rays) || !frame.isWide() || !form.set(rays, frame)) return 0;
  EpnpBest best;
  if (frame.spread[2] < kMostFlat) searchFlat(form, frame, best);
  if (frame.spread[2] > kLeastSolid) searchSolid(form, frame, rays.size() < 6, best);
  if (!std::isfinite(best.cost)) return 0;
  FramePose pose;
  std::copy(best.q, best.q + 4, pose.q);
  (void)descend(form, pose.q);
  double r[9];
  columnsOfQuaternion(pose.q, r);
  form.translationOf(r, pose.t);
  polish(rays, frame, pose);
  return frame.setPose(pose.q, pose.t, T_camera_world) ? 1 : 0;
}

}  // namespace v1
}  // namespace gslam
