// Random numbers that are the same on every machine.
#ifndef GSLAM_ESTIMATOR_ROBUST_RANDOM_BITS_H
#define GSLAM_ESTIMATOR_ROBUST_RANDOM_BITS_H

#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
// A stream for each pair of seed and number, so that samples can be made in any order.
class RandomBits {
 public:
  RandomBits(std::uint64_t seed, std::uint64_t stream)
      : state_(mix(mix(seed + kStep) ^ (stream * kStep + 0x1234567))) {}

  std::uint64_t next() { return mix(state_ += kStep); }

  // 0 to bound - 1; the bias is below bound / 2^32.
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32) * bound) >> 32);
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15;

  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_RANDOM_BITS_H
