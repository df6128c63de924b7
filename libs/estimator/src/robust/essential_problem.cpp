#include "robust/essential_problem.h"

#include <gslam/estimator/solvers/essential_5pt.h>
#include <gslam/geometry/nearest_rotation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "robust/bearing_frame.h"
#include "robust/examination.h"
#include "robust/least_squares.h"
#include "robust/plane_parallax.h"
#include "robust/project_sums.h"
#include "robust/refiner.h"
#include "robust/translation_survey.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr std::size_t kVoters = 100;  // matches that choose among the four poses of an E
constexpr double kLargestTranslationSigma = 0.07;  // radians, see kLargestRotationSigma
// Noise in the place of parallax draws the translation to itself: radians, for as much noise as
// parallax, both squared.
constexpr double kBias = 0.6;
constexpr double kSameDirection = 0.98;  // cosine of 11 degrees
constexpr double kAsGoodDirection = 12;  // of a difference of squares, in variances
// Of n matches, n times the ratio of parallax to noise, both squared: what makes the direction of a
// translation known to about 0.2 radians (turns hide most of a translation), and eight of what
// noise makes of it, divided by two.
constexpr double kEnoughParallax = 250;
constexpr double kParallaxNoise = 8;
constexpr double kLeastRelief = 30;  // the same of a plane
// Beside kAsGood, times the root of n: four times what n matches make whose noise is seen across
// other lines.
constexpr double kAsGoodNoise = 8;

constexpr const char* kTwoPosesOfPlane =
    "the inliers lie on one plane, which two poses explain equally well: the second one is the "
    "alternative";

Mat3d essentialOf(const ModelNumbers& model) {
  Mat3d e;
  std::copy(model.begin(), model.begin() + 9, e.values);
  return e;
}
SO3d rotationIn(const ModelNumbers& m) {
  return SO3d::fromQuaternion(m[9], m[10], m[11], m[12]);
}
Vec3d translationIn(const ModelNumbers& m) {
  return {m[13], m[14], m[15]};
}

// Two directions at right angles to a unit vector and to each other, in columns.
Mat<double, 3, 2> basisOf(const Vec3d& t) {
  return frameOfBearing(t).transpose();
}

Mat3d cofactorsOf(const Mat3d& m) {
  const Vec3d a = m.row(0), b = m.row(1), c = m.row(2);
  const Vec3d bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  return {{bc[0], bc[1], bc[2], ca[0], ca[1], ca[2], ab[0], ab[1], ab[2]}};
}

bool toRotation(const Mat3d& m, SO3d& rotation) {
  const Vec<double, 4> q = quaternionOfMatrix(m);
  const double square = q.squaredNorm();
  if (!(square > 0.25 && square < 4)) return false;  // NaN, too
  rotation = SO3d::fromQuaternion(q[0], q[1], q[2], q[3]);
  return true;
}

// Signs of the depths in both views where R a + t / depth is seen in b.
void depthSigns(const Vec3d& turned, const Vec3d& second, const Vec3d& translation, bool& first_on,
                bool& second_on) {
  const Vec3d across = turned.cross(second);
  first_on = across.dot(second.cross(translation)) > 0;
  second_on = across.dot(turned.cross(translation)) > 0;
}

bool isSameDirection(const ModelNumbers& a, const ModelNumbers& b) {
  return std::abs(translationIn(a).dot(translationIn(b))) > kSameDirection;
}

// Of the residuals within the threshold; a 1 for each of them.
double varianceOfInliers(const Problem& problem, const ModelNumbers& model, double threshold,
                         std::vector<double>& weights) {
  problem.exactSquaredResiduals(model, weights.data());
  const double square = threshold * threshold;
  double sum = 0, count = 0;
  for (double& w : weights) {
    const bool is_inlier = w <= square;
    if (is_inlier) sum += w, ++count;
    w = is_inlier ? 1 : 0;
  }
  return std::max(sum / std::max(count, 1.0), 1e-4 * square);
}

}  // namespace

