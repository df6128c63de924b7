// The nearest of a few float descriptors, in all variants of SIMD, for rows of floats, halves and
// bytes.
#ifndef GSLAM_VOCABULARY_DETAIL_L2_H
#define GSLAM_VOCABULARY_DETAIL_L2_H

#include <gslam/base/platform.h>
#include <gslam/base/simd.h>
#include <gslam/vocabulary/detail/encode.h>
#include <gslam/vocabulary/detail/exact_sum.h>
#include <gslam/vocabulary/detail/half.h>
#include <gslam/vocabulary/detail/visit.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if GSLAM_X86
#include <immintrin.h>
#elif GSLAM_ARM64
#include <arm_neon.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

// One number of a row.
inline float elementOf(const DescriptorFormat& format, const std::uint8_t* row, std::size_t i) {
  if (format.type == DescriptorType::float32) {
    float value;
    std::memcpy(&value, row + i * 4, 4);
    return value;
  }
  if (format.type == DescriptorType::float16) {
    std::uint16_t half;
    std::memcpy(&half, row + i * 2, 2);
    return floatOfHalf(half);
  }
  std::int8_t step;
  std::memcpy(&step, row + i, 1);
  return floatOfStep(format, step);
}

// Of two of these their difference is off by no more than kDoubleError of the larger one, whether
// or not a compiler fuses what is here.
constexpr double kDoubleError = 1e-12;  // two sums of 4096 terms
inline double exactDistance(const DescriptorFormat& format, const std::uint8_t* query,
                            const std::uint8_t* row) {
  double sum = 0;
  for (std::size_t i = 0; i < format.size; ++i) {
    float value;
    std::memcpy(&value, query + i * 4, 4);
    const double difference = double(value) - double(elementOf(format, row, i));
    sum += difference * difference;
  }
  return sum;
}

// Whether `row` is nearer to a query than `other`, to the last bit.
inline bool isExactlyNearer(const DescriptorFormat& format, const std::uint8_t* query,
                            const std::uint8_t* row, const std::uint8_t* other) {
  // The squares of the query are in both, so what is left is b b - 2 a b.
  ExactSum sum;
  for (std::size_t i = 0; i < format.size; ++i) {
    float value;
    std::memcpy(&value, query + i * 4, 4);
    const float here = elementOf(format, row, i);
    const float there = elementOf(format, other, i);
    sum.addProduct(here, here);
    sum.addProduct(value, here, -2);
    sum.addProduct(there, there, -1);
    sum.addProduct(value, there, 2);
  }
  return sum.isNegative();
}

// The nearest of those whose distance is not over the limit, the first of equals.
GSLAM_COLD inline Choice settleExactly(const DescriptorFormat& format, std::size_t stride,
                                       const Visit& visit, const float* distances, float limit) {
  std::uint32_t best = visit.count;
  double least = 0;
  for (std::uint32_t c = 0; c < visit.count; ++c) {
    if (distances[c] > limit) continue;
    const std::uint8_t* const row = visit.rows + c * stride;
    const double distance = exactDistance(format, visit.query, row);
    if (best != visit.count) {
      const bool is_clear = std::abs(distance - least) > kDoubleError * std::max(distance, least);
      const bool is_finite = std::isfinite(distance) && std::isfinite(least);
      if (is_clear || !is_finite) {
        if (!(distance < least)) continue;
      } else if (!isExactlyNearer(format, visit.query, row, visit.rows + best * stride)) {
        continue;
      }
    }
    least = distance;
    best = c;
  }
  return Choice{best, static_cast<float>(least)};
}

// Kernels read numbers of int8 a little beside what they are, as they round and a compiler may
// fuse: what a limit of squares of distances becomes by that.
GSLAM_COLD inline float withDecodingError(const DescriptorFormat& format, float limit) {
  const float error = 2.4e-7f * (std::abs(format.offset) + 128 * std::abs(format.scale));
  const float root = std::sqrt(limit) + 2 * error * std::sqrt(static_cast<float>(format.size));
  return root * root;
}

