#ifndef GSLAM_GEOMETRY_DISTANCE_H
#define GSLAM_GEOMETRY_DISTANCE_H

#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>

/// @file
/// How far two rotations or poses are apart.

namespace gslam {
inline namespace v1 {

/// The angle of the rotation from one to the other, 0 to pi radians.
/// @param a  rotation
/// @param b  another
template <class T>
T angleBetween(const SO3<T>& a, const SO3<T>& b) noexcept {
  return (a.inverse() * b).angle();
}
/// @copydoc angleBetween(const SO3<T>&, const SO3<T>&)
template <class T>
T angleBetween(const SO2<T>& a, const SO2<T>& b) noexcept {
  return std::fabs((a.inverse() * b).angle());
}

/// The Frobenius norm of the difference of the two matrices: 2 sqrt(2) sin(angle / 2), 0 to 2
/// sqrt(2).
/// @param a  rotation
/// @param b  another
template <class T>
T chordalDistance(const SO3<T>& a, const SO3<T>& b) noexcept {
  const SO3<T> way = a.inverse() * b;
  return std::sqrt(T(8)) * Vec<T, 3>{{way.x(), way.y(), way.z()}}.norm();
}
/// @copydoc chordalDistance(const SO3<T>&, const SO3<T>&)
template <class T>
T chordalDistance(const SO2<T>& a, const SO2<T>& b) noexcept {
  return std::sqrt(T(2)) * Vec<T, 2>{{a.cosine() - b.cosine(), a.sine() - b.sine()}}.norm();
}

/// The length of log(a^-1 b). Of rotations it is the angle between them. Of poses it mixes the unit
/// of the translation with radians, and of similarities with the logarithm of the scale: it says
/// whether two are near, not how near. It is the same for g a and g b.
/// @param a  element of SO2, SO3, SE2, SE3 or SIM3
/// @param b  another
template <class G>
typename G::Scalar geodesicDistance(const G& a, const G& b) noexcept {
  return (a.inverse() * b).log().norm();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DISTANCE_H
