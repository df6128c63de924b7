#include "robust/homography_problem.h"

#include <gslam/estimator/solvers/homography_4pt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The reflection that takes h, of norm 1, to a multiple of the last axis: I - factor v v^T. Its
// first eight columns are tangents of the sphere at h.
struct Reflection {
  double v[9];
  double factor;

  explicit Reflection(const double* h) {
    std::copy(h, h + 9, v);
    v[8] += std::copysign(1.0, h[8]);
    factor = 1 / (1 + std::fabs(h[8]));
  }
};

void toModel(const Mat3d& h, ModelNumbers& model) {
  model = ModelNumbers{};
  std::copy(h.data(), h.data() + 9, model.begin());
}

void toFloats(const ModelNumbers& model, float* h) {
  for (std::size_t i = 0; i < 9; ++i) h[i] = static_cast<float>(model[i]);
}

// Sums over x x^T, x = (x, y, 1) / w, each times 1, u, v, u^2 + v^2: that is J^T J.
struct PlaneSums {
  double plain[6] = {}, by_u[6] = {}, by_v[6] = {}, by_both[6] = {};
  double gradient[9] = {};
  double cost = 0;

  void add(const double* h, const Vec2d& a, const Vec2d& b, double weight) {
    const double w = h[6] * a[0] + h[7] * a[1] + h[8];
    if (!(w > 0)) return;
    const double inverse = 1 / w;
    const double u = (h[0] * a[0] + h[1] * a[1] + h[2]) * inverse;
    const double v = (h[3] * a[0] + h[4] * a[1] + h[5]) * inverse;
    const double ru = weight * (u - b[0]), rv = weight * (v - b[1]);
    const double x[3] = {a[0] * inverse, a[1] * inverse, inverse};
    const double products[6] = {x[0] * x[0], x[0] * x[1], x[0] * x[2],
                                x[1] * x[1], x[1] * x[2], x[2] * x[2]};
    const double wu = weight * u, wv = weight * v, both = wu * u + wv * v;
    for (std::size_t k = 0; k < 6; ++k) {
      plain[k] += weight * products[k];
      by_u[k] += wu * products[k];
      by_v[k] += wv * products[k];
      by_both[k] += both * products[k];
    }
    const double third = -(u * ru + v * rv);
    for (std::size_t k = 0; k < 3; ++k) {
      gradient[k] += ru * x[k];
      gradient[3 + k] += rv * x[k];
      gradient[6 + k] += third * x[k];
    }
    cost += ru * (u - b[0]) + rv * (v - b[1]);
  }

  // The upper triangle, 9 x 9.
  void toHessian(double* hessian) const {
    static constexpr std::size_t place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = place[r][c];
        hessian[r * 9 + c] = hessian[(3 + r) * 9 + 3 + c] = plain[k];
        hessian[r * 9 + 3 + c] = 0;
        hessian[r * 9 + 6 + c] = -by_u[k];
        hessian[(3 + r) * 9 + 6 + c] = -by_v[k];
        hessian[(6 + r) * 9 + 6 + c] = by_both[k];
      }
    }
  }
};

// The rotation of a bearing to the third axis.
Mat3d rotationToAxis(const Vec3d& bearing) {
  const double x = bearing[0], y = bearing[1], z = bearing[2];
  if (z < -0.5) {  // by way of the opposite axis, and a half turn about the first one
    const Mat3d other = rotationToAxis({x, -y, -z});
    Mat3d result = other;
    for (std::size_t r = 0; r < 3; ++r) {
      result(r, 1) = -other(r, 1);
      result(r, 2) = -other(r, 2);
    }
    return result;
  }
  const double c = 1 / (1 + z);
  return {{1 - c * x * x, -c * x * y, -x, -c * x * y, 1 - c * y * y, -y, x, y, z}};
}

// Four bearings as points of the plane before their mean direction; false where one is beside it.
bool toPlane(const Vec3d* bearings, Mat3d& rotation, Vec2d* points) {
  const Vec3d sum = bearings[0] + bearings[1] + bearings[2] + bearings[3];
  const double norm = sum.norm();
  if (!(norm > 1e-3)) return false;
  rotation = rotationToAxis(sum / norm);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d p = rotation * bearings[i];
    if (!(p[2] > 1e-3)) return false;
    points[i] = {p[0] / p[2], p[1] / p[2]};
  }
  return true;
}

}  // namespace

Mat<double, 9, 8> sphereTangents(const double* h) {
  const Reflection reflection(h);
  Mat<double, 9, 8> tangents{};
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t c = 0; c < 8; ++c) {
      tangents(r, c) = (r == c ? 1 : 0) - reflection.factor * reflection.v[r] * reflection.v[c];
    }
  }
  return tangents;
}

