#ifndef GSLAM_VOCABULARY_DESCRIPTORS_H
#define GSLAM_VOCABULARY_DESCRIPTORS_H

#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>
#include <string>

/// @file
/// Descriptors of image features: what they are, and where they lie.

namespace gslam {
inline namespace v1 {

/// How a vocabulary keeps its descriptors.
enum class DescriptorType : std::uint8_t {
  binary,   ///< bits, compared by the Hamming distance: ORB, BRIEF, BRISK, AKAZE, FREAK
  float32,  ///< numbers, compared by the L2 distance: SIFT, SURF, learned ones
  float16,  ///< the same in half the memory: IEEE 754 binary16
  int8  ///< the same in a quarter: steps of DescriptorFormat::scale from DescriptorFormat::offset
};

/// Its name: "binary", "float32", "float16" or "int8".
inline const char* descriptorTypeName(DescriptorType type) noexcept {
  static const char* const names[] = {"binary", "float32", "float16", "int8"};
  const std::size_t i = static_cast<std::size_t>(type);
  return i < 4 ? names[i] : "unknown";
}

/// The shape of the descriptors in a vocabulary.
struct DescriptorFormat {
  DescriptorType type = DescriptorType::binary;  ///< how each is kept
  std::uint32_t size = 32;  ///< bytes of a binary one, numbers of the others; 1 to 4096
  /// @{
  /// Of `int8`: the number that byte b stands for is the float nearest to `offset + scale * b`,
  /// with b from -128 to 127. Finite, the scale not 0.
  float scale = 1;
  float offset = 0;
  /// @}
};

/// Bytes of one descriptor, without the padding that a vocabulary may have behind it.
inline std::size_t bytesOf(const DescriptorFormat& format) noexcept {
  switch (format.type) {
    case DescriptorType::float32:
      return std::size_t(format.size) * 4;
    case DescriptorType::float16:
      return std::size_t(format.size) * 2;
    default:
      return format.size;
  }
}

/// A view of descriptors that somebody else owns: `count` rows, one every `stride` bytes.
///
/// They are bytes of bits or floats, also for vocabularies that keep floats in less. Made by
/// binaryDescriptors() and floatDescriptors(), or viewDescriptors() of gslam/vocabulary/opencv.h.
struct Descriptors {
  const void* data = nullptr;  ///< of the first; aligned for its elements
  std::size_t count = 0;       ///< how many
  std::size_t stride = 0;      ///< bytes from one to the next
  std::uint32_t size = 0;      ///< bytes of a binary one, floats of the others
  bool is_binary = true;       ///< bits or floats

  /// The descriptor of that number, unchecked.
  const std::uint8_t* row(std::size_t i) const noexcept {
    return static_cast<const std::uint8_t*>(data) + i * stride;
  }
};

/// @{
/// Views descriptors.
/// @param data    of the first
/// @param count   how many
/// @param size    bytes of a binary one, floats of the others
/// @param stride  bytes from one to the next; 0: they lie without gaps
/// @throws ArgumentError when the size is 0, or the stride less than a descriptor
inline Descriptors binaryDescriptors(const std::uint8_t* data, std::size_t count,
                                     std::uint32_t size, std::size_t stride = 0) {
  if (size == 0) throw ArgumentError("size", "of descriptors is 0");
  if (stride == 0) stride = size;
  if (stride < size) {
    throw ArgumentError("stride", "is " + std::to_string(stride) + " bytes, less than the " +
                                      std::to_string(size) + " of a descriptor");
  }
  Descriptors view;
  view.data = data;
  view.count = count;
  view.stride = stride;
  view.size = size;
  return view;
}

inline Descriptors floatDescriptors(const float* data, std::size_t count, std::uint32_t size,
                                    std::size_t stride = 0) {
  if (size == 0) throw ArgumentError("size", "of descriptors is 0");
  const std::size_t row = std::size_t(size) * sizeof(float);
  if (stride == 0) stride = row;
  if (stride < row || stride % sizeof(float) != 0) {
    throw ArgumentError(
        "stride", "is " + std::to_string(stride) + " bytes, expected a multiple of " +
                      "4 that is not less than the " + std::to_string(row) + " of a descriptor");
  }
  Descriptors view;
  view.data = data;
  view.count = count;
  view.stride = stride;
  view.size = size;
  view.is_binary = false;
  return view;
}
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DESCRIPTORS_H
