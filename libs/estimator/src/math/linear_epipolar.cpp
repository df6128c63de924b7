#include "math/linear_epipolar.h"

#include <cfloat>
#include <cmath>

#include "math/null_space.h"
#include "math/tangents.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// The unit vector v with the least |m v|, and the eigenvalue |m v|^2.
//
// Newton's method for the characteristic polynomial of S = m^T m runs from 0 upwards to the least
// eigenvalue l without ever passing it; v is a column of the adjugate of S - l. Of equal
// eigenvalues, one of the vectors.
Vec3d leastSingularVector(const Mat3d& m) noexcept {
  const double* const e = m.values;
  double s[6];  // 00 01 02 11 12 22
  std::size_t k = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      s[k++] = e[i] * e[j] + e[3 + i] * e[3 + j] + e[6 + i] * e[6 + j];
    }
  }
  // l^3 - trace l^2 + minors l - det^2 = 0
  const double trace = s[0] + s[3] + s[5];
  const double minors =
      (s[0] * s[3] - s[1] * s[1]) + (s[0] * s[5] - s[2] * s[2]) + (s[3] * s[5] - s[4] * s[4]);
  const double det = e[0] * (e[4] * e[8] - e[5] * e[7]) + e[1] * (e[5] * e[6] - e[3] * e[8]) +
                     e[2] * (e[3] * e[7] - e[4] * e[6]);
  const double square = det * det;
  double l = 0;
  for (int i = 0; i < 40; ++i) {
    const double value = ((l - trace) * l + minors) * l - square;
    const double slope = (3 * l - 2 * trace) * l + minors;
    const double step = -value / slope;
    if (!(step > 1e-17 * trace)) break;  // rounding, or NaN
    l += step;
  }
  const double a = s[0] - l, d = s[3] - l, f = s[5] - l, b = s[1], c = s[2], x = s[4];
  // The longest column.
  const Vec3d columns[3] = {{{d * f - x * x, c * x - b * f, b * x - c * d}},
                            {{c * x - b * f, a * f - c * c, b * c - a * x}},
                            {{b * x - c * d, b * c - a * x, a * d - b * b}}};
  std::size_t best = 0;
  double longest = columns[0].squaredNorm();
  for (std::size_t i = 1; i < 3; ++i) {
    const double squared = columns[i].squaredNorm();
    if (squared > longest) {
      longest = squared;
      best = i;
    }
  }
  // Two equal least singular values: every vector in a plane does.
  if (!(longest > 1e-26 * trace * trace * trace * trace)) {
    const Vec3d row = {{e[0], e[1], e[2]}};
    const double norm = row.norm();
    if (!(norm > 0 && norm <= DBL_MAX)) return {{0, 0, 1}};
    Vec3d u, other;
    tangentsOf(row / norm, u, other);
    return u;
  }
  return columns[best] / std::sqrt(longest);
}

// Divided by the largest element, so that no product leaves the range. False where that is none.
bool normalize(Mat3d& m) noexcept {
  double largest = 0;
  bool finite = true;
  for (const double value : m.values) {
    finite = finite && std::isfinite(value);
    largest = std::fabs(value) > largest ? std::fabs(value) : largest;
  }
  if (!finite || !(largest > 0)) return false;
  // By division: the inverse of a tiny number may not be finite.
  for (double& value : m.values) value /= largest;
  return true;
}

}  // namespace

PointScale PointScale::of(Span<const Vec2d> points) noexcept {
  double x = 0, y = 0;
  for (const Vec2d& p : points) {
    x += p[0];
    y += p[1];
  }
  const double share = 1 / static_cast<double>(points.size());
  x *= share;
  y *= share;
  double distance = 0;
  for (const Vec2d& p : points) {
    const double u = p[0] - x, v = p[1] - y;
    distance += std::sqrt(u * u + v * v);
  }
  const double scale = 1.4142135623730951 / (distance * share);
  return {x, y, std::isfinite(scale) ? scale : 1};
}

bool unscaleFundamental(const double* scaled, const PointScale& first, const PointScale& second,
                        Mat3d& fundamental) noexcept {
  // second^T F first with first' = s (first - c): to the columns, then to the rows.
  double m[9];
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = first.scale * scaled[3 * i], b = first.scale * scaled[3 * i + 1];
    m[3 * i] = a;
    m[3 * i + 1] = b;
    m[3 * i + 2] = scaled[3 * i + 2] - a * first.x - b * first.y;
  }
  Mat3d result;
  double squared = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const double a = second.scale * m[j], b = second.scale * m[3 + j];
    const double c = m[6 + j] - a * second.x - b * second.y;
    result.values[j] = a;
    result.values[3 + j] = b;
    result.values[6 + j] = c;
    squared += a * a + b * b + c * c;
  }
  if (!(squared > 1e-290 && squared <= DBL_MAX)) return false;
  fundamental = (1 / std::sqrt(squared)) * result;
  return true;
}

