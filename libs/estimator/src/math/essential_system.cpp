#include "math/essential_system.h"

#include <gslam/base/platform.h>

#include <cmath>
#include <limits>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

using Lanes = Pair<double>;

// A linear form in x y z 1, for two equations at a time.
struct Linear {
  Lanes x, y, z, one;
};

// x2 xy xz x y2 yz y z2 z 1
struct Quadratic {
  double values[10];
};

// Of the basis: element e in the first, element f in the second lane.
GSLAM_ALWAYS_INLINE Linear linear(const EssentialBasis& basis, std::size_t e,
                                  std::size_t f) noexcept {
  return {
      Lanes(basis[0].values[e], basis[0].values[f]), Lanes(basis[1].values[e], basis[1].values[f]),
      Lanes(basis[2].values[e], basis[2].values[f]), Lanes(basis[3].values[e], basis[3].values[f])};
}

struct Products {
  Lanes values[10];
};

GSLAM_ALWAYS_INLINE Products product(const Linear& a, const Linear& b) noexcept {
  return {{a.x * b.x, a.x * b.y + a.y * b.x, a.x * b.z + a.z * b.x, a.x * b.one + a.one * b.x,
           a.y * b.y, a.y * b.z + a.z * b.y, a.y * b.one + a.one * b.y, a.z * b.z,
           a.z * b.one + a.one * b.z, a.one * b.one}};
}

// The sum of three products, the first lane to one quadratic and the second to another.
GSLAM_ALWAYS_INLINE void sumOfProducts(const Linear (&a)[3], const Linear (&b)[3], Quadratic& first,
                                       Quadratic& second) noexcept {
  const Products p = product(a[0], b[0]);
  const Products q = product(a[1], b[1]);
  const Products r = product(a[2], b[2]);
  for (std::size_t i = 0; i < 10; ++i) {
    const Lanes sum = p.values[i] + q.values[i] + r.values[i];
    first.values[i] = sum.first();
    second.values[i] = sum.second();
  }
}

GSLAM_ALWAYS_INLINE Products pairs(const Quadratic& a, const Quadratic& b) noexcept {
  const double(&x)[10] = a.values;
  const double(&y)[10] = b.values;
  return {{Lanes(x[0], y[0]), Lanes(x[1], y[1]), Lanes(x[2], y[2]), Lanes(x[3], y[3]),
           Lanes(x[4], y[4]), Lanes(x[5], y[5]), Lanes(x[6], y[6]), Lanes(x[7], y[7]),
           Lanes(x[8], y[8]), Lanes(x[9], y[9])}};
}
GSLAM_ALWAYS_INLINE Products both(const Quadratic& a) noexcept {
  return pairs(a, a);
}

// Two rows of the system: sums of three products of a quadratic and a linear form.
GSLAM_ALWAYS_INLINE void cubics(const Products& q0, const Products& q1, const Products& q2,
                                const Linear (&l)[3], double* first, double* second) noexcept {
  const auto set = [&](std::size_t column, Lanes even, Lanes odd) {
    Lanes(even.first(), odd.first()).store(first + column);
    Lanes(even.second(), odd.second()).store(second + column);
  };
  const auto sum = [](Lanes a, Lanes b, Lanes c) { return a + b + c; };
  const auto x = [&](std::size_t m) {
    return sum(q0.values[m] * l[0].x, q1.values[m] * l[1].x, q2.values[m] * l[2].x);
  };
  const auto y = [&](std::size_t m) {
    return sum(q0.values[m] * l[0].y, q1.values[m] * l[1].y, q2.values[m] * l[2].y);
  };
  const auto z = [&](std::size_t m) {
    return sum(q0.values[m] * l[0].z, q1.values[m] * l[1].z, q2.values[m] * l[2].z);
  };
  const auto one = [&](std::size_t m) {
    return sum(q0.values[m] * l[0].one, q1.values[m] * l[1].one, q2.values[m] * l[2].one);
  };
  // 0 x2, 1 xy, 2 xz, 3 x, 4 y2, 5 yz, 6 y, 7 z2, 8 z, 9 one
  set(0, x(0), y(4));                                // x3 y3
  set(2, y(0) + x(1), y(1) + x(4));                  // x2y xy2
  set(4, z(0) + x(2), one(0) + x(3));                // x2z x2
  set(6, z(4) + y(5), one(4) + y(6));                // y2z y2
  set(8, z(1) + y(2) + x(5), one(1) + y(3) + x(6));  // xyz xy
  set(10, z(2) + x(7), one(2) + z(3) + x(8));        // xz2 xz
  set(12, one(3) + x(9), z(5) + y(7));               // x yz2
  set(14, one(5) + z(6) + y(8), one(6) + y(9));      // yz y
  set(16, z(7), one(7) + z(8));                      // z3 z2
  set(18, one(8) + z(9), one(9));                    // z 1
}

