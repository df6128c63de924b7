#include "math/rotation_fit.h"

#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/detail/symmetric_eigen.h>

#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Two vectors at less than this angle (sine) are collinear.
constexpr double kLeastSine = 1e-8;
// Of the two largest eigenvalues, relative to `bound`: a few hundred roundings.
constexpr double kLeastGap = 1e-13;
// From where on the eigenvector of the adjugate would lose three digits or more.
constexpr double kLeastSlope = 1e-3;

// Horn's symmetric matrix: q^T K q is the trace of R(q)^T m.
Mat4d hornMatrix(const Mat3d& m) noexcept {
  const double xx = m(0, 0), yy = m(1, 1), zz = m(2, 2);
  const double xy = m(0, 1) + m(1, 0), xz = m(0, 2) + m(2, 0), yz = m(1, 2) + m(2, 1);
  const double wx = m(2, 1) - m(1, 2), wy = m(0, 2) - m(2, 0), wz = m(1, 0) - m(0, 1);
  return {{xx - yy - zz, xy, xz, wx,  //
           xy, yy - xx - zz, yz, wy,  //
           xz, yz, zz - xx - yy, wz,  //
           wx, wy, wz, xx + yy + zz}};
}

// The minors of two rows and two columns of a 4 x 4 matrix: all cofactors are made of them.
struct Minors {
  explicit Minors(const Mat4d& k) noexcept : a(k) {
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t p = kColumns[i][0], q = kColumns[i][1];
      s[i] = a(0, p) * a(1, q) - a(1, p) * a(0, q);
      c[i] = a(2, p) * a(3, q) - a(3, p) * a(2, q);
    }
  }
  double determinant() const noexcept {
    return (s[0] * c[5] - s[1] * c[4] + s[2] * c[3]) + (s[3] * c[2] - s[4] * c[1] + s[5] * c[0]);
  }
  // The column of the adjugate of a symmetric matrix that has the largest diagonal element.
  Vec4d largestColumn() const noexcept {
    const double d0 = a(1, 1) * c[5] - a(1, 2) * c[4] + a(1, 3) * c[3];
    const double d1 = a(0, 0) * c[5] - a(0, 2) * c[2] + a(0, 3) * c[1];
    const double d2 = a(3, 0) * s[4] - a(3, 1) * s[2] + a(3, 3) * s[0];
    const double d3 = a(2, 0) * s[3] - a(2, 1) * s[1] + a(2, 2) * s[0];
    const double e0 = std::fabs(d0), e1 = std::fabs(d1), e2 = std::fabs(d2), e3 = std::fabs(d3);
    const double c01 = a(0, 2) * c[4] - a(0, 1) * c[5] - a(0, 3) * c[3];
    const double c23 = a(2, 1) * s[2] - a(2, 0) * s[4] - a(2, 3) * s[0];
    const double c02 = a(3, 1) * s[5] - a(3, 2) * s[4] + a(3, 3) * s[3];
    const double c03 = a(2, 2) * s[4] - a(2, 1) * s[5] - a(2, 3) * s[3];
    const double c12 = a(3, 2) * s[2] - a(3, 0) * s[5] - a(3, 3) * s[1];
    const double c13 = a(2, 0) * s[5] - a(2, 2) * s[2] + a(2, 3) * s[1];
    if (std::fmax(e0, e1) >= std::fmax(e2, e3)) {
      return e0 >= e1 ? Vec4d{{d0, c01, c02, c03}} : Vec4d{{c01, d1, c12, c13}};
    }
    return e2 >= e3 ? Vec4d{{c02, c12, d2, c23}} : Vec4d{{c03, c13, c23, d3}};
  }

  static constexpr std::size_t kColumns[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  const Mat4d& a;
  double s[6];
  double c[6];
};

bool setRotation(const Vec4d& q, SO3d& rotation) {
  const double squared = q.squaredNorm();
  if (!(squared > 1e-100 && squared < 1e100)) return false;
  const double inverse = 1 / std::sqrt(squared);
  rotation = SO3d::fromQuaternion(inverse * q[0], inverse * q[1], inverse * q[2], inverse * q[3]);
  return true;
}

// For two eigenvalues near each other; sure, and several times slower.
bool fitByJacobi(const Mat4d& k, SO3d& rotation) {
  const SymmetricEigen<double, 4> eigen(k);
  if (!(eigen.values[0] - eigen.values[1] > kLeastGap)) return false;
  return setRotation(eigen.vectors.col(0), rotation);
}

// Along the first of two vectors, and at right angles to it in their plane.
struct PlaneFrame {
  bool compute(const Vec3d& p, const Vec3d& q) noexcept {
    const double square = p.squaredNorm();
    normal = p.cross(q);
    const double area = normal.squaredNorm();
    if (!(area > kLeastSine * kLeastSine * (square * q.squaredNorm())) || !(area < 1e290)) {
      return false;
    }
    length = std::sqrt(square);
    const double inverse = 1 / length;
    const double whole = std::sqrt(area);
    u = inverse * p;
    normal *= 1 / whole;
    v = normal.cross(u);
    along = u.dot(q);
    height = whole * inverse;
    return true;
  }

  Vec3d u, v, normal;
  double length;         // the first vector is (length, 0)
  double along, height;  // the second one
};

}  // namespace

SO3d rotationOf(const Mat3d& m) noexcept {
  const Vec4d q = quaternionOfMatrix(m);
  return SO3d::fromQuaternion(q[0], q[1], q[2], q[3]);
}

