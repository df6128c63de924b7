#ifndef GSLAM_OPTIMIZER_INITIALIZE_POSES_H
#define GSLAM_OPTIMIZER_INITIALIZE_POSES_H

#include <gslam/optimizer/pose_graph_problem.h>

#include <cstddef>

/// @file
/// Where to start a pose graph.

namespace gslam {
inline namespace v1 {

/// How poses are initialised.
enum class PoseInitialization {
  /// Rotations from the linear relaxation of the chordal distance, projected to rotations
  /// (Martinec, Pajdla, CVPR 2007; Carlone et al., "Initialization techniques for 3D SLAM", ICRA
  /// 2015), then translations from linear least squares.
  Chordal,
  SpanningTree  ///< measured poses one after the other, along a tree of fewest edges from an anchor
};

/// @{
/// Replaces all poses that are not fixed. Each connected part of the graph begins at its fixed
/// poses, else at its priors of all freedoms, else at its lowest index, which stays where it is.
/// Priors of positions alone are not used: alignTrajectories() finds what brings all poses onto
/// them.
/// @param problem  poses and edges
/// @param kind     how
/// @return what was done: Chordal falls back to SpanningTree where its equations cannot be solved
/// @throws ArgumentError for what checkPoseGraph() calls an error
GSLAM_OPTIMIZER_EXPORT PoseInitialization initializePoses(
    const PoseGraphProblem<SE2d>& problem, PoseInitialization kind = PoseInitialization::Chordal);
GSLAM_OPTIMIZER_EXPORT PoseInitialization initializePoses(
    const PoseGraphProblem<SE3d>& problem, PoseInitialization kind = PoseInitialization::Chordal);
GSLAM_OPTIMIZER_EXPORT PoseInitialization initializePoses(
    const PoseGraphProblem<SIM3d>& problem, PoseInitialization kind = PoseInitialization::Chordal);
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_INITIALIZE_POSES_H