bool factoriseEssential(const Mat3d& matrix, SO3d (&rotations)[2], Vec3d& translation) {
  double square = 0;
  for (const double x : matrix.values) square += x * x;
  if (!(square > 0) || !std::isfinite(square)) return false;
  const Mat3d e = matrix * std::sqrt(2 / square);
  // The cofactors of [t]x R are t t^T R, so that its columns are multiples of t.
  const Mat3d cofactors = cofactorsOf(e);
  Vec3d t{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3d column = cofactors.col(c);
    if (column.squaredNorm() > t.squaredNorm()) t = column;
  }
  const double length = std::sqrt(t.squaredNorm());
  if (!(length > 1e-6)) return false;
  translation = t / length;
  const Mat3d across = SO3d::hat(translation) * e;  // (t t^T - I) R
  return toRotation(cofactors - across, rotations[0]) &&
         toRotation(cofactors + across, rotations[1]);
}

std::size_t otherPosesOfPlane(const SO3d& rotation, const Vec3d& translation, const Vec3d& normal,
                              SE3d (&poses)[2]) {
  // H^T H - I = n m^T + m n^T with m = a + |a|^2 / 2 n and a = R^T t: n and m change places.
  const Vec3d a = rotation.inverse() * translation;
  const Vec3d m = a + 0.5 * a.squaredNorm() * normal;
  const double square = 0.25 * m.squaredNorm(), linear = 1 + normal.dot(m);
  const double constant = normal.squaredNorm();
  const double under = linear * linear - 4 * square * constant;
  if (!(square > 0) || !(under >= 0)) return 0;
  const Mat3d homography = rotation.matrix() + outer(translation, normal);
  std::size_t count = 0;
  for (const double sign : {-1.0, 1.0}) {
    const double x = (linear + sign * std::sqrt(under)) / (2 * square);  // |a'|^2
    const Vec3d other = normal - 0.5 * x * m;
    const double denominator = 1 + m.dot(other);
    if (!(std::abs(denominator) > 1e-12)) continue;
    const Mat3d turn = homography - outer(homography * other, m) * (1 / denominator);
    const Mat3d defect = turn * turn.transpose() - Mat3d::identity();
    double largest = 0;
    for (const double d : defect.values) largest = std::max(largest, std::abs(d));
    SO3d r;
    if (!(largest < 1e-6) || !(turn.row(0).dot(turn.row(1).cross(turn.row(2))) > 0)) continue;
    if (!toRotation(turn, r)) continue;
    const double length = other.norm();
    if (!(length > 0)) continue;
    poses[count++] = SE3d(r, r * (other / length));
  }
  return count;
}

ModelNumbers EssentialProblem::modelOf(const SO3d& rotation, const Vec3d& translation) {
  ModelNumbers model;
  const Vec3d t = translation / std::sqrt(translation.squaredNorm());
  const Mat3d e = SO3d::hat(t) * rotation.matrix();
  std::copy(e.values, e.values + 9, model.begin());
  std::copy(rotation.data(), rotation.data() + 4, model.begin() + 9);
  std::copy(t.values, t.values + 3, model.begin() + 13);
  return model;
}

SE3d EssentialProblem::poseOf(const ModelNumbers& model) {
  return SE3d(rotationIn(model), translationIn(model));
}

std::size_t EssentialProblem::solve(const std::uint32_t* sample, ModelNumbers* models) const {
  Vec3d first[5], second[5];
  for (std::size_t k = 0; k < 5; ++k) {
    first[k] = matches_.firstRay(matches_.first(sample[k]));
    second[k] = matches_.secondRay(matches_.second(sample[k]));
    first[k] /= std::sqrt(first[k].squaredNorm());
    second[k] /= std::sqrt(second[k].squaredNorm());
  }
  std::array<Mat3d, 10> solutions;
  const std::size_t found =
      essential5pt(Span<const Vec3d>(first, 5), Span<const Vec3d>(second, 5), solutions);
  std::size_t count = 0;
  for (std::size_t s = 0; s < found; ++s) {
    SO3d rotations[2];
    Vec3d t;
    if (!factoriseEssential(solutions[s], rotations, t)) continue;
    // Of the four poses that which has the sample in front of both cameras. One may be so far away
    // that noise decides on which side it is.
    std::size_t best = 3;
    int chosen = -1;
    for (int pose = 0; pose < 4; ++pose) {
      const Mat3d turn = rotations[pose / 2].matrix();
      const Vec3d direction = pose % 2 == 0 ? t : -t;
      std::size_t in_front = 0;
      for (std::size_t k = 0; k < 5; ++k) {
        bool first_on, second_on;
        depthSigns(turn * first[k], second[k], direction, first_on, second_on);
        in_front += first_on && second_on;
      }
      if (in_front > best) best = in_front, chosen = pose;
    }
    if (chosen < 0) continue;
    models[count++] = modelOf(rotations[chosen / 2], chosen % 2 == 0 ? t : -t);
  }
  return count;
}

