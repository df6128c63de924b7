#ifndef GSLAM_GEOMETRY_NEAREST_ROTATION_H
#define GSLAM_GEOMETRY_NEAREST_ROTATION_H

#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/detail/symmetric_eigen.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <limits>

/// @file
/// The rotation next to a matrix.

namespace gslam {
inline namespace v1 {

/// What nearestRotation() found.
template <class T>
struct NearestRotation {
  SO3<T> rotation;  ///< none is nearer to the matrix
  T distance;       ///< Frobenius norm of the difference of the matrices
  /// Whether it is the only one, as far as T's digits tell. It is not for matrices of rank 1 or 0,
  /// and for those with a negative determinant whose two smaller singular values are equal.
  bool is_unique;
};

/// The rotation R with the least |R - m|, in Frobenius norm, for any matrix: noisy, scaled,
/// sheared, singular, or a reflection. For a matrix with a positive determinant it is the rotation
/// of the polar decomposition. Its error is about epsilon / s, s the sum of the two smaller
/// singular values (their difference, where the determinant is negative) as parts of the largest.
///
/// The quaternion is the eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix.
/// Source: B. Horn, "Closed-form solution of absolute orientation using unit quaternions", JOSA A
/// 4(4), 1987; P. Davenport, NASA TN D-4696, 1968.
/// @param m  the matrix
/// @throws ArgumentError when an element is not finite
template <class T>
NearestRotation<T> nearestRotation(const Mat<T, 3, 3>& m) {
  detail::checkFinite(m);
  T largest = 0;
  for (const T value : m.values) largest = std::fmax(largest, std::fabs(value));
  // By a power of two, so that no digit is lost and no square leaves the range.
  int exponent = 0;
  if (largest > 0) (void)std::frexp(largest, &exponent);
  Mat<T, 3, 3> a;
  for (std::size_t i = 0; i < 9; ++i) a.values[i] = std::ldexp(m.values[i], -exponent);

  const T xx = a(0, 0), yy = a(1, 1), zz = a(2, 2);
  const Mat<T, 4, 4> k = {{xx - yy - zz, a(0, 1) + a(1, 0), a(0, 2) + a(2, 0), a(2, 1) - a(1, 2),
                           a(0, 1) + a(1, 0), yy - xx - zz, a(1, 2) + a(2, 1), a(0, 2) - a(2, 0),
                           a(0, 2) + a(2, 0), a(1, 2) + a(2, 1), zz - xx - yy, a(1, 0) - a(0, 1),
                           a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1), xx + yy + zz}};
  const detail::SymmetricEigen<T, 4> eigen(k);
  // The distance between the first two eigenvalues is twice s above; rounding alone makes a few
  // epsilon of it.
  const T gap = eigen.values[0] - eigen.values[1];
  const T noise = 16 * std::numeric_limits<T>::epsilon() * std::fabs(eigen.values[0]);
  NearestRotation<T> result{{}, 0, gap > noise};
  if (largest > 0) {  // else all are equally near, and it is the identity
    const Vec<T, 4> q = eigen.vectors.col(0);
    result.rotation = SO3<T>::fromQuaternion(q[0], q[1], q[2], q[3]);
  }
  const Mat<T, 3, 3> rest = result.rotation.matrix() - m;
  Vec<T, 9> elements;
  for (std::size_t i = 0; i < 9; ++i) elements[i] = rest.values[i];
  result.distance = elements.norm();
  return result;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_NEAREST_ROTATION_H
