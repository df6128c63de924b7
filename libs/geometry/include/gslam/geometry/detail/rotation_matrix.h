#ifndef GSLAM_GEOMETRY_DETAIL_ROTATION_MATRIX_H
#define GSLAM_GEOMETRY_DETAIL_ROTATION_MATRIX_H

#include <gslam/base/error.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>

/// @file
/// Rotation matrix to unit quaternion, and the words with which a matrix is refused.

namespace gslam {
inline namespace v1 {
namespace detail {

/// The number with the digits that its type has.
template <class T>
std::string numberText(T value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.*g", std::numeric_limits<T>::digits10,
                static_cast<double>(value));
  return text;
}

template <class T, std::size_t N>
std::string vectorText(const Vec<T, N>& v) {
  std::string text = "(";
  for (std::size_t i = 0; i < N; ++i) text += (i == 0 ? "" : " ") + numberText(v[i]);
  return text + ")";
}

[[noreturn]] inline void refuseMatrix(const std::string& problem) {
  throw ArgumentError("matrix", problem);
}

template <class T, std::size_t R, std::size_t C>
void checkFinite(const Mat<T, R, C>& m) {
  for (std::size_t i = 0; i < R * C; ++i) {
    if (std::isfinite(m.values[i])) continue;
    refuseMatrix("has the element " + numberText(m.values[i]) + " in row " + std::to_string(i / C) +
                 ", column " + std::to_string(i % C) + ", expected finite elements");
  }
}

template <class T>
void checkRow(const Vec<T, 3> (&rows)[3], std::size_t i, T tolerance) {
  const std::string allowed = " within " + numberText(tolerance);
  const T squared = rows[i].squaredNorm();
  if (!(std::fabs(squared - 1) <= tolerance)) {
    refuseMatrix("is not orthonormal, row " + std::to_string(i) + " has the squared length " +
                 numberText(squared) + ", expected 1" + allowed);
  }
  for (std::size_t j = 0; j < i; ++j) {
    const T product = rows[i].dot(rows[j]);
    if (std::fabs(product) <= tolerance) continue;
    refuseMatrix("is not orthonormal, rows " + std::to_string(j) + " and " + std::to_string(i) +
                 " have the dot product " + numberText(product) + ", expected 0" + allowed);
  }
}

template <class T>
T determinant(const Mat<T, 3, 3>& m) noexcept {
  return m.row(0).dot(m.row(1).cross(m.row(2)));
}

template <class T>
void checkRotation(const Mat<T, 3, 3>& m, T tolerance) {
  checkFinite(m);
  const Vec<T, 3> rows[3] = {m.row(0), m.row(1), m.row(2)};
  for (std::size_t i = 0; i < 3; ++i) checkRow(rows, i, tolerance);
  if (!(determinant(m) > 0)) {
    refuseMatrix("is a reflection, its determinant is " + numberText(determinant(m)) +
                 ", expected 1");
  }
}

/// Of the four ways to get a quaternion from the elements, each divides by one of its components;
/// the one that divides by the largest is taken, so nothing cancels at any angle (S. W. Shepperd,
/// "Quaternion from rotation matrix", J. Guidance and Control 1(3), 1978).
template <class T>
Vec<T, 4> quaternionOfMatrix(const Mat<T, 3, 3>& m) {
  const T trace = m(0, 0) + m(1, 1) + m(2, 2);
  std::size_t i = 0;
  if (m(1, 1) > m(0, 0)) i = 1;
  if (m(2, 2) > m(i, i)) i = 2;
  if (trace > m(i, i)) {  // w is the largest component; all four times 4 w
    return Vec<T, 4>{{m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1), 1 + trace}}
        .normalized();
  }
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  Vec<T, 4> q;  // component i is the largest; all four times 4 q[i]
  q[i] = 1 + m(i, i) - m(j, j) - m(k, k);
  q[j] = m(j, i) + m(i, j);
  q[k] = m(k, i) + m(i, k);
  q[3] = m(k, j) - m(j, k);
  return q.normalized();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_ROTATION_MATRIX_H
