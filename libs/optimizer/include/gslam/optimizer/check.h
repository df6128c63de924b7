#ifndef GSLAM_OPTIMIZER_CHECK_H
#define GSLAM_OPTIMIZER_CHECK_H

#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/pose_graph_problem.h>

#include <string>
#include <vector>

/// @file
/// What is wrong with a problem, before it is solved.

namespace gslam {
inline namespace v1 {

/// Something wrong or suspect in a problem.
struct ProblemFinding {
  bool is_error = false;  ///< whether solving would throw; else it is a warning of the summary
  std::string field;      ///< of the problem, with the index: `observation_point[17]`
  std::string problem;    ///< what is wrong and what was expected: `is 900, expected below 512`
};

/// Errors: sizes that differ, indices that are not there, numbers that are not finite, cameras that
/// are none, information that is not symmetric or not positive semi-definite, a freedom that the
/// model does not have. Warnings: poses, cameras and points without observations, points seen once,
/// points without parallax, nothing that fixes position, orientation or scale. Of each kind the
/// first one is named and the others are counted.
/// @param problem  to look at
/// @return errors first; empty: nothing
GSLAM_OPTIMIZER_EXPORT std::vector<ProblemFinding> checkBundle(const BundleProblem& problem);

/// @{
/// Errors as of checkBundle(), edges from a pose to itself, and singular information of a residual
/// that needs its inverse. Warnings: poses without edges, parts that are not connected to each
/// other or to an anchor, information that is singular.
/// @param problem  to look at
/// @return errors first; empty: nothing
GSLAM_OPTIMIZER_EXPORT std::vector<ProblemFinding> checkPoseGraph(
    const PoseGraphProblem<SE2d>& problem);
GSLAM_OPTIMIZER_EXPORT std::vector<ProblemFinding> checkPoseGraph(
    const PoseGraphProblem<SE3d>& problem);
GSLAM_OPTIMIZER_EXPORT std::vector<ProblemFinding> checkPoseGraph(
    const PoseGraphProblem<SIM3d>& problem);
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CHECK_H
