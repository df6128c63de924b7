#ifndef GSLAM_GEOMETRY_EIGEN_H
#define GSLAM_GEOMETRY_EIGEN_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <type_traits>

/// @file
/// To and from Eigen, for those who have it. No other header of GSLAM includes this one.
///
/// toEigen() and fromEigen() copy. viewAsEigen() gives Eigen's view of our own elements, which must
/// outlive it.

namespace gslam {
inline namespace v1 {

/// @{
/// The elements themselves, without a copy.
/// @param x  what is viewed; not a temporary
template <class T, std::size_t N>
Eigen::Map<Eigen::Matrix<T, static_cast<int>(N), 1>> viewAsEigen(Vec<T, N>& x) noexcept {
  return Eigen::Map<Eigen::Matrix<T, static_cast<int>(N), 1>>(x.data());
}
template <class T, std::size_t N>
Eigen::Map<const Eigen::Matrix<T, static_cast<int>(N), 1>> viewAsEigen(
    const Vec<T, N>& x) noexcept {
  return Eigen::Map<const Eigen::Matrix<T, static_cast<int>(N), 1>>(x.data());
}
template <class T, std::size_t N>
void viewAsEigen(const Vec<T, N>&& x) = delete;
/// @}

namespace detail {

// Rows one after the other, as ours are; of a single column Eigen wants to hear the opposite.
template <class T, std::size_t R, std::size_t C>
using EigenRows = Eigen::Matrix<T, static_cast<int>(R), static_cast<int>(C),
                                C == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

// Vec for a column, Mat for all else.
template <class T, int R, int C>
struct FromEigen {
  static_assert(R > 0 && C > 0, "the size of the matrix must be known when compiling");
  using Type = Mat<T, static_cast<std::size_t>(R), static_cast<std::size_t>(C)>;
};
template <class T, int R>
struct FromEigen<T, R, 1> {
  static_assert(R > 0, "the size of the vector must be known when compiling");
  using Type = Vec<T, static_cast<std::size_t>(R)>;
};

}  // namespace detail

/// @{
/// The elements themselves, without a copy.
template <class T, std::size_t R, std::size_t C>
Eigen::Map<detail::EigenRows<T, R, C>> viewAsEigen(Mat<T, R, C>& x) noexcept {
  return Eigen::Map<detail::EigenRows<T, R, C>>(x.data());
}
template <class T, std::size_t R, std::size_t C>
Eigen::Map<const detail::EigenRows<T, R, C>> viewAsEigen(const Mat<T, R, C>& x) noexcept {
  return Eigen::Map<const detail::EigenRows<T, R, C>>(x.data());
}
template <class T, std::size_t R, std::size_t C>
void viewAsEigen(const Mat<T, R, C>&& x) = delete;
/// Both have x y z w. It cannot be written to: that would pass the checks.
template <class T>
Eigen::Map<const Eigen::Quaternion<T>> viewAsEigen(const SO3<T>& x) noexcept {
  return Eigen::Map<const Eigen::Quaternion<T>>(x.data());
}
template <class T>
void viewAsEigen(const SO3<T>&& x) = delete;
/// @}

/// @{
/// A copy. Matrices become what Eigen has by default, column by column; similarities an affine
/// transform.
/// @param x  what is copied
template <class T, std::size_t N>
Eigen::Matrix<T, static_cast<int>(N), 1> toEigen(const Vec<T, N>& x) {
  return viewAsEigen(x);
}
template <class T, std::size_t R, std::size_t C>
Eigen::Matrix<T, static_cast<int>(R), static_cast<int>(C)> toEigen(const Mat<T, R, C>& x) {
  return viewAsEigen(x);
}
template <class T>
Eigen::Rotation2D<T> toEigen(const SO2<T>& x) {
  return Eigen::Rotation2D<T>(x.angle());
}
template <class T>
Eigen::Quaternion<T> toEigen(const SO3<T>& x) {
  return Eigen::Quaternion<T>(viewAsEigen(x));
}
template <class T>
Eigen::Transform<T, 2, Eigen::Isometry> toEigen(const SE2<T>& x) {
  return Eigen::Transform<T, 2, Eigen::Isometry>(toEigen(x.matrix()));
}
template <class T>
Eigen::Transform<T, 3, Eigen::Isometry> toEigen(const SE3<T>& x) {
  return Eigen::Transform<T, 3, Eigen::Isometry>(toEigen(x.matrix()));
}
template <class T>
Eigen::Transform<T, 3, Eigen::Affine> toEigen(const SIM3<T>& x) {
  return Eigen::Transform<T, 3, Eigen::Affine>(toEigen(x.matrix()));
}
/// @}

/// @{
/// A copy. Columns become Vec, other matrices Mat; their size must be known when compiling.
/// @param x  what is copied
/// @throws ArgumentError what is no rotation, pose or similarity is refused as by the functions
///   from quaternions and matrices
template <class Derived>
typename detail::FromEigen<typename Derived::Scalar, Derived::RowsAtCompileTime,
                           Derived::ColsAtCompileTime>::Type
fromEigen(const Eigen::MatrixBase<Derived>& x) {
  typename detail::FromEigen<typename Derived::Scalar, Derived::RowsAtCompileTime,
                             Derived::ColsAtCompileTime>::Type result;
  auto view = viewAsEigen(result);
  view = x;
  return result;
}
template <class T>
SO2<T> fromEigen(const Eigen::Rotation2D<T>& x) {
  return SO2<T>::fromAngle(x.angle());
}
template <class Derived>
SO3<typename Derived::Scalar> fromEigen(const Eigen::QuaternionBase<Derived>& x) {
  return SO3<typename Derived::Scalar>::fromQuaternion(x.x(), x.y(), x.z(), x.w());
}
template <class T>
SE2<T> fromEigen(const Eigen::Transform<T, 2, Eigen::Isometry>& x) {
  return SE2<T>::fromMatrix(fromEigen(x.matrix()));
}
template <class T>
SE3<T> fromEigen(const Eigen::Transform<T, 3, Eigen::Isometry>& x) {
  return SE3<T>::fromMatrix(fromEigen(x.matrix()));
}
template <class T>
SIM3<T> fromEigen(const Eigen::Transform<T, 3, Eigen::Affine>& x) {
  return SIM3<T>::fromMatrix(fromEigen(x.matrix()));
}
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_EIGEN_H
