#ifndef GSLAM_OPTIMIZER_FILES_ANY_POSE_GRAPH_H
#define GSLAM_OPTIMIZER_FILES_ANY_POSE_GRAPH_H

#include <gslam/optimizer/pose_graph.h>

#include <variant>

/// @file
/// A pose graph of any kind.

namespace gslam {
inline namespace v1 {

/// What a file of a pose graph has: poses in the plane, in space, or with a scale.
using AnyPoseGraph = std::variant<PoseGraph<SE2d>, PoseGraph<SE3d>, PoseGraph<SIM3d>>;

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_FILES_ANY_POSE_GRAPH_H
