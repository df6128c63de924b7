#include "robust/score_kernels.h"

#include <gslam/base/platform.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr std::size_t kLanes = 16;
constexpr float kMagsacScale = 1 / (1 - kMagsacFloor - kMagsacEnd * kMagsacFloor);

// In the same order in every variant.
GSLAM_ALWAYS_INLINE double totalOfLanes(const float* parts) {
  double sum = 0;
  for (std::size_t i = 0; i < kLanes; ++i) sum += static_cast<double>(parts[i]);
  return sum;
}

// exp(-u), of a number or of lanes, for u from 0 to kMagsacEnd; the error is below 5e-6. Never
// above 1, and 1 at 0: the fourth-order series at u / 16, raised to the power 16.
template <class T>
GSLAM_ALWAYS_INLINE void expMinus(const T& u, T& result) {
  const T x = u * 0.0625f;
  T y = 1.0f - x * (1.0f - x * (0.5f - x * (1.0f / 6 - x * (1.0f / 24))));
  y *= y;
  y *= y;
  y *= y;
  result = y * y;
}

float truncatedOne(float squared, float limit) {
  return squared < limit ? squared : limit;
}

double truncatedScalar(const float* squared, std::size_t count, float limit) {
  float sums[kLanes] = {};
  for (std::size_t i = 0; i < count; ++i) sums[i % kLanes] += truncatedOne(squared[i], limit);
  return totalOfLanes(sums);
}

double aboveScalar(const float* squared, std::size_t count, float limit) {
  std::size_t below = 0;
  for (std::size_t i = 0; i < count; ++i) below += squared[i] <= limit ? 1u : 0u;
  return static_cast<double>(count - below);
}

double magsacScalar(const float* squared, std::size_t count, float limit) {
  float sums[kLanes] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const float u = truncatedOne(squared[i], limit) * (kMagsacEnd / limit);
    float power;
    expMinus(u, power);
    sums[i % kLanes] += (1.0f - power - u * kMagsacFloor) * kMagsacScale;
  }
  return totalOfLanes(sums);
}

}  // namespace
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#if GSLAM_X86
GSLAM_TARGET_SSE4
#define GSLAM_SCORE_VARIANT sse4
#define GSLAM_SCORE_WIDTH 4
#include "robust/score_variant.h"
#undef GSLAM_SCORE_VARIANT
#undef GSLAM_SCORE_WIDTH
GSLAM_TARGET_END

GSLAM_TARGET_AVX2
#define GSLAM_SCORE_VARIANT avx2
#define GSLAM_SCORE_WIDTH 8
#include "robust/score_variant.h"
#undef GSLAM_SCORE_VARIANT
#undef GSLAM_SCORE_WIDTH
GSLAM_TARGET_END

GSLAM_TARGET_AVX512
#define GSLAM_SCORE_VARIANT avx512
#define GSLAM_SCORE_WIDTH 16
#include "robust/score_variant.h"
#undef GSLAM_SCORE_VARIANT
#undef GSLAM_SCORE_WIDTH
GSLAM_TARGET_END
#endif

#if GSLAM_ARM64
#define GSLAM_SCORE_VARIANT neon
#define GSLAM_SCORE_WIDTH 4
#include "robust/score_variant.h"
#undef GSLAM_SCORE_VARIANT
#undef GSLAM_SCORE_WIDTH
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

const ScoreKernels::Kernel& ScoreKernels::truncated() {
  static constexpr Kernel kernel(truncatedScalar, GSLAM_IF_X86(sse4::truncated),
                                 GSLAM_IF_X86(avx2::truncated), GSLAM_IF_X86(avx512::truncated),
                                 GSLAM_IF_ARM64(neon::truncated));
  return kernel;
}

const ScoreKernels::Kernel& ScoreKernels::above() {
  static constexpr Kernel kernel(aboveScalar, GSLAM_IF_X86(sse4::above), GSLAM_IF_X86(avx2::above),
                                 GSLAM_IF_X86(avx512::above), GSLAM_IF_ARM64(neon::above));
  return kernel;
}

const ScoreKernels::Kernel& ScoreKernels::magsac() {
  static constexpr Kernel kernel(magsacScalar, GSLAM_IF_X86(sse4::magsac),
                                 GSLAM_IF_X86(avx2::magsac), GSLAM_IF_X86(avx512::magsac),
                                 GSLAM_IF_ARM64(neon::magsac));
  return kernel;
}

double magsacWeight(double squared, double limit) {
  if (!(squared < limit)) return 0;
  const double end = static_cast<double>(kMagsacEnd);
  return std::exp(-squared / limit * end) - std::exp(-end);
}

double magsacLoss(double squared, double limit) {
  if (!(squared < limit)) return 1;
  const double end = static_cast<double>(kMagsacEnd), floor = std::exp(-end);
  const double u = squared / limit * end;
  return (1 - std::exp(-u) - u * floor) / (1 - floor - end * floor);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
