// What the tests of rotations are measured against: the matrix exponential in long double, which
// knows nothing of quaternions, half angles or Rodrigues' formula.
#ifndef GSLAM_GEOMETRY_TESTS_REFERENCE_H
#define GSLAM_GEOMETRY_TESTS_REFERENCE_H

#include <gslam/geometry.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

namespace reference {

using Real = long double;
using Vector = gslam::Vec<Real, 3>;
using Matrix = gslam::Mat<Real, 3, 3>;

constexpr Real kPi = 3.14159265358979323846264338327950288L;

// The bound that the library states: 4e-15 for double, 2.1e-6 for float.
template <class T>
constexpr Real bound() {
  return 18 * static_cast<Real>(std::numeric_limits<T>::epsilon());
}

template <class To, class From, std::size_t N>
gslam::Vec<To, N> convert(const gslam::Vec<From, N>& v) {
  gslam::Vec<To, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = static_cast<To>(v[i]);
  return result;
}

template <class To, class From, std::size_t R, std::size_t C>
gslam::Mat<To, R, C> convert(const gslam::Mat<From, R, C>& m) {
  gslam::Mat<To, R, C> result;
  for (std::size_t i = 0; i < R * C; ++i) result.values[i] = static_cast<To>(m.values[i]);
  return result;
}

inline Real norm(const Matrix& m) {
  Real sum = 0;
  for (Real value : m.values) sum += value * value;
  return std::sqrt(sum);
}

inline Matrix add(const Matrix& a, const Matrix& b, Real factor = 1) {
  Matrix result;
  for (std::size_t i = 0; i < 9; ++i) result.values[i] = a.values[i] + factor * b.values[i];
  return result;
}

// exp(hat(v)) - I by scaling and squaring. The identity is left out, so that the result is accurate
// for the smallest v, too: (I + e)^2 - I = 2 e + e e.
inline Matrix expMinusIdentity(const Vector& v) {
  int halvings = 0;
  Real scale = 1;
  for (; v.norm() * scale > 0.25L; scale /= 2) ++halvings;
  const Real x = v[0] * scale, y = v[1] * scale, z = v[2] * scale;
  const Matrix a = {0, -z, y, z, 0, -x, -y, x, 0};
  Matrix term = a;
  Matrix sum = a;
  for (int k = 2; k < 24; ++k) {
    term = add(Matrix{}, term * a, Real(1) / static_cast<Real>(k));
    sum = add(sum, term);
  }
  while (halvings-- > 0) sum = add(add(sum, sum), sum * sum);
  return sum;
}

// Difference relative to the norm of what is expected.
template <class A, class B, std::size_t N>
Real relativeError(const gslam::Vec<A, N>& actual, const gslam::Vec<B, N>& expected) {
  const gslam::Vec<Real, N> e = convert<Real>(expected);
  return (convert<Real>(actual) - e).norm() / e.norm();
}

template <class T>
Real relativeError(const gslam::Mat<T, 3, 3>& actual, const Matrix& expected) {
  return norm(add(convert<Real>(actual), expected, -1)) / norm(expected);
}

template <class T>
class Random {
 public:
  explicit Random(unsigned seed = 1) : generator_(seed) {}

  T uniform(T low, T high) {
    return static_cast<T>(std::uniform_real_distribution<double>(
        static_cast<double>(low), static_cast<double>(high))(generator_));
  }
  gslam::Vec<T, 3> direction() {
    std::normal_distribution<double> normal;
    gslam::Vec<T, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = static_cast<T>(normal(generator_));
    return v.normalized();
  }
  gslam::SO3<T> rotation() { return gslam::SO3<T>::exp(uniform(T(0), T(3.14)) * direction()); }

 private:
  std::mt19937 generator_;
};

// Axes along which a formula may take another branch, and some of no special kind.
template <class T>
std::vector<gslam::Vec<T, 3>> axes() {
  std::vector<gslam::Vec<T, 3>> all = {
      {T(1), T(0), T(0)},  {T(0), T(-1), T(0)}, {T(0), T(0), T(1)}, {T(1), T(1), T(0)},
      {T(0), T(-1), T(1)}, {T(1), T(0), T(-1)}, {T(1), T(1), T(1)}, {T(1), T(1e-9), T(-1e-18)}};
  Random<T> random;
  for (int i = 0; i < 50; ++i) all.push_back(random.direction());
  for (gslam::Vec<T, 3>& axis : all) axis = axis.normalized();
  return all;
}

// first, first * factor, ... up to `last` or down to it.
template <class T>
std::vector<T> geometricSteps(T first, T last, T factor) {
  std::vector<T> all;
  T value = first;
  while (factor > 1 ? value < last : value > last) {
    all.push_back(value);
    value *= factor;
  }
  return all;
}

// From the smallest normal numbers to half a turn, with every distance from it.
template <class T>
std::vector<T> angles() {
  std::vector<T> all = geometricSteps(T(1e-2), std::numeric_limits<T>::min() * 100, T(0.21));
  if (std::is_same<T, double>::value) all.insert(all.end(), {T(1e-160), T(1e-154), T(1e-14)});
  for (int i = 1; i < 62; ++i) all.push_back(T(0.05) * static_cast<T>(i));
  const T pi = static_cast<T>(kPi);
  for (T gap : geometricSteps(T(0.1), std::numeric_limits<T>::epsilon(), T(0.3))) {
    all.push_back(pi - gap);
  }
  all.push_back(std::nextafter(pi, T(0)));
  all.push_back(pi);
  return all;
}

// The same and beyond half a turn.
template <class T>
std::vector<T> anglesAndBeyond() {
  std::vector<T> all = angles<T>();
  const T pi = static_cast<T>(kPi);
  for (T gap : geometricSteps(std::numeric_limits<T>::epsilon() * 2, T(0.1), T(3))) {
    all.insert(all.end(), {pi + gap, 2 * pi + gap, 2 * pi - gap});
  }
  for (T angle : geometricSteps(T(3.2), T(40), T(1.07))) all.push_back(angle);
  all.push_back(std::nextafter(pi, T(4)));
  all.push_back(std::sqrt(T(10)));
  all.push_back(std::nextafter(std::sqrt(T(10)), T(4)));
  return all;
}

}  // namespace reference

#endif  // GSLAM_GEOMETRY_TESTS_REFERENCE_H
