#include "robust/plane_problem.h"

#include <algorithm>
#include <cmath>

#include "math/tangents.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

Vec3d normalOf(const ModelNumbers& model) {
  return {{model[0], model[1], model[2]}};
}

}  // namespace

PlaneProblem::PlaneProblem(Span<const Vec3d> points, const RandomOrder& order)
    : points_(points, order, false),
      length_(std::max({points_.middle.box[0], points_.middle.box[1], points_.middle.box[2]})),
      columns_{points_.columns[0].data(), points_.columns[1].data(), points_.columns[2].data()},
      kernel_(PointKernels::plane().active()) {}

std::size_t PlaneProblem::solve(const std::uint32_t* sample, ModelNumbers* models) const {
  const Vec3d& a = points_.points[sample[0]];
  const Vec3d ab = points_.points[sample[1]] - a;
  const Vec3d ac = points_.points[sample[2]] - a;
  const Vec3d cross = ab.cross(ac);
  const double squared = cross.squaredNorm();
  // Collinear to 1e-8 of their extent.
  if (!(squared > 1e-16 * ab.squaredNorm() * ac.squaredNorm()) || !(squared > 0)) return 0;
  const Vec3d n = cross / std::sqrt(squared);
  models[0] = ModelNumbers{{n[0], n[1], n[2], -n.dot(a)}};
  return 1;
}

void PlaneProblem::squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                                    float* squared) const {
  float plane[4];
  for (std::size_t i = 0; i < 4; ++i) plane[i] = static_cast<float>(model[i]);
  kernel_(plane, 1, columns_, first, count, squared);
}

void PlaneProblem::exactSquaredResiduals(const ModelNumbers& model, double* squared) const {
  const Vec3d n = normalOf(model);
  for (std::size_t i = 0; i < size(); ++i) {
    const double distance = n.dot(points_.points[i]) + model[3];
    squared[i] = distance * distance;
  }
}

void PlaneProblem::squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift,
                                           std::size_t count, double* squared) const {
  if (shift == 0) return exactSquaredResiduals(model, squared);
  // Directions on a spiral from pole to equator: each half turn of the golden angle one.
  constexpr std::size_t kSpiral = 61;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t number = (i + 7 * shift) % kSpiral;
    const double z = (static_cast<double>(number) + 0.5) / kSpiral;
    const double turn = 2.39996322972865332 * static_cast<double>(number);
    const double radius = std::sqrt(1 - z * z);
    const Vec3d n = {{radius * std::cos(turn), radius * std::sin(turn), z}};
    const double distance = n.dot(points_.points[(i + shift) % size()] - points_.points[i]);
    squared[i] = distance * distance;
  }
}

std::size_t PlaneProblem::placeOf(const ModelNumbers&, std::size_t i, double* place) const {
  std::copy(points_.points[i].values, points_.points[i].values + 3, place);
  return 3;
}

void PlaneProblem::accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                              NormalEquations& sums) const {
  const Vec3d n = normalOf(model);
  Vec3d u, v;
  tangentsOf(n, u, v);
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weights[i];
    if (!(w > 0)) continue;
    const Vec3d& x = points_.points[i];
    const double r = n.dot(x) + model[3];
    const double row[3] = {u.dot(x), v.dot(x), 1};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = k; l < 3; ++l) sums.hessian[k * kMaxDof + l] += w * row[k] * row[l];
      sums.gradient[k] += w * row[k] * r;
    }
    sums.cost += w * r * r;
  }
}

ModelNumbers PlaneProblem::retract(const ModelNumbers& model, const double* delta) const {
  const Vec3d n = normalOf(model);
  Vec3d u, v;
  tangentsOf(n, u, v);
  const Vec3d turned = n + delta[0] * u + delta[1] * v;
  const Vec3d unit = turned / std::sqrt(turned.squaredNorm());
  return ModelNumbers{{unit[0], unit[1], unit[2], model[3] + delta[2]}};
}

// A plane through a cube cuts it in an area of at most sqrt(2) of a side.
double PlaneProblem::chance(double threshold) const {
  const double slab = 2 * std::sqrt(2.0) * threshold;
  return slab < length_ ? slab / length_ : 1;
}

Examination PlaneProblem::examine(const ModelNumbers& model, const std::uint8_t* inliers,
                                  double) const {
  const Spread<3> spread = coreSpreadOf(Span<const Vec3d>(points_.points), inliers, 1);
  const Vec3d n = normalOf(model);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (inliers[i] == 0) continue;
    const double distance = n.dot(points_.points[i]) + model[3];
    sum += distance * distance;
    ++count;
  }
  Examination result;
  result.degeneracy = shapeOf(spread, 2 * std::sqrt(sum / count));
  if (result.degeneracy == Degeneracy::Planar) result.degeneracy = Degeneracy::None;
  if (result.degeneracy == Degeneracy::None) return result;
  result.is_determined = false;
  result.reason = "they lie on one line, as far as their residuals tell, which determines no plane";
  return result;
}

// d = inner d - n centre.
Vec4d PlaneProblem::planeOf(const ModelNumbers& model, Mat<double, 4, 3>* by_delta) const {
  const Vec3d n = normalOf(model);
  const Vec3d& centre = points_.centre();
  if (by_delta != nullptr) {
    Vec3d u, v;
    tangentsOf(n, u, v);
    for (std::size_t r = 0; r < 3; ++r) {
      (*by_delta)(r, 0) = u[r];
      (*by_delta)(r, 1) = v[r];
      (*by_delta)(r, 2) = 0;
    }
    (*by_delta)(3, 0) = -u.dot(centre);
    (*by_delta)(3, 1) = -v.dot(centre);
    (*by_delta)(3, 2) = 1;
  }
  return {{n[0], n[1], n[2], model[3] - n.dot(centre)}};
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
