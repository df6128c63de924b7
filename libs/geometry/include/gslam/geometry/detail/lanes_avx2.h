#ifndef GSLAM_GEOMETRY_DETAIL_LANES_AVX2_H
#define GSLAM_GEOMETRY_DETAIL_LANES_AVX2_H

#include <gslam/base/platform.h>

#include <cstddef>

#if GSLAM_X86
#include <immintrin.h>

/// @file
/// What batches need to know of AVX2: 4 doubles or 8 floats at once.
///
/// Beside arithmetic these are transposes between elements in memory, each of 3 or 4 or more
/// numbers, and one register for each number. Registers are seen as two pieces of 128 bits.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace avx2 {
GSLAM_TARGET_AVX2

template <class T>
struct Registers;

// g++ would rather load once more for each use than keep a register.
template <class Register>
Register kept(Register r) noexcept {
  asm("" : "+x"(r));
  return r;
}

template <>
struct Registers<double> {
  using Register = __m256d;
  static constexpr std::size_t kWidth = 4;

  static Register load(const double* from) noexcept { return kept(_mm256_loadu_pd(from)); }
  static void store(double* to, Register r) noexcept { _mm256_storeu_pd(to, r); }
  static Register all(double value) noexcept { return _mm256_set1_pd(value); }
  static Register multiplyAdd(Register a, Register x, Register b) noexcept {
    return _mm256_fmadd_pd(a, x, b);
  }
  static Register subtractProduct(Register b, Register a, Register x) noexcept {
    return _mm256_fnmadd_pd(a, x, b);
  }
  static Register magnitude(Register r) noexcept { return _mm256_andnot_pd(all(-0.0), r); }
  static Register timesSign(Register r, Register sign) noexcept {
    return _mm256_xor_pd(r, _mm256_and_pd(sign, all(-0.0)));
  }
  static bool areAtMost(Register r, double bound) noexcept {
    return _mm256_movemask_pd(_mm256_cmp_pd(r, all(bound), _CMP_LE_OQ)) == 15;
  }

  /// Elements of 3: x0 y0 | z0 x1   y1 z1 | x2 y2   z2 x3 | y3 z3
  static void load3(const double* from, Register* r) noexcept {
    const Register a = load(from), b = load(from + 4), c = load(from + 8);
    const Register xy = _mm256_blend_pd(a, b, 12);
    const Register zx = _mm256_permute2f128_pd(a, c, 0x21);
    const Register yz = _mm256_blend_pd(b, c, 12);
    r[0] = _mm256_blend_pd(xy, zx, 10);
    r[1] = _mm256_shuffle_pd(xy, yz, 5);
    r[2] = _mm256_blend_pd(zx, yz, 10);
  }
  static void store3(double* to, const Register* r) noexcept {
    const Register xy = _mm256_unpacklo_pd(r[0], r[1]);
    const Register zx = _mm256_blend_pd(r[2], r[0], 10);
    const Register yz = _mm256_unpackhi_pd(r[1], r[2]);
    store(to, _mm256_permute2f128_pd(xy, zx, 0x20));
    store(to + 4, _mm256_blend_pd(yz, xy, 12));
    store(to + 8, _mm256_permute2f128_pd(zx, yz, 0x31));
  }

  /// Four numbers of each element; elements begin `stride` numbers apart.
  static void load4(const double* from, std::size_t stride, Register* r) noexcept {
    transpose(load(from), load(from + stride), load(from + 2 * stride), load(from + 3 * stride), r);
  }
  static void store4(double* to, std::size_t stride, const Register* r) noexcept {
    Register rows[4];
    transpose(r[0], r[1], r[2], r[3], rows);
    store(to, rows[0]);
    store(to + stride, rows[1]);
    store(to + 2 * stride, rows[2]);
    store(to + 3 * stride, rows[3]);
  }

 private:
  static void transpose(Register a, Register b, Register c, Register d, Register* r) noexcept {
    const Register ab_even = _mm256_unpacklo_pd(a, b), ab_odd = _mm256_unpackhi_pd(a, b);
    const Register cd_even = _mm256_unpacklo_pd(c, d), cd_odd = _mm256_unpackhi_pd(c, d);
    r[0] = _mm256_permute2f128_pd(ab_even, cd_even, 0x20);
    r[1] = _mm256_permute2f128_pd(ab_odd, cd_odd, 0x20);
    r[2] = _mm256_permute2f128_pd(ab_even, cd_even, 0x31);
    r[3] = _mm256_permute2f128_pd(ab_odd, cd_odd, 0x31);
  }
};

template <>
struct Registers<float> {
  using Register = __m256;
  static constexpr std::size_t kWidth = 8;

