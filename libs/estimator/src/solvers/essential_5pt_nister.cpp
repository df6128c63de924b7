#include <gslam/estimator/solvers/essential_5pt_nister.h>

#include "math/check_size.h"
#include "math/essential_system.h"
#include "math/hidden_variable.h"
#include "math/sturm.h"

namespace gslam {
inline namespace v1 {

std::size_t essential5ptNister(Span<const Vec3d> first, Span<const Vec3d> second,
                               std::array<Mat3d, 10>& essentials) {
  detail::checkSize("first", first.size(), 5);
  detail::checkSize("second", second.size(), 5);
  detail::EssentialBasis basis;
  detail::essentialBasis(first.data(), second.data(), basis);
  detail::EssentialSystem system;
  detail::essentialSystem(basis, system);
  double* row[10];
  if (!(detail::eliminate(system, 4, row) > 0)) return 0;
  const detail::HiddenVariable hidden(row);
  double c[11];
  hidden.determinant(c);
  const detail::RealRoots<10> roots(c, 1e-12);
  std::size_t count = 0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    double v[4];
    hidden.solution(roots.t(i), roots.u(i), v);
    if (detail::essentialOf(basis, v, essentials[count]) &&
        detail::isEssential(essentials[count])) {
      ++count;
    }
  }
  return count;
}

}  // namespace v1
}  // namespace gslam
