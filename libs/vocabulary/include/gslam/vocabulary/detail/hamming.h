// The nearest of a few binary descriptors, in all variants of SIMD.
#ifndef GSLAM_VOCABULARY_DETAIL_HAMMING_H
#define GSLAM_VOCABULARY_DETAIL_HAMMING_H

#include <gslam/base/platform.h>
#include <gslam/base/simd.h>
#include <gslam/vocabulary/detail/visit.h>

#include <algorithm>
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

// A distance and the index of its row in one number, so that the least number is the nearest row,
// and of equal ones the first.
constexpr std::uint32_t kIndexBits = 6;

inline Choice choiceOf(std::uint32_t key) noexcept {
  return Choice{key & 63u, static_cast<float>(key >> kIndexBits)};
}

inline std::uint64_t loadWord(const std::uint8_t* bytes) noexcept {
  std::uint64_t word;
  std::memcpy(&word, bytes, 8);
  return word;
}

// Bits that are set (H. S. Warren, "Hacker's Delight", 2nd edition, figure 5-2).
inline std::uint32_t countBits(std::uint64_t x) noexcept {
  x -= (x >> 1) & 0x5555555555555555u;
  x = (x & 0x3333333333333333u) + ((x >> 2) & 0x3333333333333333u);
  x = (x + (x >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
  return static_cast<std::uint32_t>((x * 0x0101010101010101u) >> 56);
}

inline void chooseBinaryScalar(const DescriptorFormat&, std::size_t stride, const Visit* visits,
                               std::size_t count, Choice* choices) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kFetchAhead < count) fetchRows(visits[i + kFetchAhead], stride);
    const Visit& visit = visits[i];
    std::uint32_t best = 0xFFFFFFFFu;
    for (std::uint32_t c = 0; c < visit.count; ++c) {
      const std::uint8_t* const row = visit.rows + c * stride;
      std::uint32_t distance = 0;
      for (std::size_t at = 0; at < stride; at += 8) {
        distance += countBits(loadWord(visit.query + at) ^ loadWord(row + at));
      }
      best = std::min(best, (distance << kIndexBits) | c);
    }
    choices[i] = choiceOf(best);
  }
}

#if GSLAM_X86

GSLAM_TARGET_SSE4

inline std::uint32_t popcountOfDifference(const std::uint8_t* a, const std::uint8_t* b) noexcept {
  return static_cast<std::uint32_t>(_mm_popcnt_u64(loadWord(a) ^ loadWord(b)));
}

inline void chooseBinarySse4(const DescriptorFormat&, std::size_t stride, const Visit* visits,
                             std::size_t count, Choice* choices) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kFetchAhead < count) fetchRows(visits[i + kFetchAhead], stride);
    const Visit& visit = visits[i];
    std::uint32_t best = 0xFFFFFFFFu;
    for (std::uint32_t c = 0; c < visit.count; ++c) {
      const std::uint8_t* const row = visit.rows + c * stride;
      std::uint32_t distance = 0;
      for (std::size_t at = 0; at < stride; at += 8) {
        distance += popcountOfDifference(visit.query + at, row + at);
      }
      best = std::min(best, (distance << kIndexBits) | c);
    }
    choices[i] = choiceOf(best);
  }
}

GSLAM_TARGET_END

GSLAM_TARGET_AVX2

// Bits set in each 8 bytes: those of half bytes are looked up (W. Mula, "SSSE3: fast popcount",
// 2008).
inline __m256i countBits256(__m256i x) {
  const __m256i table = _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4, 0, 1, 1, 2,
                                         1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const __m256i low = _mm256_set1_epi8(15);
  const __m256i counts =
      _mm256_add_epi8(_mm256_shuffle_epi8(table, _mm256_and_si256(x, low)),
                      _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi16(x, 4), low)));
  return _mm256_sad_epu8(counts, _mm256_setzero_si256());
}

inline __m256i countDifference256(__m256i query, const std::uint8_t* row) {
  return countBits256(
      _mm256_xor_si256(query, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row))));
}

