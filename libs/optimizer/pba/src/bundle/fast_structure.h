#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_STRUCTURE_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_STRUCTURE_H

#include <gslam/optimizer/bundle_problem.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "raw_vector.h"

// A bundle in the order in which it is solved: points by their first block of variables, the
// observations of a point together, in the order of their blocks.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

constexpr std::uint32_t kNoBlock = std::numeric_limits<std::uint32_t>::max();

// The pose of a body, with the intrinsics of a camera where they are variables.
struct FastBlock {
  std::uint32_t pose = 0;
  std::uint32_t camera = kNoBlock;  // whose intrinsics are variables; kNoBlock: none
  bool is_pose_free = true;
};

// A camera on a body.
struct FastView {
  std::uint32_t pose = 0;
  std::uint32_t camera = 0;
  std::uint32_t block = kNoBlock;  // kNoBlock: nothing of it is a variable
  bool is_plain = false;           // pinhole, or radtan with 4 or 5 coefficients
  bool has_free_camera = false;
};

struct FastStructure {
  std::size_t freedom = 6;  // of a block: 6, or 9 with the intrinsics of a BAL camera
  bool has_rig = false;     // some camera is not its body
  bool all_plain = true;
  std::vector<FastView> views;
  std::vector<std::uint32_t> block_of_view;  // as the views say, but close together
  std::vector<FastBlock> blocks;
  std::vector<std::uint32_t> points;       // which points of the problem
  std::vector<std::uint32_t> point_begin;  // their first observation; one more as the end
  RawVector<std::uint32_t> sources;        // which observations of the problem
  RawVector<std::uint32_t> view_of;        // of each observation
  RawVector<double> seen_u, seen_v;        // its pixel
  std::vector<std::uint32_t> row_begin;    // of each block the first in `row`; one more as the end
  RawVector<std::uint32_t> row;            // its observations, ascending
  std::vector<std::uint32_t> task_begin;   // first point of each task; one more as the end
  std::size_t left_out = 0;                // observations that are not seen at the start
  std::size_t most_in_task = 0;            // observations of the largest task

  std::size_t observationCount() const { return sources.size(); }
  std::uint32_t blockOf(std::size_t observation) const {
    return block_of_view[view_of[observation]];
  }
};

// Whether the camera has the formula that is computed in lanes.
bool isPlainCamera(const Camera& camera);
// Whether the freedom is that of a BAL camera: f with a fixed aspect, k1, k2.
bool isBalFreedom(const Camera& camera, const CameraFreedom& freedom);

// The same for any number of threads.
FastStructure makeFastStructure(const BundleProblem& problem, unsigned threads);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_STRUCTURE_H