bool fitRotation(const Mat3d& m, double bound, SO3d& rotation) {
  if (!(bound > 1e-290 && bound < 1e290)) return false;
  const Mat3d scaled = (1 / bound) * m;
  double square = 0;
  for (const double value : scaled.values) square += value * value;
  if (!(square < 4)) return false;  // NaN, or no bound at all
  const Mat4d k = hornMatrix(scaled);
  // The characteristic polynomial has four real roots, of which 1 is no less than the largest:
  // Newton's method falls towards it from there.
  const double c2 = -2 * square;
  const double c1 = -8 * detail::determinant(scaled);
  const double c0 = Minors(k).determinant();
  double root = 1;
  double slope = 0;
  for (int i = 0; i < 20; ++i) {
    const double value = ((root * root + c2) * root + c1) * root + c0;
    slope = (4 * root * root + 2 * c2) * root + c1;
    if (!(slope > kLeastSlope)) break;
    const double step = value / slope;
    root -= step;
    if (std::fabs(step) < 1e-9) break;  // the next one would be below rounding
  }
  if (!(slope > kLeastSlope)) return fitByJacobi(k, rotation);
  Mat4d shifted = k;
  for (std::size_t i = 0; i < 4; ++i) shifted(i, i) -= root;
  return setRotation(Minors(shifted).largestColumn(), rotation);
}

bool fitPlanarRotation(const Vec3d (&a)[2], const Vec3d (&b)[2], const Mat<double, 2, 2>& moment,
                       SO3d& rotation, double& trace) {
  // The planes are laid on each other with the same side up, and turned: Horn 1987, section 5.
  PlaneFrame p, q;
  if (!p.compute(a[0], a[1]) || !q.compute(b[0], b[1])) return false;
  const double m00 = moment(0, 0) * p.length + moment(0, 1) * p.along;
  const double m10 = moment(1, 0) * p.length + moment(1, 1) * p.along;
  const double m01 = moment(0, 1) * p.height;
  const double m11 = moment(1, 1) * p.height;
  double cosine = q.length * m00 + q.along * m10 + q.height * m11;
  double sine = q.height * m10 - (q.length * m01 + q.along * m11);
  trace = std::sqrt(cosine * cosine + sine * sine);
  if (!(trace > 1e-140 && trace < 1e290)) return false;
  cosine /= trace;
  sine /= trace;
  const Vec3d u = cosine * q.u + sine * q.v;
  const Vec3d v = cosine * q.v - sine * q.u;
  Mat3d m;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      m(r, c) = u[r] * p.u[c] + v[r] * p.v[c] + q.normal[r] * p.normal[c];
    }
  }
  rotation = rotationOf(m);
  return true;
}

bool Alignment::computeOfThree(const Vec3d* first, const Vec3d* second, const double* weights) {
  const double w0 = weights != nullptr ? weights[0] : 1;
  const double w1 = weights != nullptr ? weights[1] : 1;
  const double w2 = weights != nullptr ? weights[2] : 1;
  if (!(w0 > 0 && w1 > 0 && w2 > 0)) return false;
  const double share = 1 / (w0 + w1 + w2);
  const double v1 = share * w1;
  const double v2 = share * w2;
  const Vec3d a[2] = {first[1] - first[0], first[2] - first[0]};
  const Vec3d b[2] = {second[1] - second[0], second[2] - second[0]};
  const double beside = -v1 * w2;
  const Mat<double, 2, 2> moment = {{v1 * (w0 + w2), beside, beside, v2 * (w0 + w1)}};
  if (!fitPlanarRotation(a, b, moment, rotation, trace)) return false;
  mean_first = first[0] + (v1 * a[0] + v2 * a[1]);
  mean_second = second[0] + (v1 * b[0] + v2 * b[1]);
  square_first = moment(0, 0) * a[0].squaredNorm() + moment(1, 1) * a[1].squaredNorm() +
                 2 * beside * a[0].dot(a[1]);
  return true;
}

bool Alignment::compute(Span<const Vec3d> first, Span<const Vec3d> second,
                        Span<const double> weights) {
  if (first.size() == 3) {
    return computeOfThree(first.data(), second.data(), weights.empty() ? nullptr : weights.data());
  }
  double total = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double w = weights.empty() ? 1 : weights[i];
    if (!(w >= 0)) return false;
    total += w;
    mean_first += w * first[i];
    mean_second += w * second[i];
  }
  if (!(total > 0)) return false;
  mean_first *= 1 / total;
  mean_second *= 1 / total;
  Vec3d c0{}, c1{}, c2{};  // columns of the sum of b a^T
  double square_second = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double w = weights.empty() ? 1 : weights[i];
    const Vec3d a = first[i] - mean_first;
    const Vec3d b = second[i] - mean_second;
    const Vec3d wa = w * a;
    c0 += wa[0] * b;
    c1 += wa[1] * b;
    c2 += wa[2] * b;
    square_first += wa.dot(a);
    square_second += w * b.squaredNorm();
  }
  const Mat3d m = {{c0[0], c1[0], c2[0], c0[1], c1[1], c2[1], c0[2], c1[2], c2[2]}};
  const double bound = std::sqrt(square_first) * std::sqrt(square_second);
  if (!fitRotation(m, bound, rotation)) return false;
  const Mat3d r = rotation.matrix();
  trace = 0;
  for (std::size_t i = 0; i < 9; ++i) trace += r.values[i] * m.values[i];
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
