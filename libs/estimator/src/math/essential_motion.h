// The motions of an essential matrix.
#ifndef GSLAM_ESTIMATOR_MATH_ESSENTIAL_MOTION_H
#define GSLAM_ESTIMATOR_MATH_ESSENTIAL_MOTION_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

namespace gslam {
inline namespace v1 {
namespace detail {

// E = [t]x rotations[0] = -[t]x rotations[1] up to a positive scale, |t| = 1.
struct EssentialMotion {
  Vec3d t;
  Mat3d rotations[2];

  // False where there is none.
  bool set(const Mat3d& essential) noexcept;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_ESSENTIAL_MOTION_H
