#include <gslam/optimizer/check.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "anchorage.h"
#include "factors/pose_edge.h"
#include "findings.h"
#include "finite.h"
#include "information.h"

namespace gslam {
inline namespace v1 {
namespace {

using detail::Counted;
using detail::Findings;
using detail::InformationKind;

template <class Group>
void checkGraphSizes(const PoseGraphProblem<Group>& problem, Findings& findings) {
  const std::size_t n = problem.from.size(), m = problem.prior_pose.size();
  const auto check = [&](const char* name, std::size_t size, std::size_t expected, const char* as,
                         bool may_be_empty) {
    detail::checkSize(findings, name, size, expected, as, may_be_empty);
  };
  check("pose_fixed", problem.pose_fixed.size(), problem.T_world_body.size(), "T_world_body", true);
  check("to", problem.to.size(), n, "from", false);
  check("T_from_to", problem.T_from_to.size(), n, "from", false);
  check("information", problem.information.size(), n, "from", true);
  check("is_robust", problem.is_robust.size(), n, "from", true);
  check("prior_T_world_body", problem.prior_T_world_body.size(), m, "prior_pose", false);
  check("prior_information", problem.prior_information.size(), m, "prior_pose", false);
  if (static_cast<int>(problem.residual) < 0 || problem.residual > PoseGraphResidual::Chordal) {
    findings.error("residual", "is " + std::to_string(static_cast<int>(problem.residual)) +
                                   ", expected one of the enumerators");
  }
  if (std::is_same<Group, SIM3d>::value && problem.residual == PoseGraphResidual::Chordal) {
    findings.error("residual",
                   "is Chordal, which is not for SIM3: expected Logarithm or Quaternion");
  }
}

// Whether Chordal finds weights in it. Translations may be known 1e6 times better in one direction
// than in another, as those of INTEL are: that is not singular yet.
template <class Group>
bool hasChordalWeights(const typename Group::Jacobian& information) {
  const detail::EdgeWeight<Group> weight =
      detail::edgeWeight<Group>(PoseGraphResidual::Chordal, information);
  return weight.kappa_root > 0 && weight.tau_root > 0;
}

template <class Group>
void checkGraphInformation(const char* name, Span<const typename Group::Jacobian> all,
                           PoseGraphResidual residual, Findings& findings) {
  constexpr std::size_t n = Group::kFreedom;
  Counted bad, singular;
  const char* first_complaint = "";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const InformationKind kind = detail::informationKind(all[i].data(), n, n);
    if (*detail::complaintAbout(kind) != 0) {
      if (bad.count == 0) first_complaint = detail::complaintAbout(kind);
      bad.note(i);
    } else if (residual == PoseGraphResidual::Chordal ? !hasChordalWeights<Group>(all[i])
                                                      : kind == InformationKind::Singular) {
      singular.note(i);
    }
  }
  findings.errors(name, bad, first_complaint);
  if (residual == PoseGraphResidual::Chordal) {
    findings.errors(name, singular, "is singular, expected one with an inverse for Chordal");
  } else {
    findings.warnings(name, singular, "is singular: some direction of the residual costs nothing");
  }
}

template <class Group>
void findLoops(const PoseGraphProblem<Group>& problem, Findings& findings) {
  Counted loops;
  for (std::size_t i = 0; i < problem.from.size(); ++i) {
    if (problem.from[i] == problem.to[i]) loops.note(i);
  }
  findings.errors("to", loops, "is the pose that the edge comes from");
}

template <class Group>
void findLooseParts(const PoseGraphProblem<Group>& problem, Findings& findings) {
  detail::Anchorage anchorage(problem);
  Counted unused, loose;
  for (std::uint32_t i = 0; i < problem.T_world_body.size(); ++i) {
    if (!anchorage.isUsed(i)) {
      unused.note(i);
    } else if (anchorage.isFirst(i) && !anchorage.isHeld(i)) {
      loose.note(i);
    }
  }
  findings.warnings("T_world_body", unused, "has no edges: it stays");
  findings.warnings("T_world_body", loose,
                    "begins a part that no edge connects to an anchor: it stays near the start");
}

template <class Group>
std::vector<ProblemFinding> checkGraph(const PoseGraphProblem<Group>& problem) {
  Findings findings;
  checkGraphSizes(problem, findings);
  if (findings.hasErrors()) return findings.take();
  const std::size_t poses = problem.T_world_body.size();
  detail::checkIndices(findings, "from", problem.from, poses);
  detail::checkIndices(findings, "to", problem.to, poses);
  detail::checkIndices(findings, "prior_pose", problem.prior_pose, poses);
  detail::checkFinite(findings, "T_world_body", Span<const Group>(problem.T_world_body));
  detail::checkFinite(findings, "T_from_to", problem.T_from_to);
  detail::checkFinite(findings, "prior_T_world_body", problem.prior_T_world_body);
  checkGraphInformation<Group>("information", problem.information, problem.residual, findings);
  checkGraphInformation<Group>("prior_information", problem.prior_information, problem.residual,
                               findings);
  findLoops(problem, findings);
  if (!findings.hasErrors()) findLooseParts(problem, findings);
  return findings.take();
}

}  // namespace

std::vector<ProblemFinding> checkPoseGraph(const PoseGraphProblem<SE2d>& problem) {
  return checkGraph(problem);
}
std::vector<ProblemFinding> checkPoseGraph(const PoseGraphProblem<SE3d>& problem) {
  return checkGraph(problem);
}
std::vector<ProblemFinding> checkPoseGraph(const PoseGraphProblem<SIM3d>& problem) {
  return checkGraph(problem);
}

}  // namespace v1
}  // namespace gslam
