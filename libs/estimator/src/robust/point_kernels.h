// Squared residuals of maps between points, in SIMD variants.
#ifndef GSLAM_ESTIMATOR_ROBUST_POINT_KERNELS_H
#define GSLAM_ESTIMATOR_ROBUST_POINT_KERNELS_H

#include <gslam/base/simd.h>

#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// Columns of floats, one for each number of a match; `map` is a matrix, row by row.
struct PointKernels {
  using Squared = void (*)(const float* map, float factor, const float* const* columns,
                           std::size_t first, std::size_t count, float* squared);
  using Kernel = SimdKernel<Squared>;
  // x1 y1 x2 y2, 3 x 3: factor |H x1 - x2|^2 as pixels; infinite beyond the horizon.
  static const Kernel& homography();
  // b1 (3), b2 (3), A (2 x 3, row by row), 3 x 3: factor |A y / (b2 y)|^2 with y = H b1.
  static const Kernel& bearingHomography();
  // x1 y1 x2 y2, 2 x 3: factor |A (x1, 1) - x2|^2.
  static const Kernel& affine2D();
  // x1 y1 z1 x2 y2 z2, 3 x 4.
  static const Kernel& affine3D();
  // x y z, 1 x 4: factor (n x + d)^2.
  static const Kernel& plane();
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_POINT_KERNELS_H
