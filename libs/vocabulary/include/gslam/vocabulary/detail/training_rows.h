// The descriptors of a training, copied side by side.
#ifndef GSLAM_VOCABULARY_DETAIL_TRAINING_ROWS_H
#define GSLAM_VOCABULARY_DETAIL_TRAINING_ROWS_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Squares of differences of larger numbers, summed, might leave float.
constexpr float kMostFloat = 1e15f;

inline std::string kindOf(bool is_binary, std::uint32_t size) {
  return std::to_string(size) + (is_binary ? " bytes of bits" : " floats");
}

inline std::string imageName(std::size_t image) {
  return "image " + std::to_string(image);
}

// What descriptors are copied to: binary, or float32.
inline DescriptorFormat rowFormat(const Descriptors& descriptors) noexcept {
  DescriptorFormat format;
  format.type = descriptors.is_binary ? DescriptorType::binary : DescriptorType::float32;
  format.size = descriptors.size;
  return format;
}

// Throws ArgumentError unless the image has rows of this format. One without any is fine.
inline void checkImage(const Descriptors& image, std::size_t number,
                       const DescriptorFormat& format) {
  if (image.count == 0) return;
  const bool is_binary = format.type == DescriptorType::binary;
  if (image.is_binary != is_binary || image.size != format.size) {
    throw ArgumentError(imageName(number), "has descriptors of " +
                                               kindOf(image.is_binary, image.size) + ", expected " +
                                               kindOf(is_binary, format.size));
  }
  if (image.data == nullptr) throw ArgumentError(imageName(number), "has descriptors at null");
  const std::size_t bytes = image.is_binary ? image.size : std::size_t(image.size) * sizeof(float);
  if (image.count > 1 && image.stride < bytes) {
    throw ArgumentError(imageName(number), "has a descriptor every " +
                                               std::to_string(image.stride) + " bytes, expected " +
                                               std::to_string(bytes));
  }
}

// Whether all numbers are finite and not too large.
inline bool areSoundFloats(const float* numbers, std::size_t count) noexcept {
  bool is_sound = true;
  for (std::size_t i = 0; i < count; ++i) is_sound &= std::fabs(numbers[i]) <= kMostFloat;
  return is_sound;
}

[[noreturn]] inline void refuseFloats(const float* numbers, std::size_t count, std::size_t image,
                                      std::size_t row) {
  std::size_t i = 0;
  while (i + 1 < count && std::fabs(numbers[i]) <= kMostFloat) ++i;
  throw ArgumentError(imageName(image), "has the number " + std::to_string(numbers[i]) +
                                            " in descriptor " + std::to_string(row) +
                                            ", expected finite ones of at most 1e15");
}

// Throws ArgumentError unless all numbers of an image, which was checked else, are sound.
inline void checkNumbers(const Descriptors& image, std::size_t number) {
  if (image.is_binary) return;
  std::vector<float> row(image.size);
  for (std::size_t i = 0; i < image.count; ++i) {
    std::memcpy(row.data(), image.row(i), image.size * sizeof(float));
    if (!areSoundFloats(row.data(), image.size)) refuseFloats(row.data(), image.size, number, i);
  }
}

// Writes row i of an image and zeros behind it; `number` is that of the image.
inline void copyRow(const Descriptors& image, std::size_t number, std::size_t i, std::uint8_t* to,
                    std::size_t stride) {
  const std::size_t bytes = image.is_binary ? image.size : std::size_t(image.size) * sizeof(float);
  std::memcpy(to, image.row(i), bytes);
  std::memset(to + bytes, 0, stride - bytes);
  if (image.is_binary) return;
  const float* const numbers = reinterpret_cast<const float*>(to);
  if (!areSoundFloats(numbers, image.size)) refuseFloats(numbers, image.size, number, i);
}

// The least and the largest of all numbers.
struct FloatRange {
  float least = 0;
  float most = 0;
  bool is_empty = true;

  void add(const FloatRange& other) noexcept {
    if (other.is_empty) return;
    least = is_empty ? other.least : std::min(least, other.least);
    most = is_empty ? other.most : std::max(most, other.most);
    is_empty = false;
  }
  void add(const float* numbers, std::size_t count) noexcept {
    if (is_empty) least = most = numbers[0];
    is_empty = false;
    for (std::size_t i = 0; i < count; ++i) {
      least = std::min(least, numbers[i]);
      most = std::max(most, numbers[i]);
    }
  }
};

// The format that keeps floats of this range; their own where it is float32.
inline DescriptorFormat storageFormat(const DescriptorFormat& rows, DescriptorType type,
                                      const FloatRange& range) {
  DescriptorFormat format = rows;
  if (rows.type == DescriptorType::binary) return format;
  format.type = type;
  if (type == DescriptorType::float16 && std::max(-range.least, range.most) > 65504.0f) {
    throw ArgumentError("options.storage",
                        "is float16, which has numbers up to 65504; there is " +
                            std::to_string(range.most > -range.least ? range.most : range.least));
  }
  if (type == DescriptorType::int8) {
    const float step = (range.most - range.least) / 255;
    format.scale = step >= std::numeric_limits<float>::min() ? step : 1;
    format.offset = range.least + 128 * format.scale;
  }
  return format;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TRAINING_ROWS_H
