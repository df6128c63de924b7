#include "robust/fundamental_problem.h"

#include <gslam/estimator/solvers/fundamental_7pt.h>
#include <gslam/geometry/so3.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/examination.h"
#include "robust/plane_parallax.h"
#include "robust/project_sums.h"
#include "robust/random_bits.h"
#include "robust/refiner.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr std::size_t kMostPairs = 500;
constexpr std::size_t kMostOffPlane = 200;  // matches that models of pairs are compared with
constexpr std::size_t kKept = 4;            // models of pairs that the loop is shown
// Of the elements of F of norm 1, in coordinates of about 1.
constexpr double kLargestSigma = 0.1;

double cofactors(const double* f, double* c) {
  c[0] = f[4] * f[8] - f[5] * f[7], c[1] = f[5] * f[6] - f[3] * f[8];
  c[2] = f[3] * f[7] - f[4] * f[6], c[3] = f[2] * f[7] - f[1] * f[8];
  c[4] = f[0] * f[8] - f[2] * f[6], c[5] = f[1] * f[6] - f[0] * f[7];
  c[6] = f[1] * f[5] - f[2] * f[4], c[7] = f[2] * f[3] - f[0] * f[5];
  c[8] = f[0] * f[4] - f[1] * f[3];
  return f[0] * c[0] + f[1] * c[1] + f[2] * c[2];
}

double squareOf(const double* f) {
  double sum = 0;
  for (std::size_t k = 0; k < 9; ++k) sum += f[k] * f[k];
  return sum;
}

// x - 2 u (u x), where u takes the vector `v` to the axis.
struct Householder {
  double u[9];
  Householder(const double* v, std::size_t axis) {
    double norm = 0;
    for (std::size_t k = 0; k < 9; ++k) u[k] = k < axis ? 0 : v[k], norm += u[k] * u[k];
    norm = std::sqrt(norm);
    u[axis] += std::copysign(norm, u[axis]);
    const double length = std::sqrt(squareOf(u));
    for (double& x : u) x = length > 0 ? x / length : 0;
  }
  void apply(double* x) const {
    double dot = 0;
    for (std::size_t k = 0; k < 9; ++k) dot += u[k] * x[k];
    for (std::size_t k = 0; k < 9; ++k) x[k] -= 2 * dot * u[k];
  }
};

Mat3d matrixOf(const double* numbers) {
  Mat3d m;
  std::copy(numbers, numbers + 9, m.values);
  return m;
}

bool setModel(const Mat3d& f, ModelNumbers& model) {
  model.fill(0);
  std::copy(f.values, f.values + 9, model.begin());
  return toRankTwo(model.data());
}

// F = [e']x H for every H of this family.
HomographyFamily familyOf(const double* f) {
  double c[9];
  cofactors(f, c);
  Vec3d epipole{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d column = {c[k], c[3 + k], c[6 + k]};
    if (column.squaredNorm() > epipole.squaredNorm()) epipole = column;
  }
  const double norm = epipole.norm();
  if (norm > 0) epipole /= norm;
  return {-(SO3d::hat(epipole) * matrixOf(f)), epipole};
}

// Whether five of the seven lie on one plane: each five have three in one of these sets.
bool isSampleOnPlane(const EpipolarMatches& matches, const HomographyFamily& family,
                     const std::uint32_t* sample, double largest) {
  static constexpr std::uint8_t kSets[5][3] = {
      {0, 1, 2}, {3, 4, 5}, {0, 1, 6}, {3, 4, 6}, {2, 5, 6}};
  for (const auto& set : kSets) {
    const std::uint32_t three[3] = {sample[set[0]], sample[set[1]], sample[set[2]]};
    const PlaneFit fit = planeOf(matches, family, three);
    if (!fit.is_found) continue;
    std::size_t on_plane = 0;
    for (std::size_t k = 0; k < 7; ++k) {
      on_plane += matches.transferSquared(fit.homography, fit.inverse, sample[k]) <= largest;
    }
    if (on_plane >= 5) return true;
  }
  return false;
}

}  // namespace

bool toRankTwo(double* f) {
  for (int step = 0; step < 5; ++step) {
    const double norm = std::sqrt(squareOf(f));
    if (!(norm > 0) || !std::isfinite(norm)) return false;
    for (std::size_t k = 0; k < 9; ++k) f[k] /= norm;
    double c[9];
    const double determinant = cofactors(f, c);
    const double square = squareOf(c);
    if (std::abs(determinant) < 1e-17 || !(square > 0)) break;
    for (std::size_t k = 0; k < 9; ++k) f[k] -= determinant / square * c[k];
  }
  return true;
}

