#include "robust/translation_survey.h"

#include <algorithm>
#include <cmath>

#include "robust/examination.h"
#include "robust/least_squares.h"
#include "robust/refiner.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr int kDirections = 20;          // of the half sphere: about 30 degrees apart
constexpr std::size_t kSurveyed = 120;   // matches that they are tried with
constexpr std::size_t kRefined = 5;      // of the directions
constexpr double kSameMinimum = 0.9994;  // cosine of 2 degrees

// Directions spread evenly over the half sphere around z, on a spiral of golden angles.
Vec3d directionOf(int k) {
  const double z = (k + 0.5) / kDirections, angle = 2.399963229728653 * k;
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// A few steps of reweighted least squares whose weights (Geman, McClure) narrow.
ModelNumbers approach(const EssentialProblem& problem, ModelNumbers model, double threshold) {
  const std::size_t n = problem.size();
  std::vector<float> squared(n);
  std::vector<double> weights(n);
  for (const double width : {5.0, 3.0, 1.5, 1.0}) {
    problem.squaredResiduals(model, 0, n, squared.data());
    const double limit = width * width * threshold * threshold;
    for (std::size_t i = 0; i < n; ++i) {
      const double ratio = 1 / (1 + static_cast<double>(squared[i]) / limit);
      weights[i] = ratio * ratio;
    }
    NormalEquations sums;
    problem.accumulate(model, weights.data(), n, sums);
    double delta[kMaxDof];
    if (!solveStep(sums, problem.dof(), 1e-2, delta)) break;
    model = problem.retract(model, delta);
  }
  return model;
}

void sortByCost(std::vector<CostOfModel>& models) {
  std::stable_sort(models.begin(), models.end(),
                   [](const CostOfModel& a, const CostOfModel& b) { return a.cost < b.cost; });
}

double quickCost(const EssentialProblem& problem, const ModelNumbers& model, double threshold) {
  std::vector<float> squared(problem.size());
  problem.squaredResiduals(model, 0, problem.size(), squared.data());
  const double largest = threshold * threshold;
  double sum = 0;
  for (const float s : squared) sum += s < largest ? static_cast<double>(s) : largest;
  return sum;
}

}  // namespace

std::vector<std::uint32_t> withoutChanceParallax(const EpipolarMatches& matches,
                                                 const SO3d& rotation, const std::uint8_t* inliers,
                                                 double chance) {
  const std::size_t n = matches.size();
  std::vector<double> cosines(n);
  std::vector<std::uint32_t> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d a = matches.firstRay(matches.first(i)), b = matches.secondRay(matches.second(i));
    cosines[i] = (rotation * a).dot(b) / std::sqrt(a.squaredNorm() * b.squaredNorm());
    order[i] = static_cast<std::uint32_t>(i);
  }
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return cosines[a] < cosines[b]; });
  // Where the part of inliers changes from that of chance to another one: the most likely place.
  const double p = std::min(std::max(chance, 1e-6), 0.5);
  const auto all = static_cast<double>(std::count(inliers, inliers + n, 1));
  double agreeing = 0, best = -1e300;
  std::size_t dropped = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double in = all - agreeing, count = static_cast<double>(n - k), out = count - in;
    if (2 * in < all) break;  // of a few matches nothing can be said
    double likelihood =
        agreeing * std::log(p) + (static_cast<double>(k) - agreeing) * std::log1p(-p);
    if (in > 0) likelihood += in * std::log(in / count);
    if (out > 0) likelihood += out * std::log(out / count);
    if (likelihood > best) best = likelihood, dropped = k;
    agreeing += inliers[order[k]];
  }
  std::vector<std::uint32_t> kept(order.begin() + static_cast<std::ptrdiff_t>(dropped),
                                  order.end());
  std::sort(kept.begin(), kept.end());
  return kept;
}

std::vector<CostOfModel> surveyTranslations(const EpipolarMatches& matches,
                                            const ModelNumbers& model, double threshold) {
  const EssentialProblem all(matches, threshold);
  std::vector<std::uint32_t> first(std::min(kSurveyed, matches.size()));
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = static_cast<std::uint32_t>(i);
  const EpipolarMatches some_matches = matches.picked(first);
  const EssentialProblem some(some_matches, threshold);
  const SO3d rotation = EssentialProblem::poseOf(model).rotation();
  std::vector<CostOfModel> found;
  for (int k = 0; k < kDirections; ++k) {
    CostOfModel candidate;
    candidate.model =
        approach(some, EssentialProblem::modelOf(rotation, directionOf(k)), threshold);
    candidate.cost = quickCost(some, candidate.model, threshold);
    const Vec3d t = EssentialProblem::poseOf(candidate.model).translation();
    const auto same = std::find_if(found.begin(), found.end(), [&](const CostOfModel& other) {
      return std::abs(t.dot(EssentialProblem::poseOf(other.model).translation())) > kSameMinimum;
    });
    if (same == found.end()) {
      found.push_back(candidate);
    } else if (candidate.cost < same->cost) {
      *same = candidate;
    }
  }
  sortByCost(found);
  if (found.size() > kRefined) found.resize(kRefined);
  Refiner refiner(all, false);
  for (CostOfModel& candidate : found) {
    candidate.model = all.oriented(refiner.improve(candidate.model, threshold, 0));
    candidate.cost = truncatedCost(all, candidate.model, threshold);
  }
  sortByCost(found);
  return found;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
