#ifndef GSLAM_GEOMETRY_DETAIL_LANES_AVX512_H
#define GSLAM_GEOMETRY_DETAIL_LANES_AVX512_H

#include <gslam/base/platform.h>

#include <cstddef>

#if GSLAM_X86
#include <immintrin.h>

/// @file
/// What batches need to know of AVX-512: 8 doubles or 16 floats at once.
///
/// For columns only. Rows go through AVX2: on the processors that were measured (Zen 4) transposes
/// of 512 bits take longer than those of 256 bits, which already take longer than the arithmetic.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace avx512 {
GSLAM_TARGET_AVX512

template <class T>
struct Registers;

// g++ would rather load once more for each use than keep a register.
template <class Register>
Register kept(Register r) noexcept {
  asm("" : "+v"(r));
  return r;
}

template <>
struct Registers<double> {
  using Register = __m512d;
  static constexpr std::size_t kWidth = 8;

  static Register load(const double* from) noexcept { return kept(_mm512_loadu_pd(from)); }
  static void store(double* to, Register r) noexcept { _mm512_storeu_pd(to, r); }
  static Register all(double value) noexcept { return _mm512_set1_pd(value); }
  static Register multiplyAdd(Register a, Register x, Register b) noexcept {
    return _mm512_fmadd_pd(a, x, b);
  }
  static Register subtractProduct(Register b, Register a, Register x) noexcept {
    return _mm512_fnmadd_pd(a, x, b);
  }
  static Register magnitude(Register r) noexcept { return _mm512_andnot_pd(all(-0.0), r); }
  static Register timesSign(Register r, Register sign) noexcept {
    return _mm512_xor_pd(r, _mm512_and_pd(sign, all(-0.0)));
  }
  static bool areAtMost(Register r, double bound) noexcept {
    return _mm512_cmp_pd_mask(r, all(bound), _CMP_LE_OQ) == 0xff;
  }
};

template <>
struct Registers<float> {
  using Register = __m512;
  static constexpr std::size_t kWidth = 16;

  static Register load(const float* from) noexcept { return kept(_mm512_loadu_ps(from)); }
  static void store(float* to, Register r) noexcept { _mm512_storeu_ps(to, r); }
  static Register all(float value) noexcept { return _mm512_set1_ps(value); }
  static Register multiplyAdd(Register a, Register x, Register b) noexcept {
    return _mm512_fmadd_ps(a, x, b);
  }
  static Register subtractProduct(Register b, Register a, Register x) noexcept {
    return _mm512_fnmadd_ps(a, x, b);
  }
  static Register magnitude(Register r) noexcept { return _mm512_andnot_ps(all(-0.0f), r); }
  static Register timesSign(Register r, Register sign) noexcept {
    return _mm512_xor_ps(r, _mm512_and_ps(sign, all(-0.0f)));
  }
  static bool areAtMost(Register r, float bound) noexcept {
    return _mm512_cmp_ps_mask(r, all(bound), _CMP_LE_OQ) == 0xffff;
  }
};

GSLAM_TARGET_END
}  // namespace avx512
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif

#endif  // GSLAM_GEOMETRY_DETAIL_LANES_AVX512_H
