// Brightness on a rectangle, with smaller and smaller copies, so that what is far does not alias.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_TEXTURE_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_TEXTURE_H

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

class Texture {
 public:
  /// Fills width x height metres with brightness(x, y), 0 to 1, of the middle of each texel.
  /// Brightness is called by several threads.
  template <class Brightness>
  Texture(float width, float height, float texel, const Brightness& brightness)
      : texels_per_metre_(1 / texel) {
    addLevel(texelCount(width), texelCount(height));
    const Level& base = levels_[0];
    parallelFor(
        0, static_cast<std::size_t>(base.height),
        [&](std::size_t row) {
          std::uint8_t* const out = &data_[row * static_cast<std::size_t>(base.width)];
          const float y = (static_cast<float>(row) + 0.5F) * texel;
          for (int i = 0; i < base.width; ++i) {
            const float b = brightness((static_cast<float>(i) + 0.5F) * texel, y);
            out[i] = static_cast<std::uint8_t>(std::min(std::max(b, 0.0F), 1.0F) * 255 + 0.5F);
          }
        },
        rows());
    addSmallerLevels();
  }

  float texelsPerMetre() const { return texels_per_metre_; }

  /// Brightness, 0 to 255, at a place in texels of the finest level.
  /// @param level  0 or more: how often the size is halved
  float at(float x, float y, float level) const {
    const float last = static_cast<float>(levels_.size() - 1);
    level = std::min(std::max(level, 0.0F), last);
    const int fine = static_cast<int>(level);
    // Mixed only in the middle between two levels: that is half the work, and not seen.
    const float part = (level - static_cast<float>(fine) - 0.35F) * (1 / 0.3F);
    const auto first = static_cast<std::size_t>(fine);
    if (part <= 0) return bilinear(levels_[first], x, y);
    if (part >= 1) return bilinear(levels_[first + 1], x, y);
    const float a = bilinear(levels_[first], x, y);
    return a + part * (bilinear(levels_[first + 1], x, y) - a);
  }

 private:
  struct Level {
    int width, height;
    float scale;           // texels of this level in one of the finest
    float last_x, last_y;  // just before the last texel, so that there are four around
    std::size_t first;
  };

  int texelCount(float length) const {
    return std::max(2, static_cast<int>(std::ceil(length * texels_per_metre_ - 1e-3F)));
  }

  static ParallelOptions rows() {
    ParallelOptions options;
    options.grain = 8;
    return options;
  }

  void addLevel(int width, int height) {
    const std::size_t first = data_.size();
    const float scale = std::ldexp(1.0F, -static_cast<int>(levels_.size()));
    levels_.push_back({width, height, scale, std::nextafter(static_cast<float>(width - 1), 0.0F),
                       std::nextafter(static_cast<float>(height - 1), 0.0F), first});
    data_.resize(first + static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }

  void addSmallerLevels() {
    while (std::min(levels_.back().width, levels_.back().height) >= 4) {
      const Level from = levels_.back();
      addLevel(from.width / 2, from.height / 2);
      const Level& to = levels_.back();
      for (int y = 0; y < to.height; ++y) {
        const std::uint8_t* a = &data_[from.first] + std::ptrdiff_t(2) * y * from.width;
        const std::uint8_t* b = a + from.width;
        std::uint8_t* out = &data_[to.first] + std::ptrdiff_t(y) * to.width;
        for (int x = 0; x < to.width; ++x, a += 2, b += 2) {
          out[x] = static_cast<std::uint8_t>((a[0] + a[1] + b[0] + b[1] + 2) / 4);
        }
      }
    }
  }

  float bilinear(const Level& level, float x, float y) const {
    x = std::min(std::max(x * level.scale - 0.5F, 0.0F), level.last_x);
    y = std::min(std::max(y * level.scale - 0.5F, 0.0F), level.last_y);
    const int ix = static_cast<int>(x), iy = static_cast<int>(y);
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    const std::uint8_t* const a =
        data_.data() + level.first + std::ptrdiff_t(iy) * level.width + ix;
    const std::uint8_t* const b = a + level.width;
    const float a0 = a[0], b0 = b[0];
    const float upper = a0 + fx * (static_cast<float>(a[1]) - a0);
    const float lower = b0 + fx * (static_cast<float>(b[1]) - b0);
    return upper + fy * (lower - upper);
  }

  float texels_per_metre_;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> data_;
};

/// log2 to 0.01, of what is above 0.
inline float fastLog2(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, 4);
  const int exponent = static_cast<int>(bits >> 23) - 127;
  bits = (bits & 0x7FFFFFU) | 0x3F800000U;
  float m;
  std::memcpy(&m, &bits, 4);
  return static_cast<float>(exponent) + (m - 1) * (1.3465554F - 0.3465554F * m);
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_TEXTURE_H