// Rows of 32 bytes: four distances side by side in one register.
inline std::uint32_t nearest32Avx2(const Visit& visit) {
  const __m256i query = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(visit.query));
  std::uint32_t best = 0xFFFFFFFFu;
  for (std::uint32_t c = 0; c < visit.count; c += 4) {
    __m256i sums = countDifference256(query, visit.rows + c * 32);
    for (std::uint32_t j = 1; j < 4 && c + j < visit.count; ++j) {
      const __m256i bits = countDifference256(query, visit.rows + (c + j) * 32);
      sums = _mm256_add_epi64(sums, _mm256_slli_epi64(bits, static_cast<int>(16 * j)));
    }
    const __m128i halves =
        _mm_add_epi64(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
    std::uint64_t packed = static_cast<std::uint64_t>(_mm_cvtsi128_si64(halves)) +
                           static_cast<std::uint64_t>(_mm_extract_epi64(halves, 1));
    for (std::uint32_t j = 0; j < 4 && c + j < visit.count; ++j, packed >>= 16) {
      best = std::min(best, static_cast<std::uint32_t>((packed & 0xFFFF) << kIndexBits) | (c + j));
    }
  }
  return best;
}

inline std::uint32_t distanceAvx2(const std::uint8_t* a, const std::uint8_t* b,
                                  std::size_t stride) {
  __m256i sum = _mm256_setzero_si256();
  std::size_t at = 0;
  for (; at + 32 <= stride; at += 32) {
    const __m256i query = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(a + at));
    sum = _mm256_add_epi64(sum, countDifference256(query, b + at));
  }
  const __m128i halves =
      _mm_add_epi64(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
  auto distance =
      static_cast<std::uint32_t>(_mm_cvtsi128_si64(halves) + _mm_extract_epi64(halves, 1));
  for (; at < stride; at += 8) {
    distance += static_cast<std::uint32_t>(_mm_popcnt_u64(loadWord(a + at) ^ loadWord(b + at)));
  }
  return distance;
}

inline void chooseBinaryAvx2(const DescriptorFormat&, std::size_t stride, const Visit* visits,
                             std::size_t count, Choice* choices) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kFetchAhead < count) fetchRows(visits[i + kFetchAhead], stride);
    const Visit& visit = visits[i];
    std::uint32_t best = 0xFFFFFFFFu;
    if (stride == 32) {
      best = nearest32Avx2(visit);
    } else {
      for (std::uint32_t c = 0; c < visit.count; ++c) {
        const std::uint32_t distance = distanceAvx2(visit.query, visit.rows + c * stride, stride);
        best = std::min(best, (distance << kIndexBits) | c);
      }
    }
    choices[i] = choiceOf(best);
  }
}

GSLAM_TARGET_END