void EssentialProblem::squaredResiduals(const ModelNumbers& model, std::size_t first,
                                        std::size_t count, float* squared) const {
  matches_.squaredFloat(matches_.linesOf(essentialOf(model)).values, first, count, squared);
}

bool EssentialProblem::isInFront(const Mat3d& rotation, const Vec3d& translation,
                                 std::size_t i) const {
  const Vec3d turned = rotation * matches_.firstRay(matches_.first(i));
  const Vec3d second = matches_.secondRay(matches_.second(i));
  bool first_on, second_on;
  depthSigns(turned, second, translation, first_on, second_on);
  if (first_on && second_on) return true;
  if (!(turned.dot(second) > 0)) return false;
  const Mat3d homography = matches_.homographyOf(rotation);
  const Mat3d inverse = matches_.inverseHomographyOf(rotation.transpose());
  return matches_.transferSquared(homography, inverse, i) <=
         kPlaneTolerance * threshold_ * threshold_;
}

ModelNumbers EssentialProblem::oriented(const ModelNumbers& model) const {
  const Vec3d t = translationIn(model);
  const SO3d rotation = rotationIn(model);
  // Half a turn about t gives the other rotation of the same E.
  const SO3d half_turn = SO3d::fromQuaternion(t[0], t[1], t[2], 0);
  const Mat3d turns[2] = {rotation.matrix(), (half_turn * rotation).matrix()};
  const Mat3d lines = matches_.linesOf(essentialOf(model));
  std::size_t in_front[4] = {};
  std::size_t seen = 0;
  for (std::size_t i = 0; i < size() && seen < kVoters; ++i) {
    if (!(matches_.squared(lines.values, i) <= threshold_ * threshold_)) continue;
    ++seen;
    const Vec3d first = matches_.firstRay(matches_.first(i));
    const Vec3d second = matches_.secondRay(matches_.second(i));
    for (std::size_t k = 0; k < 2; ++k) {
      bool first_on, second_on;
      depthSigns(turns[k] * first, second, t, first_on, second_on);
      in_front[2 * k] += first_on && second_on;
      in_front[2 * k + 1] += !first_on && !second_on;
    }
  }
  const std::size_t best =
      static_cast<std::size_t>(std::max_element(in_front, in_front + 4) - in_front);
  if (best == 0) return model;
  return modelOf(best < 2 ? rotation : half_turn * rotation, best % 2 == 0 ? t : -t);
}

void EssentialProblem::exactSquaredResiduals(const ModelNumbers& any, double* squared) const {
  const ModelNumbers model = oriented(any);
  const Mat3d lines = matches_.linesOf(essentialOf(model));
  const Mat3d rotation = rotationIn(model).matrix();
  const Vec3d translation = translationIn(model);
  const double largest = 9 * threshold_ * threshold_;  // beyond it nobody asks for the side
  for (std::size_t i = 0; i < size(); ++i) {
    squared[i] = matches_.squared(lines.values, i);
    if (squared[i] <= largest && !isInFront(rotation, translation, i)) {
      squared[i] = std::numeric_limits<double>::infinity();
    }
  }
}

// From whichever side, so that there are rather more than fewer of them.
void EssentialProblem::squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift,
                                               std::size_t count, double* squared) const {
  matches_.squaredOfPairs(matches_.linesOf(essentialOf(model)).values, shift, count, squared);
}

std::size_t EssentialProblem::placeOf(const ModelNumbers&, std::size_t i, double* place) const {
  return matches_.placeOf(i, place);
}

