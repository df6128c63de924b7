#include <gslam/base/error.h>
#include <gslam/optimizer/check.h>
#include <gslam/optimizer/initialize_poses.h>

#include <vector>

#include "initialize_poses_chordal.h"
#include "initialize_poses_roots.h"

namespace gslam {
inline namespace v1 {
namespace {

template <class Group>
PoseInitialization initializeGraph(const PoseGraphProblem<Group>& problem,
                                   PoseInitialization kind) {
  for (const ProblemFinding& finding : checkPoseGraph(problem)) {
    if (finding.is_error) throw ArgumentError(finding.field, finding.problem);
  }
  detail::PoseTree<Group> tree(problem);
  if (kind == PoseInitialization::Chordal) {
    detail::ChordalStart<Group> chordal(problem, tree);
    std::vector<Group> poses = tree.poses;
    if (chordal.solve(poses)) {
      tree.poses.swap(poses);
    } else {
      kind = PoseInitialization::SpanningTree;
    }
  }
  for (std::size_t i = 0; i < tree.poses.size(); ++i) {
    if (tree.is_known[i] == 0) problem.T_world_body[i] = tree.poses[i];
  }
  return kind;
}

}  // namespace

PoseInitialization initializePoses(const PoseGraphProblem<SE2d>& problem, PoseInitialization kind) {
  return initializeGraph(problem, kind);
}
PoseInitialization initializePoses(const PoseGraphProblem<SE3d>& problem, PoseInitialization kind) {
  return initializeGraph(problem, kind);
}
PoseInitialization initializePoses(const PoseGraphProblem<SIM3d>& problem,
                                   PoseInitialization kind) {
  return initializeGraph(problem, kind);
}

}  // namespace v1
}  // namespace gslam
