// From the depths of three points to the pose: what every solver of three points ends with.
#ifndef GSLAM_ESTIMATOR_MATH_TRIANGLE_POSE_H
#define GSLAM_ESTIMATOR_MATH_TRIANGLE_POSE_H

#include <gslam/base/platform.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "math/quaternion.h"
#include "math/two.h"

namespace gslam {
inline namespace v1 {
namespace detail {

inline Vec3d minus(const Vec3d& a, const Vec3d& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
inline Vec3d times(double s, const Vec3d& a) {
  return {{s * a[0], s * a[1], s * a[2]}};
}
// s a + t b.
inline Vec3d mixOf(double s, const Vec3d& a, double t, const Vec3d& b) {
  return {{s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]}};
}

// a where the condition holds, else b, without a branch: those that compilers make of ?: on the
// order of two random numbers are guessed wrong every second time.
inline std::size_t chosen(bool condition, std::size_t a, std::size_t b) {
  return b ^ ((a ^ b) & (~std::size_t(condition) + 1));
}

// The unit quaternion of a matrix, row by row, that is nearly a rotation. False where it is none at
// all. Of the columns of 4 q q^T the one with the largest diagonal is taken.
template <class T>
auto quaternionOf(const T (&r)[9], T (&q)[4]) -> decltype(r[0] < r[1]) {
  const T a = r[7] - r[5], b = r[2] - r[6], c = r[3] - r[1];
  const T d = r[1] + r[3], e = r[2] + r[6], f = r[5] + r[7];
  const T plus = T(1) + r[8], less = T(1) - r[8];
  const T xx = less + (r[0] - r[4]), yy = less - (r[0] - r[4]);
  const T zz = plus - (r[0] + r[4]), ww = plus + (r[0] + r[4]);
  const auto is_y = yy > xx, is_w = ww > zz;
  const T xy[4] = {chosenBy(is_y, d, xx), chosenBy(is_y, yy, d), chosenBy(is_y, f, e),
                   chosenBy(is_y, b, a)};
  const T zw[4] = {chosenBy(is_w, a, e), chosenBy(is_w, b, f), chosenBy(is_w, c, zz),
                   chosenBy(is_w, ww, c)};
  const auto is_zw = chosenBy(is_w, ww, zz) > chosenBy(is_y, yy, xx);
  for (int i = 0; i < 4; ++i) q[i] = chosenBy(is_zw, zw[i], xy[i]);
  const T square = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
  const T factor = T(1) / rootOf(square);
  for (int i = 0; i < 4; ++i) q[i] = factor * q[i];
  return (square > T(0.5)) & (square < T(1e3));  // 4 to 16 for a rotation
}

// Depths along three rays: of the first, and how much longer the others are. For far points, whose
// depths are nearly equal, the differences keep the digits that the depths have not.
struct Depths {
  double first;
  double more[2];
};

struct TwoDepths {
  Two first, more[2];

  Depths operator[](int i) const { return {first[i], {more[0][i], more[1][i]}}; }
};

// Three points in the world, and the rays on which they must come to lie. Of corner 0, at depth
// ray 0: the others are at sides[i] from it in the world, and their rays start at -offsets[i] from
// where its ray starts.
struct FlatTriangle {
  Vec3d rays[3];
  Vec3d sides[2];
  Vec3d offsets[2];

  // The rotation and the depth of corner 0, for nearly collinear points; bettered in place. False
  // where that does not end with the points on their rays.
  bool refine(Quaternion& q, double& depth) const;
};

// The rotation that takes two sides of a triangle to where they are seen.
class SideFrame {
 public:
  SideFrame() = default;
  SideFrame(const Vec3d& side1, const Vec3d& side2) {
    const Vec3d n = side1.cross(side2);
    area_ = n.squaredNorm();
    const double inverse = 1 / area_;
    normal_ = times(inverse, n);
    dual1_ = side2.cross(normal_);
    dual2_ = normal_.cross(side1);
  }

  // Whether the rotation is to be refined. The sides are of length 1 or less.
  bool isFlat() const { return area_ < 1e-5; }

  // False where there is none.
  template <class T, class V>
  auto rotation(const V& seen1, const V& seen2, T (&q)[4]) const -> decltype(q[0] < q[1]) {
    const T n[3] = {seen1[1] * seen2[2] - seen1[2] * seen2[1],
                    seen1[2] * seen2[0] - seen1[0] * seen2[2],
                    seen1[0] * seen2[1] - seen1[1] * seen2[0]};
    T r[9];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        r[3 * i + j] = seen1[i] * T(dual1_[j]) + seen2[i] * T(dual2_[j]) + n[i] * T(normal_[j]);
      }
    }
    return quaternionOf(r, q);
  }

 private:
  Vec3d dual1_, dual2_, normal_;
  double area_;  // four times the square of the area
};

// A triangle in the world and the unit bearings of its corners. Corner 0 lies opposite the longest
// side, which is the unit of length. Everything is made of differences, so that neither large
// coordinates nor narrow bundles of rays lose digits.
class Triangle {
 public:
  // Of three points.
  Triangle(const Vec3d* bearings, const Vec3d* points) {
    const Vec3d sides[3] = {minus(points[2], points[1]), minus(points[0], points[2]),
                            minus(points[1], points[0])};
    const double squares[3] = {sides[0].squaredNorm(), sides[1].squaredNorm(),
                               sides[2].squaredNorm()};
    std::size_t i = squares[1] > squares[0];
    i = chosen(squares[2] > squares[i], 2, i);
    static constexpr std::size_t kNext[4] = {1, 2, 0, 1};
    const std::size_t j = kNext[i], k = kNext[i + 1];
    corner_ = points[i];
    rays_[0] = bearings[i];
    rays_[1] = bearings[j];
    rays_[2] = bearings[k];
    unit_ = std::sqrt(squares[i]);
    const double inverse = 1 / squares[i];
    a01 = squares[k] * inverse;
    a02 = squares[j] * inverse;
    side1_ = times(unit_ * inverse, sides[k]);
    side2_ = times(-unit_ * inverse, sides[j]);
    turn1_ = minus(rays_[1], rays_[0]);
    turn2_ = minus(rays_[2], rays_[0]);
    c01 = 0.5 * turn1_.squaredNorm();
    c02 = 0.5 * turn2_.squaredNorm();
    c12 = 0.5 * minus(rays_[2], rays_[1]).squaredNorm();
  }

