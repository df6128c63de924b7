#ifndef GSLAM_OPTIMIZER_MARGINALIZE_H
#define GSLAM_OPTIMIZER_MARGINALIZE_H

#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/pose_graph.h>

#include <cstdint>

/// @file
/// What remains of a bundle when points and poses are taken out of it.

namespace gslam {
inline namespace v1 {

/// The prior on some poses that a bundle leaves when all else is eliminated: its points, its other
/// poses, and whatever of it is known. Poses that are kept and fixed are left out of the result.
///
/// For a window that moves: make a bundle of what leaves it (the observations of the points that
/// the oldest pose sees, all that is known of it, the prior of before), keep the other poses, and
/// give the result to the next window in place of all that. Each observation must be in one of the
/// two. Time is linear in observations, and cubic in the poses and cameras that are coupled.
/// @param problem  at its optimum, or near it
/// @param keep     poses to keep, each once; their indices stand in the result
/// @param loss     of observations: weights are those of the present values
/// @return the prior, linearised at the present poses. Its information has no inverse where nothing
///   fixes the whole
/// @throws ArgumentError for what checkBundle() calls an error, and for a pose that is not there or
///   named twice
GSLAM_OPTIMIZER_EXPORT WindowPrior marginalize(const BundleProblem& problem,
                                               Span<const std::uint32_t> keep,
                                               const RobustLoss& loss = {});

/// The pose graph of a bundle: an edge between each two poses that see at least `min_shared` points
/// together, measured by the present poses, its information that of the relative pose when the
/// points both see are eliminated and nothing else is known. Pairs that see outliers only have
/// none.
///
/// Two views of one camera do not know how far they are apart: without a rig or stereo the
/// information has rank 5, of which checkPoseGraph() warns. Solving such a graph keeps directions;
/// distances follow from them where poses are not on a line, and need two poses that are fixed.
/// @param problem     at its optimum, or near it
/// @param min_shared  points; at least 3
/// @param loss        of observations
/// @return the graph, its poses with the indices that they have in the problem
/// @throws ArgumentError as marginalize()
GSLAM_OPTIMIZER_EXPORT PoseGraph<SE3d> poseGraphOf(const BundleProblem& problem,
                                                   std::size_t min_shared = 15,
                                                   const RobustLoss& loss = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_MARGINALIZE_H
