// The decomposition of a homography whose sign is known.
#ifndef GSLAM_ESTIMATOR_MATH_HOMOGRAPHY_MOTIONS_H
#define GSLAM_ESTIMATOR_MATH_HOMOGRAPHY_MOTIONS_H

#include <gslam/estimator/solvers/decompose_homography.h>

#include <array>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// H = s (R + t n^T) with s > 0.
std::size_t homographyMotions(const Mat3d& H, std::array<HomographyMotion, 4>& motions) noexcept;

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_MATH_HOMOGRAPHY_MOTIONS_H
