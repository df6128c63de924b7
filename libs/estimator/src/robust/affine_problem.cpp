#include "robust/affine_problem.h"

#include <gslam/estimator/solvers/affine_2d.h>
#include <gslam/estimator/solvers/affine_3d.h>
#include <gslam/estimator/solvers/rigid_3d.h>
#include <gslam/estimator/solvers/similarity_3d.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

PointKernels::Squared kernelOf(std::size_t n) {
  return (n == 2 ? PointKernels::affine2D() : PointKernels::affine3D()).active();
}

// A x1 + t - x2.
template <std::size_t N>
Vec<double, N> residualOf(const double* a, const Vec<double, N>& x1, const Vec<double, N>& x2) {
  Vec<double, N> r;
  for (std::size_t i = 0; i < N; ++i) {
    r[i] = a[i * (N + 1) + N] - x2[i];
    for (std::size_t k = 0; k < N; ++k) r[i] += a[i * (N + 1) + k] * x1[k];
  }
  return r;
}

std::size_t solveAffine(const Vec2d* first, const Vec2d* second, Mat<double, 2, 3>& a) {
  return affine2D({first, 3}, {second, 3}, a);
}

std::size_t solveAffine(const Vec3d* first, const Vec3d* second, Mat<double, 3, 4>& a) {
  return affine3D({first, 4}, {second, 4}, a);
}

ModelNumbers modelOf(const SIM3d& s) {
  ModelNumbers model{};
  const Mat3d r = s.scale() * s.rotation().matrix();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) model[i * 4 + k] = r(i, k);
    model[i * 4 + 3] = s.translation()[i];
  }
  std::copy(s.rotation().data(), s.rotation().data() + 4, model.begin() + 12);
  return model;
}

SIM3d innerSimilarityOf(const ModelNumbers& model, bool is_rigid) {
  const SO3d rotation = SO3d::fromQuaternion(model[12], model[13], model[14], model[15]);
  const double scale = is_rigid ? 1 : Vec3d{{model[0], model[4], model[8]}}.norm();
  return SIM3d(rotation, {{model[3], model[7], model[11]}}, scale);
}

}  // namespace

template <std::size_t N>
MapProblem<N>::MapProblem(Span<const Point> first, Span<const Point> second,
                          const RandomOrder& order)
    : first_(first, order, false), second_(second, order, false), kernel_(kernelOf(N)) {
  for (std::size_t k = 0; k < N; ++k) {
    columns_[k] = first_.columns[k].data();
    columns_[N + k] = second_.columns[k].data();
  }
}

template <std::size_t N>
void MapProblem<N>::squaredResiduals(const ModelNumbers& model, std::size_t first,
                                     std::size_t count, float* squared) const {
  float a[kElements];
  for (std::size_t i = 0; i < kElements; ++i) a[i] = static_cast<float>(model[i]);
  kernel_(a, 1, columns_, first, count, squared);
}

template <std::size_t N>
void MapProblem<N>::exactSquaredResiduals(const ModelNumbers& model, double* squared) const {
  squaredResidualsOfPairs(model, 0, size(), squared);
}

template <std::size_t N>
void MapProblem<N>::squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift,
                                            std::size_t count, double* squared) const {
  for (std::size_t i = 0; i < count; ++i) {
    const Point& second = second_.points[(i + shift) % size()];
    squared[i] = residualOf<N>(model.data(), first_.points[i], second).squaredNorm();
  }
}

// The first points as large as the model makes them.
template <std::size_t N>
std::size_t MapProblem<N>::placeOf(const ModelNumbers& model, std::size_t i, double* place) const {
  const Point zero{};
  const Point first = residualOf<N>(model.data(), first_.points[i], zero);
  for (std::size_t k = 0; k < N; ++k) {
    place[k] = first[k];
    place[N + k] = second_.points[i][k];
  }
  return 2 * N;
}

template <std::size_t N>
double MapProblem<N>::chance(double threshold) const {
  return chanceInBox(second_.middle.box, threshold);
}

template <std::size_t N>
Examination MapProblem<N>::examine(const ModelNumbers& model, const std::uint8_t* inliers,
                                   double) const {
  const std::size_t flat = isTooFlat(Degeneracy::Planar) ? N - 1 : 1;
  const Spread<N> a = coreSpreadOf(Span<const Point>(first_.points), inliers, flat);
  const Spread<N> b = spreadOf(Span<const Point>(second_.points), inliers);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (inliers[i] == 0) continue;
    sum += residualOf<N>(model.data(), first_.points[i], second_.points[i]).squaredNorm();
    ++count;
  }
  // The residuals are in the unit of the second points; the first ones are as noisy as they are
  // large compared with these.
  const double noise = 2 * std::sqrt(sum / count);
  Examination result;
  const double first_noise =
      b.deviations[0] > 0 ? std::min(1.0, noise / b.deviations[0]) * a.deviations[0] : 0;
  result.degeneracy = shapeOf(a, first_noise);
  if (!isTooFlat(result.degeneracy)) return result;
  result.is_determined = false;
  result.reason =
      "the first points of these lie too close together, on a line or on a plane to "
      "determine the map";
  return result;
}

template <std::size_t N>
typename MapProblem<N>::Matrix MapProblem<N>::matrixOf(const ModelNumbers& model) const {
  Matrix a;
  std::copy(model.begin(), model.begin() + kElements, a.values);
  for (std::size_t i = 0; i < N; ++i) {
    a(i, N) += second_.centre()[i];
    for (std::size_t k = 0; k < N; ++k) a(i, N) -= a(i, k) * first_.centre()[k];
  }
  return a;
}

