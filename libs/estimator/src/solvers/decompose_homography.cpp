#include <gslam/estimator/solvers/decompose_homography.h>
#include <gslam/geometry/detail/rotation_matrix.h>

#include "math/homography_motions.h"

namespace gslam {
inline namespace v1 {

std::size_t decomposeHomography(const Mat3d& H_second_first,
                                std::array<HomographyMotion, 4>& motions) noexcept {
  const bool is_opposite = detail::determinant(H_second_first) < 0;
  return detail::homographyMotions(is_opposite ? -H_second_first : H_second_first, motions);
}

}  // namespace v1
}  // namespace gslam
