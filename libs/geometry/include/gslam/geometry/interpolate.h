#ifndef GSLAM_GEOMETRY_INTERPOLATE_H
#define GSLAM_GEOMETRY_INTERPOLATE_H

#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>

#include <cmath>

/// @file
/// Between two rotations or poses.

namespace gslam {
inline namespace v1 {

/// a exp(t log(a^-1 b)): from a at t = 0 to b at t = 1, both to the bit, with a velocity that is
/// constant as seen from the body, and the shortest way round. Of rotations it is what is called
/// slerp. Poses go along a screw, so that between two far-apart headings the translation makes an
/// arc: as a vehicle does that keeps its steering wheel still. Half a turn has two shortest ways;
/// one of them is taken.
/// @param a  element of SO2, SO3, SE2, SE3 or SIM3
/// @param b  another
/// @param t  0 to 1 between the two; beyond, the motion goes on
/// @throws ArgumentError when t or t times the angle is not finite
template <class G>
G interpolate(const G& a, const G& b, typename G::Scalar t) {
  const typename G::Tangent way = (a.inverse() * b).log();
  // From the nearer end, so that both are met.
  return t <= typename G::Scalar(0.5) ? a * G::exp(way * t) : b * G::exp(way * (t - 1));
}

/// Rotation and translation apart: the rotation as interpolate(), the translation on a straight
/// line with constant velocity. What one wants of a camera between two frames whose motion in
/// between is not known, and what most programs do with trajectories.
/// @param a  pose
/// @param b  another
/// @param t  0 to 1 between the two; beyond, the motion goes on
/// @throws ArgumentError when t or t times the angle is not finite
template <class T>
SE3<T> interpolateSplit(const SE3<T>& a, const SE3<T>& b, typename SE3<T>::Scalar t) {
  return SE3<T>(interpolate(a.rotation(), b.rotation(), t),
                (1 - t) * a.translation() + t * b.translation());
}
/// @copydoc interpolateSplit(const SE3<T>&, const SE3<T>&, typename SE3<T>::Scalar)
template <class T>
SE2<T> interpolateSplit(const SE2<T>& a, const SE2<T>& b, typename SE2<T>::Scalar t) {
  return SE2<T>(interpolate(a.rotation(), b.rotation(), t),
                (1 - t) * a.translation() + t * b.translation());
}
/// The same; the scale grows by equal factors in equal times.
/// @param a  similarity
/// @param b  another
/// @param t  0 to 1 between the two; beyond, the motion goes on
/// @throws ArgumentError when t or t times the angle is not finite, and when the scale leaves the
///   range of T
template <class T>
SIM3<T> interpolateSplit(const SIM3<T>& a, const SIM3<T>& b, typename SIM3<T>::Scalar t) {
  return SIM3<T>(interpolateSplit(a.rigid(), b.rigid(), t),
                 std::pow(a.scale(), 1 - t) * std::pow(b.scale(), t));
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_INTERPOLATE_H