template <std::size_t N>
typename MapProblem<N>::Sums MapProblem<N>::sumUp(const ModelNumbers& model, const double* weights,
                                                  std::size_t count) const {
  Sums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weights[i];
    if (!(w > 0)) continue;
    const Point r = residualOf<N>(model.data(), first_.points[i], second_.points[i]);
    double x[N + 1];
    std::copy(first_.points[i].values, first_.points[i].values + N, x);
    x[N] = 1;
    for (std::size_t k = 0; k <= N; ++k) {
      for (std::size_t l = 0; l <= N; ++l) sums.block[k][l] += w * x[k] * x[l];
      for (std::size_t row = 0; row < N; ++row) {
        sums.gradient[row * (N + 1) + k] += w * r[row] * x[k];
      }
    }
    sums.cost += w * r.squaredNorm();
  }
  return sums;
}

template <std::size_t N>
void MapProblem<N>::gather(const std::uint32_t* sample, Point* first, Point* second) const {
  for (std::size_t i = 0; i < sampleSize(); ++i) {
    first[i] = first_.points[sample[i]];
    second[i] = second_.points[sample[i]];
  }
}

template <std::size_t N>
std::size_t AffineProblem<N>::solve(const std::uint32_t* sample, ModelNumbers* models) const {
  Vec<double, N> first[N + 1], second[N + 1];
  this->gather(sample, first, second);
  Mat<double, N, N + 1> a;
  if (solveAffine(first, second, a) == 0) return 0;
  models[0] = ModelNumbers{};
  std::copy(a.data(), a.data() + N * (N + 1), models[0].begin());
  return 1;
}

template <std::size_t N>
void AffineProblem<N>::accumulate(const ModelNumbers& model, const double* weights,
                                  std::size_t count, NormalEquations& sums) const {
  const typename MapProblem<N>::Sums map = this->sumUp(model, weights, count);
  for (std::size_t row = 0; row < N; ++row) {
    for (std::size_t k = 0; k <= N; ++k) {
      const std::size_t r = row * (N + 1) + k;
      sums.gradient[r] += map.gradient[r];
      for (std::size_t l = k; l <= N; ++l) {
        sums.hessian[r * kMaxDof + row * (N + 1) + l] += map.block[k][l];
      }
    }
  }
  sums.cost += map.cost;
}

template <std::size_t N>
ModelNumbers AffineProblem<N>::retract(const ModelNumbers& model, const double* delta) const {
  ModelNumbers moved = model;
  for (std::size_t i = 0; i < N * (N + 1); ++i) moved[i] += delta[i];
  return moved;
}

std::size_t SimilarityProblem::solve(const std::uint32_t* sample, ModelNumbers* models) const {
  Vec3d first[3], second[3];
  gather(sample, first, second);
  SIM3d s;
  if (is_rigid_) {
    SE3d t;
    if (rigid3D({first, 3}, {second, 3}, t) == 0) return 0;
    s = SIM3d(t);
  } else if (similarity3D({first, 3}, {second, 3}, s) == 0) {
    return 0;
  }
  models[0] = modelOf(s);
  return 1;
}

// By the chain rule through the elements of A: S exp(v, w, l) has A (I + [w] + l) and t + A v.
void SimilarityProblem::accumulate(const ModelNumbers& model, const double* weights,
                                   std::size_t count, NormalEquations& sums) const {
  const Sums map = sumUp(model, weights, count);
  double jacobian[7][12] = {};  // of the elements, by delta
  for (std::size_t row = 0; row < 3; ++row) {
    const double* a = &model[row * 4];
    const std::size_t at = row * 4;
    for (std::size_t k = 0; k < 3; ++k) {
      jacobian[k][at + 3] = a[k];
      jacobian[6][at + k] = a[k];
    }
    jacobian[3][at + 1] = a[2], jacobian[3][at + 2] = -a[1];
    jacobian[4][at + 2] = a[0], jacobian[4][at + 0] = -a[2];
    jacobian[5][at + 0] = a[1], jacobian[5][at + 1] = -a[0];
  }
  for (std::size_t r = 0; r < dof(); ++r) {
    double product[12] = {};  // the Hessian by the elements, times row r
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = 0; l < 4; ++l) {
          product[row * 4 + k] += map.block[k][l] * jacobian[r][row * 4 + l];
        }
      }
    }
    for (std::size_t k = 0; k < 12; ++k) sums.gradient[r] += map.gradient[k] * jacobian[r][k];
    for (std::size_t c = r; c < dof(); ++c) {
      for (std::size_t k = 0; k < 12; ++k) {
        sums.hessian[r * kMaxDof + c] += product[k] * jacobian[c][k];
      }
    }
  }
  sums.cost += map.cost;
}

ModelNumbers SimilarityProblem::retract(const ModelNumbers& model, const double* delta) const {
  Vec<double, 7> tangent{};
  for (std::size_t i = 0; i < dof(); ++i) tangent[i] = delta[i];
  // Far beyond what makes sense, and where exp() might refuse.
  for (std::size_t i = 3; i < 7; ++i) tangent[i] = std::min(std::max(tangent[i], -10.0), 10.0);
  return modelOf(innerSimilarityOf(model, is_rigid_) * SIM3d::exp(tangent));
}

// S = T(centre2) inner T(-centre1).
SIM3d SimilarityProblem::similarityOf(const ModelNumbers& model) const {
  const SIM3d inner = innerSimilarityOf(model, is_rigid_);
  const Vec3d turned = inner.scale() * (inner.rotation() * firstCentre());
  return SIM3d(inner.rotation(), inner.translation() + secondCentre() - turned, inner.scale());
}

template class MapProblem<2>;
template class MapProblem<3>;
template class AffineProblem<2>;
template class AffineProblem<3>;

}  // namespace detail
}  // namespace v1
}  // namespace gslam
