// Random numbers that are a function of where they are used: no order of threads changes them.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_HASH_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_HASH_H

#include <array>
#include <cmath>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// The output function of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014).
inline std::uint64_t mix64(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

/// Mixes 32 bits: the last steps of MurmurHash3 (A. Appleby, public domain).
inline std::uint32_t mix32(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85EBCA6BU;
  x = (x ^ (x >> 13)) * 0xC2B2AE35U;
  return x ^ (x >> 16);
}

/// A key for one purpose at one place.
inline std::uint64_t keyOf(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index = 0) {
  return mix64(mix64(seed * 0x100000001B3U + purpose) + index);
}

/// A uniform random bit generator for gslam/geometry/random.h: SplitMix64.
class Generator {
 public:
  explicit Generator(std::uint64_t key) : state_(key) {}
  static constexpr std::uint64_t min() { return 0; }
  static constexpr std::uint64_t max() { return ~std::uint64_t(0); }
  std::uint64_t operator()() { return mix64(state_ += 0x9E3779B97F4A7C15U); }

  /// From `low` to `high`, evenly.
  float uniform(float low, float high) {
    return low + (high - low) * static_cast<float>((*this)() >> 40) / 16777216.0F;
  }
  /// 0 to count - 1.
  int below(int count) {
    return static_cast<int>(((*this)() >> 32) * static_cast<std::uint64_t>(count) >> 32);
  }

 private:
  std::uint64_t state_;
};

/// Quantiles of the normal distribution. A normal number is the sum of two, each chosen by 11 bits
/// of a hash.
class NormalTable {
 public:
  static const NormalTable& get() {
    static const NormalTable table;
    return table;
  }
  /// Mean 0, variance 1.
  float operator()(std::uint32_t hash) const {
    return half_[hash & (kSize - 1)] + half_[(hash >> 11) & (kSize - 1)];
  }
  /// Adds to a row of numbers, each times `scale`, by its place in the image.
  /// @param first  place of the first
  void addTo(float* row, const float* scale, int count, std::uint32_t first,
             std::uint64_t key) const {
    constexpr int kStep = 64;
    const auto a = static_cast<std::uint32_t>(key), b = static_cast<std::uint32_t>(key >> 32);
    std::uint32_t hashes[kStep];
    for (int begin = 0; begin < count; begin += kStep) {
      const std::uint32_t place = first + static_cast<std::uint32_t>(begin);
      for (std::uint32_t i = 0; i < kStep; ++i) {
        hashes[i] = mix32(mix32((place + i) * 0x9E3779B9U ^ a) + b);
      }
      const int n = count - begin < kStep ? count - begin : kStep;
      for (int i = 0; i < n; ++i) row[begin + i] += scale[begin + i] * (*this)(hashes[i]);
    }
  }

 private:
  static constexpr std::uint32_t kSize = 2048;

  NormalTable() {
    double squares = 0;
    for (std::uint32_t i = 0; i < kSize; ++i) {
      const double x = quantile((i + 0.5) / kSize);
      squares += x * x;
      half_[i] = static_cast<float>(x);
    }
    const auto scale = static_cast<float>(std::sqrt(kSize / squares / 2));
    for (float& x : half_) x *= scale;
  }

  static double quantile(double p) {
    double low = -6, high = 6;
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  std::array<float, kSize> half_{};
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_HASH_H
