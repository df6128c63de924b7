#ifndef GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_TILES_H
#define GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_TILES_H

#include <gslam/optimizer/pose_problem.h>

#include <cstddef>

#include "small/pose_kernel.h"

// The observations of a pose, column by column, as the kernels read them.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Up to kPoseBlock observations of one camera, among those from `begin` to `end`.
struct PoseTile {
  PoseBlock block;
  std::size_t begin, end, count;
};

// What does not depend on the pose is written once, as far as the memory here goes, and anew for
// each use beyond.
class PoseTiles {
 public:
  PoseTiles(const PoseProblem& problem, const SE3d& start) : problem_(problem), start_(start) {}

  // use(tile) for all of camera c. Cameras come in their order, from the first one each time.
  template <class Use>
  void forCamera(std::size_t c, const Use& use) {
    if (c == 0) next_ = 0;
    for (std::size_t i = 0; i < problem_.points.size();) {
      const bool is_kept = next_ < kKept;
      PoseTile& tile = tiles_[is_kept ? next_ : kKept];
      if (!is_kept || next_ == filled_) {
        fill(c, i, tile);
        if (is_kept) ++filled_;
      }
      if (is_kept) ++next_;
      i = tile.end;
      if (tile.count > 0) use(tile);
    }
  }

  bool isOf(std::size_t i, std::size_t c) const {
    return problem_.camera_of.empty() ? c == 0 : problem_.camera_of[i] == c;
  }

 private:
  static constexpr std::size_t kKept = 16;  // tiles: 1024 observations, 66 KB of the stack

  void fill(std::size_t c, std::size_t begin, PoseTile& tile) const;
  void put(const std::size_t* index, PoseTile& tile) const;

  const PoseProblem& problem_;
  const SE3d start_;
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
  PoseTile tiles_[kKept + 1];  // the last one is for all beyond
};

// T_camera_body.
inline SE3d cameraOfBody(const PoseProblem& problem, std::size_t c) {
  return problem.T_body_camera.empty() ? SE3d() : problem.T_body_camera[c].inverse();
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_TILES_H