// Rounding may exchange rows that are nearly equally near, and each variant rounds in its own way:
// those that the bound of the error cannot tell apart are compared again, exactly. A sum of n terms
// in any order is off by no more than (n + 2) units in the last place of each, and where squares
// are too small for floats by one of the smallest for each.
inline Choice settle(const DescriptorFormat& format, std::size_t stride, const Visit& visit,
                     const float* distances) {
  std::uint32_t best = 0;
  for (std::uint32_t c = 1; c < visit.count; ++c) {
    if (distances[c] < distances[best]) best = c;
  }
  const auto size = static_cast<float>(format.size);
  const float error = (size + 4) * 1.2e-7f;
  float limit = distances[best] * (1 + 2 * error) + 4 * size * FLT_MIN;
  if (format.type == DescriptorType::int8) limit = withDecodingError(format, limit);
  std::uint32_t rivals = 0;
  for (std::uint32_t c = 0; c < visit.count; ++c) {
    if (!(distances[c] > limit)) ++rivals;
  }
  if (rivals == 1) return Choice{best, distances[best]};
  return settleExactly(format, stride, visit, distances, limit);
}

inline void chooseFloatScalar(const DescriptorFormat& format, std::size_t stride,
                              const Visit* visits, std::size_t count, Choice* choices) {
  for (std::size_t i = 0; i < count; ++i) {
    const Visit& visit = visits[i];
    float distances[64] = {};
    for (std::uint32_t c = 0; c < visit.count; ++c) {
      const std::uint8_t* const row = visit.rows + c * stride;
      float sum = 0;
      for (std::size_t at = 0; at < format.size; ++at) {
        float value;
        std::memcpy(&value, visit.query + at * 4, 4);
        const float difference = value - elementOf(format, row, at);
        sum += difference * difference;
      }
      distances[c] = sum;
    }
    choices[i] = settle(format, stride, visit, distances);
  }
}

// Loops that all variants share: `Rows` reads a few numbers of a row at once, `Sum` adds up squares
// of differences. Four rows together, so that no addition waits for the one before.
#define GSLAM_DETAIL_CHOOSE_FLOAT(variant)                                                        \
  template <class Rows>                                                                           \
  void distances##variant(const DescriptorFormat& format, std::size_t stride, const Visit& visit, \
                          float* distances) {                                                     \
    std::uint32_t c = 0;                                                                          \
    for (; c + 4 <= visit.count; c += 4) {                                                        \
      const std::uint8_t* const row = visit.rows + c * stride;                                    \
      sumSquares##variant<Rows, 4>(format, visit.query, row, stride, distances + c);              \
    }                                                                                             \
    for (; c < visit.count; ++c) {                                                                \
      const std::uint8_t* const row = visit.rows + c * stride;                                    \
      sumSquares##variant<Rows, 1>(format, visit.query, row, stride, distances + c);              \
    }                                                                                             \
  }                                                                                               \
  template <class Rows>                                                                           \
  void chooseRows##variant(const DescriptorFormat& format, std::size_t stride,                    \
                           const Visit* visits, std::size_t count, Choice* choices) {             \
    for (std::size_t i = 0; i < count; ++i) {                                                     \
      if (i + 2 < count) fetchRows(visits[i + 2], stride);                                        \
      float distances[64];                                                                        \
      distances##variant<Rows>(format, stride, visits[i], distances);                             \
      choices[i] = settle(format, stride, visits[i], distances);                                  \
    }                                                                                             \
  }                                                                                               \
  inline void chooseFloat##variant(const DescriptorFormat& format, std::size_t stride,            \
                                   const Visit* visits, std::size_t count, Choice* choices) {     \
    if (format.type == DescriptorType::float32) {                                                 \
      chooseRows##variant<FloatRows##variant>(format, stride, visits, count, choices);            \
    } else if (format.type == DescriptorType::float16) {                                          \
      chooseRows##variant<HalfRows##variant>(format, stride, visits, count, choices);             \
    } else {                                                                                      \
      chooseRows##variant<ByteRows##variant>(format, stride, visits, count, choices);             \
    }                                                                                             \
  }

// Loops over a few registers: rolled up they would be memory.
#if defined(__clang__)
#define GSLAM_DETAIL_UNROLL _Pragma("clang loop unroll(full)")
#elif defined(__GNUC__)
#define GSLAM_DETAIL_UNROLL _Pragma("GCC unroll 4")
#else
#define GSLAM_DETAIL_UNROLL
#endif

