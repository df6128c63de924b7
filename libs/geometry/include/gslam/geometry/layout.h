#ifndef GSLAM_GEOMETRY_LAYOUT_H
#define GSLAM_GEOMETRY_LAYOUT_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <string>

/// @file
/// Quaternions and matrices in the order that other programs and files have.

namespace gslam {
inline namespace v1 {

/// The rotation of a quaternion, Hamilton, given w x y z, as Eigen's constructor, Ceres, COLMAP and
/// EuRoC have it.
/// @param w  real part, first
/// @param x  imaginary part
/// @param y  imaginary part
/// @param z  imaginary part
/// @throws ArgumentError as SO3::fromQuaternion()
template <class T>
SO3<T> fromQuaternionWxyz(T w, T x, T y, T z) {
  return SO3<T>::fromQuaternion(x, y, z, w);
}

/// The unit quaternion w x y z.
/// @param rotation  the rotation
template <class T>
Vec<T, 4> quaternionWxyzOf(const SO3<T>& rotation) noexcept {
  return {{rotation.w(), rotation.x(), rotation.y(), rotation.z()}};
}

namespace detail {

inline void checkCount(std::size_t count, bool is_right, const char* expected) {
  if (is_right) return;
  throw ArgumentError("elements",
                      "are " + std::to_string(count) + ", expected " + std::string(expected));
}

template <class T>
SE3<T> poseOfElements(const T* m, std::size_t count, std::size_t down, std::size_t right,
                      T tolerance) {
  Mat<T, 4, 4> matrix = Mat<T, 4, 4>::identity();
  for (std::size_t r = 0; r * 4 < count; ++r) {
    for (std::size_t c = 0; c < 4; ++c) matrix(r, c) = m[r * down + c * right];
  }
  return SE3<T>::fromMatrix(matrix, tolerance);
}

}  // namespace detail

/// The transform of a matrix [R t] or [R t; 0 0 0 1], row by row, as in a line of a KITTI file.
/// @param elements   12 or 16 numbers
/// @param tolerance  as SE3::fromMatrix()
/// @throws ArgumentError as SE3::fromMatrix(), and when there are neither 12 nor 16
template <class T>
SE3<T> fromRowMajor(Span<const T> elements, T tolerance = SO3<T>::matrixTolerance()) {
  const std::size_t count = elements.size();
  detail::checkCount(count, count == 12 || count == 16, "12 or 16");
  return detail::poseOfElements(elements.data(), count, 4, 1, tolerance);
}

/// The transform of a matrix [R t; 0 0 0 1], column by column, as Eigen's and OpenGL's arrays are.
/// @param elements   16 numbers
/// @param tolerance  as SE3::fromMatrix()
/// @throws ArgumentError as SE3::fromMatrix(), and when there are not 16
template <class T>
SE3<T> fromColumnMajor(Span<const T> elements, T tolerance = SO3<T>::matrixTolerance()) {
  const std::size_t count = elements.size();
  detail::checkCount(count, count == 16, "16");
  return detail::poseOfElements(elements.data(), count, 1, 4, tolerance);
}

/// The elements of the matrix [R t; 0 0 0 1], column by column. Those row by row are
/// `pose.matrix().values`, and KITTI's twelve `pose.matrix3x4().values`.
/// @param pose  the transform
template <class T>
Vec<T, 16> columnMajorOf(const SE3<T>& pose) noexcept {
  const Mat<T, 4, 4> transposed = pose.matrix().transpose();
  Vec<T, 16> elements;
  for (std::size_t i = 0; i < 16; ++i) elements[i] = transposed.values[i];
  return elements;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_LAYOUT_H