Mat<double, 9, 5> EssentialProblem::matrixByDelta(const ModelNumbers& model) {
  const Mat3d rotation = rotationIn(model).matrix();
  const Mat3d e = essentialOf(model);
  const Mat<double, 3, 2> basis = basisOf(translationIn(model));
  Mat<double, 9, 5> result;
  for (std::size_t k = 0; k < 5; ++k) {
    Vec3d axis{};
    if (k >= 2) axis[k - 2] = 1;
    const Mat3d moved = k < 2 ? SO3d::hat(basis.col(k)) * rotation : e * SO3d::hat(axis);
    for (std::size_t r = 0; r < 9; ++r) result(r, k) = moved.values[r];
  }
  return result;
}

Mat<double, 6, 5> EssentialProblem::tangentByDelta(const ModelNumbers& model) {
  const Mat<double, 3, 2> turned =
      rotationIn(model).matrix().transpose() * basisOf(translationIn(model));
  Mat<double, 6, 5> result{};
  for (std::size_t r = 0; r < 3; ++r) {
    result(r, 0) = turned(r, 0);
    result(r, 1) = turned(r, 1);
    result(3 + r, 2 + r) = 1;
  }
  return result;
}

void EssentialProblem::accumulate(const ModelNumbers& model, const double* weights,
                                  std::size_t count, NormalEquations& sums) const {
  const EpipolarSums all =
      matches_.sums(matches_.linesOf(essentialOf(model)).values, weights, count);
  Mat<double, 9, 5> derivative = matrixByDelta(model);
  const Vec3d& a = matches_.firstDiagonal();
  const Vec3d& b = matches_.secondDiagonal();
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t k = 0; k < 5; ++k) derivative(r, k) *= b[r / 3] * a[r % 3];
  }
  projectSums(all, derivative, sums);
}

ModelNumbers EssentialProblem::retract(const ModelNumbers& model, const double* delta) const {
  for (std::size_t k = 0; k < 5; ++k) {
    if (!(std::abs(delta[k]) < 1e3)) return model;
  }
  const Vec3d t = translationIn(model);
  const Vec3d moved = t + basisOf(t) * Vec<double, 2>{delta[0], delta[1]};
  const SO3d turn = SO3d::exp({delta[2], delta[3], delta[4]});
  return modelOf((rotationIn(model) * turn).normalized(), moved);
}

// Whether the camera only turned: the inliers that a rotation does not explain are no more than
// chance, and the others move along their epipolar lines no more than across them.
bool EssentialProblem::examineRotation(const ModelNumbers& model,
                                       const std::vector<std::uint32_t>& inliers, double threshold,
                                       Examination& result) const {
  const double variance = threshold * threshold;
  Mat3d turn = rotationIn(model).matrix();
  SO3d rotation = rotationIn(model);
  for (const double tolerance : {16.0, 9.0, kPlaneTolerance, kPlaneTolerance}) {
    const Mat3d homography = matches_.homographyOf(turn);
    const Mat3d inverse = matches_.inverseHomographyOf(turn.transpose());
    Mat3d sum{};
    std::size_t count = 0;
    for (const std::uint32_t i : inliers) {
      if (!(matches_.transferSquared(homography, inverse, i) <= tolerance * variance)) continue;
      const Vec3d a = matches_.firstRay(matches_.first(i));
      const Vec3d b = matches_.secondRay(matches_.second(i));
      sum += outer(b, a) * (1 / std::sqrt(a.squaredNorm() * b.squaredNorm()));
      ++count;
    }
    if (2 * count < inliers.size()) return false;
    rotation = nearestRotation(sum).rotation;
    turn = rotation.matrix();
  }
  const Mat3d homography = matches_.homographyOf(turn);
  const Mat3d inverse = matches_.inverseHomographyOf(turn.transpose());
  const Mat3d lines = matches_.linesOf(essentialOf(model));
  // Over all that a rotation explains, inliers or not: so both directions are cut off alike.
  std::size_t all = 0;
  double total = 0, across = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double squared = matches_.transferSquared(homography, inverse, i);
    if (!(squared <= kPlaneTolerance * variance)) continue;
    total += squared;
    across += matches_.squared(lines.values, i);
    ++all;
  }
  std::size_t turned = 0;
  for (const std::uint32_t i : inliers) {
    turned += matches_.transferSquared(homography, inverse, i) <= kPlaneTolerance * variance;
  }
  const auto n = static_cast<double>(all);
  across = std::max(across, n * 1e-4 * variance);
  const double ratio = (total - across) / across - 1;
  if (isBeyondChance(size() - all, inliers.size() - turned, 2, chance(threshold))) return false;
  if (n * ratio > kEnoughParallax + kParallaxNoise * std::sqrt(n)) return false;
  result.is_determined = false;
  result.degeneracy = Degeneracy::PureRotation;
  result.reason =
      "a rotation alone explains the inliers: the model's rotation can be relied on, its "
      "translation means nothing; take views that are farther apart";
  result.has_replacement = true;
  result.replacement = modelOf(rotation, translationIn(model));
  return true;
}

