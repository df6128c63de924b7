// Random numbers that are the same with every standard library.
#ifndef GSLAM_VOCABULARY_DETAIL_RANDOM_H
#define GSLAM_VOCABULARY_DETAIL_RANDOM_H

#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {

// SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA
// 2014): any seed will do, neighbouring ones too, so each node of a tree may have one of its own.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) noexcept : state_(seed) {}

  std::uint64_t next() noexcept {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  // From 0 to under 1, in steps of 2^-53.
  double unit() noexcept { return static_cast<double>(next() >> 11) * (1.0 / 9007199254740992.0); }

  // From 0 to under `count`, which is not 0. Off from even by less than count / 2^64.
  std::uint64_t below(std::uint64_t count) noexcept { return next() % count; }

 private:
  std::uint64_t state_;
};

// The seed of child number i of a node: it depends on the way there only, not on when it is split.
inline std::uint64_t childSeed(std::uint64_t seed, std::uint32_t i) noexcept {
  return SplitMix64(seed ^ SplitMix64(i + 1).next()).next();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_RANDOM_H
