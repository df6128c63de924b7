// Numbers of two bytes: IEEE 754 binary16.
#ifndef GSLAM_VOCABULARY_DETAIL_HALF_H
#define GSLAM_VOCABULARY_DETAIL_HALF_H

#include <cstdint>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {

inline float floatOfBits(std::uint32_t bits) noexcept {
  float value;
  std::memcpy(&value, &bits, 4);
  return value;
}
inline std::uint32_t bitsOfFloat(float value) noexcept {
  std::uint32_t bits;
  std::memcpy(&bits, &value, 4);
  return bits;
}

// Exact, for finite numbers: the exponent is too small by 112, which a product mends, also where
// the number is subnormal.
inline float floatOfHalf(std::uint16_t half) noexcept {
  const float magnitude = floatOfBits((half & 0x7FFFu) << 13) * floatOfBits((127u + 112u) << 23);
  return floatOfBits(bitsOfFloat(magnitude) | ((half & 0x8000u) << 16));
}

// The nearest, ties to even; what is too large becomes the largest finite one.
inline std::uint16_t halfOfFloat(float value) noexcept {
  const std::uint32_t bits = bitsOfFloat(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000u;
  const float magnitude = floatOfBits(bits & 0x7FFFFFFFu);
  if (magnitude >= 65504.0f) return static_cast<std::uint16_t>(sign | 0x7BFFu);
  std::uint32_t half;
  if (magnitude < 6.103515625e-05f) {
    // Subnormal: units of 2^-24, rounded by the addition to a number whose last bit is one of them.
    half = bitsOfFloat(magnitude + 0.5f) - bitsOfFloat(0.5f);
  } else {
    const std::uint32_t odd = (bits >> 13) & 1u;
    half = (((bits & 0x7FFFFFFFu) + 0xFFFu + odd) >> 13) - (112u << 10);
    if (half > 0x7BFFu) half = 0x7BFFu;
  }
  return static_cast<std::uint16_t>(sign | half);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_HALF_H