// Least squares of where R + t n^T takes the matches on a plane: both components of their errors
// count, of which epipolar lines see only one. Steps of Gauss and Newton, derivatives by
// differences.
void EssentialProblem::refinePlane(const std::vector<std::uint32_t>& on_plane, SO3d& rotation,
                                   Vec3d& translation, Vec3d& normal) const {
  constexpr std::size_t kFreedom = 8;
  constexpr double kStep = 1e-6;
  struct Plane {
    SO3d rotation;
    Vec3d translation, normal;
  };
  const auto moved = [](const Plane& from, const double* delta) {
    const Vec3d t =
        from.translation + basisOf(from.translation) * Vec<double, 2>{delta[3], delta[4]};
    return Plane{(from.rotation * SO3d::exp({delta[0], delta[1], delta[2]})).normalized(),
                 t / std::sqrt(t.squaredNorm()), from.normal + Vec3d{delta[5], delta[6], delta[7]}};
  };
  const auto homographyOf = [this](const Plane& plane) {
    return matches_.homographyOf(plane.rotation.matrix() + outer(plane.translation, plane.normal));
  };
  Plane plane = {rotation, translation, normal};
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 8; ++iteration) {
    const Mat3d here = homographyOf(plane);
    Mat3d beside[kFreedom];
    for (std::size_t k = 0; k < kFreedom; ++k) {
      double delta[kFreedom] = {};
      delta[k] = kStep;
      beside[k] = homographyOf(moved(plane, delta));
    }
    NormalEquations sums;
    for (const std::uint32_t i : on_plane) {
      double r[3], jacobian[kFreedom][3];
      bool is_seen = matches_.transferResidual(here, i, r);
      for (std::size_t k = 0; k < kFreedom; ++k) {
        is_seen = is_seen && matches_.transferResidual(beside[k], i, jacobian[k]);
        for (std::size_t c = 0; c < 3; ++c) jacobian[k][c] = (jacobian[k][c] - r[c]) / kStep;
      }
      if (!is_seen) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t a = 0; a < kFreedom; ++a) {
          for (std::size_t b = a; b < kFreedom; ++b) {
            sums.hessian[a * kMaxDof + b] += jacobian[a][c] * jacobian[b][c];
          }
          sums.gradient[a] += jacobian[a][c] * r[c];
        }
        sums.cost += r[c] * r[c];
      }
    }
    if (!(sums.cost < last)) return;
    rotation = plane.rotation, translation = plane.translation, normal = plane.normal;
    if (last - sums.cost < 1e-6 * sums.cost) return;
    last = sums.cost;
    double delta[kMaxDof];
    if (!solveStep(sums, kFreedom, 1e-6, delta)) return;
    for (std::size_t k = 0; k < kFreedom; ++k) {
      if (!(std::abs(delta[k]) < 1)) return;
    }
    plane = moved(plane, delta);
  }
}

