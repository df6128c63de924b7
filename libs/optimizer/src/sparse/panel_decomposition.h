#ifndef GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_DECOMPOSITION_H
#define GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_DECOMPOSITION_H

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sparse/panel_kernels.h"
#include "sparse/panel_plan.h"

// Cholesky decomposition of a dense panel in place. All say whether it is positive definite, and
// lower `least_pivot` to what is left of a diagonal element, `largest` before anything was
// subtracted from it.

namespace gslam {
inline namespace v1 {
namespace detail {

inline bool decomposeCorner(const double* corner, std::size_t stride, std::size_t n,
                            const double* largest, double* l, double& least_pivot) {
  constexpr std::size_t w = kPanelPadding;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      double sum = corner[i + k * stride];
      for (std::size_t m = 0; m < k; ++m) sum -= l[i * w + m] * l[k * w + m];
      if (k < i) {
        l[i * w + k] = sum * l[k * w + k];
      } else {
        if (!(sum > 0 && sum <= std::numeric_limits<double>::max())) return false;
        least_pivot = std::min(least_pivot, sum / largest[i]);
        l[i * w + i] = 1 / std::sqrt(sum);
      }
    }
  }
  return true;
}

// Columns by eights, each of which takes from itself what those of the group contribute.
inline bool decomposeGroup(const Panel& layout, double* panel, std::size_t begin,
                           const double* largest, double& least_pivot) {
  const PanelKernels& kernels = panelKernels();
  const std::size_t stride = layout.stride;
  const std::size_t end = std::min(begin + 8 * kPanelPadding, layout.columns);
  for (std::size_t j = begin; j < end; j += kPanelPadding) {
    const std::size_t n = std::min(kPanelPadding, end - j);
    double* const corner = panel + j + j * stride;
    if (j > begin) {
      const double* const left = panel + j + begin * stride;
      kernels.multiply({left, left, stride, corner, stride, stride - j, n, j - begin, true});
    }
    double l[kPanelPadding * kPanelPadding];
    if (!decomposeCorner(corner, stride, n, largest + j, l, least_pivot)) return false;
    kernels.divide(l, n, corner, stride, stride - j);
  }
  return true;
}

// By groups of columns, each of which is subtracted from all those after it.
inline bool decomposePanel(const Panel& layout, double* panel, const double* largest,
                           unsigned threads, double& least_pivot) {
  constexpr std::size_t group = 8 * kPanelPadding, share = 4 * kPanelPadding;
  const std::size_t stride = layout.stride;
  ParallelOptions parallel;
  parallel.threads = threads;
  parallel.grain = share;
  for (std::size_t j = 0; j < layout.columns; j += group) {
    const std::size_t next = j + group;
    if (!decomposeGroup(layout, panel, j, largest, least_pivot)) return false;
    parallelChunks(
        next, layout.columns,
        [&](std::size_t first, std::size_t last) {
          const double* const left = panel + first + j * stride;
          panelKernels().multiply({left, left, stride, panel + first + first * stride, stride,
                                   stride - first, last - first, group, true});
        },
        parallel);
  }
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_DECOMPOSITION_H
