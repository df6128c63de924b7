// A kernel in every variant, to try the mechanism of gslam/base/simd.h on.
#ifndef GSLAM_BASE_TESTS_DOT_KERNEL_H
#define GSLAM_BASE_TESTS_DOT_KERNEL_H

#include <gslam/base/simd.h>

#include <cstddef>

#if GSLAM_X86
#include <immintrin.h>
#elif GSLAM_ARM64
#include <arm_neon.h>
#endif

namespace dot_kernel {

using Function = float (*)(const float* a, const float* b, std::size_t n);

inline float dotScalar(const float* a, const float* b, std::size_t n) {
  float sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

#if GSLAM_X86
GSLAM_TARGET_SSE4
inline float dotSse4(const float* a, const float* b, std::size_t n) {
  __m128 sum = _mm_setzero_ps();
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    sum = _mm_add_ps(sum, _mm_dp_ps(_mm_loadu_ps(a + i), _mm_loadu_ps(b + i), 0xf1));
  }
  return _mm_cvtss_f32(sum) + dotScalar(a + i, b + i, n - i);
}
GSLAM_TARGET_END

GSLAM_TARGET_AVX2
inline float dotAvx2(const float* a, const float* b, std::size_t n) {
  __m256 sum = _mm256_setzero_ps();
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    sum = _mm256_fmadd_ps(_mm256_loadu_ps(a + i), _mm256_loadu_ps(b + i), sum);
  }
  float part[8];
  _mm256_storeu_ps(part, sum);
  float total = dotScalar(a + i, b + i, n - i);
  for (float value : part) total += value;
  return total;
}
GSLAM_TARGET_END

GSLAM_TARGET_AVX512
inline float dotAvx512(const float* a, const float* b, std::size_t n) {
  __m512 sum = _mm512_setzero_ps();
  for (std::size_t i = 0; i < n; i += 16) {
    const std::size_t left = n - i;
    const __mmask16 mask =
        left >= 16 ? static_cast<__mmask16>(0xffff) : static_cast<__mmask16>((1u << left) - 1u);
    sum = _mm512_fmadd_ps(_mm512_maskz_loadu_ps(mask, a + i), _mm512_maskz_loadu_ps(mask, b + i),
                          sum);
  }
  return _mm512_reduce_add_ps(sum);
}
GSLAM_TARGET_END
#endif

#if GSLAM_ARM64
inline float dotNeon(const float* a, const float* b, std::size_t n) {
  float32x4_t sum = vdupq_n_f32(0);
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) sum = vfmaq_f32(sum, vld1q_f32(a + i), vld1q_f32(b + i));
  return vaddvq_f32(sum) + dotScalar(a + i, b + i, n - i);
}
#endif

inline const gslam::SimdKernel<Function>& dot() {
  static constexpr gslam::SimdKernel<Function> kernel(
      dotScalar, GSLAM_IF_X86(dotSse4), GSLAM_IF_X86(dotAvx2), GSLAM_IF_X86(dotAvx512),
      GSLAM_IF_ARM64(dotNeon));
  return kernel;
}

}  // namespace dot_kernel

#endif  // GSLAM_BASE_TESTS_DOT_KERNEL_H
