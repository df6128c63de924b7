// What group_reference.h says of the groups of space, for those of the plane.
#ifndef GSLAM_GEOMETRY_TESTS_PLANAR_REFERENCE_H
#define GSLAM_GEOMETRY_TESTS_PLANAR_REFERENCE_H

#include <gslam/geometry/se2.h>
#include <gslam/geometry/so2.h>

#include <vector>

#include "group_reference.h"

namespace reference {

template <class T>
struct GroupFacts<gslam::SO2<T>> {
  static constexpr std::size_t size = 2;  // of the matrices
  static constexpr bool has_translation = false, has_scale = false;
  static Square<2> hat(const gslam::Vec<Real, 1>& a) { return {0, -a[0], a[0], 0}; }
  // The inverse of hat.
  static gslam::Vec<Real, 1> vee(const Square<2>& m) { return {m(1, 0)}; }
  static gslam::Vec<Real, 1> tangent(Real, Real, Real angle) { return {angle}; }
};

template <class T>
struct GroupFacts<gslam::SE2<T>> {
  static constexpr std::size_t size = 3;
  static constexpr bool has_translation = true, has_scale = false;
  static Square<3> hat(const gslam::Vec<Real, 3>& a) {
    return {0, -a[2], a[0], a[2], 0, a[1], 0, 0, 0};
  }
  static gslam::Vec<Real, 3> vee(const Square<3>& m) { return {m(0, 2), m(1, 2), m(1, 0)}; }
  static gslam::Vec<Real, 3> tangent(Real x, Real y, Real angle) { return {x, y, angle}; }
};

// ad by its definition: column j is the tangent of the commutator of hat(a) and hat(unit j).
template <class G>
Square<G::kFreedom> planarAdOf(const gslam::Vec<Real, G::kFreedom>& a) {
  using Facts = GroupFacts<G>;
  Square<G::kFreedom> result;
  for (std::size_t j = 0; j < G::kFreedom; ++j) {
    gslam::Vec<Real, G::kFreedom> unit{};
    unit[j] = 1;
    const auto bracket = Facts::hat(a) * Facts::hat(unit) - Facts::hat(unit) * Facts::hat(a);
    const auto column = Facts::vee(bracket);
    for (std::size_t i = 0; i < G::kFreedom; ++i) result(i, j) = column[i];
  }
  return result;
}

// Tangents with each angle and its opposite, and translations of length 1 in some directions.
template <class G>
std::vector<typename G::Tangent> planarScan(const std::vector<typename G::Scalar>& angles) {
  using T = typename G::Scalar;
  std::vector<typename G::Tangent> result;
  for (const T angle : angles) {
    for (int i = 0; i < 5; ++i) {
      const Real direction = 1.3L * i;
      const auto a = [&](T signed_angle) {
        return GroupFacts<G>::tangent(std::cos(direction), std::sin(direction), signed_angle);
      };
      result.push_back(convert<T>(a(angle)));
      result.push_back(convert<T>(a(-angle)));
    }
  }
  return result;
}

using PlanarGroups = testing::Types<gslam::SO2f, gslam::SO2d, gslam::SE2f, gslam::SE2d>;

}  // namespace reference

#endif  // GSLAM_GEOMETRY_TESTS_PLANAR_REFERENCE_H
