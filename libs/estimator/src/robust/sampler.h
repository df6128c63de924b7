// Minimal samples.
#ifndef GSLAM_ESTIMATOR_ROBUST_SAMPLER_H
#define GSLAM_ESTIMATOR_ROBUST_SAMPLER_H

#include <gslam/base/span.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/problem.h"
#include "robust/random_order.h"

namespace gslam {
inline namespace v1 {
namespace detail {

using Sample = std::array<std::uint32_t, kMaxSample>;

// Sample number k depends only on the seed, on k and on the pool, so that any number of threads
// may draw samples in any order.
class Sampler {
 public:
  // All matches alike.
  Sampler(std::size_t matches, std::size_t sample_size, std::uint64_t seed);
  // The best first: PROSAC. quality is in the caller's order. After most_ranked samples all matches
  // are alike: rankings may be bad.
  Sampler(const RandomOrder& order, std::size_t sample_size, std::uint64_t seed,
          Span<const float> quality, std::uint64_t most_ranked = ~std::uint64_t(0));

  // Different matches, as many as sample_size. With PROSAC: pool 0 is its growing set of the best,
  // another number so many of the best, each sample of them alike.
  Sample draw(std::uint64_t number, std::size_t pool) const;

  bool isProsac() const { return !ranked_.empty(); }
  // The matches, best first; none without PROSAC.
  const std::vector<std::uint32_t>& ranked() const { return ranked_; }
  // Of how many of the best sample `number` is drawn by growth.
  std::size_t reach(std::uint64_t number) const;

 private:
  void computeGrowth();

  std::size_t matches_;
  std::size_t sample_size_;
  std::uint64_t seed_;
  std::uint64_t most_ranked_ = 0;
  std::vector<std::uint32_t> ranked_;
  std::vector<std::uint64_t> last_sample_;  // T'_n of the paper, from n = sample_size on
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_SAMPLER_H
