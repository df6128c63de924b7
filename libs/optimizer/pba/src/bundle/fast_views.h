#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_VIEWS_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_VIEWS_H

#include <gslam/base/parallel.h>
#include <gslam/optimizer/bundle_problem.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bundle/fast_structure.h"
#include "raw_vector.h"

// Which cameras see from which poses, and what of them is a variable.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

inline ParallelOptions fastParallel(std::size_t grain, unsigned threads) {
  ParallelOptions options;
  options.grain = grain;
  options.threads = threads;
  return options;
}

inline std::uint32_t cameraOfObservation(const BundleProblem& problem, std::size_t k) {
  return problem.observation_camera.empty() ? 0 : problem.observation_camera[k];
}

inline bool isCameraFree(const BundleProblem& problem, std::size_t camera) {
  return !problem.camera_freedom.empty() && problem.camera_freedom[camera].parameters != 0;
}

// Fills views and blocks of the structure, in the order of poses and cameras.
void makeViews(const BundleProblem& problem, unsigned threads, FastStructure& structure);

// The view of each observation of the problem, kNoBlock where it is not seen at the start, of which
// left_out counts them; and how many see each point.
RawVector<std::uint32_t> viewOfObservations(const BundleProblem& problem, unsigned threads,
                                            FastStructure& structure,
                                            std::vector<std::atomic<std::uint32_t>>& seen_by);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_VIEWS_H
