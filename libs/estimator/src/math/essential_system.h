// The polynomial equations of an essential matrix in the null space of five epipolar constraints.
#ifndef GSLAM_ESTIMATOR_MATH_ESSENTIAL_SYSTEM_H
#define GSLAM_ESTIMATOR_MATH_ESSENTIAL_SYSTEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>

#include "math/null_space.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Four orthonormal matrices; E = x basis[0] + y basis[1] + z basis[2] + w basis[3].
using EssentialBasis = Row9[4];

// Ten cubics in x, y, z, where w = 1: 2 E E^T E - trace(E E^T) E = 0 (halved), det E = 0. Order of
// the monomials (Nister 2004):
//   x3 y3 x2y xy2 x2z x2 y2z y2 xyz xy | xz2 xz x yz2 yz y z3 z2 z 1.
struct alignas(16) EssentialSystem {
  double rows[10][20];
};

// The basis for five bearings each.
void essentialBasis(const Vec3d* first, const Vec3d* second, EssentialBasis& basis) noexcept;

// Another orthonormal basis of the same space, by an orthogonal matrix without zeros.
void mixBasis(EssentialBasis& basis) noexcept;

// The equations for a basis.
void essentialSystem(const EssentialBasis& basis, EssentialSystem& system) noexcept;

// Gauss elimination with the choice of a row: afterwards row[i] points to a row whose elements from
// 10 on are those of the reduced system, [I rest], for i >= first_row. Returns the least pivot as a
// part of the largest; 0 where there is none.
double eliminate(EssentialSystem& system, std::size_t first_row, double* (&row)[10]) noexcept;

// The matrix of coefficients (x y z w), scaled to singular values 1, 1, 0. False where it is not
// finite or is zero.
bool essentialOf(const EssentialBasis& basis, const double* coefficients,
                 Mat3d& essential) noexcept;

// Whether the singular values are 1, 1, 0 to about 1e-3: roots of ill-conditioned polynomials may
// lead anywhere.
bool isEssential(const Mat3d& essential) noexcept;

// Polishes `count` solutions, each (x y z w) of any scale but zero, on all ten equations, to
// rounding; unit vectors afterwards. first_step[i] is the length of the first step, or an infinity
// where there was no convergence.
void polishEssential(const EssentialBasis& basis, std::size_t count, double (*solutions)[4],
                     double* first_step) noexcept;

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_ESSENTIAL_SYSTEM_H