ModelNumbers HomographyProblem::retract(const ModelNumbers& model, const double* delta) const {
  const Reflection reflection(model.data());
  double dot = 0;
  for (std::size_t i = 0; i < 8; ++i) dot += reflection.v[i] * delta[i];
  ModelNumbers moved = model;
  double squared = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    moved[i] += (i < 8 ? delta[i] : 0) - reflection.factor * dot * reflection.v[i];
    squared += moved[i] * moved[i];
  }
  const double scale = 1 / std::sqrt(squared);
  for (std::size_t i = 0; i < 9; ++i) moved[i] *= scale;
  return moved;
}

void HomographyProblem::project(const ModelNumbers& model, const double* hessian,
                                const double* gradient, NormalEquations& sums) {
  const Reflection p(model.data());
  double product[9];  // of the Hessian with v
  double square = 0, along = 0;
  for (std::size_t r = 0; r < 9; ++r) {
    product[r] = 0;
    for (std::size_t c = 0; c < 9; ++c) {
      product[r] += (c < r ? hessian[c * 9 + r] : hessian[r * 9 + c]) * p.v[c];
    }
    square += product[r] * p.v[r];
    along += gradient[r] * p.v[r];
  }
  for (std::size_t r = 0; r < 8; ++r) {
    for (std::size_t c = r; c < 8; ++c) {
      sums.hessian[r * kMaxDof + c] += hessian[r * 9 + c] -
                                       p.factor * (p.v[r] * product[c] + product[r] * p.v[c]) +
                                       p.factor * p.factor * square * p.v[r] * p.v[c];
    }
    sums.gradient[r] += gradient[r] - p.factor * along * p.v[r];
  }
}

PlaneHomographyProblem::PlaneHomographyProblem(Span<const Vec2d> first, Span<const Vec2d> second,
                                               const RandomOrder& order)
    : first_(first, order, true),
      second_(second, order, true),
      scale1_(first_.factor),
      scale2_(second_.factor),
      columns_{first_.columns[0].data(), first_.columns[1].data(), second_.columns[0].data(),
               second_.columns[1].data()},
      kernel_(PointKernels::homography().active()) {}

std::size_t PlaneHomographyProblem::solve(const std::uint32_t* sample, ModelNumbers* models) const {
  Vec2d a[4], b[4];
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = first_.points[sample[i]];
    b[i] = second_.points[sample[i]];
  }
  Mat3d h;
  if (homography4pt({a, 4}, {b, 4}, h) == 0) return 0;
  toModel(h, models[0]);
  return 1;
}

void PlaneHomographyProblem::squaredResiduals(const ModelNumbers& model, std::size_t first,
                                              std::size_t count, float* squared) const {
  float h[9];
  toFloats(model, h);
  kernel_(h, static_cast<float>(1 / (scale2_ * scale2_)), columns_, first, count, squared);
}

void PlaneHomographyProblem::exactSquaredResiduals(const ModelNumbers& model,
                                                   double* squared) const {
  squaredResidualsOfPairs(model, 0, size(), squared);
}

void PlaneHomographyProblem::squaredResidualsOfPairs(const ModelNumbers& h, std::size_t shift,
                                                     std::size_t count, double* squared) const {
  const double factor = 1 / (scale2_ * scale2_);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2d& a = first_.points[i];
    const Vec2d& b = second_.points[(i + shift) % size()];
    const double w = h[6] * a[0] + h[7] * a[1] + h[8];
    const double du = (h[0] * a[0] + h[1] * a[1] + h[2]) / w - b[0];
    const double dv = (h[3] * a[0] + h[4] * a[1] + h[5]) / w - b[1];
    squared[i] = w > 0 ? factor * (du * du + dv * dv) : kInfinity;
  }
}

std::size_t PlaneHomographyProblem::placeOf(const ModelNumbers&, std::size_t i,
                                            double* place) const {
  for (std::size_t k = 0; k < 2; ++k) {
    // The first points as if they were spread like the second ones.
    place[k] = first_.points[i][k] / scale2_;
    place[2 + k] = second_.points[i][k] / scale2_;
  }
  return 4;
}

void PlaneHomographyProblem::accumulate(const ModelNumbers& model, const double* weights,
                                        std::size_t count, NormalEquations& sums) const {
  PlaneSums plane;
  const double factor = 1 / (scale2_ * scale2_);
  for (std::size_t i = 0; i < count; ++i) {
    if (weights[i] > 0) {
      plane.add(model.data(), first_.points[i], second_.points[i], factor * weights[i]);
    }
  }
  double hessian[81];
  plane.toHessian(hessian);
  project(model, hessian, plane.gradient, sums);
  sums.cost += plane.cost;
}

