#include "noise_field.h"

#include "hash.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

float latticeValue(std::uint32_t key, int x, int y) {
  const std::uint32_t place = static_cast<std::uint32_t>(y) * 1024U + static_cast<std::uint32_t>(x);
  return static_cast<float>(mix32(key + place * 0x9E3779B9U) >> 8) / 8388608.0F - 1;
}

float smooth(float t) {
  return t * t * (3 - 2 * t);
}

}  // namespace

NoiseField::NoiseField(std::uint64_t key, int first, int last, float gain)
    : cells_(std::size_t(kSize) * kSize) {
  float amplitude = 1, squares = 0;
  for (int octave = first; octave <= last; ++octave, amplitude *= gain) {
    squares += amplitude * amplitude;
    const int count = 1 << octave, step = kSize / count;
    const auto octave_key = static_cast<std::uint32_t>(keyOf(key, 1, std::uint64_t(octave)));
    for (int y = 0; y < kSize; ++y) {
      const int iy = y / step, jy = (iy + 1) % count;
      const float fy = smooth(static_cast<float>(y % step) / static_cast<float>(step));
      for (int ix = 0; ix < count; ++ix) {
        const int jx = (ix + 1) % count;
        const float left =
            latticeValue(octave_key, ix, iy) * (1 - fy) + latticeValue(octave_key, ix, jy) * fy;
        const float right =
            latticeValue(octave_key, jx, iy) * (1 - fy) + latticeValue(octave_key, jx, jy) * fy;
        for (int i = 0; i < step; ++i) {
          const float fx = smooth(static_cast<float>(i) / static_cast<float>(step));
          cells_[static_cast<std::size_t>(y * kSize + ix * step + i)] +=
              amplitude * (left + fx * (right - left));
        }
      }
    }
  }
  const float scale = 1 / std::sqrt(squares);
  for (float& cell : cells_) cell *= scale;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