#if GSLAM_X86

GSLAM_TARGET_SSE4

struct FloatRowsSse4 {
  explicit FloatRowsSse4(const DescriptorFormat&) {}
  __m128 load(const std::uint8_t* row, std::size_t i) const {
    return _mm_loadu_ps(reinterpret_cast<const float*>(row) + i);
  }
};
struct HalfRowsSse4 {
  explicit HalfRowsSse4(const DescriptorFormat&) {}
  __m128 load(const std::uint8_t* row, std::size_t i) const {
    const __m128i half =
        _mm_cvtepu16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + i * 2)));
    const __m128i magnitude = _mm_slli_epi32(_mm_and_si128(half, _mm_set1_epi32(0x7FFF)), 13);
    const __m128i sign = _mm_slli_epi32(_mm_and_si128(half, _mm_set1_epi32(0x8000)), 16);
    const __m128 scale = _mm_castsi128_ps(_mm_set1_epi32((127 + 112) << 23));
    return _mm_or_ps(_mm_mul_ps(_mm_castsi128_ps(magnitude), scale), _mm_castsi128_ps(sign));
  }
};
struct ByteRowsSse4 {
  explicit ByteRowsSse4(const DescriptorFormat& format)
      : scale(_mm_set1_ps(format.scale)), offset(_mm_set1_ps(format.offset)) {}
  __m128 load(const std::uint8_t* row, std::size_t i) const {
    std::int32_t steps;
    std::memcpy(&steps, row + i, 4);
    const __m128 step = _mm_cvtepi32_ps(_mm_cvtepi8_epi32(_mm_cvtsi32_si128(steps)));
    return _mm_add_ps(offset, _mm_mul_ps(scale, step));
  }
  __m128 scale, offset;
};

// Where the size is no multiple of four, the last numbers are taken one by one.
template <class Rows, int count>
inline void sumSquaresSse4(const DescriptorFormat& format, const std::uint8_t* query,
                           const std::uint8_t* rows, std::size_t stride, float* distances) {
  const Rows reader(format);
  const float* const values = reinterpret_cast<const float*>(query);
  __m128 sums[count];
  for (int c = 0; c < count; ++c) sums[c] = _mm_setzero_ps();
  std::size_t i = 0;
  for (; i + 4 <= format.size; i += 4) {
    const __m128 value = _mm_loadu_ps(values + i);
    GSLAM_DETAIL_UNROLL for (int c = 0; c < count; ++c) {
      const __m128 difference =
          _mm_sub_ps(value, reader.load(rows + static_cast<std::size_t>(c) * stride, i));
      sums[c] = _mm_add_ps(sums[c], _mm_mul_ps(difference, difference));
    }
  }
  for (int c = 0; c < count; ++c) {
    const __m128 pairs = _mm_add_ps(sums[c], _mm_movehl_ps(sums[c], sums[c]));
    distances[c] = _mm_cvtss_f32(_mm_add_ss(pairs, _mm_movehdup_ps(pairs)));
    for (std::size_t j = i; j < format.size; ++j) {
      const float difference =
          values[j] - elementOf(format, rows + static_cast<std::size_t>(c) * stride, j);
      distances[c] += difference * difference;
    }
  }
}

GSLAM_DETAIL_CHOOSE_FLOAT(Sse4)

GSLAM_TARGET_END

GSLAM_TARGET_AVX2

