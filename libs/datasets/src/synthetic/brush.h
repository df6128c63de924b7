// What patterns are made of: noise, cells with random values, blobs, marks that look like text.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_BRUSH_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_BRUSH_H

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hash.h"
#include "noise_field.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// A cell of a grid, and where in it a place is, 0 to 1.
struct Cell {
  int i, j;
  float x, y;
};

inline Cell cellOf(float x, float y, float width, float height) {
  const float i = std::floor(x / width), j = std::floor(y / height);
  return {static_cast<int>(i), static_cast<int>(j), x / width - i, y / height - j};
}

/// All coordinates in metres.
class Brush {
 public:
  Brush(const NoiseField& coarse, const NoiseField& fine, std::uint64_t key)
      : coarse_(coarse),
        fine_(fine),
        key_(static_cast<std::uint32_t>(key)),
        x_(value(0, 0, 900)),
        y_(value(0, 0, 901)) {}

  /// 0 to 1, of a cell.
  float value(int i, int j, std::uint32_t purpose) const {
    return static_cast<float>(bits(i, j, purpose) >> 8) / 16777216.0F;
  }
  std::uint32_t bits(int i, int j, std::uint32_t purpose) const {
    return mix32(key_ + purpose * 0x9E3779B9U +
                 mix32(static_cast<std::uint32_t>(i) * 0x85EBCA6BU + 77U +
                       static_cast<std::uint32_t>(j) * 0xC2B2AE35U));
  }

  /// Slow changes, about -1 to 1: the largest are `size` wide.
  float soft(float x, float y, float size) const {
    return coarse_.at(x / (4 * size) + x_, y / (4 * size) + y_);
  }
  /// Quick changes, about -1 to 1: the smallest are `size` wide.
  float grain(float x, float y, float size) const {
    const float scale = 1 / (256 * size);
    return 0.6F * fine_.at(x * scale + x_, y * scale + y_) +
           0.5F * fine_.at((0.79F * x + 0.53F * y) * scale * 0.61F,
                           (0.79F * y - 0.53F * x) * scale * 0.61F);
  }

  /// In most cells a disc, square, ring or cross: how much brighter it is, -1 to 1; else 0.
  /// @param is_round  discs only
  float blobs(float x, float y, float size, std::uint32_t purpose, bool is_round = false) const {
    const Cell cell = cellOf(x, y, size, size);
    const std::uint32_t random = bits(cell.i, cell.j, purpose);
    if ((random & 7U) == 0) return 0;
    const float reach = 0.12F + 0.26F * part(random, 3);
    const float dx = std::fabs(cell.x - reach - (1 - 2 * reach) * part(random, 9));
    const float dy = std::fabs(cell.y - reach - (1 - 2 * reach) * part(random, 15));
    const float far = std::sqrt(dx * dx + dy * dy);
    bool is_inside = far < reach;
    const std::uint32_t kind = is_round ? 0 : random >> 30;
    if (kind == 1) is_inside = std::max(dx, dy) < 0.8F * reach;
    if (kind == 2) is_inside = is_inside && far > 0.55F * reach;
    if (kind == 3) is_inside = std::min(dx, dy) < 0.25F * reach && std::max(dx, dy) < reach;
    if (!is_inside) return 0;
    const float strength = 0.45F + 0.55F * part(random, 21);
    return (random & 8U) != 0 ? strength : -strength;
  }

  /// Whether there is ink: lines of letters of that height.
  bool text(float x, float y, float height, std::uint32_t purpose) const {
    const Cell letter = cellOf(x, y, 0.75F * height, 1.7F * height);
    const float gx = letter.x * 5, gy = letter.y * 8.5F;
    if (gx >= 4 || gy >= 5) return false;
    const std::uint32_t random = bits(letter.i, letter.j, purpose);
    if ((random >> 27) < 5) return false;  // between words
    const int bit = static_cast<int>(gy) * 4 + static_cast<int>(gx);
    return ((random >> bit) & 1U) != 0;
  }

 private:
  static float part(std::uint32_t random, int shift) {
    return static_cast<float>((random >> shift) & 63U) / 63;
  }

  const NoiseField& coarse_;
  const NoiseField& fine_;
  std::uint32_t key_;
  float x_, y_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_BRUSH_H