// Columns K to 9; all loops have bounds that the compiler knows.
template <std::size_t K>
GSLAM_ALWAYS_INLINE void eliminateColumn(double* (&row)[10], double* inverses, double& least,
                                         double& largest) noexcept {
  std::size_t best = K;
  double pivot = std::fabs(row[K][K]);
  for (std::size_t i = K + 1; i < 10; ++i) {
    const double value = std::fabs(row[i][K]);
    if (value > pivot) {
      pivot = value;
      best = i;
    }
  }
  std::swap(row[K], row[best]);
  least = pivot < least || !(pivot == pivot) ? pivot : least;
  largest = pivot > largest ? pivot : largest;
  const double inverse = 1 / row[K][K];
  inverses[K] = inverse;
  constexpr std::size_t kFrom = (K + 1) / 2 * 2;  // a column too many does not matter
  for (std::size_t i = K + 1; i < 10; ++i) {
    const Lanes factor = Lanes::both(row[i][K] * inverse);
    for (std::size_t j = kFrom; j < 20; j += 2) {
      (Lanes::load(row[i] + j) - factor * Lanes::load(row[K] + j)).store(row[i] + j);
    }
  }
}

template <std::size_t K>
GSLAM_ALWAYS_INLINE void eliminateFrom(double* (&row)[10], double* inverses, double& least,
                                       double& largest) noexcept {
  eliminateColumn<K>(row, inverses, least, largest);
  if constexpr (K < 9) eliminateFrom<K + 1>(row, inverses, least, largest);
}

}  // namespace

void essentialBasis(const Vec3d* first, const Vec3d* second, EssentialBasis& basis) noexcept {
  Row9 rows[5];
  for (std::size_t i = 0; i < 5; ++i) setEpipolarRow(first[i].data(), second[i].data(), rows[i]);
  nullSpace(rows, basis);
  // Bearings and motions along the axes, as in stereo pairs, would leave zeros in the basis, and
  // solutions with w = 0.
  mixBasis(basis);
}

void mixBasis(EssentialBasis& basis) noexcept {
  const auto both = [](double value) { return Lanes::both(value); };
  for (std::size_t i = 0; i < 5; ++i) {
    const Lanes a = basis[0].pair(i), b = basis[1].pair(i);
    const Lanes c = basis[2].pair(i), d = basis[3].pair(i);
    const Lanes half = both(0.5) * ((a + b) + (c + d));  // a reflection
    const Lanes p = a - half, q = b - half, r = c - half, s = d - half;
    basis[0].setPair(i, both(0.6) * p + both(0.8) * q);
    basis[1].setPair(i, both(0.6) * q - both(0.8) * p);
    basis[2].setPair(i, both(0.28) * r + both(0.96) * s);
    basis[3].setPair(i, both(0.28) * s - both(0.96) * r);
  }
}

