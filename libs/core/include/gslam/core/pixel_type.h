#ifndef GSLAM_CORE_PIXEL_TYPE_H
#define GSLAM_CORE_PIXEL_TYPE_H

#include <cstddef>
#include <cstdint>

/// @file
/// The types a channel of a pixel can have.

namespace gslam {
inline namespace v1 {

/// Type of a channel of a pixel. The numbers stand in files; the first eight are OpenCV's depths.
enum class PixelType : std::uint8_t {
  u8 = 0,
  i8 = 1,
  u16 = 2,
  i16 = 3,
  i32 = 4,
  f32 = 5,
  f64 = 6,
  f16 = 7,  ///< IEEE binary16, which C++ has no type for: bytes only
  u32 = 8,
  i64 = 9,
  u64 = 10
};

/// Bytes of a channel; 0 for a number that is no type.
inline std::size_t pixelTypeSize(PixelType type) noexcept {
  static const std::uint8_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 2, 4, 8, 8};
  const std::size_t i = static_cast<std::size_t>(type);
  return i < sizeof(kSizes) ? kSizes[i] : 0;
}

/// Its name, such as "u8"; "unknown" for a number that is no type.
inline const char* pixelTypeName(PixelType type) noexcept {
  static const char* const kNames[] = {"u8",  "i8",  "u16", "i16", "i32", "f32",
                                       "f64", "f16", "u32", "i64", "u64"};
  return pixelTypeSize(type) == 0 ? "unknown" : kNames[static_cast<std::size_t>(type)];
}

/// The PixelType of a C++ type, as `value`; only for types that a channel can have.
template <class T>
struct PixelTypeOf;

/// @cond
template <PixelType Type>
struct PixelTypeConstant {
  static constexpr PixelType value = Type;
};
template <>
struct PixelTypeOf<std::uint8_t> : PixelTypeConstant<PixelType::u8> {};
template <>
struct PixelTypeOf<std::int8_t> : PixelTypeConstant<PixelType::i8> {};
template <>
struct PixelTypeOf<std::uint16_t> : PixelTypeConstant<PixelType::u16> {};
template <>
struct PixelTypeOf<std::int16_t> : PixelTypeConstant<PixelType::i16> {};
template <>
struct PixelTypeOf<std::int32_t> : PixelTypeConstant<PixelType::i32> {};
template <>
struct PixelTypeOf<float> : PixelTypeConstant<PixelType::f32> {};
template <>
struct PixelTypeOf<double> : PixelTypeConstant<PixelType::f64> {};
template <>
struct PixelTypeOf<std::uint32_t> : PixelTypeConstant<PixelType::u32> {};
template <>
struct PixelTypeOf<std::int64_t> : PixelTypeConstant<PixelType::i64> {};
template <>
struct PixelTypeOf<std::uint64_t> : PixelTypeConstant<PixelType::u64> {};
/// @endcond

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_PIXEL_TYPE_H
