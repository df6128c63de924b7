#include "robust/point_kernels.h"

#include <gslam/base/platform.h>

#include <cmath>

// Vectors of 128 bits are in what x86-64 and arm64 always have.
#define GSLAM_POINT_VARIANT plain
#include "robust/point_variant.h"
#undef GSLAM_POINT_VARIANT

#if GSLAM_X86
GSLAM_TARGET_AVX2
#define GSLAM_POINT_VARIANT avx2
#include "robust/point_variant.h"
#undef GSLAM_POINT_VARIANT
GSLAM_TARGET_END
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

const PointKernels::Kernel& PointKernels::homography() {
  static constexpr Kernel kernel(plain::homography, nullptr, GSLAM_IF_X86(avx2::homography),
                                 nullptr, nullptr);
  return kernel;
}

const PointKernels::Kernel& PointKernels::bearingHomography() {
  static constexpr Kernel kernel(plain::bearingHomography, nullptr,
                                 GSLAM_IF_X86(avx2::bearingHomography), nullptr, nullptr);
  return kernel;
}

const PointKernels::Kernel& PointKernels::affine2D() {
  static constexpr Kernel kernel(plain::affine2D, nullptr, GSLAM_IF_X86(avx2::affine2D), nullptr,
                                 nullptr);
  return kernel;
}

const PointKernels::Kernel& PointKernels::affine3D() {
  static constexpr Kernel kernel(plain::affine3D, nullptr, GSLAM_IF_X86(avx2::affine3D), nullptr,
                                 nullptr);
  return kernel;
}

const PointKernels::Kernel& PointKernels::plane() {
  static constexpr Kernel kernel(plain::plane, nullptr, GSLAM_IF_X86(avx2::plane), nullptr,
                                 nullptr);
  return kernel;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
