#include "robust/epipolar_matches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/bearing_frame.h"
#include "robust/support.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Of the two views' distances from epipolar lines, Sampson's error is the smaller one by up to
// sqrt(2).
constexpr double kWidestBand = 1.4142135623730951;

Vec2d meanOf(Span<const Vec2d> points) {
  Vec2d sum{};
  for (const Vec2d& p : points) sum += p;
  return points.empty() ? sum : sum / static_cast<double>(points.size());
}

double squareSum(Span<const Vec2d> points, const Vec2d& centre) {
  double sum = 0;
  for (const Vec2d& p : points) sum += (p - centre).squaredNorm();
  return sum;
}

// How far the ray c is from what was observed at the bearing b, in the unit of residuals. Signs
// of homographies between unknown cameras mean nothing.
double squaredOnPlane(const Vec3d& c, double x, double y) {
  if (c[2] == 0) return kInfinite;
  const double u = c[0] / c[2] - x, v = c[1] / c[2] - y;
  return u * u + v * v;
}
double squaredOnSphere(const Vec3d& c, const Vec3d& b) {
  const double along = b.dot(c);
  if (!(along > 0)) return kInfinite;
  return (c / along - b).squaredNorm();
}
double squaredOnFrame(const Vec3d& c, const Vec3d& b, const double* j) {
  const double along = b.dot(c);
  if (!(along > 0)) return kInfinite;
  const Vec3d d = c / along - b, j0 = {j[0], j[1], j[2]}, j1 = {j[3], j[4], j[5]};
  const double a = j0.dot(j0), ab = j0.dot(j1), bb = j1.dot(j1);
  const double u = j0.dot(d), v = j1.dot(d), determinant = a * bb - ab * ab;
  const double p = (bb * u - ab * v) / determinant, q = (a * v - ab * u) / determinant;
  return p * p + q * q;
}

}  // namespace

EpipolarMatches::EpipolarMatches(EpipolarKind kind, std::size_t size)
    : kind_(kind),
      size_(size),
      width_(kEpipolarColumns[static_cast<std::size_t>(kind)]),
      rows_(size * width_) {}

EpipolarMatches EpipolarMatches::fromPoints(Span<const Vec2d> first, Span<const Vec2d> second,
                                            const RandomOrder& order) {
  EpipolarMatches m(EpipolarKind::Plane, order.size());
  m.first_shift_ = meanOf(first);
  m.second_shift_ = meanOf(second);
  const double sum = squareSum(first, m.first_shift_) + squareSum(second, m.second_shift_);
  const double length = std::sqrt(sum / (4 * static_cast<double>(order.size())));
  if (length > 0 && std::isfinite(length)) m.length_ = length;
  for (std::size_t i = 0; i < m.size_; ++i) {
    const Vec2d a = (first[order[i]] - m.first_shift_) / m.length_;
    const Vec2d b = (second[order[i]] - m.second_shift_) / m.length_;
    double* const row = m.row(i);
    row[0] = a[0], row[1] = a[1], row[2] = b[0], row[3] = b[1];
  }
  m.finish();
  return m;
}

EpipolarMatches EpipolarMatches::fromPinholes(Span<const Vec2d> first, Span<const Vec2d> second,
                                              const Camera& first_camera,
                                              const Camera& second_camera,
                                              const RandomOrder& order) {
  EpipolarMatches m(EpipolarKind::Plane, order.size());
  const std::vector<double> a = first_camera.parameters(), b = second_camera.parameters();
  m.length_ = (std::abs(a[0]) + std::abs(a[1]) + std::abs(b[0]) + std::abs(b[1])) / 4;
  m.first_shift_ = {a[2], a[3]};
  m.second_shift_ = {b[2], b[3]};
  m.first_ = {m.length_ / a[0], m.length_ / a[1], 1};
  m.second_ = {m.length_ / b[0], m.length_ / b[1], 1};
  for (std::size_t i = 0; i < m.size_; ++i) {
    const Vec2d x = (first[order[i]] - m.first_shift_) / m.length_;
    const Vec2d y = (second[order[i]] - m.second_shift_) / m.length_;
    double* const row = m.row(i);
    row[0] = x[0], row[1] = x[1], row[2] = y[0], row[3] = y[1];
  }
  m.finish();
  return m;
}

EpipolarMatches EpipolarMatches::fromBearings(Span<const Vec3d> first, Span<const Vec3d> second,
                                              const RandomOrder& order) {
  EpipolarMatches m(EpipolarKind::Sphere, order.size());
  for (std::size_t i = 0; i < m.size_; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      m.row(i)[k] = first[order[i]][k];
      m.row(i)[3 + k] = second[order[i]][k];
    }
  }
  m.finish();
  return m;
}

