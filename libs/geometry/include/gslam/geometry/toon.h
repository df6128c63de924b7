#ifndef GSLAM_GEOMETRY_TOON_H
#define GSLAM_GEOMETRY_TOON_H

#include <TooN/TooN.h>
#include <TooN/se3.h>
#include <TooN/sim3.h>
#include <TooN/so3.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

/// @file
/// To and from TooN, for those who have it. No other header of GSLAM includes this one. Everything
/// is copied.
///
/// Both have the same tangents, (translation, rotation[, log scale]); TooN's perturbations are on
/// the left.

namespace gslam {
inline namespace v1 {

/// @{
/// A copy for TooN.
/// @param x  what is copied
template <class T, std::size_t N>
TooN::Vector<static_cast<int>(N), T> toTooN(const Vec<T, N>& x) {
  TooN::Vector<static_cast<int>(N), T> result;
  for (std::size_t i = 0; i < N; ++i) result[static_cast<int>(i)] = x[i];
  return result;
}
template <class T, std::size_t R, std::size_t C>
TooN::Matrix<static_cast<int>(R), static_cast<int>(C), T> toTooN(const Mat<T, R, C>& x) {
  TooN::Matrix<static_cast<int>(R), static_cast<int>(C), T> result;
  for (std::size_t r = 0; r < R; ++r) {
    for (std::size_t c = 0; c < C; ++c) {
      result(static_cast<int>(r), static_cast<int>(c)) = x(r, c);
    }
  }
  return result;
}
template <class T>
TooN::SO3<T> toTooN(const SO3<T>& x) {
  return TooN::SO3<T>(toTooN(x.matrix()));
}
template <class T>
TooN::SE3<T> toTooN(const SE3<T>& x) {
  return TooN::SE3<T>(toTooN(x.rotation()), toTooN(x.translation()));
}
template <class T>
TooN::SIM3<T> toTooN(const SIM3<T>& x) {
  return TooN::SIM3<T>(toTooN(x.rotation()), toTooN(x.translation()), x.scale());
}
/// @}

/// @{
/// A copy.
/// @param x  what is copied; of vectors and matrices the size must be known when compiling
/// @throws ArgumentError what is no rotation is refused as by SO3::fromMatrix()
template <int N, class T, class Base>
Vec<T, static_cast<std::size_t>(N)> fromTooN(const TooN::Vector<N, T, Base>& x) {
  static_assert(N > 0, "the size of the vector must be known when compiling");
  Vec<T, static_cast<std::size_t>(N)> result;
  for (int i = 0; i < N; ++i) result[static_cast<std::size_t>(i)] = x[i];
  return result;
}
template <int R, int C, class T, class Layout>
Mat<T, static_cast<std::size_t>(R), static_cast<std::size_t>(C)> fromTooN(
    const TooN::Matrix<R, C, T, Layout>& x) {
  static_assert(R > 0 && C > 0, "the size of the matrix must be known when compiling");
  Mat<T, static_cast<std::size_t>(R), static_cast<std::size_t>(C)> result;
  for (int r = 0; r < R; ++r) {
    for (int c = 0; c < C; ++c) {
      result(static_cast<std::size_t>(r), static_cast<std::size_t>(c)) = x(r, c);
    }
  }
  return result;
}
template <class T>
SO3<T> fromTooN(const TooN::SO3<T>& x) {
  return SO3<T>::fromMatrix(fromTooN(x.get_matrix()));
}
template <class T>
SE3<T> fromTooN(const TooN::SE3<T>& x) {
  return SE3<T>(fromTooN(x.get_rotation()), fromTooN(x.get_translation()));
}
template <class T>
SIM3<T> fromTooN(const TooN::SIM3<T>& x) {
  return SIM3<T>(fromTooN(x.get_rotation()), fromTooN(x.get_translation()), x.get_scale());
}
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_TOON_H
