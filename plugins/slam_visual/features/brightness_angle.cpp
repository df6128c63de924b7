// The orientation of a corner: the intensity centroid of ORB.
#include <gslam/base/simd.h>

#include <array>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "features/grid_orb.h"

#if GSLAM_X86
#include <immintrin.h>
#endif

namespace visual {
namespace {

constexpr int kRadius = 15;

// For each row of the disc, 16 columns to the left and 16 to the right: which belong to it, and
// how far they are from the middle.
struct Disc {
  alignas(16) std::uint8_t mask[2 * kRadius + 1][32];
  alignas(16) std::int8_t column[32];
  int half[2 * kRadius + 1];

  Disc() {
    for (int x = 0; x < 32; ++x) column[x] = std::int8_t(x - kRadius);
    for (int y = -kRadius; y <= kRadius; ++y) {
      int width = 0;
      // A disc of radius 15.5: the same under quarter turns.
      while (4 * ((width + 1) * (width + 1) + y * y) <= 31 * 31) ++width;
      half[y + kRadius] = width < kRadius ? width : kRadius;
      for (int x = 0; x < 32; ++x) {
        mask[y + kRadius][x] = std::abs(x - kRadius) <= half[y + kRadius] ? 255 : 0;
      }
    }
  }
};

const Disc& disc() {
  static const Disc kDisc;
  return kDisc;
}

struct Moments {
  int u, v;
};

// `corner` is the first pixel of the square around the disc.
using MomentKernel = Moments (*)(const std::uint8_t* corner, std::ptrdiff_t step);

Moments momentsScalar(const std::uint8_t* corner, std::ptrdiff_t step) {
  Moments sum = {0, 0};
  for (int y = 0; y <= 2 * kRadius; ++y, corner += step) {
    const int half = disc().half[y];
    int row = 0;
    for (int x = -half; x <= half; ++x) {
      const int brightness = corner[x + kRadius];
      row += brightness;
      sum.u += x * brightness;
    }
    sum.v += (y - kRadius) * row;
  }
  return sum;
}

#if GSLAM_X86

GSLAM_TARGET_SSE4

Moments momentsSse4(const std::uint8_t* corner, std::ptrdiff_t step) {
  const Disc& d = disc();
  const auto load = [](const void* at) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
  };
  const __m128i left = load(d.column), right = load(d.column + 16);
  const __m128i one = _mm_set1_epi16(1), zero = _mm_setzero_si128();
  __m128i along_u = zero, along_v = zero;
  for (int y = 0; y <= 2 * kRadius; ++y, corner += step) {
    // 31 pixels: the second half begins a pixel early, so that nothing beyond them is read.
    const __m128i a = _mm_and_si128(load(corner), load(d.mask[y]));
    const __m128i b = _mm_and_si128(_mm_srli_si128(load(corner + 15), 1), load(d.mask[y] + 16));
    const __m128i products = _mm_add_epi16(_mm_maddubs_epi16(a, left), _mm_maddubs_epi16(b, right));
    along_u = _mm_add_epi32(along_u, _mm_madd_epi16(products, one));
    const __m128i row = _mm_add_epi32(_mm_sad_epu8(a, zero), _mm_sad_epu8(b, zero));
    along_v = _mm_add_epi32(along_v, _mm_mullo_epi32(row, _mm_set1_epi32(y - kRadius)));
  }
  along_u = _mm_hadd_epi32(along_u, along_v);  // u u v v
  along_u = _mm_hadd_epi32(along_u, along_u);
  return {_mm_cvtsi128_si32(along_u), _mm_extract_epi32(along_u, 1)};
}

GSLAM_TARGET_END

#endif

}  // namespace

float brightnessAngle(const cv::Mat& image, int u, int v) {
  static constexpr gslam::SimdKernel<MomentKernel> kernel(momentsScalar, GSLAM_IF_X86(momentsSse4),
                                                          nullptr, nullptr, nullptr);
  const Moments m =
      kernel.active()(image.ptr<std::uint8_t>(v - kRadius) + (u - kRadius), image.step[0]);
  return float(std::atan2(double(m.v), double(m.u)));
}

}  // namespace visual