EpipolarMatches EpipolarMatches::fromFrames(Span<const Vec3d> first, Span<const Vec3d> second,
                                            Span<const Mat<double, 3, 2>> first_by_pixel,
                                            Span<const Mat<double, 3, 2>> second_by_pixel,
                                            const RandomOrder& order) {
  EpipolarMatches m(EpipolarKind::Frames, order.size());
  for (std::size_t i = 0; i < m.size_; ++i) {
    double* const row = m.row(i);
    const std::uint32_t from = order[i];
    for (std::size_t k = 0; k < 3; ++k) {
      row[k] = first[from][k];
      row[3 + k] = second[from][k];
      row[6 + k] = first_by_pixel[from](k, 0);
      row[9 + k] = first_by_pixel[from](k, 1);
      row[12 + k] = second_by_pixel[from](k, 0);
      row[15 + k] = second_by_pixel[from](k, 1);
    }
  }
  m.finish();
  return m;
}

EpipolarMatches EpipolarMatches::picked(const std::vector<std::uint32_t>& indices) const {
  EpipolarMatches m(kind_, indices.size());
  m.length_ = length_;
  m.first_shift_ = first_shift_, m.second_shift_ = second_shift_;
  m.first_ = first_, m.second_ = second_;
  for (std::size_t i = 0; i < m.size_; ++i) std::copy_n(row(indices[i]), width_, m.row(i));
  m.finish();
  return m;
}

void EpipolarMatches::finish() {
  columns_.resize(size_ * width_);
  for (std::size_t k = 0; k < width_; ++k) {
    column_starts_.push_back(columns_.data() + k * size_);
    for (std::size_t i = 0; i < size_; ++i) {
      columns_[k * size_ + i] = static_cast<float>(row(i)[k]);
    }
  }
  // A line through the image, as wide as the threshold on both sides, as a part of the image.
  if (kind_ == EpipolarKind::Plane) {
    Box box;
    for (std::size_t i = 0; i < size_; ++i) box.add(row(i)[2], row(i)[3]);
    chance_per_unit_ = 2 * kWidestBand * box.diagonal() / (box.area() * length_);
    return;
  }
  const Cone cone(size_, [&](std::size_t i) { return second(i); });
  const double band = cone.half_angle > 1.5 ? 6.283185307179586 : 2 * cone.half_angle;
  chance_per_unit_ = 2 * kWidestBand * band / cone.solid_angle;
  if (kind_ == EpipolarKind::Sphere) return;
  std::vector<double> per_pixel(size_);  // radians
  for (std::size_t i = 0; i < size_; ++i) {
    double sum = 0;
    for (std::size_t k = 12; k < 18; ++k) sum += row(i)[k] * row(i)[k];
    per_pixel[i] = std::sqrt(sum / 2);
  }
  if (size_ == 0) return;
  std::nth_element(per_pixel.begin(), per_pixel.begin() + static_cast<std::ptrdiff_t>(size_ / 2),
                   per_pixel.end());
  chance_per_unit_ *= per_pixel[size_ / 2];
}

double EpipolarMatches::chance(double threshold) const {
  const double chance = chance_per_unit_ * threshold;
  return chance < 1 ? chance : 1;  // NaN of an image without an area, too
}

void EpipolarMatches::squaredFloat(const double* matrix, std::size_t first, std::size_t count,
                                   float* squared) const {
  float e[9];
  for (std::size_t k = 0; k < 9; ++k) e[k] = static_cast<float>(matrix[k]);
  sampsonFunction(kind_)(e, static_cast<float>(length_ * length_), column_starts_.data(), first,
                         count, squared);
}

double EpipolarMatches::squared(const double* e, std::size_t i, std::size_t of_second) const {
  const Vec3d a = first(i), b = second(of_second);
  const Vec3d n = {e[0] * a[0] + e[1] * a[1] + e[2] * a[2], e[3] * a[0] + e[4] * a[1] + e[5] * a[2],
                   e[6] * a[0] + e[7] * a[1] + e[8] * a[2]};
  const Vec3d m = {e[0] * b[0] + e[3] * b[1] + e[6] * b[2], e[1] * b[0] + e[4] * b[1] + e[7] * b[2],
                   e[2] * b[0] + e[5] * b[1] + e[8] * b[2]};
  const double error = n.dot(b);
  double g = 1e-60;
  if (kind_ == EpipolarKind::Plane) {
    g += m[0] * m[0] + m[1] * m[1] + n[0] * n[0] + n[1] * n[1];
  } else if (kind_ == EpipolarKind::Sphere) {
    g += (m - error * a).squaredNorm() + (n - error * b).squaredNorm();
  } else {
    const double* const j1 = row(i);
    const double* const j2 = row(of_second) + 6;
    for (std::size_t k = 6; k < 12; k += 3) {
      const double p = m[0] * j1[k] + m[1] * j1[k + 1] + m[2] * j1[k + 2];
      const double q = n[0] * j2[k] + n[1] * j2[k + 1] + n[2] * j2[k + 2];
      g += p * p + q * q;
    }
  }
  return length_ * length_ * error * error / g;
}

void EpipolarMatches::squaredOfPairs(const double* matrix, std::size_t shift, std::size_t count,
                                     double* squares) const {
  for (std::size_t i = 0; i < count; ++i) squares[i] = squared(matrix, i, (i + shift) % size_);
}

