// exp, Ad and the left Jacobian of every group as matrix functions in long double, from hat()
// alone, which is written down here a second time.
#ifndef GSLAM_GEOMETRY_TESTS_GROUP_REFERENCE_H
#define GSLAM_GEOMETRY_TESTS_GROUP_REFERENCE_H

#include <cstddef>
#include <vector>

#include "reference.h"

namespace reference {

template <std::size_t N>
using Square = gslam::Mat<Real, N, N>;

template <std::size_t R, std::size_t C>
Real frobenius(const gslam::Mat<Real, R, C>& m) {
  Real sum = 0;
  for (const Real value : m.values) sum += value * value;
  return std::sqrt(sum);
}

// exp(m) - I, by scaling and squaring, accurate for the smallest m, too.
template <std::size_t N>
Square<N> expMinusIdentityOf(const Square<N>& m) {
  int halvings = 0;
  Real scale = 1;
  for (; frobenius(m) * scale > 0.25L; scale /= 2) ++halvings;
  const Square<N> a = scale * m;
  Square<N> term = a;
  Square<N> sum = a;
  for (int k = 2; k < 24; ++k) {
    term = (Real(1) / static_cast<Real>(k)) * (term * a);
    sum += term;
  }
  while (halvings-- > 0) sum = sum + sum + sum * sum;
  return sum;
}

// The integral of exp(u m) over u from 0 to 1, which for m = ad(a) is the left Jacobian at a: a
// series, and J(2 m) = (I + exp(m)) J(m) / 2.
template <std::size_t N>
Square<N> integralOfExp(const Square<N>& m) {
  int halvings = 0;
  Real scale = 1;
  for (; frobenius(m) * scale > 0.25L; scale /= 2) ++halvings;
  Square<N> a = scale * m;
  Square<N> term = Square<N>::identity();
  Square<N> sum = term;
  for (int k = 2; k < 24; ++k) {
    term = (Real(1) / static_cast<Real>(k)) * (term * a);
    sum += term;
  }
  while (halvings-- > 0) {
    sum = sum + Real(0.5) * (expMinusIdentityOf(a) * sum);
    a *= 2;
  }
  return sum;
}

// What the tests need to know of a group beside its class.
template <class G>
struct GroupFacts;

template <class T>
struct GroupFacts<gslam::SO3<T>> {
  static constexpr std::size_t size = 3;  // of the matrices
  static constexpr bool has_translation = false, has_scale = false;
  static Square<3> hat(const gslam::Vec<Real, 3>& v) {
    return {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
  }
  static gslam::Vec<Real, 3> tangent(const Vector&, const Vector& v, Real) { return v; }
};

template <class T>
struct GroupFacts<gslam::SE3<T>> {
  static constexpr std::size_t size = 4;
  static constexpr bool has_translation = true, has_scale = false;
  static Square<4> hat(const gslam::Vec<Real, 6>& a) {
    return {0, -a[5], a[4], a[0], a[5], 0, -a[3], a[1], -a[4], a[3], 0, a[2], 0, 0, 0, 0};
  }
  static gslam::Vec<Real, 6> tangent(const Vector& r, const Vector& v, Real) {
    return {r[0], r[1], r[2], v[0], v[1], v[2]};
  }
};

template <class T>
struct GroupFacts<gslam::SIM3<T>> {
  static constexpr std::size_t size = 4;
  static constexpr bool has_translation = true, has_scale = true;
  static Square<4> hat(const gslam::Vec<Real, 7>& a) {
    return {a[6], -a[5], a[4], a[0], a[5], a[6], -a[3], a[1], -a[4], a[3], a[6], a[2], 0, 0, 0, 0};
  }
  static gslam::Vec<Real, 7> tangent(const Vector& r, const Vector& v, Real s) {
    return {r[0], r[1], r[2], v[0], v[1], v[2], s};
  }
};

// ad by its definition: column j is the tangent of the commutator of hat(a) and hat(unit j).
template <class G>
Square<G::kFreedom> adOf(const gslam::Vec<Real, G::kFreedom>& a) {
  using Facts = GroupFacts<G>;
  constexpr std::size_t n = G::kFreedom;
  Square<n> result;
  for (std::size_t j = 0; j < n; ++j) {
    gslam::Vec<Real, n> unit{};
    unit[j] = 1;
    const auto bracket = Facts::hat(a) * Facts::hat(unit) - Facts::hat(unit) * Facts::hat(a);
    const std::size_t turn = Facts::has_translation ? 3 : 0;  // where the rotation begins
    for (std::size_t i = 0; i < turn; ++i) result(i, j) = bracket(i, Facts::size - 1);
    result(turn, j) = bracket(2, 1);
    result(turn + 1, j) = bracket(0, 2);
    result(turn + 2, j) = bracket(1, 0);
    if (Facts::has_scale) result(n - 1, j) = bracket(0, 0);
  }
  return result;
}

template <class T, std::size_t R, std::size_t C>
Real errorOf(const gslam::Mat<T, R, C>& actual, const gslam::Mat<Real, R, C>& expected) {
  return frobenius(convert<Real>(actual) - expected) / frobenius(expected);
}

// Every third, for what takes long.
template <class T>
std::vector<T> thinned(const std::vector<T>& all) {
  std::vector<T> some;
  for (std::size_t i = 0; i < all.size(); i += 3) some.push_back(all[i]);
  return some;
}

// Tangents all over the group: angles up to half a turn or beyond, logarithms of scales,
// translations of length 1 in all relations to the axis.
template <class G>
std::vector<typename G::Tangent> scan(const std::vector<typename G::Scalar>& angles,
                                      std::size_t axis_count) {
  using T = typename G::Scalar;
  using Facts = GroupFacts<G>;
  std::vector<Real> scales = {0};
  if (Facts::has_scale) {
    for (const Real s : {1e-14L, 1e-9L, 1e-5L, 1e-3L, 0.1L, 0.5L, 0.99L, 1.0L, 1.01L, 2.0L}) {
      scales.push_back(s);
      scales.push_back(-s);
    }
  }
  std::vector<gslam::Vec<T, 3>> all = axes<T>();
  std::vector<typename G::Tangent> result;
  for (const T angle : angles) {
    for (std::size_t i = 0; i < axis_count; ++i) {
      const auto v = convert<Real>(angle * all[(i * 7) % all.size()]);
      const auto r = convert<Real>(all[(i * 11 + 3) % all.size()]);
      for (const Real s : scales) result.push_back(convert<T>(Facts::tangent(r, v, s)));
      if (Facts::has_translation) {
        result.push_back(convert<T>(Facts::tangent(v.norm() > 0 ? v / v.norm() : r, v, 0)));
      }
    }
  }
  return result;
}

using SpaceGroups =
    testing::Types<gslam::SO3f, gslam::SO3d, gslam::SE3f, gslam::SE3d, gslam::SIM3f, gslam::SIM3d>;

}  // namespace reference

#endif  // GSLAM_GEOMETRY_TESTS_GROUP_REFERENCE_H