// A plane is seen alike from two poses; whichever the loop found, the other one is tried, too.
void EssentialProblem::examinePlane(const ModelNumbers& model,
                                    const std::vector<std::uint32_t>& inliers, double threshold,
                                    Examination& result) const {
  const double largest = kPlaneTolerance * threshold * threshold;
  const SO3d rotation = rotationIn(model);
  const HomographyFamily family = {matches_.homographyOf(rotation.matrix()),
                                   matches_.epipoleOf(translationIn(model))};
  const PlaneFit plane = fitPlane(matches_, family, inliers, largest);
  if (!plane.is_found) return;
  const std::size_t rest =
      size() - countOnPlane(matches_, plane.homography, plane.inverse, largest);
  if (isBeyondChance(rest, inliers.size() - plane.on_plane, 2, chance(threshold))) return;
  const Vec3d& diagonal = matches_.firstDiagonal();
  Vec3d normal = {plane.plane[0] / diagonal[0], plane.plane[1] / diagonal[1],
                  plane.plane[2] / diagonal[2]};
  std::vector<std::uint32_t> on_plane;
  for (std::size_t i = 0; i < size(); ++i) {
    if (matches_.transferSquared(plane.homography, plane.inverse, i) <= largest) {
      on_plane.push_back(static_cast<std::uint32_t>(i));
    }
  }
  SO3d turn = rotation;
  Vec3d translation = translationIn(model);
  refinePlane(on_plane, turn, translation, normal);
  // Relief below the threshold, but above the noise: no plane, and the pose knows it.
  const Mat3d homography = matches_.homographyOf(turn.matrix() + outer(translation, normal));
  Mat3d inverse;
  if (!invert(homography, inverse)) return;
  const Mat3d lines = matches_.linesOf(essentialOf(model));
  double total = 0, across = 0;
  for (const std::uint32_t i : on_plane) {
    total += std::min(matches_.transferSquared(homography, inverse, i), largest);
    across += matches_.squared(lines.values, i);
  }
  const auto n = static_cast<double>(on_plane.size());
  across = std::max(across, n * 1e-4 * threshold * threshold);
  if (n * ((total - across) / across - 1) > kLeastRelief + kParallaxNoise * std::sqrt(n)) return;
  result.degeneracy = Degeneracy::Planar;
  SE3d poses[3];
  poses[2] = SE3d(turn, translation);
  SE3d others[2];
  const std::size_t count = otherPosesOfPlane(turn, translation, normal, others);
  std::copy(others, others + count, poses);
  std::swap(poses[count], poses[2]);
  ModelNumbers best = model, other{};
  double best_cost = std::numeric_limits<double>::infinity(), other_cost = best_cost;
  for (std::size_t p = 0; p <= count; ++p) {
    const ModelNumbers candidate = oriented(modelOf(poses[p].rotation(), poses[p].translation()));
    if (best_cost < std::numeric_limits<double>::infinity() &&
        poseOf(candidate).isApprox(poseOf(best), 1e-3)) {
      continue;
    }
    const double cost = truncatedCost(*this, candidate, threshold);
    if (cost < best_cost) {
      other = best, other_cost = best_cost;
      best = candidate, best_cost = cost;
    } else if (cost < other_cost) {
      other = candidate, other_cost = cost;
    }
  }
  // Sampson's least squares only, where the plane's led astray.
  const double cost_before = truncatedCost(*this, model, threshold);
  if (best_cost > cost_before + kPlaneTolerance * kAsGood * threshold * threshold) return;
  result.has_replacement = true;
  result.replacement = best;
  double inlier_cost = 0;
  std::vector<double> squared(size());
  exactSquaredResiduals(best, squared.data());
  std::size_t inlier_count = 0;
  for (const double s : squared) {
    if (s <= threshold * threshold) inlier_cost += s, ++inlier_count;
  }
  const double variance = inlier_cost / static_cast<double>(std::max<std::size_t>(inlier_count, 1));
  const double as_good = kAsGood + kAsGoodNoise * std::sqrt(static_cast<double>(plane.on_plane));
  if (other_cost - best_cost <= as_good * std::max(variance, 1e-4 * threshold * threshold)) {
    result.has_alternative = true;
    result.alternative = other;
    result.reason = kTwoPosesOfPlane;
  }
}

