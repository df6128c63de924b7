#include <gslam/estimator/solvers/essential_5pt_stewenius.h>

#include <cmath>

#include "math/check_size.h"
#include "math/essential_system.h"
#include "math/real_eigen.h"

namespace gslam {
inline namespace v1 {
namespace {

// x times the monomials x2 xy xz y2 yz z2 x y z 1, in terms of the same. False where the
// elimination breaks down.
bool actionMatrix(const detail::EssentialSystem& nister, double (&action)[10][10]) noexcept {
  // y3 y2z yz2 z3 x3 x2y x2z xy2 xyz xz2, then the monomials above.
  constexpr std::size_t kOrder[20] = {1, 6, 13, 16, 0,  2,  4,  3,  8,  10,
                                      5, 9, 11, 7,  14, 17, 12, 15, 18, 19};
  detail::EssentialSystem system;
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t j = 0; j < 20; ++j) system.rows[i][j] = nister.rows[i][kOrder[j]];
  }
  double* row[10];
  if (!(detail::eliminate(system, 4, row) > 0)) return false;
  bool finite = true;
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t j = 0; j < 10; ++j) {
      action[i][j] = i < 6 ? -row[4 + i][10 + j] : 0;
      finite = finite && std::fabs(action[i][j]) < 1e100;
    }
  }
  action[6][0] = action[7][1] = action[8][2] = action[9][6] = 1;
  return finite;
}

}  // namespace

std::size_t essential5ptStewenius(Span<const Vec3d> first, Span<const Vec3d> second,
                                  std::array<Mat3d, 10>& essentials) {
  detail::checkSize("first", first.size(), 5);
  detail::checkSize("second", second.size(), 5);
  detail::EssentialBasis basis;
  detail::essentialBasis(first.data(), second.data(), basis);
  detail::EssentialSystem system;
  detail::essentialSystem(basis, system);
  double action[10][10];
  if (!actionMatrix(system, action)) return 0;
  const detail::RealEigen<10> eigen(action);
  std::size_t count = 0;
  for (std::size_t i = 0; i < eigen.size(); ++i) {
    double monomials[10];
    eigen.vector(eigen.value(i), monomials);
    const double* const v = monomials + 6;  // x y z 1
    if (detail::essentialOf(basis, v, essentials[count]) &&
        detail::isEssential(essentials[count])) {
      ++count;
    }
  }
  return count;
}

}  // namespace v1
}  // namespace gslam
