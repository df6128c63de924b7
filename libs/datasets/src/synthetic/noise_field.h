// Fractal value noise in one tile, made once and then looked up: patterns sample it at many scales.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_NOISE_FIELD_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_NOISE_FIELD_H

#include <cmath>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

class NoiseField {
 public:
  static constexpr int kSize = 512;

  /// Sum of octaves with 2^first to 2^last cells across the tile, each with `gain` times the
  /// amplitude of the one before.
  NoiseField(std::uint64_t key, int first, int last, float gain);

  /// -1 to 1, mostly within 0.6.
  /// @param x, y  in tiles: it repeats itself after 1
  float at(float x, float y) const {
    x = (x - std::floor(x)) * kSize;
    y = (y - std::floor(y)) * kSize;
    const int ix = static_cast<int>(x) & (kSize - 1), iy = static_cast<int>(y) & (kSize - 1);
    const int jx = (ix + 1) & (kSize - 1), jy = (iy + 1) & (kSize - 1);
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    const float* const a = &cells_[static_cast<std::size_t>(iy * kSize)];
    const float* const b = &cells_[static_cast<std::size_t>(jy * kSize)];
    const float upper = a[ix] + fx * (a[jx] - a[ix]);
    const float lower = b[ix] + fx * (b[jx] - b[ix]);
    return upper + fy * (lower - upper);
  }

 private:
  std::vector<float> cells_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_NOISE_FIELD_H
