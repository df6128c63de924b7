#ifndef GSLAM_GEOMETRY_MAT_H
#define GSLAM_GEOMETRY_MAT_H

#include <gslam/geometry/vec.h>

#include <cstddef>
#include <iosfwd>
#include <type_traits>

/// @file
/// Small matrices of fixed size.

namespace gslam {
inline namespace v1 {

/// R rows and C columns of type T, stored row by row.
///
/// Layout: exactly `T[R * C]`, row-major, an aggregate, trivially copyable, aligned as T, so that
/// it may cross plugin borders. `Mat2d m;` leaves the elements uninitialised, `Mat2d m{}` sets them
/// to zero, `Mat2d m{11, 12, 21, 22}` gives them row by row. (Eigen's default is column-major.)
/// Thread-safety: as a number; it may be read by many threads, or written by one.
template <class T, std::size_t R, std::size_t C>
struct Mat {
  static_assert(std::is_floating_point<T>::value, "Mat is made of floating-point numbers");
  static_assert(R > 0 && C > 0, "Mat has at least one element");

  using value_type = T;  ///< type of an element

  T values[R * C];  ///< the elements, row by row; public, because that makes Mat an aggregate

  /// Ones on the main diagonal, zeros elsewhere.
  static Mat identity() noexcept {
    Mat result{};
    for (std::size_t i = 0; i < R && i < C; ++i) result(i, i) = T(1);
    return result;
  }

  /// Number of rows, R.
  static constexpr std::size_t rows() noexcept { return R; }
  /// Number of columns, C.
  static constexpr std::size_t cols() noexcept { return C; }
  /// The first of R * C contiguous elements, row by row.
  T* data() noexcept { return values; }
  /// The first of R * C contiguous elements, row by row.
  constexpr const T* data() const noexcept { return values; }

  /// Element in row r and column c, both from 0, unchecked.
  T& operator()(std::size_t r, std::size_t c) noexcept { return values[r * C + c]; }
  /// Element in row r and column c, both from 0, unchecked.
  constexpr const T& operator()(std::size_t r, std::size_t c) const noexcept {
    return values[r * C + c];
  }

  /// Row r from 0, unchecked.
  Vec<T, C> row(std::size_t r) const noexcept {
    Vec<T, C> result;
    for (std::size_t c = 0; c < C; ++c) result[c] = (*this)(r, c);
    return result;
  }
  /// Column c from 0, unchecked.
  Vec<T, R> col(std::size_t c) const noexcept {
    Vec<T, R> result;
    for (std::size_t r = 0; r < R; ++r) result[r] = (*this)(r, c);
    return result;
  }
  /// The (BR x BC) elements from row r and column c on; the block must lie inside, unchecked.
  template <std::size_t BR, std::size_t BC>
  Mat<T, BR, BC> block(std::size_t r, std::size_t c) const noexcept {
    Mat<T, BR, BC> result;
    for (std::size_t i = 0; i < BR; ++i) {
      for (std::size_t j = 0; j < BC; ++j) result(i, j) = (*this)(r + i, c + j);
    }
    return result;
  }
  /// Overwrites the (BR x BC) elements from row r and column c on; unchecked.
  template <std::size_t BR, std::size_t BC>
  void setBlock(std::size_t r, std::size_t c, const Mat<T, BR, BC>& values_of_block) noexcept {
    for (std::size_t i = 0; i < BR; ++i) {
      for (std::size_t j = 0; j < BC; ++j) (*this)(r + i, c + j) = values_of_block(i, j);
    }
  }

  /// Adds element by element.
  Mat& operator+=(const Mat& other) noexcept {
    for (std::size_t i = 0; i < R * C; ++i) values[i] += other.values[i];
    return *this;
  }
  /// Subtracts element by element.
  Mat& operator-=(const Mat& other) noexcept {
    for (std::size_t i = 0; i < R * C; ++i) values[i] -= other.values[i];
    return *this;
  }
  /// Multiplies every element.
  Mat& operator*=(T factor) noexcept {
    for (std::size_t i = 0; i < R * C; ++i) values[i] *= factor;
    return *this;
  }
  /// Sum, element by element.
  friend Mat operator+(Mat a, const Mat& b) noexcept { return a += b; }
  /// Difference, element by element.
  friend Mat operator-(Mat a, const Mat& b) noexcept { return a -= b; }
  /// The opposite matrix.
  friend Mat operator-(Mat a) noexcept { return a *= T(-1); }
  /// Every element times a number.
  friend Mat operator*(Mat a, T factor) noexcept { return a *= factor; }
  /// Every element times a number.
  friend Mat operator*(T factor, Mat a) noexcept { return a *= factor; }

  /// Rows and columns exchanged, (C x R).
  Mat<T, C, R> transpose() const noexcept {
    Mat<T, C, R> result;
    for (std::size_t r = 0; r < R; ++r) {
      for (std::size_t c = 0; c < C; ++c) result(c, r) = (*this)(r, c);
    }
    return result;
  }

  /// Matrix product, (R x C) (C x K) = (R x K).
  template <std::size_t K>
  Mat<T, R, K> operator*(const Mat<T, C, K>& other) const noexcept {
    Mat<T, R, K> result;
    for (std::size_t r = 0; r < R; ++r) {
      for (std::size_t k = 0; k < K; ++k) {
        T sum = (*this)(r, 0) * other(0, k);
        for (std::size_t c = 1; c < C; ++c) sum += (*this)(r, c) * other(c, k);
        result(r, k) = sum;
      }
    }
    return result;
  }

  /// Product with a column vector, (R x C) (C) = (R).
  Vec<T, R> operator*(const Vec<T, C>& v) const noexcept {
    Vec<T, R> result;
    for (std::size_t r = 0; r < R; ++r) {
      T sum = (*this)(r, 0) * v[0];
      for (std::size_t c = 1; c < C; ++c) sum += (*this)(r, c) * v[c];
      result[r] = sum;
    }
    return result;
  }

  /// Exact comparison, element by element; NaN equals nothing.
  friend bool operator==(const Mat& a, const Mat& b) noexcept {
    for (std::size_t i = 0; i < R * C; ++i) {
      if (!(a.values[i] == b.values[i])) return false;
    }
    return true;
  }
  /// The opposite of ==.
  friend bool operator!=(const Mat& a, const Mat& b) noexcept { return !(a == b); }

  /// A line a row, without an end of line after the last; the stream's precision.
  template <class Char, class Traits>
  friend std::basic_ostream<Char, Traits>& operator<<(std::basic_ostream<Char, Traits>& out,
                                                      const Mat& m) {
    for (std::size_t i = 0; i < R * C; ++i) {
      if (i != 0) out << (i % C == 0 ? '\n' : ' ');
      out << m.values[i];
    }
    return out;
  }
};

using Mat2d = Mat<double, 2, 2>;  ///< 2 x 2, double
using Mat3d = Mat<double, 3, 3>;  ///< 3 x 3, double
using Mat4d = Mat<double, 4, 4>;  ///< 4 x 4, double
using Mat2f = Mat<float, 2, 2>;   ///< 2 x 2, float
using Mat3f = Mat<float, 3, 3>;   ///< 3 x 3, float
using Mat4f = Mat<float, 4, 4>;   ///< 4 x 4, float

/// The matrix a b^T of two vectors, (R x C).
template <class T, std::size_t R, std::size_t C>
Mat<T, R, C> outer(const Vec<T, R>& a, const Vec<T, C>& b) noexcept {
  Mat<T, R, C> result;
  for (std::size_t r = 0; r < R; ++r) {
    for (std::size_t c = 0; c < C; ++c) result(r, c) = a[r] * b[c];
  }
  return result;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_MAT_H
