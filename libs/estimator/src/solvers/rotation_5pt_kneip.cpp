#include <gslam/estimator/solvers/rotation_5pt_kneip.h>
#include <gslam/geometry/detail/pair.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "math/check_size.h"
#include "math/quaternion.h"
#include "math/real_eigen.h"
#include "math/solve_linear.h"
#include "math/tangents.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::multiply;
using detail::normalize;
using detail::Quaternion;

// Exponents of the monomials of a degree, without w first, then with rising powers of it; so that
// w times cubic i is quartic 15 + i.
template <std::size_t Count>
constexpr std::size_t indexOf(const unsigned char (&list)[Count][4], int x, int y, int z, int w) {
  for (std::size_t i = 0; i < Count; ++i) {
    if (list[i][0] == x && list[i][1] == y && list[i][2] == z && list[i][3] == w) return i;
  }
  return Count;
}

template <std::size_t Count>
constexpr void list(int degree, unsigned char (&result)[Count][4]) {
  std::size_t n = 0;
  for (int w = 0; w <= degree; ++w) {
    // Those without x first.
    for (int x = 0; x <= degree - w; ++x) {
      for (int y = degree - w - x; y >= 0; --y) {
        result[n][0] = static_cast<unsigned char>(x);
        result[n][1] = static_cast<unsigned char>(y);
        result[n][2] = static_cast<unsigned char>(degree - w - x - y);
        result[n][3] = static_cast<unsigned char>(w);
        ++n;
      }
    }
  }
}

struct Tables {
  unsigned char quadratics[10][4] = {};
  unsigned char cubics[20][4] = {};
  unsigned char quartics[35][4] = {};
  unsigned char pair[4][4] = {};       // quadratic of two variables
  unsigned char product[10][10] = {};  // quartic of two quadratics
  unsigned char times_x[20] = {};      // quartic of x times a cubic

  constexpr Tables() {
    list(2, quadratics);
    list(3, cubics);
    list(4, quartics);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        int e[4] = {};
        ++e[i];
        ++e[j];
        pair[i][j] = static_cast<unsigned char>(indexOf(quadratics, e[0], e[1], e[2], e[3]));
      }
    }
    for (std::size_t i = 0; i < 10; ++i) {
      for (std::size_t j = 0; j < 10; ++j) {
        const auto& a = quadratics[i];
        const auto& b = quadratics[j];
        product[i][j] = static_cast<unsigned char>(
            indexOf(quartics, a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]));
      }
    }
    for (std::size_t i = 0; i < 20; ++i) {
      const auto& a = cubics[i];
      times_x[i] = static_cast<unsigned char>(indexOf(quartics, a[0] + 1, a[1], a[2], a[3]));
    }
  }
};
constexpr Tables kTables{};

// The product with the unit quaternion (1 2 4 10) / 11: unknown is q' with q = mix q', so that
// usual rotations, as the identity, have no zeros among the unknowns.
constexpr double kMix[4][4] = {{10. / 11, -4. / 11, 2. / 11, 1. / 11},
                               {4. / 11, 10. / 11, -1. / 11, 2. / 11},
                               {-2. / 11, 1. / 11, 10. / 11, 4. / 11},
                               {-1. / 11, -2. / 11, -4. / 11, 10. / 11}};

// rows[i][c][k]: component c of a 4-vector that is linear in q, with coefficient k. Its product
// with r is zero: <r first, second q> = 0, and <r, q> = 0.
using LinearRows = double[6][4][4];

void setRows(const Vec3d* first, const Vec3d* second, LinearRows& rows) noexcept {
  for (std::size_t k = 0; k < 4; ++k) {
    const Quaternion q = {kMix[0][k], kMix[1][k], kMix[2][k], kMix[3][k]};
    for (std::size_t i = 0; i < 5; ++i) {
      const Quaternion a = {second[i][0], second[i][1], second[i][2], 0};
      const Quaternion b = {-first[i][0], -first[i][1], -first[i][2], 0};
      // <r first, p> = <r, p first*>
      Quaternion p, row;
      multiply(a, q, p);
      multiply(p, b, row);
      for (std::size_t c = 0; c < 4; ++c) rows[i][c][k] = row[c];
    }
    for (std::size_t c = 0; c < 4; ++c) rows[5][c][k] = q[c];
  }
}

using Quadratic = double[10];

// The six minors of two rows, columns 01 02 03 12 13 23.
void setMinors(const double (&a)[4][4], const double (&b)[4][4], Quadratic (&minors)[6]) noexcept {
  std::size_t n = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t d = c + 1; d < 4; ++d, ++n) {
      for (double& value : minors[n]) value = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
          minors[n][kTables.pair[i][j]] += a[c][i] * b[d][j] - a[d][i] * b[c][j];
        }
      }
    }
  }
}

