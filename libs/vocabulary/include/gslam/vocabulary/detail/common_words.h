// The words that two bags have in common.
#ifndef GSLAM_VOCABULARY_DETAIL_COMMON_WORDS_H
#define GSLAM_VOCABULARY_DETAIL_COMMON_WORDS_H

#include <gslam/base/simd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#if GSLAM_X86
#include <immintrin.h>
#elif GSLAM_ARM64
#include <arm_neon.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

// Two ascending lists, and how far they have been searched.
struct WordLists {
  const std::uint32_t* a;
  std::size_t a_size;
  const std::uint32_t* b;
  std::size_t b_size;
  std::size_t a_place;
  std::size_t b_place;

  bool areDone() const noexcept { return a_place == a_size || b_place == b_size; }
};

// Where words that are in both lists stand in each. Kernels write up to 8 places too far.
struct CommonWords {
  enum : std::size_t { kCapacity = 256 };  // needs no definition in C++11
  std::uint32_t in_a[kCapacity + 8];
  std::uint32_t in_b[kCapacity + 8];
};

// All kernels find the same, in ascending order, whatever the instruction set: a block of one list
// is compared with a block of the other, and the block with the lower end is left behind
// (B. Schlegel, T. Willhalm, W. Lehner, "Fast Sorted-Set Intersection using SIMD Instructions",
// ADMS 2011). Whether a block has a common word cannot be foretold, so there are few branches.
inline std::size_t findCommonRest(WordLists& lists, CommonWords& found, std::size_t count) {
  std::size_t i = lists.a_place;
  std::size_t j = lists.b_place;
  while (i < lists.a_size && j < lists.b_size && count < CommonWords::kCapacity) {
    const std::uint32_t x = lists.a[i];
    const std::uint32_t y = lists.b[j];
    found.in_a[count] = static_cast<std::uint32_t>(i);
    found.in_b[count] = static_cast<std::uint32_t>(j);
    count += x == y ? 1 : 0;
    i += x <= y ? 1 : 0;
    j += y <= x ? 1 : 0;
  }
  lists.a_place = i;
  lists.b_place = j;
  return count;
}

inline std::size_t findCommonScalar(WordLists& lists, CommonWords& found) {
  return findCommonRest(lists, found, 0);
}

// The numbers of the bits that are set in four.
inline const std::uint32_t* bitNumbers(unsigned bits) noexcept {
  alignas(16) static const std::uint32_t numbers[16][4] = {
      {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {2, 0, 0, 0}, {0, 2, 0, 0},
      {1, 2, 0, 0}, {0, 1, 2, 0}, {3, 0, 0, 0}, {0, 3, 0, 0}, {1, 3, 0, 0}, {0, 1, 3, 0},
      {2, 3, 0, 0}, {0, 2, 3, 0}, {1, 2, 3, 0}, {0, 1, 2, 3}};
  return numbers[bits];
}

inline unsigned bitCountOf4(unsigned bits) noexcept {
  return static_cast<unsigned>(0x4332322132212110u >> (4 * bits)) & 15;
}

#if GSLAM_X86
GSLAM_TARGET_SSE4

inline unsigned signsSse4(__m128i lanes) noexcept {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(lanes)));
}

inline void writePlacesSse4(std::uint32_t* to, std::size_t begin, unsigned bits) noexcept {
  const __m128i numbers = _mm_load_si128(reinterpret_cast<const __m128i*>(bitNumbers(bits)));
  const __m128i places = _mm_add_epi32(numbers, _mm_set1_epi32(static_cast<int>(begin)));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), places);
}