std::size_t EpipolarMatches::placeOf(std::size_t i, double* place) const {
  const double* const r = row(i);
  const std::size_t count = kind_ == EpipolarKind::Plane ? 4 : 6;
  double unit = length_;
  if (kind_ == EpipolarKind::Frames) {  // pixels of a radian
    double sum = 0;
    for (std::size_t k = 6; k < 12; ++k) sum += r[k] * r[k];
    unit = std::sqrt(2 / sum);
  }
  for (std::size_t k = 0; k < count; ++k) place[k] = unit * r[k];
  return count;
}

EpipolarSums EpipolarMatches::sums(const double* matrix, const double* weights,
                                   std::size_t count) const {
  EpipolarSums sums;
  EpipolarBlock block;
  const SampsonBlockFunction add = sampsonBlockFunction(kind_);
  std::size_t filled = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(weights[i] > 0)) continue;
    const double* const from = row(i);
    for (std::size_t k = 0; k < width_; ++k) block.columns[k][filled] = from[k];
    block.weights[filled] = weights[i];
    if (++filled < kBlock) continue;
    add(matrix, block, sums);
    filled = 0;
  }
  if (filled > 0) {
    for (std::size_t j = filled; j < kBlock; ++j) {
      for (std::size_t k = 0; k < width_; ++k) block.columns[k][j] = block.columns[k][0];
      block.weights[j] = 0;
    }
    add(matrix, block, sums);
  }
  const double factor = length_ * length_;
  for (double& h : sums.hessian) h *= factor;
  for (double& g : sums.gradient) g *= factor;
  sums.cost *= factor;
  return sums;
}

Vec3d EpipolarMatches::first(std::size_t i) const {
  const double* const r = row(i);
  return {r[0], r[1], kind_ == EpipolarKind::Plane ? 1 : r[2]};
}

Vec3d EpipolarMatches::second(std::size_t i) const {
  const double* const r = row(i);
  if (kind_ == EpipolarKind::Plane) return {r[2], r[3], 1};
  return {r[3], r[4], r[5]};
}

double EpipolarMatches::transferSquared(const Mat3d& homography, const Mat3d& inverse,
                                        std::size_t i) const {
  const Vec3d a = first(i), b = second(i);
  const Vec3d to_second = homography * a, to_first = inverse * b;
  double forth, back;
  if (kind_ == EpipolarKind::Plane) {
    forth = squaredOnPlane(to_second, b[0], b[1]);
    back = squaredOnPlane(to_first, a[0], a[1]);
  } else if (kind_ == EpipolarKind::Sphere) {
    forth = squaredOnSphere(to_second, b);
    back = squaredOnSphere(to_first, a);
  } else {
    forth = squaredOnFrame(to_second, b, row(i) + 12);
    back = squaredOnFrame(to_first, a, row(i) + 6);
  }
  if (!(forth < kInfinite && back < kInfinite)) return kInfinite;
  const double sum = forth + back;
  return sum > 0 ? length_ * length_ * forth * back / sum : 0;
}

bool EpipolarMatches::transferResidual(const Mat3d& homography, std::size_t i,
                                       double* residual) const {
  const Vec3d b = second(i), c = homography * first(i);
  const double along = kind_ == EpipolarKind::Plane ? c[2] : b.dot(c);
  if (!(std::abs(along) > 0)) return false;
  const Vec3d d = c / along - b;
  residual[2] = 0;
  if (kind_ == EpipolarKind::Frames) {
    const double* const j = row(i) + 12;
    const Mat<double, 3, 2> frame = {{j[0], j[3], j[1], j[4], j[2], j[5]}};
    const Mat<double, 2, 3> across = frameOfPixel(frame);
    for (std::size_t k = 0; k < 2; ++k) residual[k] = across.row(k).dot(d);
  } else {
    for (std::size_t k = 0; k < 3; ++k) residual[k] = length_ * d[k];
  }
  return true;
}

Mat3d EpipolarMatches::linesOf(const Mat3d& matrix) const {
  Mat3d result;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) result(r, c) = second_[r] * matrix(r, c) * first_[c];
  }
  return result;
}

Mat3d EpipolarMatches::homographyOf(const Mat3d& matrix) const {
  Mat3d result;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) result(r, c) = matrix(r, c) / second_[r] * first_[c];
  }
  return result;
}

Mat3d EpipolarMatches::inverseHomographyOf(const Mat3d& matrix) const {
  Mat3d result;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) result(r, c) = matrix(r, c) / first_[r] * second_[c];
  }
  return result;
}

Vec3d EpipolarMatches::epipoleOf(const Vec3d& direction) const {
  return {direction[0] / second_[0], direction[1] / second_[1], direction[2] / second_[2]};
}

Vec3d EpipolarMatches::firstRay(const Vec3d& first) const {
  return {first[0] * first_[0], first[1] * first_[1], first[2] * first_[2]};
}

Vec3d EpipolarMatches::secondRay(const Vec3d& second) const {
  return {second[0] * second_[0], second[1] * second_[1], second[2] * second_[2]};
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
