#include "small/pose_kernel.h"

#include <gslam/base/platform.h>

#include <cmath>
#include <cstring>

#if GSLAM_X86
#include <immintrin.h>
#endif
#if GSLAM_ARM64
#include <arm_neon.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

// What is kept of a block between the two loops of a kernel: the places on the plane z = 1, the
// weights of (x, y) there, upper triangle, and the weighted residuals.
struct PoseRows {
  alignas(64) double x[kPoseBlock];
  double y[kPoseBlock], inverse[kPoseBlock];
  double m00[kPoseBlock], m01[kPoseBlock], m11[kPoseBlock];
  double pull_x[kPoseBlock], pull_y[kPoseBlock];
  double right[kPoseBlock], cross_x[kPoseBlock], cross_y[kPoseBlock];  // stereo only
  double pull_right[kPoseBlock];
};

// Out of the regions: std::log may be a template.
double logOfProduct(double mantissa, long long exponent) {
  return std::log(mantissa) + 0.6931471805599453 * static_cast<double>(exponent);
}

}  // namespace
}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#define GSLAM_POSE_VARIANT scalar
#define GSLAM_POSE_WIDTH 1
#define GSLAM_POSE_ROOT(x) std::sqrt(x)
#include "small/pose_variant.h"
#undef GSLAM_POSE_VARIANT
#undef GSLAM_POSE_WIDTH
#undef GSLAM_POSE_ROOT

#if GSLAM_X86
GSLAM_TARGET_SSE4
#define GSLAM_POSE_VARIANT sse4
#define GSLAM_POSE_WIDTH 2
#define GSLAM_POSE_ROOT(x) (Register) _mm_sqrt_pd((__m128d)(x))
#include "small/pose_variant.h"
#undef GSLAM_POSE_VARIANT
#undef GSLAM_POSE_WIDTH
#undef GSLAM_POSE_ROOT
GSLAM_TARGET_END

GSLAM_TARGET_AVX2
#define GSLAM_POSE_VARIANT avx2
#define GSLAM_POSE_WIDTH 4
#define GSLAM_POSE_ROOT(x) (Register) _mm256_sqrt_pd((__m256d)(x))
#include "small/pose_variant.h"
#undef GSLAM_POSE_VARIANT
#undef GSLAM_POSE_WIDTH
#undef GSLAM_POSE_ROOT
GSLAM_TARGET_END

GSLAM_TARGET_AVX512
#define GSLAM_POSE_VARIANT avx512
#define GSLAM_POSE_WIDTH 8
#define GSLAM_POSE_ROOT(x) (Register) _mm512_sqrt_pd((__m512d)(x))
#include "small/pose_variant.h"
#undef GSLAM_POSE_VARIANT
#undef GSLAM_POSE_WIDTH
#undef GSLAM_POSE_ROOT
GSLAM_TARGET_END
#endif

#if GSLAM_ARM64
#define GSLAM_POSE_VARIANT neon
#define GSLAM_POSE_WIDTH 2
#define GSLAM_POSE_ROOT(x) (Register) vsqrtq_f64((float64x2_t)(x))
#include "small/pose_variant.h"
#undef GSLAM_POSE_VARIANT
#undef GSLAM_POSE_WIDTH
#undef GSLAM_POSE_ROOT
#endif

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

const SimdKernel<PoseFunction>& poseKernel(PoseFormula formula) {
#define GSLAM_POSE_KERNEL(name)                                                                   \
  {                                                                                               \
    scalar::name, GSLAM_IF_X86(sse4::name), GSLAM_IF_X86(avx2::name), GSLAM_IF_X86(avx512::name), \
        GSLAM_IF_ARM64(neon::name)                                                                \
  }
  static constexpr SimdKernel<PoseFunction> kernels[] = {
      GSLAM_POSE_KERNEL(pinhole), GSLAM_POSE_KERNEL(radtan), GSLAM_POSE_KERNEL(stereo)};
#undef GSLAM_POSE_KERNEL
  return kernels[static_cast<int>(formula)];
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
