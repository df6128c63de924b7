// The inner loops of image resampling: bilinear, in fixed point, in several SIMD variants with
// equal results.
#ifndef GSLAM_GEOMETRY_DETAIL_REMAP_H
#define GSLAM_GEOMETRY_DETAIL_REMAP_H

#include <gslam/base/simd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if GSLAM_X86
#include <immintrin.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr int kRemapOne = 64;   // positions in the source are multiples of 1/64 pixel
constexpr int kRemapBlock = 8;  // pixels of the target that are treated together

// What is known of 8 pixels of the target.
enum class RemapBlock : std::uint8_t {
  unseen,  // none is in the source
  easy,    // all are, and 8 bytes may be read at each of their rows
  mixed    // to be looked at one by one
};

// One row of the target. Of pixel i: (xy[2 i], xy[2 i + 1]) is the upper left of the four pixels of
// the source around it, fraction[i] = fx + 256 fy its distance from that in 1/64 pixel, 0 to 64.
struct RemapRow {
  const std::int16_t* xy;
  const std::uint16_t* fraction;
  const std::uint8_t* is_seen;
  const RemapBlock* blocks;
  int width;
};

// The source, with its rows `stride` elements apart.
template <class T>
struct RemapSource {
  const T* data;
  std::ptrdiff_t stride;
};

template <class T, typename std::enable_if<std::is_integral<T>::value, int>::type = 0>
T interpolate(T a, T b, T c, T d, unsigned fx, unsigned fy) {
  const unsigned top = a * (kRemapOne - fx) + b * fx;
  const unsigned bottom = c * (kRemapOne - fx) + d * fx;
  constexpr unsigned half = kRemapOne * kRemapOne / 2;
  return static_cast<T>((top * (kRemapOne - fy) + bottom * fy + half) / (kRemapOne * kRemapOne));
}

template <class T, typename std::enable_if<std::is_floating_point<T>::value, int>::type = 0>
T interpolate(T a, T b, T c, T d, unsigned fx, unsigned fy) {
  const T x = static_cast<T>(fx) / kRemapOne, y = static_cast<T>(fy) / kRemapOne;
  const T top = a * (1 - x) + b * x;
  const T bottom = c * (1 - x) + d * x;
  return top * (1 - y) + bottom * y;
}

template <class T, int kChannels>
void remapPixels(const RemapRow& row, const RemapSource<T>& source, T fill, T* target, int first,
                 int last) {
  for (int i = first; i < last; ++i) {
    T* const out = target + std::ptrdiff_t(i) * kChannels;
    if (row.is_seen[i] == 0) {
      for (int c = 0; c < kChannels; ++c) out[c] = fill;
      continue;
    }
    const std::int16_t* const xy = row.xy + 2 * std::ptrdiff_t(i);
    const T* const in = source.data + xy[1] * source.stride + std::ptrdiff_t(xy[0]) * kChannels;
    const unsigned fx = row.fraction[i] & 0xFFU, fy = row.fraction[i] >> 8U;
    for (int c = 0; c < kChannels; ++c) {
      out[c] = interpolate(in[c], in[c + kChannels], in[source.stride + c],
                           in[source.stride + c + kChannels], fx, fy);
    }
  }
}

// The pixels of a block that is not easy.
template <class T, int kChannels>
void remapHardBlock(const RemapRow& row, const RemapSource<T>& source, T fill, T* target,
                    int block) {
  const int first = block * kRemapBlock;
  remapPixels<T, kChannels>(row, source, fill, target, first, first + kRemapBlock);
}

// The pixels behind the last whole block.
template <class T, int kChannels>
void remapRest(const RemapRow& row, const RemapSource<T>& source, T fill, T* target) {
  const int first = row.width / kRemapBlock * kRemapBlock;
  remapPixels<T, kChannels>(row, source, fill, target, first, row.width);
}

template <class T>
using RemapFunction = void (*)(const RemapRow&, const RemapSource<T>&, T fill, T* target);

template <class T, int kChannels>
void remapScalar(const RemapRow& row, const RemapSource<T>& source, T fill, T* target) {
  remapPixels<T, kChannels>(row, source, fill, target, 0, row.width);
}

#if GSLAM_X86

GSLAM_TARGET_SSE4

// Lanes of fx + 256 fy to lanes of bytes 64 - fx, fx, 64 - fx, fx.
inline __m128i remapWeightsX(__m128i fraction) {
  const __m128i copies =
      _mm_shuffle_epi8(fraction, _mm_setr_epi8(0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12));
  const __m128i flip = _mm_set1_epi16(0x00FF), add = _mm_set1_epi16(kRemapOne + 1);
  return _mm_add_epi8(_mm_xor_si128(copies, flip), add);  // ~f + 65 = 64 - f
}