double PlaneHomographyProblem::chance(double threshold) const {
  return chanceInBox(second_.middle.box, threshold);
}

Examination PlaneHomographyProblem::examine(const ModelNumbers& model, const std::uint8_t* inliers,
                                            double) const {
  const Spread<2> a = coreSpreadOf(Span<const Vec2d>(first_.points), inliers, 1);
  const Spread<2> b = coreSpreadOf(Span<const Vec2d>(second_.points), inliers, 1);
  std::vector<double> squared(size());
  exactSquaredResiduals(model, squared.data());
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (inliers[i] == 0) continue;
    sum += squared[i];
    ++count;
  }
  const double noise = 2 * scale2_ * std::sqrt(sum / count);  // in units of the second points
  Examination result;
  result.degeneracy = shapeOf(b, noise);
  if (result.degeneracy == Degeneracy::None) {
    result.degeneracy = shapeOf(a, noise * a.deviations[0] / b.deviations[0]);
  }
  if (result.degeneracy == Degeneracy::None) return result;
  result.is_determined = false;
  result.reason =
      "they lie on one line, as far as their residuals tell, which determines no "
      "homography";
  return result;
}

// H = C2 h C1 with C1 x = scale1 (x - centre1), C2 y = y / scale2 + centre2, made of norm 1.
Mat3d PlaneHomographyProblem::matrixOf(const ModelNumbers& model,
                                       Mat<double, 9, 8>* by_delta) const {
  const Vec2d& c1 = first_.centre();
  const Vec2d& c2 = second_.centre();
  const Mat3d in = {{scale1_, 0, -scale1_ * c1[0], 0, scale1_, -scale1_ * c1[1], 0, 0, 1}};
  const Mat3d out = {{1 / scale2_, 0, c2[0], 0, 1 / scale2_, c2[1], 0, 0, 1}};
  Mat3d inner;
  std::copy(model.begin(), model.begin() + 9, inner.values);
  Mat3d h = out * inner * in;
  double squared = 0;
  for (const double value : h.values) squared += value * value;
  const double scale = 1 / std::sqrt(squared);
  h *= scale;
  if (by_delta == nullptr) return h;
  const Mat<double, 9, 8> tangents = sphereTangents(model.data());
  for (std::size_t c = 0; c < 8; ++c) {
    for (std::size_t i = 0; i < 9; ++i) inner.values[i] = tangents(i, c);
    const Mat3d moved = scale * (out * inner * in);
    double along = 0;  // what the norm takes away
    for (std::size_t i = 0; i < 9; ++i) along += moved.values[i] * h.values[i];
    for (std::size_t i = 0; i < 9; ++i) {
      (*by_delta)(i, c) = moved.values[i] - along * h.values[i];
    }
  }
  return h;
}

BearingHomographyProblem::BearingHomographyProblem(std::vector<Match> matches, const Vec2d& image)
    : matches_(std::move(matches)),
      image_(image),
      numbers_(12 * matches_.size()),
      kernel_(PointKernels::bearingHomography().active()) {
  const std::size_t n = matches_.size();
  for (std::size_t k = 0; k < 12; ++k) columns_[k] = numbers_.data() + k * n;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      numbers_[k * n + i] = static_cast<float>(matches_[i].first[k]);
      numbers_[(3 + k) * n + i] = static_cast<float>(matches_[i].second[k]);
    }
    for (std::size_t k = 0; k < 6; ++k) {
      numbers_[(6 + k) * n + i] = static_cast<float>(matches_[i].by_point.values[k]);
    }
  }
}

std::size_t BearingHomographyProblem::solve(const std::uint32_t* sample,
                                            ModelNumbers* models) const {
  Vec3d a[4], b[4];
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = matches_[sample[i]].first;
    b[i] = matches_[sample[i]].second;
  }
  Vec2d on_a[4], on_b[4];
  Mat3d to_a, to_b, h;
  if (!toPlane(a, to_a, on_a) || !toPlane(b, to_b, on_b)) return 0;
  if (homography4pt({on_a, 4}, {on_b, 4}, h) == 0) return 0;
  toModel(to_b.transpose() * h * to_a, models[0]);
  return 1;
}

void BearingHomographyProblem::squaredResiduals(const ModelNumbers& model, std::size_t first,
                                                std::size_t count, float* squared) const {
  float h[9];
  toFloats(model, h);
  kernel_(h, 1, columns_, first, count, squared);
}

