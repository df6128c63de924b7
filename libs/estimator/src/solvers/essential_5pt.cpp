#include <gslam/estimator/solvers/essential_5pt.h>

#include <cmath>
#include <limits>

#include "math/check_size.h"
#include "math/essential_system.h"
#include "math/hidden_variable.h"
#include "math/sturm.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::EssentialBasis;

// Solutions so near each other are one: where two lie close, each is found to the square root of
// rounding only.
constexpr double kSameSquare = 1e-14;
// Where less of the pivots is left, or more to polish, two roots near each other may have become
// complex by rounding: nothing tells of it but another basis, in which they are others.
constexpr double kCleanCondition = 1e-6;
constexpr double kCleanStep = 1e-6;
constexpr int kMostTurns = 8;

// Adds an essential matrix where it is not there already, up to sign. Its place.
std::size_t add(const Mat3d& essential, std::array<Mat3d, 10>& essentials,
                std::size_t& count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    double product = 0;
    for (std::size_t k = 0; k < 9; ++k) product += essential.values[k] * essentials[i].values[k];
    if (!(std::fabs(product) > 1.9999)) continue;  // of 2
    const double sign = std::copysign(1, product);
    double squared = 0;
    for (std::size_t k = 0; k < 9; ++k) {
      const double difference = essential.values[k] - sign * essentials[i].values[k];
      squared += difference * difference;
    }
    if (squared < kSameSquare) return i;
  }
  if (count < 10) essentials[count++] = essential;
  return count - 1;
}

// One chain from basis to solutions; those that are new are added. Whether nothing looks amiss.
bool solve(const EssentialBasis& basis, std::array<Mat3d, 10>& essentials,
           std::size_t& count) noexcept {
  detail::EssentialSystem system;
  detail::essentialSystem(basis, system);
  double* row[10];
  const double condition = detail::eliminate(system, 4, row);
  if (!(condition > 0)) return false;
  const detail::HiddenVariable hidden(row);
  double c[11];
  hidden.determinant(c);
  const detail::RealRoots<10> roots(c, 1e-5);
  double found[10][4];
  double first_step[10];
  for (std::size_t i = 0; i < roots.size(); ++i) hidden.solution(roots.t(i), roots.u(i), found[i]);
  detail::polishEssential(basis, roots.size(), found, first_step);
  bool clean = condition > kCleanCondition;
  const std::size_t known = count;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (!(first_step[i] < kCleanStep)) clean = false;
    Mat3d essential;
    if (!(first_step[i] < std::numeric_limits<double>::infinity()) ||
        !detail::essentialOf(basis, found[i], essential)) {
      continue;
    }
    const std::size_t before = count;
    const std::size_t place = add(essential, essentials, count);
    if (count == before && place >= known) clean = false;  // two roots led to the same
  }
  return clean;
}

}  // namespace

std::size_t essential5pt(Span<const Vec3d> first, Span<const Vec3d> second,
                         std::array<Mat3d, 10>& essentials) {
  detail::checkSize("first", first.size(), 5);
  detail::checkSize("second", second.size(), 5);
  EssentialBasis basis;
  detail::essentialBasis(first.data(), second.data(), basis);
  std::size_t count = 0;
  bool clean = solve(basis, essentials, count);
  for (int i = 0; i < kMostTurns && !clean; ++i) {
    detail::mixBasis(basis);
    clean = solve(basis, essentials, count);
  }
  return count;
}

}  // namespace v1
}  // namespace gslam