inline std::size_t findCommonSse4(WordLists& lists, CommonWords& found) {
  std::size_t i = lists.a_place;
  std::size_t j = lists.b_place;
  std::size_t count = 0;
  while (lists.a_size - i >= 4 && lists.b_size - j >= 4 && count <= CommonWords::kCapacity - 4) {
    const __m128i x = _mm_loadu_si128(reinterpret_cast<const __m128i*>(lists.a + i));
    const __m128i y = _mm_loadu_si128(reinterpret_cast<const __m128i*>(lists.b + j));
    const __m128i same0 = _mm_cmpeq_epi32(x, y);
    const __m128i same1 = _mm_cmpeq_epi32(x, _mm_shuffle_epi32(y, 0x39));  // y 1 2 3 0
    const __m128i same2 = _mm_cmpeq_epi32(x, _mm_shuffle_epi32(y, 0x4E));  // y 2 3 0 1
    const __m128i same3 = _mm_cmpeq_epi32(x, _mm_shuffle_epi32(y, 0x93));  // y 3 0 1 2
    const unsigned in_a =
        signsSse4(_mm_or_si128(_mm_or_si128(same0, same1), _mm_or_si128(same2, same3)));
    const unsigned in_b = signsSse4(
        _mm_or_si128(_mm_or_si128(same0, _mm_shuffle_epi32(same1, 0x93)),
                     _mm_or_si128(_mm_shuffle_epi32(same2, 0x4E), _mm_shuffle_epi32(same3, 0x39))));
    writePlacesSse4(found.in_a + count, i, in_a);
    writePlacesSse4(found.in_b + count, j, in_b);
    count += bitCountOf4(in_a);
    const std::uint32_t x_end = lists.a[i + 3];
    const std::uint32_t y_end = lists.b[j + 3];
    i += x_end <= y_end ? 4 : 0;
    j += y_end <= x_end ? 4 : 0;
  }
  lists.a_place = i;
  lists.b_place = j;
  return findCommonRest(lists, found, count);
}

GSLAM_TARGET_END
GSLAM_TARGET_AVX2

inline unsigned signsAvx2(__m256i lanes) noexcept {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(lanes)));
}

inline void writePlacesAvx2(std::uint32_t* to, std::size_t begin, unsigned bits) noexcept {
  writePlacesSse4(to, begin, bits & 15);
  writePlacesSse4(to + bitCountOf4(bits & 15), begin + 4, bits >> 4);
}

// Compares x with y turned by none, one, two and three within halves.
struct TurnsAvx2 {
  __m256i same[4];

  TurnsAvx2(__m256i x, __m256i y) noexcept
      : same{_mm256_cmpeq_epi32(x, y), _mm256_cmpeq_epi32(x, _mm256_shuffle_epi32(y, 0x39)),
             _mm256_cmpeq_epi32(x, _mm256_shuffle_epi32(y, 0x4E)),
             _mm256_cmpeq_epi32(x, _mm256_shuffle_epi32(y, 0x93))} {}
  __m256i inX() const noexcept {
    return _mm256_or_si256(_mm256_or_si256(same[0], same[1]), _mm256_or_si256(same[2], same[3]));
  }
  __m256i inY() const noexcept {
    return _mm256_or_si256(
        _mm256_or_si256(same[0], _mm256_shuffle_epi32(same[1], 0x93)),
        _mm256_or_si256(_mm256_shuffle_epi32(same[2], 0x4E), _mm256_shuffle_epi32(same[3], 0x39)));
  }
};