// The same twice: with an instruction that counts bits, and without. Rows of 32 bytes are taken by
// ten: each half of a register is a row, and five registers hold the bits of rows 0 2 4 6 8 and
// 1 3 5 7 9, which are added up side by side, in 12 bits each.
#define GSLAM_DETAIL_CHOOSE_AVX512(name)                                                           \
  inline __m512i countDifference##name(__m512i query, const std::uint8_t* rows) {                  \
    return countBits512##name(_mm512_xor_si512(query, _mm512_loadu_si512(rows)));                  \
  }                                                                                                \
  inline __m512i countTen##name(__m512i query, const std::uint8_t* rows) {                         \
    const __m512i a = countDifference##name(query, rows);                                          \
    const __m512i b = _mm512_slli_epi64(countDifference##name(query, rows + 64), 12);              \
    const __m512i c = _mm512_slli_epi64(countDifference##name(query, rows + 128), 24);             \
    const __m512i d = _mm512_slli_epi64(countDifference##name(query, rows + 192), 36);             \
    const __m512i e = _mm512_slli_epi64(countDifference##name(query, rows + 256), 48);             \
    return _mm512_add_epi64(_mm512_add_epi64(_mm512_add_epi64(a, b), _mm512_add_epi64(c, d)), e);  \
  }                                                                                                \
  inline __m512i countRest##name(__m512i query, const std::uint8_t* rows, std::uint32_t count) {   \
    __m512i sums = _mm512_setzero_si512();                                                         \
    for (std::uint32_t at = 0; at < count; at += 2) {                                              \
      const __mmask8 mask = at + 1 < count ? 0xFF : 0x0F;                                          \
      const __m512i row = _mm512_maskz_loadu_epi64(mask, rows + std::size_t(at) * 32);             \
      const __m512i bits = countBits512##name(_mm512_xor_si512(row, query));                       \
      sums = _mm512_add_epi64(sums, _mm512_sll_epi64(bits, _mm_cvtsi32_si128(int(at * 6))));       \
    }                                                                                              \
    return sums;                                                                                   \
  }                                                                                                \
  /* Rows that are not there are farther than any. */                                              \
  inline __m512i keysOf##name(__m512i sums, std::uint32_t count) {                                 \
    sums = _mm512_add_epi64(sums, _mm512_permutex_epi64(sums, 0xB1));                              \
    sums = _mm512_add_epi64(sums, _mm512_permutex_epi64(sums, 0x4E));                              \
    const __m512i low = _mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7);                                 \
    const __m512i high = _mm512_setr_epi64(8, 8, 8, 8, 9, 9, 9, 9);                                \
    const __m512i distances =                                                                      \
        _mm512_and_si512(_mm512_srlv_epi64(sums, _mm512_setr_epi64(0, 12, 24, 36, 0, 12, 24, 36)), \
                         _mm512_set1_epi64(0xFFF));                                                \
    __m512i keys = _mm512_or_si512(_mm512_slli_epi64(distances, kIndexBits), low);                 \
    __m512i last =                                                                                 \
        _mm512_or_si512(_mm512_slli_epi64(_mm512_srli_epi64(sums, 48), kIndexBits), high);         \
    if (count < 10) {                                                                              \
      const __m512i end = _mm512_set1_epi64(count);                                                \
      const __m512i far = _mm512_set1_epi64(0xFFFF);                                               \
      keys = _mm512_mask_mov_epi64(far, _mm512_cmplt_epi64_mask(low, end), keys);                  \
      last = _mm512_mask_mov_epi64(far, _mm512_cmplt_epi64_mask(high, end), last);                 \
    }                                                                                              \
    return _mm512_min_epu64(keys, last);                                                           \
  }                                                                                                \
  inline __m512i keysOfSome##name(__m512i query, const std::uint8_t* rows, std::uint32_t count) {  \
    if (count >= 10) return keysOf##name(countTen##name(query, rows), 10);                         \
    return keysOf##name(countRest##name(query, rows, count), count);                               \
  }                                                                                                \
  inline std::uint32_t nearest32##name(const Visit& visit) {                                       \
    const __m512i query =                                                                          \
        _mm512_broadcast_i64x4(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(visit.query))); \
    __m512i keys = keysOfSome##name(query, visit.rows, visit.count);                               \
    for (std::uint32_t begin = 10; begin < visit.count; begin += 10) {                             \
      const __m512i more =                                                                         \
          keysOfSome##name(query, visit.rows + std::size_t(begin) * 32, visit.count - begin);      \
      keys = _mm512_min_epu64(keys, _mm512_add_epi64(more, _mm512_set1_epi64(begin)));             \
    }                                                                                              \
    const __m128i nearest = _mm_minpos_epu16(_mm512_cvtepi64_epi16(keys));                         \
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(nearest)) & 0xFFFFu;                       \
  }                                                                                                \
  inline std::uint32_t distance##name(const std::uint8_t* a, const std::uint8_t* b,                \
                                      std::size_t stride) {                                        \
    __m512i sum = _mm512_setzero_si512();                                                          \
    for (std::size_t at = 0; at < stride; at += 64) {                                              \
      const auto words = static_cast<std::uint32_t>(std::min<std::size_t>(8, (stride - at) / 8));  \
      const auto mask = static_cast<__mmask8>(_bzhi_u32(0xFFu, words));                            \
      sum = _mm512_add_epi64(                                                                      \
          sum, countBits512##name(_mm512_xor_si512(_mm512_maskz_loadu_epi64(mask, a + at),         \
                                                   _mm512_maskz_loadu_epi64(mask, b + at))));      \
    }                                                                                              \
    return static_cast<std::uint32_t>(_mm512_reduce_add_epi64(sum));                               \
  }                                                                                                \
  inline void chooseBinary##name(const DescriptorFormat&, std::size_t stride, const Visit* visits, \
                                 std::size_t count, Choice* choices) {                             \
    for (std::size_t i = 0; i < count; ++i) {                                                      \
      if (i + kFetchAhead < count) fetchRows(visits[i + kFetchAhead], stride);                     \
      const Visit& visit = visits[i];                                                              \
      std::uint32_t best = 0xFFFFFFFFu;                                                            \
      if (stride == 32) {                                                                          \
        best = nearest32##name(visit);                                                             \
      } else {                                                                                     \
        for (std::uint32_t c = 0; c < visit.count; ++c) {                                          \
          const std::uint32_t distance =                                                           \
              distance##name(visit.query, visit.rows + c * stride, stride);                        \
          best = std::min(best, (distance << kIndexBits) | c);                                     \
        }                                                                                          \
      }                                                                                            \
      choices[i] = choiceOf(best);                                                                 \
    }                                                                                              \
  }

