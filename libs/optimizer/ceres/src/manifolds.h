#ifndef GSLAM_OPTIMIZER_CERES_SRC_MANIFOLDS_H
#define GSLAM_OPTIMIZER_CERES_SRC_MANIFOLDS_H

#include <ceres/manifold.h>
#include <factors/bundle_blocks.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>

#include <algorithm>
#include <cmath>
#include <cstring>

// How variables take steps.
//
// A cost function of Ceres gives derivatives by the numbers of a block, which Ceres multiplies with
// those of Plus() by the step. Only the product counts. So ours write the derivatives by the step
// into the first columns, and zeros into the others; that of Plus() is said to be [I; 0].

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// T is what stands in memory: SE3d, ...
template <class Group>
Group loaded(const double* numbers) noexcept {
  Group group;
  std::memcpy(static_cast<void*>(&group), numbers, sizeof(Group));
  return group;
}

template <class Group>
void store(const Group& group, double* numbers) noexcept {
  std::memcpy(numbers, &group, sizeof(Group));
}

template <class Group>
constexpr int ambientSize() {
  return static_cast<int>(sizeof(Group) / sizeof(double));
}

template <class Group>
constexpr int freedomOf() {
  return static_cast<int>(Group::kFreedom);
}

class LocalManifold : public ceres::Manifold {
 public:
  LocalManifold(int ambient, int tangent) : ambient_(ambient), tangent_(tangent) {}
  int AmbientSize() const override { return ambient_; }
  int TangentSize() const override { return tangent_; }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
    std::fill(jacobian, jacobian + ambient_ * tangent_, 0.0);
    for (int i = 0; i < tangent_; ++i) jacobian[i * tangent_ + i] = 1;
    return true;
  }
  // Nobody asks for the way back.
  bool Minus(const double* /*y*/, const double* /*x*/, double* /*y_minus_x*/) const override {
    return false;
  }
  bool MinusJacobian(const double* /*x*/, double* /*jacobian*/) const override { return false; }

 private:
  int ambient_;
  int tangent_;
};

inline bool areFinite(const double* numbers, int count) noexcept {
  return std::all_of(numbers, numbers + count, [](double v) { return std::isfinite(v); });
}

// Ceres takes a step along the whole gradient to measure it: steps are held where exp() has values.
inline SE2d::Tangent heldStep(const SE2d::Tangent& step) noexcept {
  return step;
}
inline SE3d::Tangent heldStep(const SE3d::Tangent& step) noexcept {
  return step;
}
inline SIM3d::Tangent heldStep(SIM3d::Tangent step) noexcept {
  step[6] = std::min(std::max(step[6], -30.0), 30.0);
  return step;
}

inline bool isKept(const SE2d& /*pose*/) noexcept {
  return true;
}
inline bool isKept(const SE3d& /*pose*/) noexcept {
  return true;
}
inline bool isKept(const SIM3d& pose) noexcept {
  return pose.scale() > 1e-100 && pose.scale() < 1e100;
}

// x exp(step), which the numbers after it follow by addition.
template <class Group>
class GroupManifold : public LocalManifold {
 public:
  explicit GroupManifold(int more = 0)
      : LocalManifold(ambientSize<Group>() + more, freedomOf<Group>() + more), more_(more) {}
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    constexpr int n = ambientSize<Group>(), d = freedomOf<Group>();
    typename Group::Tangent step;
    std::copy(delta, delta + d, step.data());
    // Far beyond any rotation, and where squares still are finite.
    for (int i = 0; i < d; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!std::isfinite(step[at])) return false;
      step[at] = std::min(std::max(step[at], -1e100), 1e100);
    }
    const Group moved = loaded<Group>(x) * Group::exp(heldStep(step));
    if (!isKept(moved)) return false;
    store(moved, x_plus_delta);
    for (int i = 0; i < more_; ++i) x_plus_delta[n + i] = x[n + i] + delta[d + i];
    return areFinite(x_plus_delta, n + more_);
  }

 private:
  int more_;
};

// A rigid transform whose translation keeps its length: the first two numbers of the tangent turn
// it, the others turn the rotation. tangentBasis() leads from there to the tangent of SE3.
class FixedLengthManifold : public LocalManifold {
 public:
  FixedLengthManifold() : LocalManifold(7, 5) {}

  // Two directions across the translation, in the frame of the body.
  static Mat<double, 3, 2> basisOf(const SE3d& pose) {
    return planeAcross((pose.rotation().inverse() * pose.translation()).normalized());
  }

  static Mat<double, 6, 5> tangentBasis(const SE3d& pose) {
    Mat<double, 6, 5> basis{};
    basis.setBlock(0, 0, basisOf(pose));
    basis.setBlock(3, 2, Mat3d::identity());
    return basis;
  }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    if (!areFinite(delta, 5)) return false;
    const SE3d pose = loaded<SE3d>(x);
    const double length = pose.translation().norm();
    const Vec3d across = pose.rotation() * (basisOf(pose) * Vec2d{delta[0], delta[1]});
    const Vec3d moved = pose.translation() + across;
    const double now = moved.norm();
    const Vec3d turn = {delta[2], delta[3], delta[4]};
    if (!(std::isfinite(now) && std::isfinite(turn.squaredNorm()))) return false;
    store(SE3d(pose.rotation() * SO3d::exp(turn), moved * (length / now)), x_plus_delta);
    return areFinite(x_plus_delta, 7);
  }
};

// An inverse distance, which ends at infinity.
class InverseManifold : public LocalManifold {
 public:
  InverseManifold() : LocalManifold(1, 1) {}
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    *x_plus_delta = std::fmax(*x + *delta, 0);
    return std::isfinite(*x_plus_delta);
  }
};

// An anchored point: a unit direction and an inverse distance. Tangent: as steppedAnchored().
class AnchoredManifold : public LocalManifold {
 public:
  AnchoredManifold() : LocalManifold(4, 3) {}

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    if (!areFinite(delta, 3)) return false;
    const Vec4d moved = steppedAnchored({x[0], x[1], x[2], x[3]}, delta);
    std::copy(moved.data(), moved.data() + 4, x_plus_delta);
    return areFinite(x_plus_delta, 4);
  }
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_MANIFOLDS_H
