#ifndef GSLAM_GEOMETRY_DETAIL_LANES_AVX512_H
#define GSLAM_GEOMETRY_DETAIL_LANES_AVX512_H

#include <gslam/base/platform.h>

#include <cstddef>

#if GSLAM_X86
#include <immintrin.h>

/// @file
/// What the formulas of batch_formulas.h need to know of AVX-512: 8 doubles or 16 floats at once.
///
/// Beside arithmetic these are transposes between elements in memory, each of 3 or 4 or more
/// numbers, and one register for each number. Registers are seen as four pieces of 128 bits, that
/// is, of two or four elements. Formulas do not mind in which order elements stand in a register,
/// so the pieces stand in the order 0 3 2 1, into which those of elements of 3 fall by blends alone.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace avx512 {
GSLAM_TARGET_AVX512

template <class T>
struct Registers;

// Elements of 3 in memory: pieces A0 B0 C0 A1   B1 C1 A2 B2   C2 A3 B3 C3
struct Pieces {
  __m512d a, b, c;  // 0 3 2 1

  static Pieces gathered(__m512d v0, __m512d v1, __m512d v2) noexcept {
    const __m512d a = blend(blend(v0, v2, 0x0c), v1, 0x30);
    const __m512d b = blend(blend(v1, v0, 0x0c), v2, 0x30);  // B1 B0 B3 B2
    const __m512d c = blend(blend(v2, v1, 0x0c), v0, 0x30);  // C2 C1 C0 C3
    return {a, _mm512_shuffle_f64x2(b, b, 0x39), _mm512_shuffle_f64x2(c, c, 0x4e)};
  }
  // Into the order of memory.
  void scatter(__m512d* v) const noexcept {
    const __m512d b1032 = _mm512_shuffle_f64x2(b, b, 0x93);
    const __m512d c2103 = _mm512_shuffle_f64x2(c, c, 0x4e);
    v[0] = blend(blend(a, b1032, 0x0c), c2103, 0x30);
    v[1] = blend(blend(b1032, c2103, 0x0c), a, 0x30);
    v[2] = blend(blend(c2103, a, 0x0c), b1032, 0x30);
  }

 private:
  static __m512d blend(__m512d v, __m512d where_one, __mmask8 bits) noexcept {
    return _mm512_mask_mov_pd(v, bits, where_one);
  }
};

template <>
struct Registers<double> {
  using Register = __m512d;
  static constexpr std::size_t kWidth = 8;

  static Register load(const double* from) noexcept { return _mm512_loadu_pd(from); }
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

  /// Elements of 3; a piece is x0 y0, z0 x1 or y1 z1.
  static void load3(const double* from, Register* r) noexcept {
    const Pieces p = Pieces::gathered(load(from), load(from + 8), load(from + 16));
    r[0] = _mm512_mask_mov_pd(p.a, 0xaa, p.b);
    r[1] = _mm512_shuffle_pd(p.a, p.c, 0x55);
    r[2] = _mm512_mask_mov_pd(p.b, 0xaa, p.c);
  }
  static void store3(double* to, const Register* r) noexcept {
    const Pieces p = {_mm512_unpacklo_pd(r[0], r[1]), _mm512_mask_mov_pd(r[2], 0xaa, r[0]),
                      _mm512_unpackhi_pd(r[1], r[2])};
    Register v[3];
    p.scatter(v);
    store(to, v[0]);
    store(to + 8, v[1]);
    store(to + 16, v[2]);
  }

  /// Four numbers of each element; elements begin `stride` numbers apart.
  static void load4(const double* from, std::size_t stride, Register* r) noexcept {
    const Register a = two(from, 0, 6, stride), b = two(from, 1, 7, stride);
    const Register c = two(from, 4, 2, stride), d = two(from, 5, 3, stride);
    const Register ab_even = _mm512_unpacklo_pd(a, b), ab_odd = _mm512_unpackhi_pd(a, b);
    const Register cd_even = _mm512_unpacklo_pd(c, d), cd_odd = _mm512_unpackhi_pd(c, d);
    r[0] = _mm512_shuffle_f64x2(ab_even, cd_even, 0x88);
    r[1] = _mm512_shuffle_f64x2(ab_odd, cd_odd, 0x88);
    r[2] = _mm512_shuffle_f64x2(ab_even, cd_even, 0xdd);
    r[3] = _mm512_shuffle_f64x2(ab_odd, cd_odd, 0xdd);
  }
  static void store4(double* to, std::size_t stride, const Register* r) noexcept {
    const Register xy_even = _mm512_unpacklo_pd(r[0], r[1]);  // of elements 0 6 4 2
    const Register xy_odd = _mm512_unpackhi_pd(r[0], r[1]);   // 1 7 5 3
    const Register zw_even = _mm512_unpacklo_pd(r[2], r[3]);
    const Register zw_odd = _mm512_unpackhi_pd(r[2], r[3]);
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
    const __m512i second = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    const Register e06 = _mm512_permutex2var_pd(xy_even, first, zw_even);
    const Register e42 = _mm512_permutex2var_pd(xy_even, second, zw_even);
    const Register e17 = _mm512_permutex2var_pd(xy_odd, first, zw_odd);
    const Register e53 = _mm512_permutex2var_pd(xy_odd, second, zw_odd);
    storeLow(to, e06);
    storeLow(to + stride, e17);
    storeHigh(to + 2 * stride, e42);
    storeHigh(to + 3 * stride, e53);
    storeLow(to + 4 * stride, e42);
    storeLow(to + 5 * stride, e53);
    storeHigh(to + 6 * stride, e06);
    storeHigh(to + 7 * stride, e17);
  }

