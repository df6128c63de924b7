// What the robust loop asks of a model. The loop itself (robust_loop.h) is compiled once and knows
// nothing of cameras or matrices.
#ifndef GSLAM_ESTIMATOR_ROBUST_PROBLEM_H
#define GSLAM_ESTIMATOR_ROBUST_PROBLEM_H

#include <gslam/estimator/estimate.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// Numbers of one model; what they mean is the problem's business.
using ModelNumbers = std::array<double, 16>;

constexpr std::size_t kMaxModels = 20;  // of one sample
constexpr std::size_t kMaxSample = 16;  // matches of one sample
constexpr std::size_t kMaxDof = 12;
constexpr std::size_t kMaxPlace = 8;

// Sums over matches: w J^T J (upper triangle, row by row in kMaxDof columns), w J^T r, w r^T r.
struct NormalEquations {
  std::array<double, kMaxDof * kMaxDof> hessian{};
  std::array<double, kMaxDof> gradient{};
  double cost = 0;
};

// What a problem says of the model that was found, and of its inliers.
struct Examination {
  bool is_determined = true;  // false: the answer is Degenerate
  Degeneracy degeneracy = Degeneracy::None;
  const char* reason = nullptr;  // a sentence, where not null: what is special, what to do
  bool has_replacement = false;  // of the model; it is taken as it is, not refined
  ModelNumbers replacement{};
  bool has_covariance = false;  // of delta, in place of that from all inliers
  std::array<double, kMaxDof * kMaxDof> covariance{};
  bool has_alternative = false;  // for Estimate::alternative
  ModelNumbers alternative{};
};

// The matches of one call, in the order in which the loop goes through them, which must be a
// random one (random_order.h): it judges by the first matches whether others are worth a look.
// Immutable while the loop runs, so that threads share it. Residuals are in the unit of the
// threshold. Nothing may throw but std::bad_alloc.
class Problem {
 public:
  virtual ~Problem() = default;

  virtual std::size_t size() const = 0;               // matches
  virtual std::size_t sampleSize() const = 0;         // of a minimal sample, at most kMaxSample
  virtual std::size_t maxSolutions() const = 0;       // of solve(): at most kMaxModels
  virtual std::size_t dof() const = 0;                // of retract()'s delta
  virtual std::size_t residualDimension() const = 0;  // numbers whose squares one residual sums:
                                                      // 1 of Sampson's, 2 of pixels, 3 of points

  // How many samples without an outlier the search is to see, with the wanted probability: more
  // than one where noise makes many of them useless.
  virtual std::size_t goodSamples() const { return 1; }

  // Models through a sample of sampleSize() matches: how many, at most kMaxModels.
  virtual std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const = 0;

  // Squared residuals of the matches [first, first + count), in float, for scoring. What the model
  // cannot see (behind the camera) is infinite; NaN counts as infinite.
  virtual void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                                float* squared) const = 0;
  // The same of all matches, in double: what masks are made from.
  virtual void exactSquaredResiduals(const ModelNumbers& model, double* squared) const = 0;

  // The same of pairs that are no matches, the first part of match i with the second part of match
  // (i + shift) % size(), for i < count <= size(): what chance looks like to this model. Of single
  // points see PlaneProblem. Shift 0: of matches.
  virtual void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift,
                                       std::size_t count, double* squared) const = 0;
  // Where match i is, in all that was observed of it, in the unit of the threshold as the model
  // sees it: at most kMaxPlace numbers; how many. Matches at one place are one piece of evidence.
  virtual std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const = 0;

  // Adds those of the first `count` matches whose weight is positive; weights has count entries.
  // Local optimisation uses the first matches only, where there are thousands.
  virtual void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                          NormalEquations& sums) const = 0;
  // The model moved by delta of dof() numbers.
  virtual ModelNumbers retract(const ModelNumbers& model, const double* delta) const = 0;

  // Probability that a match of two unrelated points lies within the threshold of a given model;
  // grows with the threshold.
  virtual double chance(double threshold) const = 0;

  // Further models to be tried when `model`, of this sample, is the best so far; e.g. a plane and
  // parallax where the inliers may lie on one plane. How many, at most kMaxModels. They are scored
  // like others, and the best of all is optimised. inliers: size() bytes, 1 within the threshold.
  virtual std::size_t propose(const ModelNumbers& model, const std::uint32_t* sample,
                              const std::uint8_t* inliers, double threshold,
                              ModelNumbers* models) const {
    static_cast<void>(model), static_cast<void>(sample), static_cast<void>(inliers);
    static_cast<void>(threshold), static_cast<void>(models);
    return 0;
  }

  // Looks at the model that was found, refined, with a consensus that chance does not explain.
  // (That the normal equations of all inliers have full rank, the loop sees to.)
  virtual Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                              double threshold) const {
    static_cast<void>(model), static_cast<void>(inliers), static_cast<void>(threshold);
    return {};
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_PROBLEM_H
