// Two rays in the frame of the first camera.
#ifndef GSLAM_ESTIMATOR_MATH_TWO_RAYS_H
#define GSLAM_ESTIMATOR_MATH_TWO_RAYS_H

#include <gslam/base/platform.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>

namespace gslam {
inline namespace v1 {
namespace detail {

// Of the sine of the angle between two rays that meet, squared.
constexpr double kLeastParallax = 1e-24;

struct TwoRays {
  GSLAM_ALWAYS_INLINE TwoRays(const SE3d& T_second_first, const Vec3d& first,
                              const Vec3d& second) noexcept
      : f(first),
        g(T_second_first.rotation().inverse() * second),
        c(T_second_first.rotation().inverse() * -T_second_first.translation()) {}

  const Vec3d f;  // from the first camera, at the origin
  const Vec3d g;  // from the second
  const Vec3d c;  // the second camera
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_TWO_RAYS_H