// ... to lanes of 16-bit numbers 64 - fy, fy.
inline __m128i remapWeightsY(__m128i fraction) {
  const __m128i copies = _mm_shuffle_epi8(
      fraction, _mm_setr_epi8(1, -1, 1, -1, 5, -1, 5, -1, 9, -1, 9, -1, 13, -1, 13, -1));
  const __m128i flip = _mm_set1_epi32(0x0000FFFF), add = _mm_set1_epi32(kRemapOne + 1);
  return _mm_add_epi16(_mm_xor_si128(copies, flip), add);
}

// Lanes of bytes a b c d to lanes of their bilinear mean.
inline __m128i remapMean(__m128i pixels, __m128i weights_x, __m128i weights_y) {
  const __m128i rows = _mm_maddubs_epi16(pixels, weights_x);  // at most 255 * 64
  const __m128i sum = _mm_madd_epi16(rows, weights_y);
  return _mm_srli_epi32(_mm_add_epi32(sum, _mm_set1_epi32(kRemapOne * kRemapOne / 2)), 12);
}

// Sets 16-bit words 2 k and 2 k + 1 to bytes a b (upper row) and c d (lower row) of pixel i + k.
template <int k>
__m128i remapInsert(__m128i pixels, const RemapRow& row, const RemapSource<std::uint8_t>& source,
                    int i) {
  const std::int16_t* const xy = row.xy + 2 * std::ptrdiff_t(i + k);
  const std::uint8_t* const at = source.data + xy[1] * source.stride + xy[0];
  std::uint16_t upper, lower;
  std::memcpy(&upper, at, 2);
  std::memcpy(&lower, at + source.stride, 2);
  return _mm_insert_epi16(_mm_insert_epi16(pixels, upper, 2 * k), lower, 2 * k + 1);
}

inline __m128i remapFourPixels(const RemapRow& row, const RemapSource<std::uint8_t>& source,
                               int i) {
  __m128i pixels = remapInsert<0>(_mm_setzero_si128(), row, source, i);
  pixels = remapInsert<1>(pixels, row, source, i);
  pixels = remapInsert<2>(pixels, row, source, i);
  pixels = remapInsert<3>(pixels, row, source, i);
  const __m128i fraction =
      _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row.fraction + i)));
  return remapMean(pixels, remapWeightsX(fraction), remapWeightsY(fraction));
}

inline void remapSse4(const RemapRow& row, const RemapSource<std::uint8_t>& source,
                      std::uint8_t fill, std::uint8_t* target) {
  for (int block = 0; block < row.width / kRemapBlock; ++block) {
    if (row.blocks[block] != RemapBlock::easy) {
      remapHardBlock<std::uint8_t, 1>(row, source, fill, target, block);
      continue;
    }
    const int i = block * kRemapBlock;
    const __m128i words =
        _mm_packus_epi32(remapFourPixels(row, source, i), remapFourPixels(row, source, i + 4));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(target + i), _mm_packus_epi16(words, words));
  }
  remapRest<std::uint8_t, 1>(row, source, fill, target);
}

// One pixel of 3 or 4 channels: the two pixels of each row stand in 8 bytes.
// @param order  brings a and b of a channel side by side, then c and d of it
template <int kChannels>
void remapColourPixel(const RemapRow& row, const RemapSource<std::uint8_t>& source,
                      std::uint8_t* target, int i, __m128i order) {
  const std::int16_t* const xy = row.xy + 2 * std::ptrdiff_t(i);
  const std::uint8_t* const at =
      source.data + xy[1] * source.stride + std::ptrdiff_t(xy[0]) * kChannels;
  const __m128i upper = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(at));
  const __m128i lower = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(at + source.stride));
  const __m128i fraction = _mm_set1_epi32(row.fraction[i]);
  const __m128i mean = remapMean(_mm_shuffle_epi8(_mm_unpacklo_epi64(upper, lower), order),
                                 remapWeightsX(fraction), remapWeightsY(fraction));
  const __m128i words = _mm_packus_epi32(mean, mean);
  const int bytes = _mm_cvtsi128_si32(_mm_packus_epi16(words, words));
  std::memcpy(target + std::ptrdiff_t(i) * kChannels, &bytes, kChannels);
}

