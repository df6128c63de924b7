#ifndef GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_KERNELS_H
#define GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_KERNELS_H

#include <gslam/base/platform.h>
#include <gslam/base/simd.h>

#include <cstddef>
#include <cstring>

// The dense loops that a sparse Cholesky decomposition consists of, in the best variant of SIMD.
// Matrices are stored column by column.

namespace gslam {
inline namespace v1 {
namespace detail {

// Rows are read and written in multiples of this, the doubles of the largest register.
constexpr std::size_t kPanelPadding = 8;

// c = a b^T, or c -= a b^T; a is (rows x depth), b is (columns x depth). Elements of c above the
// diagonal are not wanted and may have any value afterwards.
struct PanelProduct {
  const double* a;
  const double* b;
  std::size_t stride;  // of a and b
  double* c;
  std::size_t c_stride;
  std::size_t rows;  // is rounded up
  std::size_t columns;
  std::size_t depth;
  bool is_subtracted;
};

struct PanelKernels {
  void (*multiply)(const PanelProduct& product);
  // Solves x l^T = panel in place, (rows x n) with n <= 8. `l`: lower triangle in rows of
  // kPanelPadding, with the inverses of its diagonal.
  void (*divide)(const double* l, std::size_t n, double* panel, std::size_t stride,
                 std::size_t rows);
  void (*addProduct)(const double* a, std::size_t stride, std::size_t rows, std::size_t columns,
                     const double* x, double* y);  // y += a x
  double (*dot)(const double* a, const double* x, std::size_t rows);
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

// Tiles stay in registers only where their loops are unrolled, which compilers do not do by
// themselves at every level.
#if defined(__clang__)
#define GSLAM_PANEL_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define GSLAM_PANEL_UNROLL _Pragma("GCC unroll 8")
#else
#define GSLAM_PANEL_UNROLL
#endif

#define GSLAM_PANEL_VARIANT panel_scalar
#define GSLAM_PANEL_WIDTH 2
#define GSLAM_PANEL_COLUMNS 4
#include "sparse/panel_variant.h"
#undef GSLAM_PANEL_VARIANT
#undef GSLAM_PANEL_WIDTH
#undef GSLAM_PANEL_COLUMNS

#if GSLAM_X86
GSLAM_TARGET_AVX2
#define GSLAM_PANEL_VARIANT panel_avx2
#define GSLAM_PANEL_WIDTH 4
#define GSLAM_PANEL_COLUMNS 4
#include "sparse/panel_variant.h"
#undef GSLAM_PANEL_VARIANT
#undef GSLAM_PANEL_WIDTH
#undef GSLAM_PANEL_COLUMNS
GSLAM_TARGET_END

GSLAM_TARGET_AVX512
#define GSLAM_PANEL_VARIANT panel_avx512
#define GSLAM_PANEL_WIDTH 8
#define GSLAM_PANEL_COLUMNS 8
#include "sparse/panel_variant.h"
#undef GSLAM_PANEL_VARIANT
#undef GSLAM_PANEL_WIDTH
#undef GSLAM_PANEL_COLUMNS
GSLAM_TARGET_END
#endif

#undef GSLAM_PANEL_UNROLL

namespace gslam {
inline namespace v1 {
namespace detail {

inline const PanelKernels& panelKernels() {
  static constexpr SimdKernel<const PanelKernels*> kernel(
      &panel_scalar::kKernels, nullptr, GSLAM_IF_X86(&panel_avx2::kKernels),
      GSLAM_IF_X86(&panel_avx512::kKernels), nullptr);
  return *kernel.active();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_KERNELS_H