Mat<double, 9, 7> rankTwoTangents(const double* f) {
  double c[9];
  cofactors(f, c);
  const Householder first(f, 0);
  first.apply(c);
  const Householder second(c, 1);
  Mat<double, 9, 7> tangents;
  for (std::size_t k = 0; k < 7; ++k) {
    double column[9] = {};
    column[k + 2] = 1;
    second.apply(column);
    first.apply(column);
    for (std::size_t r = 0; r < 9; ++r) tangents(r, k) = column[r];
  }
  return tangents;
}

std::size_t FundamentalProblem::solve(const std::uint32_t* sample, ModelNumbers* models) const {
  Vec2d first[7], second[7];
  for (std::size_t k = 0; k < 7; ++k) {
    const Vec3d a = matches_.first(sample[k]), b = matches_.second(sample[k]);
    first[k] = {a[0], a[1]};
    second[k] = {b[0], b[1]};
  }
  std::array<Mat3d, 3> solutions;
  const std::size_t found =
      fundamental7pt(Span<const Vec2d>(first, 7), Span<const Vec2d>(second, 7), solutions);
  std::size_t count = 0;
  for (std::size_t k = 0; k < found; ++k) count += setModel(solutions[k], models[count]);
  return count;
}

void FundamentalProblem::squaredResiduals(const ModelNumbers& model, std::size_t first,
                                          std::size_t count, float* squared) const {
  matches_.squaredFloat(model.data(), first, count, squared);
}

void FundamentalProblem::exactSquaredResiduals(const ModelNumbers& model, double* squared) const {
  for (std::size_t i = 0; i < size(); ++i) squared[i] = matches_.squared(model.data(), i);
}

void FundamentalProblem::squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift,
                                                 std::size_t count, double* squared) const {
  matches_.squaredOfPairs(model.data(), shift, count, squared);
}

std::size_t FundamentalProblem::placeOf(const ModelNumbers&, std::size_t i, double* place) const {
  return matches_.placeOf(i, place);
}

void FundamentalProblem::accumulate(const ModelNumbers& model, const double* weights,
                                    std::size_t count, NormalEquations& sums) const {
  const EpipolarSums all = matches_.sums(model.data(), weights, count);
  projectSums(all, rankTwoTangents(model.data()), sums);
}

ModelNumbers FundamentalProblem::retract(const ModelNumbers& model, const double* delta) const {
  const Mat<double, 9, 7> tangents = rankTwoTangents(model.data());
  ModelNumbers moved = model;
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t k = 0; k < 7; ++k) moved[r] += tangents(r, k) * delta[k];
  }
  toRankTwo(moved.data());
  return moved;
}

Mat3d FundamentalProblem::pixelMatrix(const ModelNumbers& model,
                                      Mat<double, 9, 7>* by_delta) const {
  const double scale = 1 / matches_.length();
  const Vec2d& a = matches_.firstShift();
  const Vec2d& b = matches_.secondShift();
  const Mat3d first = {{scale, 0, -scale * a[0], 0, scale, -scale * a[1], 0, 0, 1}};
  const Mat3d second = {{scale, 0, -scale * b[0], 0, scale, -scale * b[1], 0, 0, 1}};
  Mat3d f = second.transpose() * matrixOf(model.data()) * first;
  const double norm = std::sqrt(squareOf(f.values));
  if (norm > 0) f *= 1 / norm;
  if (by_delta == nullptr) return f;
  const Mat<double, 9, 7> tangents = rankTwoTangents(model.data());
  for (std::size_t k = 0; k < 7; ++k) {
    double column[9];
    for (std::size_t r = 0; r < 9; ++r) column[r] = tangents(r, k) / norm;
    const Mat3d moved = second.transpose() * matrixOf(column) * first;
    double along = 0;
    for (std::size_t r = 0; r < 9; ++r) along += f.values[r] * moved.values[r];
    for (std::size_t r = 0; r < 9; ++r) (*by_delta)(r, k) = moved.values[r] - along * f.values[r];
  }
  return f;
}

