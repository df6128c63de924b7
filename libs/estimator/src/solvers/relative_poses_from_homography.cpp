#include <gslam/estimator/solvers/relative_poses_from_homography.h>

#include <algorithm>

#include "math/check_size.h"
#include "math/homography_motions.h"

namespace gslam {
inline namespace v1 {

std::size_t relativePosesFromHomography(const Mat3d& H_second_first, Span<const Vec3d> first,
                                        Span<const Vec3d> second,
                                        std::array<HomographyMotion, 4>& motions) {
  detail::checkSizes("first", first.size(), "second", second.size(), 1);
  std::size_t ahead = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    ahead += (H_second_first * first[i]).dot(second[i]) > 0;
  }
  const double sign = 2 * ahead >= first.size() ? 1 : -1;
  const Mat3d h = sign * H_second_first;
  std::array<HomographyMotion, 4> all;
  const std::size_t count = detail::homographyMotions(h, all);

  // With h = R + t n^T, h x is what the second camera sees of the plane's point x / (n x).
  std::size_t seen[4] = {};
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!((h * first[i]).dot(second[i]) > 0)) continue;
    for (std::size_t k = 0; k < count; ++k) {
      // A camera that only turned sees all.
      seen[k] += count == 1 || all[k].normal_first.dot(first[i]) > 0;
    }
  }
  const std::size_t most = *std::max_element(seen, seen + 4);
  if (2 * most <= first.size()) return 0;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (seen[k] == most) motions[kept++] = all[k];
  }
  return kept;
}

}  // namespace v1
}  // namespace gslam