void essentialSystem(const EssentialBasis& basis, EssentialSystem& system) noexcept {
  // G = E E^T - trace(E E^T) / 2, the upper triangle, and the cofactors of the last row of E.
  Quadratic g00, g01, g02, g11, g12, g22, c0, c1, c2;
  const auto at = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return linear(basis, 3 * i + j, 3 * k + l);
  };
  {
    const Linear e01[3] = {at(0, 0, 1, 0), at(0, 1, 1, 1), at(0, 2, 1, 2)};
    const Linear e22[3] = {at(2, 0, 2, 0), at(2, 1, 2, 1), at(2, 2, 2, 2)};
    sumOfProducts(e01, e01, g00, g11);
    sumOfProducts(e01, e22, g02, g12);
    const Linear e20[3] = {at(2, 0, 0, 0), at(2, 1, 0, 1), at(2, 2, 0, 2)};
    const Linear e21[3] = {at(2, 0, 1, 0), at(2, 1, 1, 1), at(2, 2, 1, 2)};
    sumOfProducts(e20, e21, g22, g01);
  }
  {
    const Products p = product(at(0, 1, 0, 2), at(1, 2, 1, 0));
    const Products q = product(at(0, 2, 0, 0), at(1, 1, 1, 2));
    const Products r = product(at(0, 0, 0, 1), at(1, 1, 1, 0));
    for (std::size_t i = 0; i < 10; ++i) {
      const Lanes difference = p.values[i] - q.values[i];
      c0.values[i] = difference.first();
      c1.values[i] = difference.second();
      c2.values[i] = r.values[i].first() - r.values[i].second();
    }
  }
  for (std::size_t i = 0; i < 10; ++i) {
    const double half = 0.5 * (g00.values[i] + g11.values[i] + g22.values[i]);
    g00.values[i] -= half;
    g11.values[i] -= half;
    g22.values[i] -= half;
  }

  const Linear columns01[3] = {at(0, 0, 0, 1), at(1, 0, 1, 1), at(2, 0, 2, 1)};
  const Linear columns22[3] = {at(0, 2, 0, 2), at(1, 2, 1, 2), at(2, 2, 2, 2)};
  const Linear column2_row2[3] = {at(0, 2, 2, 0), at(1, 2, 2, 1), at(2, 2, 2, 2)};
  double(*rows)[20] = system.rows;
  cubics(both(g00), both(g01), both(g02), columns01, rows[0], rows[1]);
  cubics(both(g01), both(g11), both(g12), columns01, rows[2], rows[3]);
  cubics(both(g02), both(g12), both(g22), columns01, rows[4], rows[5]);
  cubics(pairs(g00, g01), pairs(g01, g11), pairs(g02, g12), columns22, rows[6], rows[7]);
  cubics(pairs(g02, c0), pairs(g12, c1), pairs(g22, c2), column2_row2, rows[8], rows[9]);
}

double eliminate(EssentialSystem& system, std::size_t first_row, double* (&row)[10]) noexcept {
  for (std::size_t i = 0; i < 10; ++i) row[i] = system.rows[i];
  double least = std::numeric_limits<double>::infinity();
  double largest = 0;
  double inverses[10];
  eliminateFrom<0>(row, inverses, least, largest);
  if (!(least > 0) || !(largest < std::numeric_limits<double>::infinity())) return 0;
  for (std::size_t i = 10; i-- > first_row;) {
    for (std::size_t j = 10; j < 20; j += 2) {
      Lanes rest = Lanes::load(row[i] + j);
      for (std::size_t k = i + 1; k < 10; ++k) {
        rest = rest - Lanes::both(row[i][k]) * Lanes::load(row[k] + j);
      }
      (rest * Lanes::both(inverses[i])).store(row[i] + j);
    }
  }
  return least / largest;
}

bool essentialOf(const EssentialBasis& basis, const double* coefficients,
                 Mat3d& essential) noexcept {
  double squared = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += coefficients[k] * basis[k].values[i];
    essential.values[i] = sum;
    squared += sum * sum;
  }
  // Also false for NaN.
  if (!(squared > 1e-200 && squared < 1e200)) return false;
  const double scale = std::sqrt(2 / squared);
  for (double& value : essential.values) value *= scale;
  return true;
}

bool isEssential(const Mat3d& essential) noexcept {
  const double* const e = essential.values;
  const Vec3d r0 = {{e[0], e[1], e[2]}}, r1 = {{e[3], e[4], e[5]}}, r2 = {{e[6], e[7], e[8]}};
  const Vec3d c0 = r1.cross(r2), c1 = r2.cross(r0), c2 = r0.cross(r1);
  // (a b)^2 with a^2 + b^2 = 2 is 1 - (a - b)^2 or so.
  const double cofactors = c0.squaredNorm() + c1.squaredNorm() + c2.squaredNorm();
  return std::fabs(cofactors - 1) < 1e-6 && std::fabs(r0.dot(c0)) < 1e-3;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