// Here most pairs of blocks have nothing in common, so there is a branch. With AVX-512 (16 times
// 16 words, or its compressing stores) nothing was won, so it has no kernel of its own.
inline std::size_t findCommonAvx2(WordLists& lists, CommonWords& found) {
  std::size_t i = lists.a_place;
  std::size_t j = lists.b_place;
  std::size_t count = 0;
  while (lists.a_size - i >= 8 && lists.b_size - j >= 8 && count <= CommonWords::kCapacity - 8) {
    const __m256i x = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(lists.a + i));
    const __m256i y = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(lists.b + j));
    const TurnsAvx2 straight(x, y);
    const TurnsAvx2 crossed(x, _mm256_permute2x128_si256(y, y, 1));
    const unsigned in_a = signsAvx2(_mm256_or_si256(straight.inX(), crossed.inX()));
    if (in_a != 0) {
      const __m256i other = crossed.inY();
      const unsigned in_b =
          signsAvx2(_mm256_or_si256(straight.inY(), _mm256_permute2x128_si256(other, other, 1)));
      writePlacesAvx2(found.in_a + count, i, in_a);
      writePlacesAvx2(found.in_b + count, j, in_b);
      // They are as many, but where a list has a word twice; behind the fewer nothing was written.
      count += static_cast<unsigned>(std::min(_mm_popcnt_u32(in_a), _mm_popcnt_u32(in_b)));
    }
    const std::uint32_t x_end = lists.a[i + 7];
    const std::uint32_t y_end = lists.b[j + 7];
    i += x_end <= y_end ? 8 : 0;
    j += y_end <= x_end ? 8 : 0;
  }
  lists.a_place = i;
  lists.b_place = j;
  return findCommonRest(lists, found, count);
}

GSLAM_TARGET_END
#endif  // GSLAM_X86

#if GSLAM_ARM64

inline unsigned signsNeon(uint32x4_t lanes) noexcept {
  static const std::uint32_t bits[4] = {1, 2, 4, 8};
  return vaddvq_u32(vandq_u32(lanes, vld1q_u32(bits)));
}

inline void writePlacesNeon(std::uint32_t* to, std::size_t begin, unsigned bits) noexcept {
  const uint32x4_t all = vdupq_n_u32(static_cast<std::uint32_t>(begin));
  vst1q_u32(to, vaddq_u32(vld1q_u32(bitNumbers(bits)), all));
}

inline std::size_t findCommonNeon(WordLists& lists, CommonWords& found) {
  std::size_t i = lists.a_place;
  std::size_t j = lists.b_place;
  std::size_t count = 0;
  while (lists.a_size - i >= 4 && lists.b_size - j >= 4 && count <= CommonWords::kCapacity - 4) {
    const uint32x4_t x = vld1q_u32(lists.a + i);
    const uint32x4_t y = vld1q_u32(lists.b + j);
    const uint32x4_t same0 = vceqq_u32(x, y);
    const uint32x4_t same1 = vceqq_u32(x, vextq_u32(y, y, 1));
    const uint32x4_t same2 = vceqq_u32(x, vextq_u32(y, y, 2));
    const uint32x4_t same3 = vceqq_u32(x, vextq_u32(y, y, 3));
    const unsigned in_a = signsNeon(vorrq_u32(vorrq_u32(same0, same1), vorrq_u32(same2, same3)));
    const unsigned in_b =
        signsNeon(vorrq_u32(vorrq_u32(same0, vextq_u32(same1, same1, 3)),
                            vorrq_u32(vextq_u32(same2, same2, 2), vextq_u32(same3, same3, 1))));
    writePlacesNeon(found.in_a + count, i, in_a);
    writePlacesNeon(found.in_b + count, j, in_b);
    count += bitCountOf4(in_a);
    const std::uint32_t x_end = lists.a[i + 3];
    const std::uint32_t y_end = lists.b[j + 3];
    i += x_end <= y_end ? 4 : 0;
    j += y_end <= x_end ? 4 : 0;
  }
  lists.a_place = i;
  lists.b_place = j;
  return findCommonRest(lists, found, count);
}

#endif  // GSLAM_ARM64

using FindCommon = std::size_t (*)(WordLists&, CommonWords&);

// Finds the next common words, and returns how many; goes on where it stopped. When none are left,
// the lists are done. Lists that do not ascend give something else, but are not left.
inline const SimdKernel<FindCommon>& findCommonKernel() noexcept {
  static constexpr SimdKernel<FindCommon> kernel(findCommonScalar, GSLAM_IF_X86(findCommonSse4),
                                                 GSLAM_IF_X86(findCommonAvx2), nullptr,
                                                 GSLAM_IF_ARM64(findCommonNeon));
  return kernel;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_COMMON_WORDS_H
