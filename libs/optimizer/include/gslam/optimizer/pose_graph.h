#ifndef GSLAM_OPTIMIZER_POSE_GRAPH_H
#define GSLAM_OPTIMIZER_POSE_GRAPH_H

#include <gslam/optimizer/id_map.h>
#include <gslam/optimizer/pose_graph_problem.h>

#include <cstdint>
#include <vector>

/// @file
/// A pose graph that owns its arrays: what files hold.

namespace gslam {
inline namespace v1 {

/// The arrays of a PoseGraphProblem, owned. Fields as there.
/// @tparam Group  SE2d, SE3d or SIM3d
///
/// Thread-safety: as a vector.
template <class Group>
struct PoseGraph {
  std::vector<Group> T_world_body;                          ///< poses
  std::vector<std::uint8_t> pose_fixed;                     ///< empty or one for each pose
  std::vector<std::uint32_t> from;                          ///< n
  std::vector<std::uint32_t> to;                            ///< n
  std::vector<Group> T_from_to;                             ///< n
  std::vector<typename Group::Jacobian> information;        ///< empty or n
  std::vector<std::uint8_t> is_robust;                      ///< empty or n
  std::vector<std::uint32_t> prior_pose;                    ///< m
  std::vector<Group> prior_T_world_body;                    ///< m
  std::vector<typename Group::Jacobian> prior_information;  ///< m
  IdMap ids;  ///< names that the file has for poses; or empty

  /// Views of the arrays, for optimizePoseGraph(). They must not outlive this object, nor a change
  /// of the size of one.
  /// @param residual  what is minimised
  PoseGraphProblem<Group> problem(PoseGraphResidual residual = PoseGraphResidual::Logarithm) {
    PoseGraphProblem<Group> views;
    views.T_world_body = T_world_body;
    views.pose_fixed = pose_fixed;
    views.from = from;
    views.to = to;
    views.T_from_to = T_from_to;
    views.information = information;
    views.is_robust = is_robust;
    views.residual = residual;
    views.prior_pose = prior_pose;
    views.prior_T_world_body = prior_T_world_body;
    views.prior_information = prior_information;
    return views;
  }
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_POSE_GRAPH_H