// The determinant of four rows, from the minors of two and of the other two (Laplace).
void setQuartic(const Quadratic (&a)[6], const Quadratic (&b)[6], double (&quartic)[36]) noexcept {
  using Lanes = detail::Pair<double>;
  constexpr double kSigns[6] = {1, -1, 1, 1, -1, 1};
  for (double& value : quartic) value = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    // All products with monomial i of the first factor.
    double sums[10];
    for (std::size_t j = 0; j < 10; j += 2) {
      Lanes sum = Lanes::both(0);
      for (std::size_t m = 0; m < 6; ++m) {
        sum = sum + Lanes::both(kSigns[m] * a[m][i]) * Lanes::load(b[5 - m] + j);
      }
      sum.store(sums + j);
    }
    for (std::size_t j = 0; j < 10; ++j) quartic[kTables.product[i][j]] += sums[j];
  }
}

// All fifteen minors of four rows.
void setQuartics(const LinearRows& rows, double (&quartics)[15][36]) noexcept {
  Quadratic minors[6][6][6];
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) setMinors(rows[i], rows[j], minors[i][j]);
  }
  std::size_t n = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) {
      for (std::size_t k = j + 1; k < 6; ++k) {
        for (std::size_t l = k + 1; l < 6; ++l) {
          setQuartic(minors[i][j], minors[k][l], quartics[n++]);
        }
      }
    }
  }
}

// Elements 15 to 34 of the rows from 5 on become those of [I rest]. False where a pivot is zero.
bool eliminate(double (&quartics)[15][36], double* (&row)[15]) noexcept {
  for (std::size_t i = 0; i < 15; ++i) row[i] = quartics[i];
  for (std::size_t k = 0; k < 15; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < 15; ++i) {
      if (std::fabs(row[i][k]) > std::fabs(row[best][k])) best = i;
    }
    std::swap(row[k], row[best]);
    const double inverse = 1 / row[k][k];
    if (!(std::fabs(inverse) < 1e100)) return false;
    const std::size_t from = (k + 1) / 2 * 2;  // pairs
    for (std::size_t i = k + 1; i < 15; ++i) {
      const double factor = row[i][k] * inverse;
      for (std::size_t j = from; j < 36; ++j) row[i][j] -= factor * row[k][j];
    }
  }
  for (std::size_t i = 15; i-- > 5;) {
    for (std::size_t k = i + 1; k < 15; ++k) {
      const double factor = row[i][k];
      for (std::size_t j = 15; j < 35; ++j) row[i][j] -= factor * row[k][j];
    }
    const double inverse = 1 / row[i][i];
    for (std::size_t j = 15; j < 35; ++j) row[i][j] *= inverse;
  }
  return true;
}

// A rotation and the direction at right angles to the normals.
struct Motion {
  Quaternion q;
  Vec3d t;
};

// The rays of the first view, turned by a rotation, and the normals of the epipolar planes.
struct Planes {
  Planes(const Vec3d* first, const Vec3d* second, const Quaternion& q) noexcept {
    for (std::size_t i = 0; i < 5; ++i) {
      turned[i] = detail::turned(q, first[i]);
      normals[i] = turned[i].cross(second[i]);
    }
  }
  // The longest of the products of two normals; false where all are zero.
  bool direction(Vec3d& t) const noexcept {
    double longest = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t j = i + 1; j < 5; ++j) {
        const Vec3d product = normals[i].cross(normals[j]);
        const double squared = product.squaredNorm();
        if (!(squared > longest)) continue;
        longest = squared;
        t = product;
      }
    }
    if (!(longest > 0)) return false;
    t /= std::sqrt(longest);
    return true;
  }

  Vec3d turned[5], normals[5];
};

// A step of Newton's method for t n_i = 0: a turn of the rotation and a move of t. The squares of
// the step and of what was left before it; false where there is no step.
bool step(const Vec3d* first, const Vec3d* second, Motion& motion, double& moved,
          double& residual) noexcept {
  const Planes planes(first, second, motion.q);
  Vec3d u, v;
  detail::tangentsOf(motion.t, u, v);
  double m[5][6], x[5];
  residual = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    // (w x turned) x second t = w (turned x (second x t))
    const Vec3d by_rotation = planes.turned[i].cross(second[i].cross(motion.t));
    for (std::size_t k = 0; k < 3; ++k) m[i][k] = by_rotation[k];
    m[i][3] = u.dot(planes.normals[i]);
    m[i][4] = v.dot(planes.normals[i]);
    m[i][5] = -motion.t.dot(planes.normals[i]);
    residual += m[i][5] * m[i][5];
  }
  if (!detail::solveLinear(m, x) || !detail::turnBy({{x[0], x[1], x[2]}}, motion.q)) return false;
  motion.t = motion.t + x[3] * u + x[4] * v;
  motion.t /= std::sqrt(motion.t.squaredNorm());
  moved = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + x[4] * x[4];
  return true;
}

