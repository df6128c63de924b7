#include "robust/kernels.h"

#include <gslam/base/platform.h>

#include <cmath>
#include <cstring>

// The baseline has vectors of 128 bits on both x86-64 and arm64.
#define GSLAM_DETAIL_VARIANT baseline
#include "robust/kernel_bodies.h"
#undef GSLAM_DETAIL_VARIANT

#if GSLAM_X86
GSLAM_TARGET_AVX2
#define GSLAM_DETAIL_VARIANT avx2
#include "robust/kernel_bodies.h"
#undef GSLAM_DETAIL_VARIANT
GSLAM_TARGET_END
#endif

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Vectors of 512 bits gain nothing here: divisions and loads are the limit.
#define GSLAM_DETAIL_KERNEL(Function, name)                                                       \
  static constexpr SimdKernel<Function> kernel(baseline::name, nullptr, GSLAM_IF_X86(avx2::name), \
                                               nullptr, nullptr);                                 \
  return kernel.active()

template <EpipolarKind kind>
SampsonBlockFunction blockFunction() {
  GSLAM_DETAIL_KERNEL(SampsonBlockFunction, sampsonBlock<kind>);
}

SquaredFunction planeFunction() {
  GSLAM_DETAIL_KERNEL(SquaredFunction, sampsonPlane);
}
SquaredFunction sphereFunction() {
  GSLAM_DETAIL_KERNEL(SquaredFunction, sampsonSphere);
}
SquaredFunction framesFunction() {
  GSLAM_DETAIL_KERNEL(SquaredFunction, sampsonFrames);
}

}  // namespace

SquaredFunction sampsonFunction(EpipolarKind kind) {
  if (kind == EpipolarKind::Plane) return planeFunction();
  return kind == EpipolarKind::Sphere ? sphereFunction() : framesFunction();
}

SquaredFunction reprojectPlaneFunction() {
  GSLAM_DETAIL_KERNEL(SquaredFunction, reprojectPlane);
}
SquaredFunction reprojectFramesFunction() {
  GSLAM_DETAIL_KERNEL(SquaredFunction, reprojectFrames);
}

SampsonBlockFunction sampsonBlockFunction(EpipolarKind kind) {
  if (kind == EpipolarKind::Plane) return blockFunction<EpipolarKind::Plane>();
  if (kind == EpipolarKind::Sphere) return blockFunction<EpipolarKind::Sphere>();
  return blockFunction<EpipolarKind::Frames>();
}

ReprojectBlockFunction reprojectBlockFunction() {
  GSLAM_DETAIL_KERNEL(ReprojectBlockFunction, reprojectBlock);
}

#undef GSLAM_DETAIL_KERNEL

}  // namespace detail
}  // namespace v1
}  // namespace gslam
