// Floats as a vocabulary keeps them.
#ifndef GSLAM_VOCABULARY_DETAIL_ENCODE_H
#define GSLAM_VOCABULARY_DETAIL_ENCODE_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/half.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {

// The nearest step; what is outside of them becomes the last one, what is no number the first.
inline std::int8_t stepOfFloat(const DescriptorFormat& format, float value) noexcept {
  const double step =
      std::nearbyint((static_cast<double>(value) - static_cast<double>(format.offset)) /
                     static_cast<double>(format.scale));
  return static_cast<std::int8_t>(!(step >= -128) ? -128 : step > 127 ? 127 : step);
}

// What a step stands for: the float nearest to it. The product is exact in doubles, so that it is
// the same whether or not a compiler fuses it with the sum.
inline float floatOfStep(const DescriptorFormat& format, std::int8_t step) noexcept {
  return static_cast<float>(static_cast<double>(format.offset) +
                            static_cast<double>(format.scale) * static_cast<double>(step));
}

// Whether the numbers of int8 are finite, and not all the same.
inline bool hasSoundSteps(const DescriptorFormat& format) noexcept {
  return format.type != DescriptorType::int8 ||
         (format.scale != 0 && std::isfinite(floatOfStep(format, -128)) &&
          std::isfinite(floatOfStep(format, 127)));
}

// Whether the numbers of a row are; those of int8 are as its format.
inline bool isFiniteRow(const DescriptorFormat& format, const std::uint8_t* row) noexcept {
  const std::size_t size = format.size;
  for (std::size_t i = 0; i < size && format.type == DescriptorType::float32; ++i) {
    float value;
    std::memcpy(&value, row + 4 * i, 4);
    if (!std::isfinite(value)) return false;
  }
  for (std::size_t i = 0; i < size && format.type == DescriptorType::float16; ++i) {
    std::uint16_t half;
    std::memcpy(&half, row + 2 * i, 2);
    if ((half & 0x7C00u) == 0x7C00u) return false;
  }
  return true;
}

// Writes bytesOf(format) for as many floats as the format has, which is not binary.
inline void encodeFloats(const DescriptorFormat& format, const float* from, std::uint8_t* to) {
  if (format.type == DescriptorType::float32) {
    std::memcpy(to, from, format.size * sizeof(float));
    return;
  }
  for (std::size_t i = 0; i < format.size; ++i) {
    if (format.type == DescriptorType::float16) {
      const std::uint16_t half = halfOfFloat(from[i]);
      std::memcpy(to + 2 * i, &half, sizeof half);
    } else {
      const std::int8_t step = stepOfFloat(format, from[i]);
      std::memcpy(to + i, &step, sizeof step);
    }
  }
}

// To the nearest numbers that the format has.
inline void roundFloats(const DescriptorFormat& format, float* numbers) {
  for (std::size_t i = 0; i < format.size; ++i) {
    if (format.type == DescriptorType::float16) {
      numbers[i] = floatOfHalf(halfOfFloat(numbers[i]));
    } else if (format.type == DescriptorType::int8) {
      numbers[i] = floatOfStep(format, stepOfFloat(format, numbers[i]));
    }
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_ENCODE_H
