#include "matching/descriptors.h"

#include <gslam/base/error.h>
#include <gslam/base/simd.h>

#include <cmath>
#include <cstring>
#include <string>

#if GSLAM_X86
#include <immintrin.h>
#elif GSLAM_ARM64
#include <arm_neon.h>
#endif

namespace visual {
namespace {

using Rows = gslam::Span<const std::uint32_t>;

// Bits that differ between one descriptor and some rows of a table, times `scale`.
using BitKernel = void (*)(const std::uint8_t* query, const std::uint8_t* table, std::size_t stride,
                           std::size_t bytes, Rows rows, float scale, float* distances);

std::uint64_t wordAt(const std::uint8_t* bytes) noexcept {
  std::uint64_t word;
  std::memcpy(&word, bytes, 8);
  return word;
}

// Fewer than 8 bytes; what is missing is zero.
std::uint64_t partAt(const std::uint8_t* bytes, std::size_t count) noexcept {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, count);
  return word;
}

// Bits that are set (H. S. Warren, "Hacker's Delight", 2nd edition, figure 5-2).
std::uint32_t bitsOf(std::uint64_t x) noexcept {
  x -= (x >> 1) & 0x5555555555555555U;
  x = (x & 0x3333333333333333U) + ((x >> 2) & 0x3333333333333333U);
  x = (x + (x >> 4)) & 0x0F0F0F0F0F0F0F0FU;
  return std::uint32_t((x * 0x0101010101010101U) >> 56);
}

void countScalar(const std::uint8_t* query, const std::uint8_t* table, std::size_t stride,
                 std::size_t bytes, Rows rows, float scale, float* distances) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::uint8_t* const row = table + stride * rows[i];
    std::uint32_t bits = 0;
    std::size_t at = 0;
    for (; at + 8 <= bytes; at += 8) bits += bitsOf(wordAt(query + at) ^ wordAt(row + at));
    if (at < bytes) bits += bitsOf(partAt(query + at, bytes - at) ^ partAt(row + at, bytes - at));
    distances[i] = float(bits) * scale;
  }
}

#if GSLAM_X86

GSLAM_TARGET_SSE4

// All that there is time for in a row of 32 bytes is to fetch it: wider registers gain nothing.
void countSse4(const std::uint8_t* query, const std::uint8_t* table, std::size_t stride,
               std::size_t bytes, Rows rows, float scale, float* distances) {
  const auto differ = [](std::uint64_t a, std::uint64_t b) { return _mm_popcnt_u64(a ^ b); };
  if (bytes == 32) {
    const std::uint64_t a = wordAt(query), b = wordAt(query + 8), c = wordAt(query + 16),
                        d = wordAt(query + 24);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::uint8_t* const row = table + stride * rows[i];
      const auto bits = differ(a, wordAt(row)) + differ(b, wordAt(row + 8)) +
                        differ(c, wordAt(row + 16)) + differ(d, wordAt(row + 24));
      distances[i] = float(int(bits)) * scale;
    }
    return;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::uint8_t* const row = table + stride * rows[i];
    long long bits = 0;
    std::size_t at = 0;
    for (; at + 8 <= bytes; at += 8) bits += differ(wordAt(query + at), wordAt(row + at));
    if (at < bytes) bits += differ(partAt(query + at, bytes - at), partAt(row + at, bytes - at));
    distances[i] = float(int(bits)) * scale;
  }
}

GSLAM_TARGET_END

#elif GSLAM_ARM64

void countNeon(const std::uint8_t* query, const std::uint8_t* table, std::size_t stride,
               std::size_t bytes, Rows rows, float scale, float* distances) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::uint8_t* const row = table + stride * rows[i];
    std::uint32_t bits = 0;
    std::size_t at = 0;
    for (; at + 16 <= bytes; at += 16) {
      bits += vaddlvq_u8(vcntq_u8(veorq_u8(vld1q_u8(query + at), vld1q_u8(row + at))));
    }
    for (; at < bytes; at += 8) {
      const std::size_t part = bytes - at < 8 ? bytes - at : 8;
      bits += bitsOf(partAt(query + at, part) ^ partAt(row + at, part));
    }
    distances[i] = float(bits) * scale;
  }
}

#endif

float squaredLength(const float* a, std::size_t size) noexcept {
  float sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += a[i] * a[i];
  return sum;
}

// Four sums side by side, which the processor need not wait for one after the other.
float squaredDifference(const float* a, const float* b, std::size_t size) noexcept {
  float sums[4] = {0, 0, 0, 0};
  std::size_t i = 0;
  for (; i + 4 <= size; i += 4) {
    for (std::size_t j = 0; j < 4; ++j) {
      const float difference = a[i + j] - b[i + j];
      sums[j] += difference * difference;
    }
  }
  for (; i < size; ++i) sums[0] += (a[i] - b[i]) * (a[i] - b[i]);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

void compareFloats(const float* query, const gslam::Image& table, Rows rows, float* distances) {
  const std::size_t size = std::size_t(table.width()) * std::size_t(table.channels());
  const float length = std::sqrt(squaredLength(query, size));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const float* const row = table.row<float>(int(rows[i]));
    const float most = length + std::sqrt(squaredLength(row, size));
    distances[i] = most > 0 ? std::sqrt(squaredDifference(query, row, size)) / most : 0;
  }
}

void compare(const std::uint8_t* query, const gslam::Image& kind, const std::uint8_t* table,
             Rows rows, float* distances) {
  static constexpr gslam::SimdKernel<BitKernel> kernel(countScalar, GSLAM_IF_X86(countSse4),
                                                       nullptr, nullptr, GSLAM_IF_ARM64(countNeon));
  if (kind.type() != gslam::PixelType::u8) {
    throw gslam::ArgumentError(
        "table", "has descriptors of " + kind.text() + ", expected bits (u8) or floats (f32)");
  }
  const std::size_t bytes = kind.rowBytes();
  kernel.active()(query, table, kind.stride(), bytes, rows, 1 / (8 * float(bytes)), distances);
}

}  // namespace

void distancesTo(const std::uint8_t* query, const gslam::Image& table, Rows rows,
                 std::vector<float>& distances) {
  distances.resize(rows.size());
  if (table.type() == gslam::PixelType::f32) {
    compareFloats(reinterpret_cast<const float*>(query), table, rows, distances.data());
  } else {
    compare(query, table, table.bytes(), rows, distances.data());
  }
}

float distanceOf(const std::uint8_t* a, const std::uint8_t* b, const gslam::Image& kind) {
  if (kind.type() == gslam::PixelType::f32) {
    const std::size_t size = std::size_t(kind.width()) * std::size_t(kind.channels());
    const auto* const left = reinterpret_cast<const float*>(a);
    const auto* const right = reinterpret_cast<const float*>(b);
    const float most = std::sqrt(squaredLength(left, size)) + std::sqrt(squaredLength(right, size));
    return most > 0 ? std::sqrt(squaredDifference(left, right, size)) / most : 0;
  }
  const std::uint32_t first = 0;
  float distance = 0;
  compare(a, kind, b, Rows(&first, 1), &distance);
  return distance;
}

}  // namespace visual