  static Register load(const float* from) noexcept { return kept(_mm256_loadu_ps(from)); }
  static void store(float* to, Register r) noexcept { _mm256_storeu_ps(to, r); }
  static Register all(float value) noexcept { return _mm256_set1_ps(value); }
  static Register multiplyAdd(Register a, Register x, Register b) noexcept {
    return _mm256_fmadd_ps(a, x, b);
  }
  static Register subtractProduct(Register b, Register a, Register x) noexcept {
    return _mm256_fnmadd_ps(a, x, b);
  }
  static Register magnitude(Register r) noexcept { return _mm256_andnot_ps(all(-0.0f), r); }
  static Register timesSign(Register r, Register sign) noexcept {
    return _mm256_xor_ps(r, _mm256_and_ps(sign, all(-0.0f)));
  }
  static bool areAtMost(Register r, float bound) noexcept {
    return _mm256_movemask_ps(_mm256_cmp_ps(r, all(bound), _CMP_LE_OQ)) == 255;
  }

  /// Elements of 3; a piece of 128 bits is x0 y0 z0 x1, y1 z1 x2 y2 or z2 x3 y3 z3.
  static void load3(const float* from, Register* r) noexcept {
    const Register v0 = load(from), v1 = load(from + 8), v2 = load(from + 16);
    const Register a = _mm256_blend_ps(v0, v1, 0xf0);
    const Register b = _mm256_permute2f128_ps(v0, v2, 0x21);
    const Register c = _mm256_blend_ps(v1, v2, 0xf0);
    const Register xy = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
    const Register yz = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));
    r[0] = _mm256_shuffle_ps(a, xy, _MM_SHUFFLE(2, 0, 3, 0));
    r[1] = _mm256_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
    r[2] = _mm256_shuffle_ps(yz, c, _MM_SHUFFLE(3, 0, 3, 1));
  }
  static void store3(float* to, const Register* r) noexcept {
    const Register xy = _mm256_shuffle_ps(r[0], r[1], _MM_SHUFFLE(2, 0, 2, 0));
    const Register yz = _mm256_shuffle_ps(r[1], r[2], _MM_SHUFFLE(3, 1, 3, 1));
    const Register zx = _mm256_shuffle_ps(r[2], r[0], _MM_SHUFFLE(3, 1, 2, 0));
    const Register a = _mm256_shuffle_ps(xy, zx, _MM_SHUFFLE(2, 0, 2, 0));
    const Register b = _mm256_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
    const Register c = _mm256_shuffle_ps(zx, yz, _MM_SHUFFLE(3, 1, 3, 1));
    store(to, _mm256_permute2f128_ps(a, b, 0x20));
    store(to + 8, _mm256_blend_ps(c, a, 0xf0));
    store(to + 16, _mm256_permute2f128_ps(b, c, 0x31));
  }

  /// Four numbers of each element; elements begin `stride` numbers apart.
  static void load4(const float* from, std::size_t stride, Register* r) noexcept {
    const Register rows[4] = {two(from, stride), two(from + stride, stride),
                              two(from + 2 * stride, stride), two(from + 3 * stride, stride)};
    transpose(rows, r);
  }
  static void store4(float* to, std::size_t stride, const Register* r) noexcept {
    Register rows[4];
    transpose(r, rows);
    storeTwo(to, stride, rows[0]);
    storeTwo(to + stride, stride, rows[1]);
    storeTwo(to + 2 * stride, stride, rows[2]);
    storeTwo(to + 3 * stride, stride, rows[3]);
  }

 private:
  // A row and the fourth after it.
  static Register two(const float* row, std::size_t stride) noexcept {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row)),
                                _mm_loadu_ps(row + 4 * stride), 1);
  }
  static void storeTwo(float* row, std::size_t stride, Register r) noexcept {
    _mm_storeu_ps(row, _mm256_castps256_ps128(r));
    _mm_storeu_ps(row + 4 * stride, _mm256_extractf128_ps(r, 1));
  }
  static void transpose(const Register* from, Register* r) noexcept {
    const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(from[0], from[1]));
    const __m256d b = _mm256_castps_pd(_mm256_unpackhi_ps(from[0], from[1]));
    const __m256d c = _mm256_castps_pd(_mm256_unpacklo_ps(from[2], from[3]));
    const __m256d d = _mm256_castps_pd(_mm256_unpackhi_ps(from[2], from[3]));
    r[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(a, c));
    r[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(a, c));
    r[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(b, d));
    r[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(b, d));
  }
};

GSLAM_TARGET_END
}  // namespace avx2
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif

#endif  // GSLAM_GEOMETRY_DETAIL_LANES_AVX2_H
