#include "bundle/fast_kernels.h"

#include <gslam/base/platform.h>

#include <cmath>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

#if GSLAM_HAS_VECTORS
template <class T>
struct EightOf {
  typedef T Type __attribute__((vector_size(8 * sizeof(T))));
};
#else
template <class T>
struct EightOf {
  struct Type {
    T e[8];
    T& operator[](std::size_t i) { return e[i]; }
    const T& operator[](std::size_t i) const { return e[i]; }
    Type& operator+=(const Type& o) {
      for (std::size_t i = 0; i < 8; ++i) e[i] += o.e[i];
      return *this;
    }
    Type& operator-=(const Type& o) {
      for (std::size_t i = 0; i < 8; ++i) e[i] -= o.e[i];
      return *this;
    }
    friend Type operator+(Type a, const Type& b) { return a += b; }
    friend Type operator+(Type a, T b) {
      for (std::size_t i = 0; i < 8; ++i) a.e[i] += b;
      return a;
    }
    friend Type operator*(Type a, const Type& b) {
      for (std::size_t i = 0; i < 8; ++i) a.e[i] *= b.e[i];
      return a;
    }
    friend Type operator*(Type a, T b) {
      for (std::size_t i = 0; i < 8; ++i) a.e[i] *= b;
      return a;
    }
  };
};
#endif

}  // namespace
}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

// The last of the bodies has the tables.
// clang-format off
// The baseline has vectors of 128 bits on both x86-64 and arm64.
#define GSLAM_DETAIL_VARIANT fast_baseline
#include "bundle/fast_lane_bodies.h"
#include "bundle/fast_row_bodies.h"
#include "bundle/fast_block_bodies.h"
#undef GSLAM_DETAIL_VARIANT

#if GSLAM_X86
GSLAM_TARGET_AVX2
#define GSLAM_DETAIL_VARIANT fast_avx2
#include "bundle/fast_lane_bodies.h"
#include "bundle/fast_row_bodies.h"
#include "bundle/fast_block_bodies.h"
#undef GSLAM_DETAIL_VARIANT
GSLAM_TARGET_END

GSLAM_TARGET_AVX512
#define GSLAM_DETAIL_VARIANT fast_avx512
#define GSLAM_DETAIL_WIDE
#include "bundle/fast_lane_bodies.h"
#include "bundle/fast_row_bodies.h"
#include "bundle/fast_block_bodies.h"
#undef GSLAM_DETAIL_WIDE
#undef GSLAM_DETAIL_VARIANT
GSLAM_TARGET_END
#endif
// clang-format on

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

const FastKernels& fastKernels() {
  static constexpr SimdKernel<const FastKernels*> kernel(
      &fast_baseline::kKernels, nullptr, GSLAM_IF_X86(&fast_avx2::kKernels),
      GSLAM_IF_X86(&fast_avx512::kKernels), nullptr);
  return *kernel.active();
}

template <class T>
const FastBlockKernels<T>& fastBlockKernels() {
  static constexpr SimdKernel<const FastBlockKernels<T>*> kernel(
      &fast_baseline::kBlockKernels<T>, nullptr, GSLAM_IF_X86(&fast_avx2::kBlockKernels<T>),
      GSLAM_IF_X86(&fast_avx512::kBlockKernels<T>), nullptr);
  return *kernel.active();
}
template const FastBlockKernels<float>& fastBlockKernels<float>();
template const FastBlockKernels<double>& fastBlockKernels<double>();

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
