#ifndef GSLAM_GEOMETRY_DETAIL_LANES_NEON_H
#define GSLAM_GEOMETRY_DETAIL_LANES_NEON_H

#include <gslam/base/platform.h>

#include <cstddef>

#if GSLAM_ARM64
#include <arm_neon.h>

/// @file
/// What batches need to know of NEON: 2 doubles or 4 floats at once.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace neon {

template <class T>
struct Registers;

template <>
struct Registers<double> {
  using Register = float64x2_t;
  static constexpr std::size_t kWidth = 2;

  static Register load(const double* from) noexcept { return vld1q_f64(from); }
  static void store(double* to, Register r) noexcept { vst1q_f64(to, r); }
  static Register all(double value) noexcept { return vdupq_n_f64(value); }
  static Register multiplyAdd(Register a, Register x, Register b) noexcept {
    return vfmaq_f64(b, a, x);
  }
  static Register subtractProduct(Register b, Register a, Register x) noexcept {
    return vfmsq_f64(b, a, x);
  }
  static Register magnitude(Register r) noexcept { return vabsq_f64(r); }
  static Register timesSign(Register r, Register sign) noexcept {
    const uint64x2_t bits = vandq_u64(vreinterpretq_u64_f64(sign), vdupq_n_u64(1ull << 63));
    return vreinterpretq_f64_u64(veorq_u64(vreinterpretq_u64_f64(r), bits));
  }
  static bool areAtMost(Register r, double bound) noexcept {
    return vminvq_u32(vreinterpretq_u32_u64(vcleq_f64(r, all(bound)))) != 0;
  }

  /// Elements of 3.
  static void load3(const double* from, Register* r) noexcept {
    const float64x2x3_t v = vld3q_f64(from);
    r[0] = v.val[0];
    r[1] = v.val[1];
    r[2] = v.val[2];
  }
  static void store3(double* to, const Register* r) noexcept {
    vst3q_f64(to, float64x2x3_t{{r[0], r[1], r[2]}});
  }

  /// Four numbers of each element; elements begin `stride` numbers apart.
  static void load4(const double* from, std::size_t stride, Register* r) noexcept {
    load2(from, stride, r);
    load2(from + 2, stride, r + 2);
  }
  static void store4(double* to, std::size_t stride, const Register* r) noexcept {
    store2(to, stride, r);
    store2(to + 2, stride, r + 2);
  }

 private:
  static void load2(const double* from, std::size_t stride, Register* r) noexcept {
    const Register a = load(from), b = load(from + stride);
    r[0] = vtrn1q_f64(a, b);
    r[1] = vtrn2q_f64(a, b);
  }
  static void store2(double* to, std::size_t stride, const Register* r) noexcept {
    store(to, vtrn1q_f64(r[0], r[1]));
    store(to + stride, vtrn2q_f64(r[0], r[1]));
  }
};

template <>
struct Registers<float> {
  using Register = float32x4_t;
  static constexpr std::size_t kWidth = 4;

  static Register load(const float* from) noexcept { return vld1q_f32(from); }
  static void store(float* to, Register r) noexcept { vst1q_f32(to, r); }
  static Register all(float value) noexcept { return vdupq_n_f32(value); }
  static Register multiplyAdd(Register a, Register x, Register b) noexcept {
    return vfmaq_f32(b, a, x);
  }
  static Register subtractProduct(Register b, Register a, Register x) noexcept {
    return vfmsq_f32(b, a, x);
  }
  static Register magnitude(Register r) noexcept { return vabsq_f32(r); }
  static Register timesSign(Register r, Register sign) noexcept {
    const uint32x4_t bits = vandq_u32(vreinterpretq_u32_f32(sign), vdupq_n_u32(1u << 31));
    return vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(r), bits));
  }
  static bool areAtMost(Register r, float bound) noexcept {
    return vminvq_u32(vcleq_f32(r, all(bound))) != 0;
  }

  /// Elements of 3.
  static void load3(const float* from, Register* r) noexcept {
    const float32x4x3_t v = vld3q_f32(from);
    r[0] = v.val[0];
    r[1] = v.val[1];
    r[2] = v.val[2];
  }
  static void store3(float* to, const Register* r) noexcept {
    vst3q_f32(to, float32x4x3_t{{r[0], r[1], r[2]}});
  }

  /// Four numbers of each element; elements begin `stride` numbers apart.
  static void load4(const float* from, std::size_t stride, Register* r) noexcept {
    transpose(load(from), load(from + stride), load(from + 2 * stride), load(from + 3 * stride), r);
  }
  static void store4(float* to, std::size_t stride, const Register* r) noexcept {
    Register rows[4];
    transpose(r[0], r[1], r[2], r[3], rows);
    store(to, rows[0]);
    store(to + stride, rows[1]);
    store(to + 2 * stride, rows[2]);
    store(to + 3 * stride, rows[3]);
  }

 private:
  static void transpose(Register a, Register b, Register c, Register d, Register* r) noexcept {
    const float64x2_t ab_even = vreinterpretq_f64_f32(vtrn1q_f32(a, b));
    const float64x2_t ab_odd = vreinterpretq_f64_f32(vtrn2q_f32(a, b));
    const float64x2_t cd_even = vreinterpretq_f64_f32(vtrn1q_f32(c, d));
    const float64x2_t cd_odd = vreinterpretq_f64_f32(vtrn2q_f32(c, d));
    r[0] = vreinterpretq_f32_f64(vtrn1q_f64(ab_even, cd_even));
    r[1] = vreinterpretq_f32_f64(vtrn1q_f64(ab_odd, cd_odd));
    r[2] = vreinterpretq_f32_f64(vtrn2q_f64(ab_even, cd_even));
    r[3] = vreinterpretq_f32_f64(vtrn2q_f64(ab_odd, cd_odd));
  }
};

}  // namespace neon
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif

#endif  // GSLAM_GEOMETRY_DETAIL_LANES_NEON_H
