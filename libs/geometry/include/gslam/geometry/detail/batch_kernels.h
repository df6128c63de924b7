#ifndef GSLAM_GEOMETRY_DETAIL_BATCH_KERNELS_H
#define GSLAM_GEOMETRY_DETAIL_BATCH_KERNELS_H

#include <gslam/base/simd.h>
#include <gslam/geometry/detail/arctangent.h>
#include <gslam/geometry/detail/batch_elements.h>
#include <gslam/geometry/detail/batch_operations.h>
#include <gslam/geometry/detail/lanes_avx2.h>
#include <gslam/geometry/detail/lanes_avx512.h>
#include <gslam/geometry/detail/lanes_neon.h>
#include <gslam/geometry/detail/lanes_scalar.h>
#include <gslam/geometry/detail/stumpff.h>

#include <cstddef>
#include <type_traits>

/// @file
/// The batch in all its SIMD variants.

/// @def GSLAM_DETAIL_FLATTEN
/// Makes a function inline all that it calls.
#if defined(__GNUC__) || defined(__clang__)
#define GSLAM_DETAIL_FLATTEN __attribute__((flatten))
#else
#define GSLAM_DETAIL_FLATTEN
#endif

#define GSLAM_DETAIL_VARIANT scalar
#include <gslam/geometry/detail/batch_variant.h>
#undef GSLAM_DETAIL_VARIANT

#if GSLAM_X86
GSLAM_TARGET_AVX2
#define GSLAM_DETAIL_VARIANT avx2
#include <gslam/geometry/detail/batch_variant.h>
#undef GSLAM_DETAIL_VARIANT
GSLAM_TARGET_END

GSLAM_TARGET_AVX512
#define GSLAM_DETAIL_VARIANT avx512
#include <gslam/geometry/detail/batch_variant.h>
#undef GSLAM_DETAIL_VARIANT
GSLAM_TARGET_END
#endif

#if GSLAM_ARM64
#define GSLAM_DETAIL_VARIANT neon
#include <gslam/geometry/detail/batch_variant.h>
#undef GSLAM_DETAIL_VARIANT
#endif

namespace gslam {
inline namespace v1 {
namespace detail {
template <class View>
struct IsRows : std::false_type {};
template <class T, std::size_t K>
struct IsRows<Rows<T, K>> : std::true_type {};
template <class A, class B>
struct IsRows<Both<A, B>> : IsRows<A> {};

/// The kernel in its variants; see lanes_avx512.h for what is left out.
template <class Op, class In, class Out, bool is_rows = IsRows<In>::value>
struct BatchKernel {
  using Function = void (*)(const Op&, const In&, const Out&, std::size_t);
  static void run(const Op& op, const In& in, const Out& out, std::size_t n) {
    static constexpr SimdKernel<Function> kernel(
        scalar::run<Op, In, Out>, nullptr, GSLAM_IF_X86((avx2::run<Op, In, Out>)),
        GSLAM_IF_X86((avx512::run<Op, In, Out>)), GSLAM_IF_ARM64((neon::run<Op, In, Out>)));
    kernel.active()(op, in, out, n);
  }
};
template <class Op, class In, class Out>
struct BatchKernel<Op, In, Out, true> {
  using Function = void (*)(const Op&, const In&, const Out&, std::size_t);
  static void run(const Op& op, const In& in, const Out& out, std::size_t n) {
    static constexpr SimdKernel<Function> kernel(scalar::run<Op, In, Out>, nullptr,
                                                 GSLAM_IF_X86((avx2::run<Op, In, Out>)), nullptr,
                                                 GSLAM_IF_ARM64((neon::run<Op, In, Out>)));
    kernel.active()(op, in, out, n);
  }
};

/// The operations that have formulas.
template <class Op, class In, class Out>
void runBatch(std::true_type, const Op& op, const In& in, const Out& out, std::size_t n) {
  BatchKernel<Op, In, Out>::run(op, in, out, n);
}
/// The others, one by one.
template <class Op, class In, class Out>
void runBatch(std::false_type, const Op&, const In& in, const Out& out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    typename Op::Scalar x[Op::kFrom], y[Op::kTo];
    in.get(i, x);
    Op::one(x, y, i);
    out.set(i, y);
  }
}

/// out[i] = op(in[i]) for all n.
template <class Op, class In, class Out>
void runBatch(const Op& op, const In& in, const Out& out, std::size_t n) {
  runBatch(std::integral_constant<bool, Op::kHasFormula>(), op, in, out, n);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_BATCH_KERNELS_H
