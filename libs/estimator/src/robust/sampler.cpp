#include "robust/sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "robust/random_bits.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// T_N of PROSAC: after so many samples it draws from all matches.
constexpr double kSamplesToAll = 200000;

// `count` different numbers below `bound`, each set alike (Floyd's algorithm).
void drawDifferent(std::uint32_t bound, std::size_t count, RandomBits& bits, Sample& sample) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t last = bound - static_cast<std::uint32_t>(count - i);
    const std::uint32_t number = bits.below(last + 1);
    const auto end = sample.begin() + static_cast<std::ptrdiff_t>(i);
    sample[i] = std::find(sample.begin(), end, number) == end ? number : last;
  }
}

}  // namespace

Sampler::Sampler(std::size_t matches, std::size_t sample_size, std::uint64_t seed)
    : matches_(matches), sample_size_(sample_size), seed_(seed) {}

Sampler::Sampler(const RandomOrder& order, std::size_t sample_size, std::uint64_t seed,
                 Span<const float> quality, std::uint64_t most_ranked)
    : Sampler(order.size(), sample_size, seed) {
  most_ranked_ = most_ranked;
  ranked_.resize(matches_);
  std::iota(ranked_.begin(), ranked_.end(), 0u);
  // Equal ones stay in random order.
  std::stable_sort(ranked_.begin(), ranked_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return quality[order[a]] > quality[order[b]];
  });
  computeGrowth();
}

// Chum, Matas 2005, equations 3 and 4 of "The growth function": T_n is the mean number of those
// among kSamplesToAll samples of all matches that lie within the best n.
void Sampler::computeGrowth() {
  double mean = kSamplesToAll;  // T_n
  for (std::size_t i = 0; i < sample_size_; ++i) {
    mean *= static_cast<double>(sample_size_ - i) / static_cast<double>(matches_ - i);
  }
  std::uint64_t last = 1;
  last_sample_.assign(1, last);
  for (std::size_t n = sample_size_ + 1; n <= matches_; ++n) {
    const double next = mean * static_cast<double>(n) / static_cast<double>(n - sample_size_);
    last += static_cast<std::uint64_t>(std::ceil(next - mean));
    last_sample_.push_back(last);
    mean = next;
  }
}

std::size_t Sampler::reach(std::uint64_t number) const {
  if (!isProsac() || number >= most_ranked_) return matches_;
  const auto found = std::lower_bound(last_sample_.begin(), last_sample_.end(), number + 1);
  return std::min(matches_, sample_size_ + static_cast<std::size_t>(found - last_sample_.begin()));
}

Sample Sampler::draw(std::uint64_t number, std::size_t pool) const {
  RandomBits bits(seed_, number);
  Sample sample{};
  if (!isProsac() || (pool == 0 && number >= most_ranked_)) {
    drawDifferent(static_cast<std::uint32_t>(matches_), sample_size_, bits, sample);
    return sample;
  }
  const std::size_t reached = pool > 0 ? pool : reach(number);
  if (pool > 0 || number >= last_sample_.back()) {
    drawDifferent(static_cast<std::uint32_t>(reached), sample_size_, bits, sample);
  } else {  // the newest one, and others from before it
    drawDifferent(static_cast<std::uint32_t>(reached - 1), sample_size_ - 1, bits, sample);
    sample[sample_size_ - 1] = static_cast<std::uint32_t>(reached - 1);
  }
  for (std::size_t i = 0; i < sample_size_; ++i) sample[i] = ranked_[sample[i]];
  return sample;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
