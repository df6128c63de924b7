#include "features/window_search.h"

#include <gslam/base/simd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#if GSLAM_X86
#include <immintrin.h>
#endif

namespace visual {
namespace {

constexpr int kSide = 2 * kWindow + 1;
constexpr int kPlaces = 2 * kShifts + 1;
constexpr int kStrip = kSide + kPlaces - 1;  // columns of the right image that are looked at

// Pixels of both images, in rows that may be read 16 bytes at a time.
struct Patches {
  alignas(16) std::uint8_t left[kSide][16];
  alignas(16) std::uint8_t right[kSide][32];
};

// Sums of absolute differences at all places.
using DifferenceKernel = void (*)(const Patches& patches, int* differences);

void differencesScalar(const Patches& patches, int* differences) {
  for (int place = 0; place < kPlaces; ++place) {
    int sum = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        sum += std::abs(int(patches.left[y][x]) - int(patches.right[y][place + x]));
      }
    }
    differences[place] = sum;
  }
}

#if GSLAM_X86

GSLAM_TARGET_SSE4

void differencesSse4(const Patches& patches, int* differences) {
  const __m128i mask = _mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0);
  __m128i rows[kSide];
  for (int y = 0; y < kSide; ++y) {
    rows[y] = _mm_load_si128(reinterpret_cast<const __m128i*>(patches.left[y]));
  }
  for (int place = 0; place < kPlaces; ++place) {
    __m128i sum = _mm_setzero_si128();
    for (int y = 0; y < kSide; ++y) {
      const auto* const at = reinterpret_cast<const __m128i*>(patches.right[y] + place);
      sum = _mm_add_epi32(sum, _mm_sad_epu8(rows[y], _mm_and_si128(_mm_loadu_si128(at), mask)));
    }
    differences[place] = _mm_cvtsi128_si32(sum) + _mm_extract_epi32(sum, 2);
  }
}

GSLAM_TARGET_END

#endif

void findDifferences(const Patches& patches, int* differences) {
  static constexpr gslam::SimdKernel<DifferenceKernel> kernel(
      differencesScalar, GSLAM_IF_X86(differencesSse4), nullptr, nullptr, nullptr);
  kernel.active()(patches, differences);
}

// Sum of the pixels of a window.
int brightnessOf(const std::uint8_t* first, std::size_t step) {
  int sum = 0;
  for (int y = 0; y < kSide; ++y, first += step) {
    for (int x = 0; x < kSide; ++x) sum += first[x];
  }
  return sum;
}

// Makes the brighter one of both as bright as the other, so that no pixel becomes too bright.
void copyPatches(const cv::Mat& left, int u, int v, const cv::Mat& right, int right_u,
                 Patches& patches) {
  std::memset(&patches, 0, sizeof(patches));
  for (int y = 0; y < kSide; ++y) {
    std::memcpy(patches.left[y], left.ptr(v - kWindow + y) + (u - kWindow), kSide);
    std::memcpy(patches.right[y], right.ptr(v - kWindow + y) + (right_u - kWindow - kShifts),
                kStrip);
  }
  const int difference = brightnessOf(patches.left[0], sizeof(patches.left[0])) -
                         brightnessOf(patches.right[0] + kShifts, sizeof(patches.right[0]));
  const int darker = (std::abs(difference) + kSide * kSide / 2) / (kSide * kSide);
  if (darker == 0) return;
  std::uint8_t* const begin = difference > 0 ? patches.left[0] : patches.right[0];
  const std::size_t size = difference > 0 ? sizeof(patches.left) : sizeof(patches.right);
  for (std::size_t i = 0; i < size; ++i) begin[i] = std::uint8_t(std::max(0, begin[i] - darker));
}

bool holds(const cv::Mat& image, int u, int v, int reach_u) {
  return u >= reach_u && u + reach_u < image.cols && v >= kWindow && v + kWindow < image.rows;
}

}  // namespace

bool searchWindow(const cv::Mat& left, int u, int v, const cv::Mat& right, int right_u,
                  WindowMatch& match) {
  if (!holds(left, u, v, kWindow) || !holds(right, right_u, v, kWindow + kShifts)) return false;
  Patches patches;
  copyPatches(left, u, v, right, right_u, patches);
  int differences[kPlaces];
  findDifferences(patches, differences);
  const auto best = int(std::min_element(differences, differences + kPlaces) - differences);
  if (best == 0 || best == kPlaces - 1) return false;
  const double before = differences[best - 1], at = differences[best],
               after = differences[best + 1];
  // Two lines of the same slope meet there: a sum of absolute differences is no parabola.
  const double slope = std::max(before, after) - at;
  match.shift = best - kShifts + (slope > 0 ? (before - after) / (2 * slope) : 0);
  match.difference = differences[best];
  return true;
}

}  // namespace visual
