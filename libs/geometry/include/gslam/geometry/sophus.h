#ifndef GSLAM_GEOMETRY_SOPHUS_H
#define GSLAM_GEOMETRY_SOPHUS_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>

#include <sophus/se2.hpp>
#include <sophus/se3.hpp>
#include <sophus/sim3.hpp>

/// @file
/// To and from Sophus, for those who have it. No other header of GSLAM includes this one.
/// Everything is copied.
///
/// Both have the same tangents, (translation, rotation[, log scale]), and perturbations on the
/// right: tangents, Jacobians and covariances are the same numbers.

namespace gslam {
inline namespace v1 {

/// @{
/// A copy for Sophus.
/// @param x  what is copied
template <class T>
Sophus::SO2<T> toSophus(const SO2<T>& x) {
  return Sophus::SO2<T>(x.cosine(), x.sine());
}
template <class T>
Sophus::SO3<T> toSophus(const SO3<T>& x) {
  return Sophus::SO3<T>(Eigen::Quaternion<T>(x.w(), x.x(), x.y(), x.z()));
}
template <class T>
Sophus::SE2<T> toSophus(const SE2<T>& x) {
  const Vec<T, 2>& t = x.translation();
  return Sophus::SE2<T>(toSophus(x.rotation()), Eigen::Matrix<T, 2, 1>(t[0], t[1]));
}
template <class T>
Sophus::SE3<T> toSophus(const SE3<T>& x) {
  const Vec<T, 3>& t = x.translation();
  return Sophus::SE3<T>(toSophus(x.rotation()), Eigen::Matrix<T, 3, 1>(t[0], t[1], t[2]));
}
/// @throws ArgumentError when Sophus does not take the scale: it ends the program at those below
///   1e-10 or above 1e10 (float: 1e-5, 1e5)
template <class T>
Sophus::Sim3<T> toSophus(const SIM3<T>& x) {
  const T least = Sophus::Constants<T>::epsilon();
  if (!(x.scale() > least && x.scale() < 1 / least)) {
    throw ArgumentError("scale",
                        "is " + detail::numberText(x.scale()) + ", which Sophus does not take");
  }
  const Vec<T, 3>& t = x.translation();
  return Sophus::Sim3<T>(Sophus::RxSO3<T>(x.scale(), toSophus(x.rotation())),
                         Eigen::Matrix<T, 3, 1>(t[0], t[1], t[2]));
}
/// @}

/// @{
/// A copy.
/// @param x  what is copied
/// @throws ArgumentError when it is not finite
template <class T>
SO2<T> fromSophus(const Sophus::SO2<T>& x) {
  return SO2<T>::fromComplex(x.unit_complex().x(), x.unit_complex().y());
}
template <class T>
SO3<T> fromSophus(const Sophus::SO3<T>& x) {
  const Eigen::Quaternion<T>& q = x.unit_quaternion();
  return SO3<T>::fromQuaternion(q.x(), q.y(), q.z(), q.w());
}
template <class T>
SE2<T> fromSophus(const Sophus::SE2<T>& x) {
  return SE2<T>(fromSophus(x.so2()), {{x.translation().x(), x.translation().y()}});
}
template <class T>
SE3<T> fromSophus(const Sophus::SE3<T>& x) {
  const auto& t = x.translation();
  return SE3<T>(fromSophus(x.so3()), {{t.x(), t.y(), t.z()}});
}
template <class T>
SIM3<T> fromSophus(const Sophus::Sim3<T>& x) {
  const auto& t = x.translation();
  return SIM3<T>(fromSophus(x.rxso3().so3()), {{t.x(), t.y(), t.z()}}, x.scale());
}
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_SOPHUS_H
