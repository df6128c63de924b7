#ifndef GSLAM_GEOMETRY_EULER_H
#define GSLAM_GEOMETRY_EULER_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <limits>

/// @file
/// Rotations as three angles, or as an axis and an angle, in every convention there is.
///
/// A convention is a sequence of axes and whether they turn with the body:
///
/// * intrinsic, R = R_first(a0) R_second(a1) R_third(a2): each is about an axis of the body, as the
///   ones before have left it;
/// * extrinsic, R = R_third(a2) R_second(a1) R_first(a0): each is about an axis of the fixed frame.
///
/// Extrinsic xyz with (a, b, c) is intrinsic zyx with (c, b, a). Both name the angles in the order
/// of the sequence, in radians. What robots, ROS and aircraft call roll, pitch and yaw is extrinsic
/// xyz.

namespace gslam {
inline namespace v1 {

/// The axes of three rotations, in the order of their angles. The first six use three axes
/// (Tait-Bryan), the last six the same one twice (proper Euler).
enum class EulerSequence { xyz, xzy, yxz, yzx, zxy, zyx, xyx, xzx, yxy, yzy, zxz, zyz };

namespace detail {

// The axes of a sequence, and whether first, second, the one that is left are x, y, z turned
// around.
struct EulerAxes {
  std::size_t first, second, third;

  static EulerAxes of(EulerSequence sequence) {
    static constexpr unsigned char axes[12][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0},
                                                  {2, 0, 1}, {2, 1, 0}, {0, 1, 0}, {0, 2, 0},
                                                  {1, 0, 1}, {1, 2, 1}, {2, 0, 2}, {2, 1, 2}};
    const auto number = static_cast<std::size_t>(sequence);
    if (number >= 12) throw ArgumentError("sequence", "is none of the twelve EulerSequences");
    return {axes[number][0], axes[number][1], axes[number][2]};
  }
  std::size_t rest() const noexcept { return 3 - first - second; }
  // The same axis twice.
  bool isProper() const noexcept { return first == third; }
  // Whether first, second and the one that is left are right-handed.
  bool isCyclic() const noexcept { return second == (first + 1) % 3; }
};

template <class T>
T wrappedToHalfTurn(T angle) noexcept {
  const T pi = T(3.14159265358979323846);
  if (angle > pi) return angle - 2 * pi;
  if (angle < -pi) return angle + 2 * pi;
  return angle;
}

template <class T>
SO3<T> rotationAbout(std::size_t axis, T angle) {
  if (!std::isfinite(angle)) {
    throw ArgumentError("angle", "is " + numberText(angle) + ", expected a finite one");
  }
  Vec<T, 4> q = {{T(0), T(0), T(0), std::cos(angle / 2)}};
  q[axis] = std::sin(angle / 2);
  return SO3<T>::fromQuaternion(q[0], q[1], q[2], q[3]);
}

}  // namespace detail

/// R = R_first(a0) R_second(a1) R_third(a2), about the axes of the turning body.
/// @param sequence  the axes
/// @param angles    about them, radians, of any size
/// @throws ArgumentError when an angle is not finite
template <class T>
SO3<T> fromIntrinsicEuler(EulerSequence sequence, const Vec<T, 3>& angles) {
  const detail::EulerAxes axes = detail::EulerAxes::of(sequence);
  return detail::rotationAbout(axes.first, angles[0]) *
         detail::rotationAbout(axes.second, angles[1]) *
         detail::rotationAbout(axes.third, angles[2]);
}

/// R = R_third(a2) R_second(a1) R_first(a0), about the axes of the fixed frame.
/// @param sequence  the axes
/// @param angles    about them, radians, of any size
/// @throws ArgumentError when an angle is not finite
template <class T>
SO3<T> fromExtrinsicEuler(EulerSequence sequence, const Vec<T, 3>& angles) {
  const detail::EulerAxes axes = detail::EulerAxes::of(sequence);
  return detail::rotationAbout(axes.third, angles[2]) *
         detail::rotationAbout(axes.second, angles[1]) *
         detail::rotationAbout(axes.first, angles[0]);
}

/// The angles a0, a1, a2 of fromIntrinsicEuler(), radians.
///
/// The outer ones are from -pi to pi, the middle one from -pi/2 to pi/2 where the sequence uses
/// three axes, from 0 to pi where it uses two. Where the middle one is at an end of that range the
/// first and the third axis are the same (gimbal lock), and only a sum or difference of their
/// angles is determined: the third angle is then 0. At and near the lock, too, the angles give the
/// rotation back to a few epsilon.
///
/// Source: E. Bernardes, S. Viollet, "Quaternion to Euler angles conversion: A direct, general and
/// computationally efficient method", PLoS ONE 17(11), 2022; the middle angle of three axes by an
/// arctangent that keeps small angles' digits.
/// @param rotation  the rotation
/// @param sequence  the axes
template <class T>
Vec<T, 3> intrinsicEulerOf(const SO3<T>& rotation, EulerSequence sequence) {
  const detail::EulerAxes axes = detail::EulerAxes::of(sequence);
  const T sign = axes.isCyclic() ? T(1) : T(-1);
  const T qw = rotation.w();
  const T qi = rotation.data()[axes.first];
  const T qj = rotation.data()[axes.second];
  const T qk = sign * rotation.data()[axes.rest()];
  // (a, b) and (c, d) have half the sum of the outer angles and half the third less the first as
  // their directions. Their lengths are cosine and sine of half the middle angle, or, with three
  // axes, the same a quarter turn on, times the square root of 2.
  const bool proper = axes.isProper();
  const T a = proper ? qw : qw + qj;
  const T b = proper ? qi : qi + qk;
  const T c = proper ? qj : qw - qj;
  const T d = proper ? -qk : qk - qi;
  const T cosine = std::hypot(a, b);
  const T sine = std::hypot(c, d);
  const T nothing = 2 * std::numeric_limits<T>::epsilon();
  T half_sum = std::atan2(b, a);
  T half_difference = std::atan2(d, c);
  if (!(sine > nothing)) half_difference = -half_sum;  // so that the third is 0
  if (!(cosine > nothing)) half_sum = -half_difference;
  const T first = half_sum - half_difference;
  const T third = half_sum + half_difference;
  const T middle =
      proper ? 2 * std::atan2(sine, cosine) : std::atan2(2 * (qw * qj + qi * qk), cosine * sine);
  return {{detail::wrappedToHalfTurn(first), middle,
           detail::wrappedToHalfTurn(proper ? third : sign * third)}};
}

/// The angles a0, a1, a2 of fromExtrinsicEuler(), radians. As intrinsicEulerOf(), but at gimbal
/// lock it is the first angle that is 0.
/// @param rotation  the rotation
/// @param sequence  the axes
template <class T>
Vec<T, 3> extrinsicEulerOf(const SO3<T>& rotation, EulerSequence sequence) {
  // The same product read from the other end is an intrinsic one.
  static constexpr EulerSequence reversed[12] = {
      EulerSequence::zyx, EulerSequence::yzx, EulerSequence::zxy, EulerSequence::xzy,
      EulerSequence::yxz, EulerSequence::xyz, EulerSequence::xyx, EulerSequence::xzx,
      EulerSequence::yxy, EulerSequence::yzy, EulerSequence::zxz, EulerSequence::zyz};
  (void)detail::EulerAxes::of(sequence);  // checks
  const Vec<T, 3> angles = intrinsicEulerOf(rotation, reversed[static_cast<std::size_t>(sequence)]);
  return {{angles[2], angles[1], angles[0]}};
}

/// R = R_z(yaw) R_y(pitch) R_x(roll), as ROS (REP 103), aircraft and most robots have it: of a body
/// with x forward the yaw is the heading, the pitch is positive with the nose towards -z, the roll
/// is about the body's x axis.
/// @param roll   about x, radians
/// @param pitch  about y, radians
/// @param yaw    about z, radians
/// @throws ArgumentError when an angle is not finite
template <class T>
SO3<T> fromRollPitchYaw(T roll, T pitch, T yaw) {
  return fromExtrinsicEuler(EulerSequence::xyz, Vec<T, 3>{{roll, pitch, yaw}});
}

/// (roll, pitch, yaw) of fromRollPitchYaw(), radians; the pitch from -pi/2 to pi/2. With the nose
/// straight up or down (gimbal lock) the roll is 0.
/// @param rotation  R_world_body
template <class T>
Vec<T, 3> rollPitchYawOf(const SO3<T>& rotation) {
  return extrinsicEulerOf(rotation, EulerSequence::xyz);
}

/// An axis of length 1 and the angle about it, radians.
template <class T>
struct AxisAngle {
  Vec<T, 3> axis;  ///< of length 1
  T angle;         ///< 0 to pi
};

/// The rotation by an angle about an axis.
/// @param axis   of any length but 0
/// @param angle  radians, of any size
/// @throws ArgumentError when the axis has no direction or a number is not finite
template <class T>
SO3<T> fromAxisAngle(const Vec<T, 3>& axis, T angle) {
  const SO3<T> about_z = detail::rotationAbout(2, angle);
  const Vec<T, 3> v = about_z.z() * axis.normalized();
  return SO3<T>::fromQuaternion(v[0], v[1], v[2], about_z.w());
}

/// Axis and angle of a rotation. The identity has every axis; x is given.
/// @param rotation  the rotation
template <class T>
AxisAngle<T> axisAngleOf(const SO3<T>& rotation) {
  const T sign = std::copysign(T(1), rotation.w());
  const Vec<T, 3> v = sign * rotation.quaternion().template segment<3>(0);
  if (v == Vec<T, 3>{}) return {{{T(1), T(0), T(0)}}, T(0)};
  return {v.normalized(), rotation.angle()};
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_EULER_H