GSLAM_TARGET_AVX512

// As countBits256().
inline __m512i countBits512Avx512(__m512i x) {
  const __m512i table =
      _mm512_broadcast_i32x4(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
  const __m512i low = _mm512_set1_epi8(15);
  const __m512i counts =
      _mm512_add_epi8(_mm512_shuffle_epi8(table, _mm512_and_si512(x, low)),
                      _mm512_shuffle_epi8(table, _mm512_and_si512(_mm512_srli_epi16(x, 4), low)));
  return _mm512_sad_epu8(counts, _mm512_setzero_si512());
}

GSLAM_DETAIL_CHOOSE_AVX512(Avx512)

GSLAM_TARGET_END

GSLAM_TARGET_AVX512_POPCNT

inline __m512i countBits512Avx512Popcnt(__m512i x) {
  return _mm512_popcnt_epi64(x);
}

GSLAM_DETAIL_CHOOSE_AVX512(Avx512Popcnt)

GSLAM_TARGET_END

#undef GSLAM_DETAIL_CHOOSE_AVX512

#elif GSLAM_ARM64

inline std::uint32_t distanceNeon(const std::uint8_t* a, const std::uint8_t* b,
                                  std::size_t stride) noexcept {
  std::uint32_t distance = 0;
  std::size_t at = 0;
  for (; at + 16 <= stride; at += 16) {
    distance += vaddlvq_u8(vcntq_u8(veorq_u8(vld1q_u8(a + at), vld1q_u8(b + at))));
  }
  if (at < stride) distance += vaddlv_u8(vcnt_u8(veor_u8(vld1_u8(a + at), vld1_u8(b + at))));
  return distance;
}

inline void chooseBinaryNeon(const DescriptorFormat&, std::size_t stride, const Visit* visits,
                             std::size_t count, Choice* choices) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kFetchAhead < count) fetchRows(visits[i + kFetchAhead], stride);
    const Visit& visit = visits[i];
    std::uint32_t best = 0xFFFFFFFFu;
    for (std::uint32_t c = 0; c < visit.count; ++c) {
      const std::uint32_t distance = distanceNeon(visit.query, visit.rows + c * stride, stride);
      best = std::min(best, (distance << kIndexBits) | c);
    }
    choices[i] = choiceOf(best);
  }
}

#endif

// The kernels for binary descriptors. Those for AVX-512 come in two, of which the machine has one
// or both.
inline SimdKernel<ChooseFunction> binaryKernel() {
#if GSLAM_X86
  static const bool has_popcnt = detectCpu().avx512_popcnt;
  const ChooseFunction avx512 = has_popcnt ? chooseBinaryAvx512Popcnt : chooseBinaryAvx512;
#else
  const ChooseFunction avx512 = nullptr;
#endif
  return SimdKernel<ChooseFunction>(chooseBinaryScalar, GSLAM_IF_X86(chooseBinarySse4),
                                    GSLAM_IF_X86(chooseBinaryAvx2), avx512,
                                    GSLAM_IF_ARM64(chooseBinaryNeon));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_HAMMING_H