struct FloatRowsAvx2 {
  explicit FloatRowsAvx2(const DescriptorFormat&) {}
  __m256 load(const std::uint8_t* row, std::size_t i) const {
    return _mm256_loadu_ps(reinterpret_cast<const float*>(row) + i);
  }
};
struct HalfRowsAvx2 {
  explicit HalfRowsAvx2(const DescriptorFormat&) {}
  __m256 load(const std::uint8_t* row, std::size_t i) const {
    const __m256i half =
        _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(row + i * 2)));
    const __m256i magnitude =
        _mm256_slli_epi32(_mm256_and_si256(half, _mm256_set1_epi32(0x7FFF)), 13);
    const __m256i sign = _mm256_slli_epi32(_mm256_and_si256(half, _mm256_set1_epi32(0x8000)), 16);
    const __m256 scale = _mm256_castsi256_ps(_mm256_set1_epi32((127 + 112) << 23));
    return _mm256_or_ps(_mm256_mul_ps(_mm256_castsi256_ps(magnitude), scale),
                        _mm256_castsi256_ps(sign));
  }
};
struct ByteRowsAvx2 {
  explicit ByteRowsAvx2(const DescriptorFormat& format)
      : scale(_mm256_set1_ps(format.scale)), offset(_mm256_set1_ps(format.offset)) {}
  __m256 load(const std::uint8_t* row, std::size_t i) const {
    const __m256i step =
        _mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + i)));
    return _mm256_add_ps(offset, _mm256_mul_ps(scale, _mm256_cvtepi32_ps(step)));
  }
  __m256 scale, offset;
};

template <class Rows, int count>
inline void sumSquaresAvx2(const DescriptorFormat& format, const std::uint8_t* query,
                           const std::uint8_t* rows, std::size_t stride, float* distances) {
  const Rows reader(format);
  const float* const values = reinterpret_cast<const float*>(query);
  __m256 sums[count];
  for (int c = 0; c < count; ++c) sums[c] = _mm256_setzero_ps();
  std::size_t i = 0;
  for (; i + 8 <= format.size; i += 8) {
    const __m256 value = _mm256_loadu_ps(values + i);
    GSLAM_DETAIL_UNROLL for (int c = 0; c < count; ++c) {
      const __m256 difference =
          _mm256_sub_ps(value, reader.load(rows + static_cast<std::size_t>(c) * stride, i));
      sums[c] = _mm256_fmadd_ps(difference, difference, sums[c]);
    }
  }
  for (int c = 0; c < count; ++c) {
    const __m128 four =
        _mm_add_ps(_mm256_castps256_ps128(sums[c]), _mm256_extractf128_ps(sums[c], 1));
    const __m128 pairs = _mm_add_ps(four, _mm_movehl_ps(four, four));
    distances[c] = _mm_cvtss_f32(_mm_add_ss(pairs, _mm_movehdup_ps(pairs)));
    for (std::size_t j = i; j < format.size; ++j) {
      const float difference =
          values[j] - elementOf(format, rows + static_cast<std::size_t>(c) * stride, j);
      distances[c] += difference * difference;
    }
  }
}

GSLAM_DETAIL_CHOOSE_FLOAT(Avx2)

GSLAM_TARGET_END

GSLAM_TARGET_AVX512

struct FloatRowsAvx512 {
  explicit FloatRowsAvx512(const DescriptorFormat&) {}
  __m512 load(const std::uint8_t* row, std::size_t i, __mmask16 mask) const {
    return _mm512_maskz_loadu_ps(mask, reinterpret_cast<const float*>(row) + i);
  }
};
struct HalfRowsAvx512 {
  explicit HalfRowsAvx512(const DescriptorFormat&) {}
  __m512 load(const std::uint8_t* row, std::size_t i, __mmask16 mask) const {
    return _mm512_cvtph_ps(_mm256_maskz_loadu_epi16(mask, row + i * 2));
  }
};
struct ByteRowsAvx512 {
  explicit ByteRowsAvx512(const DescriptorFormat& format)
      : scale(_mm512_set1_ps(format.scale)), offset(_mm512_set1_ps(format.offset)) {}
  __m512 load(const std::uint8_t* row, std::size_t i, __mmask16 mask) const {
    const __m512 step =
        _mm512_cvtepi32_ps(_mm512_cvtepi8_epi32(_mm_maskz_loadu_epi8(mask, row + i)));
    return _mm512_maskz_add_ps(mask, offset, _mm512_mul_ps(scale, step));
  }
  __m512 scale, offset;
};