void LinearEpipolar::add(const Vec3d& first, const Vec3d& second) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) block_[3 * i + j][waiting_] = second[i] * first[j];
  }
  if (++waiting_ == kBlock) reduce();
}

// Householder reflections of the triangle above the block; the triangle's zeros stay.
void LinearEpipolar::reduce() noexcept {
  for (std::size_t i = waiting_; i < kBlock; ++i) {
    for (auto& column : block_) column[i] = 0;
  }
  waiting_ = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    double* const v = block_[k];
    double squared = 0;
    for (std::size_t i = 0; i < kBlock; ++i) squared += v[i] * v[i];
    const double pivot = triangle_[k][k];
    const double length = std::copysign(std::sqrt(squared + pivot * pivot), pivot);
    const double head = pivot + length;
    const double half = head * length;  // |(head, v)|^2 / 2
    triangle_[k][k] = -length;
    if (!(half > 1e-290)) continue;
    const double inverse = 1 / half;
    for (std::size_t j = k + 1; j < 9; ++j) {
      double* const column = block_[j];
      double sum = head * triangle_[j][k];
      for (std::size_t i = 0; i < kBlock; ++i) sum += v[i] * column[i];
      sum *= inverse;
      triangle_[j][k] -= sum * head;
      for (std::size_t i = 0; i < kBlock; ++i) column[i] -= sum * v[i];
    }
  }
}

bool LinearEpipolar::solve(Mat3d& m) noexcept {
  if (waiting_ > 0) reduce();
  double largest = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    const double size = std::fabs(triangle_[i][i]);
    if (!(size <= DBL_MAX)) return false;
    largest = size > largest ? size : largest;
  }
  // A pivot at rounding is as good as zero: inverse iteration is not harmed by its size.
  const double least = DBL_EPSILON * largest;
  if (!(least > 0)) return false;
  double inverses[9];
  for (std::size_t i = 0; i < 9; ++i) {
    const double pivot = triangle_[i][i];
    inverses[i] = 1 / (std::fabs(pivot) > least ? pivot : least);
  }
  // Inverse iteration for R^T R; the first half step starts at the last unit vector, which for
  // exact data leads there at once.
  double v[9] = {0, 0, 0, 0, 0, 0, 0, 0, 1};
  constexpr int kMostSteps = 100;
  for (int step = 0; step < kMostSteps; ++step) {
    double w[9];
    for (std::size_t i = 0; i < 9; ++i) {  // R^T w = v
      double sum = v[i];
      if (step > 0) {
        for (std::size_t j = 0; j < i; ++j) sum -= triangle_[i][j] * w[j];
        sum *= inverses[i];
      }
      w[i] = sum;
    }
    double scale = 0;  // the second half must not overflow
    for (const double value : w) scale = std::fabs(value) > scale ? std::fabs(value) : scale;
    scale = 1 / scale;
    double squared = 0;
    double product = 0;
    for (std::size_t i = 9; i-- > 0;) {  // R v = w
      double sum = w[i] * scale;
      for (std::size_t j = i + 1; j < 9; ++j) sum -= triangle_[j][i] * w[j];
      w[i] = sum * inverses[i];
      squared += w[i] * w[i];
      product += w[i] * v[i];
    }
    const double norm = std::copysign(1 / std::sqrt(squared), product);
    double moved = 0;
    for (std::size_t i = 0; i < 9; ++i) {
      const double next = w[i] * norm;
      moved += (next - v[i]) * (next - v[i]);
      v[i] = next;
    }
    if (!(moved > 1e-26)) break;
  }
  for (std::size_t i = 0; i < 9; ++i) {
    if (!std::isfinite(v[i])) return false;
    m.values[i] = v[i];
  }
  return true;
}

void makeRankTwo(Mat3d& m) noexcept {
  const Vec3d v = leastSingularVector(m);
  const Vec3d image = m * v;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m(i, j) -= image[i] * v[j];
  }
}

bool makeEssential(Mat3d& m) noexcept {
  if (!normalize(m)) return false;
  const Vec3d v = leastSingularVector(m);
  // Two vectors that make v a basis.
  Vec3d a, b;
  tangentsOf(v, a, b);
  // The orthogonal factor of the 3 x 2 matrix (m a, m b) = Q S: S = sqrt of its Gram matrix, which
  // for 2 x 2 is (G + sqrt(det G) I) / sqrt(trace G + 2 sqrt(det G)).
  const Vec3d p = m * a;
  const Vec3d q = m * b;
  const Vec3d normal = p.cross(q);
  const double root = std::sqrt(normal.squaredNorm());
  const double pp = p.squaredNorm() + root, qq = q.squaredNorm() + root, pq = p.dot(q);
  const double trace = pp + qq;
  if (!(root > 1e-12 * trace)) return false;  // rank 1
  // Q = (p q) S^-1
  const double factor = std::sqrt(trace) / (pp * qq - pq * pq);
  const Vec3d x = factor * (qq * p - pq * q);
  const Vec3d y = factor * (pp * q - pq * p);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m(i, j) = x[i] * a[j] + y[i] * b[j];
  }
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