namespace {

// Of the inliers, both squared: how far they move beside the turn that explains them best, from
// which a translation can be told, and what noise makes of it.
double parallaxToNoise(const EpipolarMatches& matches, const std::vector<double>& weights,
                       double variance) {
  Mat3d sum{};
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    const Vec3d a = matches.firstRay(matches.first(i)), b = matches.secondRay(matches.second(i));
    sum += outer(b, a) * (1 / std::sqrt(a.squaredNorm() * b.squaredNorm()));
  }
  const Mat3d turn = nearestRotation(sum).rotation.matrix();
  const Mat3d homography = matches.homographyOf(turn);
  const Mat3d inverse = matches.inverseHomographyOf(turn.transpose());
  double total = 0, count = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    // No one match is to speak for all.
    total += std::min(matches.transferSquared(homography, inverse, i), 1e3 * variance);
    ++count;
  }
  return std::max(total / (std::max(count, 1.0) * variance) - 2, 1e-3);
}

}  // namespace

// The covariance from what is no chance, and whether it is small enough; whether another direction
// of translation explains the matches better, or as well.
void EssentialProblem::surveyTranslation(const ModelNumbers& found, const std::uint8_t* inliers,
                                         double threshold, Examination& result) const {
  ModelNumbers model = result.has_replacement ? result.replacement : found;
  const EpipolarMatches trusted = matches_.picked(
      withoutChanceParallax(matches_, rotationIn(model), inliers, chance(threshold)));
  const EssentialProblem problem(trusted, threshold);
  // Both components of errors made the pose of a plane: lines alone know less.
  const bool is_of_plane = result.degeneracy == Degeneracy::Planar;
  const std::vector<CostOfModel> minima = surveyTranslations(trusted, model, threshold);
  double cost = truncatedCost(problem, model, threshold);
  Refiner refiner(problem, false);
  const ModelNumbers better = problem.oriented(
      refiner.converge(minima.front().cost < cost ? minima.front().model : model, threshold));
  const double cost_of_better = truncatedCost(problem, better, threshold);
  std::vector<double> weights(trusted.size());
  const double variance = varianceOfInliers(problem, better, threshold, weights);
  if (cost_of_better < cost - (is_of_plane ? kAsGoodDirection * variance : 0)) {
    cost = cost_of_better;
    if (is_of_plane && isSameDirection(better, result.alternative)) result.alternative = model;
    result.has_replacement = true;
    result.replacement = model = better;
  }
  for (const CostOfModel& other : minima) {
    if (result.has_alternative || other.cost - cost > kAsGoodDirection * variance) break;
    if (isSameDirection(other.model, model)) continue;
    result.has_alternative = true;
    result.alternative = other.model;
    if (is_of_plane) {
      result.reason = kTwoPosesOfPlane;
      break;
    }
    result.is_determined = false;
    result.reason =
        "another direction of translation explains the inliers as well, and is the alternative; "
        "take views that are farther apart, or more matches";
    return;
  }
  varianceOfInliers(problem, model, threshold, weights);
  const double factor = cutOffFactor(variance / (threshold * threshold));
  result.has_covariance = covarianceOf(problem, weights, model, result.covariance);
  for (double& c : result.covariance) c *= factor;
  const double bias = kBias / parallaxToNoise(trusted, weights, variance);
  for (std::size_t k = 0; k < 2; ++k) result.covariance[k * kMaxDof + k] += bias * bias;
  const double largest = kLargestTranslationSigma;
  if (!result.has_covariance || largestVariance(result.covariance, 0, 2) > largest * largest ||
      largestVariance(result.covariance, 2, 3) > kLargestRotationSigma * kLargestRotationSigma) {
    result.is_determined = false;
    result.reason = "the inliers hardly determine the pose; take views that are farther apart";
  }
}

Examination EssentialProblem::examine(const ModelNumbers& any, const std::uint8_t* inliers,
                                      double threshold) const {
  Examination result;
  const ModelNumbers model = oriented(any);
  if (model != any) result.has_replacement = true, result.replacement = model;
  const std::vector<std::uint32_t> indices = indicesOf(inliers, size());
  if (examineRotation(model, indices, threshold, result)) return result;
  examinePlane(model, indices, threshold, result);
  surveyTranslation(model, inliers, threshold, result);
  return result;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