template <class Rows, int count>
inline void sumSquaresAvx512(const DescriptorFormat& format, const std::uint8_t* query,
                             const std::uint8_t* rows, std::size_t stride, float* distances) {
  const Rows reader(format);
  const float* const values = reinterpret_cast<const float*>(query);
  __m512 sums[count];
  for (int c = 0; c < count; ++c) sums[c] = _mm512_setzero_ps();
  for (std::size_t i = 0; i < format.size; i += 16) {
    const std::size_t left = format.size - i;
    const auto mask = static_cast<__mmask16>(left >= 16 ? 0xFFFFu : (1u << left) - 1u);
    const __m512 value = _mm512_maskz_loadu_ps(mask, values + i);
    GSLAM_DETAIL_UNROLL for (int c = 0; c < count; ++c) {
      const __m512 difference =
          _mm512_sub_ps(value, reader.load(rows + static_cast<std::size_t>(c) * stride, i, mask));
      sums[c] = _mm512_fmadd_ps(difference, difference, sums[c]);
    }
  }
  for (int c = 0; c < count; ++c) distances[c] = _mm512_reduce_add_ps(sums[c]);
}

GSLAM_DETAIL_CHOOSE_FLOAT(Avx512)

GSLAM_TARGET_END

#elif GSLAM_ARM64

struct FloatRowsNeon {
  explicit FloatRowsNeon(const DescriptorFormat&) {}
  float32x4_t load(const std::uint8_t* row, std::size_t i) const {
    return vld1q_f32(reinterpret_cast<const float*>(row) + i);
  }
};
struct HalfRowsNeon {
  explicit HalfRowsNeon(const DescriptorFormat&) {}
  float32x4_t load(const std::uint8_t* row, std::size_t i) const {
    return vcvt_f32_f16(vreinterpret_f16_u8(vld1_u8(row + i * 2)));
  }
};
struct ByteRowsNeon {
  explicit ByteRowsNeon(const DescriptorFormat& format)
      : scale(vdupq_n_f32(format.scale)), offset(vdupq_n_f32(format.offset)) {}
  float32x4_t load(const std::uint8_t* row, std::size_t i) const {
    std::uint32_t steps;
    std::memcpy(&steps, row + i, 4);
    const int16x8_t wide = vmovl_s8(vreinterpret_s8_u32(vdup_n_u32(steps)));
    const float32x4_t step = vcvtq_f32_s32(vmovl_s16(vget_low_s16(wide)));
    return vaddq_f32(offset, vmulq_f32(scale, step));
  }
  float32x4_t scale, offset;
};

template <class Rows, int count>
inline void sumSquaresNeon(const DescriptorFormat& format, const std::uint8_t* query,
                           const std::uint8_t* rows, std::size_t stride, float* distances) {
  const Rows reader(format);
  const float* const values = reinterpret_cast<const float*>(query);
  float32x4_t sums[count];
  for (int c = 0; c < count; ++c) sums[c] = vdupq_n_f32(0);
  std::size_t i = 0;
  for (; i + 4 <= format.size; i += 4) {
    const float32x4_t value = vld1q_f32(values + i);
    GSLAM_DETAIL_UNROLL for (int c = 0; c < count; ++c) {
      const float32x4_t difference =
          vsubq_f32(value, reader.load(rows + static_cast<std::size_t>(c) * stride, i));
      sums[c] = vfmaq_f32(sums[c], difference, difference);
    }
  }
  for (int c = 0; c < count; ++c) {
    distances[c] = vaddvq_f32(sums[c]);
    for (std::size_t j = i; j < format.size; ++j) {
      const float difference =
          values[j] - elementOf(format, rows + static_cast<std::size_t>(c) * stride, j);
      distances[c] += difference * difference;
    }
  }
}

GSLAM_DETAIL_CHOOSE_FLOAT(Neon)

#endif

#undef GSLAM_DETAIL_CHOOSE_FLOAT
#undef GSLAM_DETAIL_UNROLL

// The kernels for descriptors of numbers.
inline SimdKernel<ChooseFunction> floatKernel() {
  return SimdKernel<ChooseFunction>(chooseFloatScalar, GSLAM_IF_X86(chooseFloatSse4),
                                    GSLAM_IF_X86(chooseFloatAvx2), GSLAM_IF_X86(chooseFloatAvx512),
                                    GSLAM_IF_ARM64(chooseFloatNeon));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_L2_H