// The epipole lies on the line of every match that is off the plane, through both of its points
// there: two lines give it (plane and parallax).
std::size_t FundamentalProblem::parallaxModels(const Mat3d& homography, const Mat3d& inverse,
                                               double threshold, std::size_t most,
                                               ModelNumbers* models) const {
  const double largest = threshold * threshold;
  std::vector<std::uint32_t> rest;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!(matches_.transferSquared(homography, inverse, i) <= kPlaneTolerance * largest)) {
      rest.push_back(static_cast<std::uint32_t>(i));
    }
  }
  if (rest.size() < 3) return 0;
  // The robust loop's order is a random one, so the first stand for all.
  if (rest.size() > kMostOffPlane) rest.resize(kMostOffPlane);
  const auto count = static_cast<std::uint32_t>(rest.size());
  const EpipolarMatches off_plane = matches_.picked(rest);
  std::vector<float> squares(count);
  RandomBits bits(count, 0x7061697273);
  std::vector<double> costs;  // of the models kept, sorted
  double needed = kMostPairs;
  for (std::size_t pair = 0; static_cast<double>(pair) < needed; ++pair) {
    Vec3d lines[2];
    for (Vec3d& line : lines) {
      const std::uint32_t i = bits.below(count);
      line = off_plane.second(i).cross(homography * off_plane.first(i));
    }
    ModelNumbers model;
    if (!setModel(SO3d::hat(lines[0].cross(lines[1])) * homography, model)) continue;
    off_plane.squaredFloat(model.data(), 0, count, squares.data());
    double cost = 0;
    std::size_t agreeing = 0;
    for (const float square : squares) {
      const auto squared = static_cast<double>(square);
      agreeing += squared <= largest;
      cost += std::min(squared, largest);
    }
    const auto place = static_cast<std::size_t>(std::upper_bound(costs.begin(), costs.end(), cost) -
                                                costs.begin());
    if (place >= most) continue;
    costs.insert(costs.begin() + static_cast<std::ptrdiff_t>(place), cost);
    if (costs.size() > most) costs.pop_back();
    for (std::size_t k = costs.size() - 1; k > place; --k) models[k] = models[k - 1];
    models[place] = model;
    if (place == 0) {
      const double part = static_cast<double>(agreeing) / count;
      needed = std::min(needed, 10 + std::log(1e-3) / std::log1p(-std::min(part * part, 0.999)));
    }
  }
  return costs.size();
}

std::size_t FundamentalProblem::propose(const ModelNumbers& model, const std::uint32_t* sample,
                                        const std::uint8_t* inliers, double threshold,
                                        ModelNumbers* models) const {
  const double largest = kPlaneTolerance * threshold * threshold;
  const HomographyFamily family = familyOf(model.data());
  if (!isSampleOnPlane(matches_, family, sample, largest)) return 0;
  const PlaneFit fit = fitPlane(matches_, family, indicesOf(inliers, size()), largest);
  if (!fit.is_found || fit.on_plane < 6) return 0;
  return parallaxModels(fit.homography, fit.inverse, threshold, kKept, models);
}

Examination FundamentalProblem::examine(const ModelNumbers& model, const std::uint8_t* inliers,
                                        double threshold) const {
  Examination result;
  const double largest = kPlaneTolerance * threshold * threshold;
  const std::vector<std::uint32_t> indices = indicesOf(inliers, size());
  std::vector<double> weights(inliers, inliers + size());
  ModelNumbers best = model;
  const PlaneFit plane = fitPlane(matches_, familyOf(model.data()), indices, largest);
  if (plane.is_found) {
    const std::size_t rest =
        size() - countOnPlane(matches_, plane.homography, plane.inverse, largest);
    const double chance_of_one = chance(threshold);
    if (!isBeyondChance(rest, indices.size() - plane.on_plane, 2, chance_of_one)) {
      ModelNumbers candidates[kKept], candidate = model;
      const std::size_t count =
          parallaxModels(plane.homography, plane.inverse, threshold, kKept, candidates);
      Refiner refiner(*this, false);
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < count; ++k) {
        candidates[k] = refiner.converge(candidates[k], threshold);
        const double cost = truncatedCost(*this, candidates[k], threshold);
        if (cost < least) least = cost, candidate = candidates[k];
      }
      std::size_t off_plane = 0;
      for (std::size_t i = 0; i < size(); ++i) {
        const bool is_inlier = matches_.squared(candidate.data(), i) <= threshold * threshold;
        weights[i] = is_inlier;
        off_plane +=
            is_inlier && !(matches_.transferSquared(plane.homography, plane.inverse, i) <= largest);
      }
      if (!isBeyondChance(rest, off_plane, 2, chance_of_one)) {
        result.is_determined = false;
        result.degeneracy = Degeneracy::Planar;
        result.reason =
            "all inliers fit one homography (a plane, or a camera that only turned), which leaves "
            "two parameters of the fundamental matrix open; estimate a homography, or calibrate";
        return result;
      }
      result.has_replacement = true;
      result.replacement = best = candidate;
    }
  }
  std::array<double, kMaxDof * kMaxDof> covariance{};
  if (!covarianceOf(*this, weights, best, covariance) ||
      largestVariance(covariance, 0, 7) > kLargestSigma * kLargestSigma) {
    result.is_determined = false;
    result.reason = "the inliers hardly determine the fundamental matrix";
  }
  return result;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