// Newton's method from the rotation; false where it does not end at a solution.
bool polish(const Vec3d* first, const Vec3d* second, Motion& motion) noexcept {
  if (!Planes(first, second, motion.q).direction(motion.t)) return false;
  for (int k = 0; k < 8; ++k) {
    double moved, residual;
    if (!step(first, second, motion, moved, residual)) return false;
    if (moved < 1e-15) return residual < 1e-12;
    if (!(moved < 1)) return false;  // leads elsewhere, or NaN
  }
  return false;
}

// The rotations found so far, each before its partner.
struct Rotations {
  Quaternion q[20];
  std::size_t count = 0;

  // Both or none, so that their number stays even.
  void add(const Quaternion& candidate, const Quaternion& partner) noexcept {
    constexpr double kNearSquare = 1e-14;  // solutions near each other are found no better
    for (std::size_t i = 0; i < count; ++i) {
      double minus = 0, plus = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        minus += (q[i][k] - candidate[k]) * (q[i][k] - candidate[k]);
        plus += (q[i][k] + candidate[k]) * (q[i][k] + candidate[k]);
      }
      if (minus < kNearSquare || plus < kNearSquare) return;
    }
    if (count == 20) return;
    for (std::size_t k = 0; k < 4; ++k) {
      q[count][k] = candidate[k];
      q[count + 1][k] = partner[k];
    }
    count += 2;
  }
};

// x times the cubics, divided by w, in terms of the cubics. False where the elimination breaks down
// or an element is not finite.
bool actionMatrix(const Vec3d* first, const Vec3d* second, double (&action)[20][20]) noexcept {
  LinearRows rows;
  setRows(first, second, rows);
  double quartics[15][36];
  setQuartics(rows, quartics);
  double* row[15];
  if (!eliminate(quartics, row)) return false;
  for (std::size_t i = 0; i < 20; ++i) {
    const std::size_t quartic = kTables.times_x[i];
    for (std::size_t j = 0; j < 20; ++j) {
      action[i][j] = quartic < 15 ? -row[quartic][15 + j] : 0;
      if (!(std::fabs(action[i][j]) < 1e100)) return false;
    }
    if (quartic >= 15) action[i][quartic - 15] = 1;
  }
  return true;
}

// The rotation of an eigenvector of the action matrix.
bool rotationOfCubics(const double (&cubics)[20], Quaternion& q) noexcept {
  // w2 times x, y, z, w, in the order of the list.
  constexpr std::size_t kX = indexOf(kTables.cubics, 1, 0, 0, 2);
  constexpr std::size_t kY = indexOf(kTables.cubics, 0, 1, 0, 2);
  constexpr std::size_t kZ = indexOf(kTables.cubics, 0, 0, 1, 2);
  constexpr std::size_t kW = indexOf(kTables.cubics, 0, 0, 0, 3);
  for (std::size_t k = 0; k < 4; ++k) {
    q[k] = kMix[k][0] * cubics[kX] + kMix[k][1] * cubics[kY] + kMix[k][2] * cubics[kZ] +
           kMix[k][3] * cubics[kW];
  }
  return normalize(q);
}

// Component c of the unknown quaternion of a rotation's: the eigenvalue is that of x over that of
// w.
double unknownOf(const Quaternion& q, std::size_t c) noexcept {
  return kMix[0][c] * q[0] + kMix[1][c] * q[1] + kMix[2][c] * q[2] + kMix[3][c] * q[3];
}

}  // namespace

std::size_t rotation5ptKneip(Span<const Vec3d> first, Span<const Vec3d> second,
                             std::array<SO3d, 20>& rotations_second_first) {
  detail::checkSize("first", first.size(), 5);
  detail::checkSize("second", second.size(), 5);
  double action[20][20];
  if (!actionMatrix(first.data(), second.data(), action)) return 0;
  const detail::RealEigen<20> eigen(action);
  Rotations rotations;
  bool is_done[20] = {};
  for (std::size_t i = 0; i < eigen.size(); ++i) {
    if (is_done[i]) continue;
    double cubics[20];
    eigen.vector(eigen.value(i), cubics);
    Motion motion;
    if (!rotationOfCubics(cubics, motion.q)) continue;
    if (!polish(first.data(), second.data(), motion)) continue;
    const Quaternion half_turn = {motion.t[0], motion.t[1], motion.t[2], 0};
    Quaternion partner;
    multiply(half_turn, motion.q, partner);
    rotations.add(motion.q, partner);
    // The partner's eigenvalue need not be looked at. (If that was another's, so near, then this
    // one comes as the partner of its own.)
    const double x = unknownOf(partner, 0), w = unknownOf(partner, 3);
    for (std::size_t k = i + 1; k < eigen.size(); ++k) {
      if (std::fabs(eigen.value(k) * w - x) < 1e-7) is_done[k] = true;
    }
  }
  for (std::size_t i = 0; i < rotations.count; ++i) {
    const Quaternion& q = rotations.q[i];
    rotations_second_first[i] = SO3d::fromQuaternion(q[0], q[1], q[2], q[3]);
  }
  return rotations.count;
}

}  // namespace v1
}  // namespace gslam