template <int kChannels>
void remapColourSse4(const RemapRow& row, const RemapSource<std::uint8_t>& source,
                     std::uint8_t fill, std::uint8_t* target) {
  const __m128i order = kChannels == 4
                            ? _mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15)
                            : _mm_setr_epi8(0, 3, 8, 11, 1, 4, 9, 12, 2, 5, 10, 13, -1, -1, -1, -1);
  for (int block = 0; block < row.width / kRemapBlock; ++block) {
    if (row.blocks[block] != RemapBlock::easy) {
      remapHardBlock<std::uint8_t, kChannels>(row, source, fill, target, block);
      continue;
    }
    for (int k = 0; k < kRemapBlock; ++k) {
      remapColourPixel<kChannels>(row, source, target, block * kRemapBlock + k, order);
    }
  }
  remapRest<std::uint8_t, kChannels>(row, source, fill, target);
}

GSLAM_TARGET_END

GSLAM_TARGET_AVX2

inline void remapAvx2(const RemapRow& row, const RemapSource<std::uint8_t>& source,
                      std::uint8_t fill, std::uint8_t* target) {
  const __m256i pick_x = _mm256_set1_epi32(0x00FF00FF), add_x = _mm256_set1_epi16(kRemapOne + 1);
  const __m256i pick_y = _mm256_set1_epi32(0x0000FFFF), add_y = _mm256_set1_epi32(kRemapOne + 1);
  const __m256i spread_x = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12));
  const __m256i spread_y = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(1, -1, 1, -1, 5, -1, 5, -1, 9, -1, 9, -1, 13, -1, 13, -1));
  const __m256i stride = _mm256_set1_epi32(static_cast<int>(source.stride));
  const __m256i half = _mm256_set1_epi32(kRemapOne * kRemapOne / 2);
  const __m256i low_bytes = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(0, 4, 8, 12, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1));
  const int* const upper_row = reinterpret_cast<const int*>(source.data);
  const int* const lower_row = reinterpret_cast<const int*>(source.data + source.stride);
  for (int block = 0; block < row.width / kRemapBlock; ++block) {
    if (row.blocks[block] != RemapBlock::easy) {
      remapHardBlock<std::uint8_t, 1>(row, source, fill, target, block);
      continue;
    }
    const int i = block * kRemapBlock;
    const __m256i xy =
        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row.xy + 2 * std::ptrdiff_t(i)));
    const __m256i x = _mm256_and_si256(xy, pick_y);
    const __m256i at = _mm256_add_epi32(_mm256_mullo_epi32(_mm256_srli_epi32(xy, 16), stride), x);
    const __m256i upper = _mm256_i32gather_epi32(upper_row, at, 1);
    const __m256i lower = _mm256_i32gather_epi32(lower_row, at, 1);
    const __m256i pixels = _mm256_blend_epi16(upper, _mm256_slli_epi32(lower, 16), 0xAA);
    const __m256i fraction =
        _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(row.fraction + i)));
    const __m256i weights_x =
        _mm256_add_epi8(_mm256_xor_si256(_mm256_shuffle_epi8(fraction, spread_x), pick_x), add_x);
    const __m256i weights_y =
        _mm256_add_epi16(_mm256_xor_si256(_mm256_shuffle_epi8(fraction, spread_y), pick_y), add_y);
    const __m256i sum = _mm256_madd_epi16(_mm256_maddubs_epi16(pixels, weights_x), weights_y);
    const __m256i mean = _mm256_srli_epi32(_mm256_add_epi32(sum, half), 12);
    const __m256i bytes = _mm256_shuffle_epi8(mean, low_bytes);
    const __m128i joined =
        _mm_unpacklo_epi32(_mm256_castsi256_si128(bytes), _mm256_extracti128_si256(bytes, 1));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(target + i), joined);
  }
  remapRest<std::uint8_t, 1>(row, source, fill, target);
}

GSLAM_TARGET_END

#endif  // GSLAM_X86

// The kernels of a type of pixel.
template <class T, int kChannels>
struct RemapKernel {
  static SimdKernel<RemapFunction<T>> get() {
    return {remapScalar<T, kChannels>, nullptr, nullptr, nullptr, nullptr};
  }
};
template <>
struct RemapKernel<std::uint8_t, 1> {
  static SimdKernel<RemapFunction<std::uint8_t>> get() {
    return {remapScalar<std::uint8_t, 1>, GSLAM_IF_X86(remapSse4), GSLAM_IF_X86(remapAvx2), nullptr,
            nullptr};
  }
};
template <>
struct RemapKernel<std::uint8_t, 3> {
  static SimdKernel<RemapFunction<std::uint8_t>> get() {
    return {remapScalar<std::uint8_t, 3>, GSLAM_IF_X86(remapColourSse4<3>), nullptr, nullptr,
            nullptr};
  }
};
template <>
struct RemapKernel<std::uint8_t, 4> {
  static SimdKernel<RemapFunction<std::uint8_t>> get() {
    return {remapScalar<std::uint8_t, 4>, GSLAM_IF_X86(remapColourSse4<4>), nullptr, nullptr,
            nullptr};
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_REMAP_H