  // Steps of Newton's method on the three equations of distances; false where they do not end at a
  // solution with positive depths.
  bool refine(Depths& depths) const {
    double d = depths.first, e = depths.more[0], f = depths.more[1];
    double r0, r1, r2;
    residuals(d, e, f, r0, r1, r2);
    double error = size(r0, r1, r2);
    for (int step = 0; step < 8 && error > kRounding; ++step) {
      // Half the derivatives by d, e and f: (a b 0), (c 0 g), (h k l).
      const double a = c01 * (2 * d + e), b = e + c01 * d;
      const double c = c02 * (2 * d + f), g = f + c02 * d;
      const double h = c12 * (2 * d + e + f), k = (e - f) + c12 * (d + f);
      const double l = c12 * (d + e) - (e - f);
      const double gk = g * k, bl = b * l, ch_ga = c * l - g * h;
      const double inverse = -0.5 / (a * gk + b * ch_ga);
      const double bg = b * g;
      const double to_d = (bg * r2 - gk * r0 - bl * r1) * inverse;
      const double to_e = (a * l * r1 - a * g * r2 - ch_ga * r0) * inverse;
      const double to_f = ((c * r0 - a * r1) * k - b * (c * r2 - h * r1)) * inverse;
      residuals(d - to_d, e - to_e, f - to_f, r0, r1, r2);
      const double next = size(r0, r1, r2);
      if (!(next < error)) break;  // rounding, or lost
      d -= to_d, e -= to_e, f -= to_f;
      error = next;
    }
    depths = {d, {e, f}};
    return (error < kAccepted) & (d > 0) & (d + e > 0) & (d + f > 0);
  }

  // The poses T_camera_world of those of `all` ratios of depths, at most 4, that Newton's method
  // takes to a solution; how many. What lies beyond them in the array may be overwritten.
  GSLAM_ALWAYS_INLINE std::size_t poses(const Depths* ratios, std::size_t all,
                                        std::array<SE3d, 4>& T_camera_world) const {
    const SideFrame frame(side1_, side2_);
    std::size_t count = 0;
    // Two at a time; the last alone is its own companion.
    for (std::size_t i = 0; i < all; i += 2) {
      const std::size_t second = i + std::size_t(i + 1 < all);
      bool good[2];
      const TwoDepths depths = solved(ratios[i], ratios[second], good);
      good[1] &= second != i;
      if (frame.isFlat()) {
        for (int k = 0; k < 2; ++k) {
          count += std::size_t(good[k] && flatPose(frame, depths[k], T_camera_world[count]));
        }
        continue;
      }
      Two numbers[7];
      pose(frame, depths, numbers, good);
      for (int k = 0; k < 2; ++k) {  // written before it is counted, without a branch
        const double q[4] = {numbers[0][k], numbers[1][k], numbers[2][k], numbers[3][k]};
        T_camera_world[count] = poseOf(q, {{numbers[4][k], numbers[5][k], numbers[6][k]}});
        count += std::size_t(good[k]);
      }
    }
    return count;
  }

  // The same of any number of ratios, of which some may lead to the same solution; it is given
  // once.
  std::size_t distinctPoses(const Depths* ratios, std::size_t all,
                            std::array<SE3d, 4>& T_camera_world) const {
    Depths found[4];
    std::size_t count = 0;
    for (std::size_t i = 0; i < all && count < 4; ++i) {
      bool good[2];
      const Depths depths = solved(ratios[i], ratios[i], good)[0];
      if (!good[0] || contains(found, count, depths)) continue;
      found[count++] = depths;
    }
    return poses(found, count, T_camera_world);
  }

