#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_STATE_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_STATE_H

#include <gslam/optimizer/bundle_problem.h>

#include <array>
#include <cstddef>
#include <vector>

#include "bundle/fast_kernels.h"
#include "bundle/fast_structure.h"
#include "raw_vector.h"

// The variables of a bundle, in the order of its structure.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

struct FastState {
  std::vector<SE3d> poses;                        // of blocks
  std::vector<std::array<double, 3>> intrinsics;  // of blocks with a camera: f k1 k2
  RawVector<double> points;                       // 3 of each
  std::vector<double> views;                      // viewNumbers() of each
};

// Those that tell of the rig only where there is one.
inline std::size_t viewNumbers(const FastStructure& structure) {
  return structure.has_rig ? std::size_t(kViewNumbers) : std::size_t(kRigRotation);
}

// The problem as it is now.
FastState makeFastState(const BundleProblem& problem, const FastStructure& structure,
                        unsigned threads);
// The same, but points have no values.
FastState stateWithoutPoints(const FastState& state);
// `moved` becomes the poses and intrinsics of `state` with the step of all blocks; its points are
// left. False where there are no such variables.
bool moveBlocks(const BundleProblem& problem, const FastStructure& structure,
                const FastState& state, const std::vector<double>& step, FastState& moved);
// Writes the variables into the problem; what is fixed is not touched.
void writeFastState(const FastStructure& structure, const FastState& state,
                    const BundleProblem& problem);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_STATE_H
