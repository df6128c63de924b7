// Frames across a bearing.
#ifndef GSLAM_ESTIMATOR_ROBUST_BEARING_FRAME_H
#define GSLAM_ESTIMATOR_ROBUST_BEARING_FRAME_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

namespace gslam {
inline namespace v1 {
namespace detail {

// The rows that turn a change of the bearing into one of the pixel, or into radians: those of a
// bearing are unit vectors at right angles to it and to each other.
Mat<double, 2, 3> frameOfBearing(const Vec3d& bearing);
Mat<double, 2, 3> frameOfPixel(const Mat<double, 3, 2>& bearing_by_pixel);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_BEARING_FRAME_H