 private:
  static Register two(const double* from, std::size_t low, std::size_t high,
                      std::size_t stride) noexcept {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(from + low * stride)),
                              _mm256_loadu_pd(from + high * stride), 1);
  }
  static void storeLow(double* to, Register r) noexcept {
    _mm256_storeu_pd(to, _mm512_castpd512_pd256(r));
  }
  static void storeHigh(double* to, Register r) noexcept {
    _mm256_storeu_pd(to, _mm512_extractf64x4_pd(r, 1));
  }
};

template <>
struct Registers<float> {
  using Register = __m512;
  static constexpr std::size_t kWidth = 16;

  static Register load(const float* from) noexcept { return _mm512_loadu_ps(from); }
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

  /// Elements of 3; a piece is x0 y0 z0 x1, y1 z1 x2 y2 or z2 x3 y3 z3.
  static void load3(const float* from, Register* r) noexcept {
    const Pieces p = Pieces::gathered(_mm512_castps_pd(load(from)), _mm512_castps_pd(load(from + 16)),
                                      _mm512_castps_pd(load(from + 32)));
    const Register a = _mm512_castpd_ps(p.a), b = _mm512_castpd_ps(p.b), c = _mm512_castpd_ps(p.c);
    const Register xy = _mm512_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
    const Register yz = _mm512_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));
    r[0] = _mm512_shuffle_ps(a, xy, _MM_SHUFFLE(2, 0, 3, 0));
    r[1] = _mm512_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
    r[2] = _mm512_shuffle_ps(yz, c, _MM_SHUFFLE(3, 0, 3, 1));
  }
  static void store3(float* to, const Register* r) noexcept {
    const Register xy = _mm512_shuffle_ps(r[0], r[1], _MM_SHUFFLE(2, 0, 2, 0));
    const Register yz = _mm512_shuffle_ps(r[1], r[2], _MM_SHUFFLE(3, 1, 3, 1));
    const Register zx = _mm512_shuffle_ps(r[2], r[0], _MM_SHUFFLE(3, 1, 2, 0));
    const Pieces p = {_mm512_castps_pd(_mm512_shuffle_ps(xy, zx, _MM_SHUFFLE(2, 0, 2, 0))),
                      _mm512_castps_pd(_mm512_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0))),
                      _mm512_castps_pd(_mm512_shuffle_ps(zx, yz, _MM_SHUFFLE(3, 1, 3, 1)))};
    __m512d v[3];
    p.scatter(v);
    store(to, _mm512_castpd_ps(v[0]));
    store(to + 16, _mm512_castpd_ps(v[1]));
    store(to + 32, _mm512_castpd_ps(v[2]));
  }

  /// Four numbers of each element; elements begin `stride` numbers apart.
  static void load4(const float* from, std::size_t stride, Register* r) noexcept {
    const Register rows[4] = {four(from, stride), four(from + stride, stride),
                              four(from + 2 * stride, stride), four(from + 3 * stride, stride)};
    transpose(rows, r);
  }
  static void store4(float* to, std::size_t stride, const Register* r) noexcept {
    Register rows[4];
    transpose(r, rows);
    storeFour(to, stride, rows[0]);
    storeFour(to + stride, stride, rows[1]);
    storeFour(to + 2 * stride, stride, rows[2]);
    storeFour(to + 3 * stride, stride, rows[3]);
  }

 private:
  // A row, and each fourth after it, in the order of pieces.
  static Register four(const float* row, std::size_t stride) noexcept {
    const Register one = _mm512_castps128_ps512(_mm_loadu_ps(row));
    const Register two = _mm512_insertf32x4(one, _mm_loadu_ps(row + 12 * stride), 1);
    const Register three = _mm512_insertf32x4(two, _mm_loadu_ps(row + 8 * stride), 2);
    return _mm512_insertf32x4(three, _mm_loadu_ps(row + 4 * stride), 3);
  }
  static void storeFour(float* row, std::size_t stride, Register r) noexcept {
    _mm_storeu_ps(row, _mm512_castps512_ps128(r));
    _mm_storeu_ps(row + 12 * stride, _mm512_extractf32x4_ps(r, 1));
    _mm_storeu_ps(row + 8 * stride, _mm512_extractf32x4_ps(r, 2));
    _mm_storeu_ps(row + 4 * stride, _mm512_extractf32x4_ps(r, 3));
  }
  static void transpose(const Register* from, Register* r) noexcept {
    const __m512d a = _mm512_castps_pd(_mm512_unpacklo_ps(from[0], from[1]));
    const __m512d b = _mm512_castps_pd(_mm512_unpackhi_ps(from[0], from[1]));
    const __m512d c = _mm512_castps_pd(_mm512_unpacklo_ps(from[2], from[3]));
    const __m512d d = _mm512_castps_pd(_mm512_unpackhi_ps(from[2], from[3]));
    r[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(a, c));
    r[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(a, c));
    r[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(b, d));
    r[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(b, d));
  }
};

GSLAM_TARGET_END
}  // namespace avx512
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif

#endif  // GSLAM_GEOMETRY_DETAIL_LANES_AVX512_H