  // The unit bearing of a corner.
  const Vec3d& ray(std::size_t corner) const { return rays_[corner]; }
  // From corner 0 to the others.
  const Vec3d& side1() const { return side1_; }
  const Vec3d& side2() const { return side2_; }

  // Of the unit of length: the squared sides 0-1 and 0-2; that of 1-2 is 1.
  double a01, a02;
  // 1 - cos of the angles between the rays.
  double c01, c02, c12;

 private:
  static constexpr double kRounding = 2e-15;
  static constexpr double kAccepted = 1e-12;

  template <class T>
  void residuals(T d, T e, T f, T& r0, T& r1, T& r2) const {
    const T d1 = d + e, d2 = d + f, g = e - f;
    r0 = e * e + T(2 * c01) * d * d1 - T(a01);
    r1 = f * f + T(2 * c02) * d * d2 - T(a02);
    r2 = g * g + T(2 * c12) * d1 * d2 - T(1);
  }
  // The depths of two ratios after Newton's method, of which most need no step.
  GSLAM_ALWAYS_INLINE TwoDepths solved(const Depths& ratio0, const Depths& ratio1,
                                       bool (&good)[2]) const {
    const Two d(ratio0.first, ratio1.first), e(ratio0.more[0], ratio1.more[0]);
    const Two f(ratio0.more[1], ratio1.more[1]);
    const Two square = (e - f) * (e - f) + Two(2 * c12) * (d + e) * (d + f);
    const Two factor = Two(1) / rootOf(square);
    TwoDepths depths{factor * d, {factor * e, factor * f}};
    Two r0, r1, r2;
    residuals(depths.first, depths.more[0], depths.more[1], r0, r1, r2);
    const TwoFlags done = magnitudeOf(r0) + magnitudeOf(r1) + magnitudeOf(r2) < Two(kRounding);
    good[0] = good[1] = true;
    if (done[0] && done[1]) return depths;  // they are positive, as they were given
    Depths both[2] = {depths[0], depths[1]};
    for (int k = 0; k < 2; ++k) {
      if (!done[k]) good[k] = refine(both[k]);
    }
    depths.first = Two(both[0].first, both[1].first);
    for (int i = 0; i < 2; ++i) depths.more[i] = Two(both[0].more[i], both[1].more[i]);
    return depths;
  }
  // The pose of one solution, where the points are nearly collinear.
  bool flatPose(const SideFrame& frame, const Depths& depths, SE3d& T_camera_world) const {
    const Vec3d v1 = mixOf(depths.first, turn1_, depths.more[0], rays_[1]);
    const Vec3d v2 = mixOf(depths.first, turn2_, depths.more[1], rays_[2]);
    double q[4];
    if (!frame.rotation(v1, v2, q)) return false;
    double depth = depths.first;
    const FlatTriangle flat{{rays_[0], rays_[1], rays_[2]}, {side1_, side2_}, {}};
    if (!flat.refine(q, depth)) return false;
    const Vec3d corner = turned(q, corner_);
    const Vec3d t = mixOf(unit_ * depth, rays_[0], -1, corner);
    T_camera_world = poseOf(q, t);
    return std::isfinite(t[0] + t[1] + t[2]);
  }
  // The seven numbers of the poses of both.
  GSLAM_ALWAYS_INLINE void pose(const SideFrame& frame, const TwoDepths& depths, Two (&numbers)[7],
                                bool (&good)[2]) const {
    Two v1[3], v2[3], q[4], corner[3];
    for (std::size_t i = 0; i < 3; ++i) {
      v1[i] = depths.first * Two(turn1_[i]) + depths.more[0] * Two(rays_[1][i]);
      v2[i] = depths.first * Two(turn2_[i]) + depths.more[1] * Two(rays_[2][i]);
    }
    TwoFlags valid = frame.rotation(v1, v2, q);
    const Two place[3] = {corner_[0], corner_[1], corner_[2]};
    turn(q, place, corner);
    const Two far = Two(unit_) * depths.first;
    for (std::size_t i = 0; i < 4; ++i) numbers[i] = q[i];
    for (std::size_t i = 0; i < 3; ++i) numbers[4 + i] = far * Two(rays_[0][i]) - corner[i];
    const Two sum = numbers[4] + numbers[5] + numbers[6];
    valid = valid & (sum - sum == Two(0));  // not where it is not finite
    for (int k = 0; k < 2; ++k) good[k] &= valid[k];
  }
  static bool contains(const Depths* found, std::size_t count, const Depths& depths) {
    for (std::size_t i = 0; i < count; ++i) {
      const double difference = std::fabs(found[i].first - depths.first) +
                                std::fabs(found[i].more[0] - depths.more[0]) +
                                std::fabs(found[i].more[1] - depths.more[1]);
      if (difference < 1e-7 * depths.first) return true;
    }
    return false;
  }
  static double size(double r0, double r1, double r2) {
    return std::fabs(r0) + std::fabs(r1) + std::fabs(r2);
  }

  Vec3d rays_[3];
  Vec3d corner_;
  Vec3d side1_, side2_, turn1_, turn2_;  // from corner 0 and ray 0
  double unit_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_TRIANGLE_POSE_H