void BearingHomographyProblem::exactSquaredResiduals(const ModelNumbers& model,
                                                     double* squared) const {
  squaredResidualsOfPairs(model, 0, size(), squared);
}

void BearingHomographyProblem::squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift,
                                                       std::size_t count, double* squared) const {
  Mat3d h;
  std::copy(model.begin(), model.begin() + 9, h.values);
  for (std::size_t i = 0; i < count; ++i) {
    const Match& match = matches_[(i + shift) % size()];
    const Vec3d y = h * matches_[i].first;
    const double depth = match.second.dot(y);
    squared[i] = depth > 0 ? (match.by_point * (y / depth)).squaredNorm() : kInfinity;
  }
}

std::size_t BearingHomographyProblem::placeOf(const ModelNumbers&, std::size_t i,
                                              double* place) const {
  const Match& match = matches_[i];
  double sum = 0;
  for (const double value : match.by_point.values) sum += value * value;
  const double unit = std::sqrt(sum / 2);  // pixels of a radian
  for (std::size_t k = 0; k < 3; ++k) {
    place[k] = unit * match.first[k];
    place[3 + k] = unit * match.second[k];
  }
  return 6;
}

void BearingHomographyProblem::accumulate(const ModelNumbers& model, const double* weights,
                                          std::size_t count, NormalEquations& sums) const {
  Mat3d h;
  std::copy(model.begin(), model.begin() + 9, h.values);
  double hessian[81] = {}, gradient[9] = {};
  for (std::size_t i = 0; i < count; ++i) {
    if (!(weights[i] > 0)) continue;
    const Match& match = matches_[i];
    const Vec3d y = h * match.first;
    const double depth = match.second.dot(y);
    if (!(depth > 0)) continue;
    const Vec2d e = match.by_point * (y / depth);
    const Mat<double, 2, 3> by_y = (match.by_point - outer(e, match.second)) * (1 / depth);
    const Mat3d inner = by_y.transpose() * by_y;
    const Vec3d pull = by_y.transpose() * e;
    const Vec3d& x = match.first;
    const double w = weights[i];
    for (std::size_t r = 0; r < 9; ++r) {
      gradient[r] += w * pull[r / 3] * x[r % 3];
      const double left = w * x[r % 3];
      for (std::size_t c = r; c < 9; ++c) {
        hessian[r * 9 + c] += left * inner(r / 3, c / 3) * x[c % 3];
      }
    }
    sums.cost += w * e.squaredNorm();
  }
  project(model, hessian, gradient, sums);
}

double BearingHomographyProblem::chance(double threshold) const {
  return chanceInBox(image_, threshold);
}

namespace {

// Bearings on one plane through the camera are points on one line. Two may be beside it.
Degeneracy shapeOfBearings(const std::vector<Vec3d>& bearings, double noise) {
  const std::vector<std::uint8_t> all(bearings.size(), 1);
  const Spread<3> about_mean = spreadOf(Span<const Vec3d>(bearings), all.data());
  if (!(about_mean.deviations[0] > std::max(noise, 1e-7))) return Degeneracy::Coincident;
  // With the opposite bearings, too, their mean is the camera.
  std::vector<Vec3d> both = bearings;
  for (const Vec3d& bearing : bearings) both.push_back(-bearing);
  const std::vector<std::uint8_t> all_of_both(both.size(), 1);
  const Spread<3> spread = coreSpreadOf(Span<const Vec3d>(both), all_of_both.data(), 2);
  return spread.deviations[2] > std::max(noise, 1e-7) ? Degeneracy::None : Degeneracy::Collinear;
}

}  // namespace

Examination BearingHomographyProblem::examine(const ModelNumbers& model,
                                              const std::uint8_t* inliers, double) const {
  std::vector<double> squared(size());
  exactSquaredResiduals(model, squared.data());
  std::vector<Vec3d> first, second;
  double sum = 0, scales = 0;  // squared pixels; squared pixels of a radian
  for (std::size_t i = 0; i < size(); ++i) {
    if (inliers[i] == 0) continue;
    first.push_back(matches_[i].first);
    second.push_back(matches_[i].second);
    sum += squared[i];
    for (const double value : matches_[i].by_point.values) scales += value * value / 2;
  }
  const double noise = 2 * std::sqrt(sum / scales);  // radians
  Examination result;
  result.degeneracy = shapeOfBearings(first, noise);
  if (result.degeneracy == Degeneracy::None) result.degeneracy = shapeOfBearings(second, noise);
  if (result.degeneracy == Degeneracy::None) return result;
  result.is_determined = false;
  result.reason =
      "they lie on one line, as far as their residuals tell, which determines no "
      "homography";
  return result;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
