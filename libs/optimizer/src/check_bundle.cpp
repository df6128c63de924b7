#include <gslam/optimizer/check.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bundle_warnings.h"
#include "findings.h"
#include "finite.h"
#include "information.h"

// The errors of a bundle. What is suspect is found in bundle_warnings.cpp.

namespace gslam {
inline namespace v1 {
namespace {

using detail::Counted;
using detail::Findings;

// marginalize() takes differences of large numbers.
constexpr double kWindowRounding = 1e-6;

void checkSizes(const BundleProblem& problem, Findings& findings) {
  const auto check = [&](const char* name, std::size_t size, std::size_t expected, const char* as,
                         bool may_be_empty) {
    detail::checkSize(findings, name, size, expected, as, may_be_empty);
  };
  const std::size_t poses = problem.T_world_body.size(), points = problem.points.size();
  const std::size_t cameras = problem.cameras.size(), n = problem.pixels.size();
  check("pose_fixed", problem.pose_fixed.size(), poses, "T_world_body", true);
  check("point_fixed", problem.point_fixed.size(), points, "points", true);
  check("point_anchor", problem.point_anchor.size(), points, "points", true);
  check("camera_freedom", problem.camera_freedom.size(), cameras, "cameras", true);
  check("T_body_camera", problem.T_body_camera.size(), cameras, "cameras", true);
  check("T_body_camera_free", problem.T_body_camera_free.size(), problem.T_body_camera.size(),
        "T_body_camera", true);
  check("observation_pose", problem.observation_pose.size(), n, "pixels", false);
  check("observation_point", problem.observation_point.size(), n, "pixels", false);
  check("observation_camera", problem.observation_camera.size(), n, "pixels", true);
  check("information", problem.information.size(), n, "pixels", true);
  check("right_u", problem.right_u.size(), n, "pixels", true);
  check("baseline", problem.baseline.size(), cameras, "cameras", problem.right_u.empty());
  if (n != 0 && cameras == 0) findings.error("cameras", "is empty, expected one or more");
  if (n > detail::kMostObservations) {
    findings.error("pixels", "has " + std::to_string(n) + " elements, expected at most " +
                                 std::to_string(detail::kMostObservations));
  }
}

void checkAnchors(const BundleProblem& problem, Findings& findings) {
  Counted bad, at_anchor;
  for (std::size_t i = 0; i < problem.point_anchor.size(); ++i) {
    const std::uint32_t anchor = problem.point_anchor[i];
    if (anchor == BundleProblem::kNoAnchor) continue;
    if (anchor >= problem.T_world_body.size()) {
      bad.note(i);
    } else if (std::isinf(
                   1 / (problem.points[i] - problem.T_world_body[anchor].translation()).norm())) {
      at_anchor.note(i);
    }
  }
  if (bad.count != 0) {
    findings.errors("point_anchor", bad,
                    "is " + std::to_string(problem.point_anchor[bad.first]) + ", expected below " +
                        std::to_string(problem.T_world_body.size()) + ", or kNoAnchor");
  }
  findings.errors("points", at_anchor, "is at its anchor: its inverse distance is infinite");
}

bool hasFreedom(const Camera& camera, const CameraFreedom& freedom) {
  const std::size_t count = camera.parameterCount();
  return count >= 32 || (freedom.parameters >> count) == 0;
}

void checkCameras(const BundleProblem& problem, Findings& findings) {
  Counted none, no_freedom;
  for (std::size_t i = 0; i < problem.cameras.size(); ++i) {
    if (!problem.cameras[i].isValid()) {
      none.note(i);
    } else if (!problem.camera_freedom.empty() &&
               !hasFreedom(problem.cameras[i], problem.camera_freedom[i])) {
      no_freedom.note(i);
    }
  }
  findings.errors("cameras", none, "is no camera");
  if (no_freedom.count == 0) return;
  const Camera& camera = problem.cameras[no_freedom.first];
  findings.errors("camera_freedom", no_freedom,
                  "has bits beyond the " + std::to_string(camera.parameterCount()) +
                      " parameters of " + camera.modelName());
}

void checkPixelInformation(const BundleProblem& problem, Findings& findings) {
  Counted not_finite, indefinite;
  for (std::size_t i = 0; i < problem.information.size(); ++i) {
    const Vec3d& w = problem.information[i];
    if (!detail::isFinite(w)) {
      not_finite.note(i);
    } else if (!detail::isSemiDefinite2(w[0], w[1], w[2])) {
      indefinite.note(i);
    }
  }
  findings.errors("information", not_finite, "is not finite");
  findings.errors("information", indefinite, "is not positive semi-definite");
}

void checkStereo(const BundleProblem& problem, Findings& findings) {
  if (problem.right_u.empty()) return;
  Counted infinite, no_baseline;
  for (std::size_t i = 0; i < problem.right_u.size(); ++i) {
    if (std::isnan(problem.right_u[i])) continue;
    if (std::isinf(problem.right_u[i])) infinite.note(i);
    const std::size_t camera =
        problem.observation_camera.empty() ? 0 : problem.observation_camera[i];
    if (camera >= problem.baseline.size()) continue;  // an error of its own
    const double baseline = problem.baseline[camera];
    if (!(baseline > 0 && std::isfinite(baseline))) no_baseline.note(i);
  }
  findings.errors("right_u", infinite, "is not finite, expected a number, or NaN for none");
  findings.errors("right_u", no_baseline,
                  "is given, but the baseline of its camera is not above 0 and finite");
}

void checkMatrix(const std::string& field, const double* values, std::size_t n, double rounding,
                 Findings& findings) {
  const char* const complaint =
      detail::complaintAbout(detail::informationKind(values, n, n, rounding));
  if (*complaint != 0) findings.error(field, complaint);
}

// The first prior of a list with errors, and what is wrong with it.
template <class Prior, class Check>
void checkPriors(const char* name, Span<const Prior> priors, const Check& check,
                 Findings& findings) {
  const std::size_t before = findings.errorCount();
  for (std::size_t i = 0; i < priors.size() && findings.errorCount() == before; ++i) {
    check(detail::elementOf(name, i), priors[i]);
  }
}

void checkPoseIndex(const std::string& field, std::uint32_t pose, const BundleProblem& problem,
                    Findings& findings) {
  if (pose < problem.T_world_body.size()) return;
  findings.error(field, "is " + std::to_string(pose) + ", expected below " +
                            std::to_string(problem.T_world_body.size()));
}

void checkWindow(const std::string& field, const WindowPrior& prior, const BundleProblem& problem,
                 Findings& findings) {
  const std::size_t n = prior.poses.size(), before = findings.errorCount();
  detail::checkSize(findings, (field + ".T_linear").c_str(), prior.T_linear.size(), n, "its poses",
                    false);
  if (prior.information.size() != 36 * n * n || prior.gradient.size() != 6 * n) {
    findings.error(field + ".information",
                   "or gradient has a size other than 36 n^2 and 6 n for its n = " +
                       std::to_string(n) + " poses");
  }
  if (findings.errorCount() != before) return;
  std::vector<std::uint8_t> is_named(problem.T_world_body.size(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::string element = detail::elementOf(field + ".poses", i);
    checkPoseIndex(element, prior.poses[i], problem, findings);
    if (findings.errorCount() != before) return;
    if (is_named[prior.poses[i]] != 0) findings.error(element, "is named twice");
    is_named[prior.poses[i]] = 1;
  }
  detail::checkFinite(findings, (field + ".T_linear").c_str(), Span<const SE3d>(prior.T_linear));
  if (!detail::allFinite(prior.gradient.data(), prior.gradient.size())) {
    findings.error(field + ".gradient", "is not finite");
  }
  checkMatrix(field + ".information", prior.information.data(), 6 * n, kWindowRounding, findings);
}

void checkAllPriors(const BundleProblem& problem, Findings& findings) {
  const auto finite = [&](const std::string& field, const auto& value) {
    if (!detail::isFinite(value)) findings.error(field, "is not finite");
  };
  checkPriors(
      "position_priors", problem.position_priors,
      [&](const std::string& field, const PositionPrior& prior) {
        checkPoseIndex(field + ".pose", prior.pose, problem, findings);
        finite(field + ".position", prior.position);
        checkMatrix(field + ".information", prior.information.data(), 3, 1e-9, findings);
      },
      findings);
  checkPriors(
      "pose_priors", problem.pose_priors,
      [&](const std::string& field, const AbsolutePosePrior& prior) {
        checkPoseIndex(field + ".pose", prior.pose, problem, findings);
        finite(field + ".T_world_body", prior.T_world_body);
        checkMatrix(field + ".information", prior.information.data(), 6, 1e-9, findings);
      },
      findings);
  checkPriors(
      "relative_priors", problem.relative_priors,
      [&](const std::string& field, const RelativePosePrior& prior) {
        checkPoseIndex(field + ".from", prior.from, problem, findings);
        checkPoseIndex(field + ".to", prior.to, problem, findings);
        if (prior.from == prior.to) findings.error(field, "leads from a pose to itself");
        finite(field + ".T_from_to", prior.T_from_to);
        checkMatrix(field + ".information", prior.information.data(), 6, 1e-9, findings);
      },
      findings);
  checkPriors(
      "window_priors", problem.window_priors,
      [&](const std::string& field, const WindowPrior& prior) {
        checkWindow(field, prior, problem, findings);
      },
      findings);
}

}  // namespace

std::vector<ProblemFinding> checkBundle(const BundleProblem& problem) {
  Findings findings;
  checkSizes(problem, findings);
  if (findings.hasErrors()) return findings.take();
  detail::checkIndices(findings, "observation_pose", problem.observation_pose,
                       problem.T_world_body.size());
  detail::checkIndices(findings, "observation_point", problem.observation_point,
                       problem.points.size());
  detail::checkIndices(findings, "observation_camera", problem.observation_camera,
                       problem.cameras.size());
  detail::checkFinite(findings, "T_world_body", Span<const SE3d>(problem.T_world_body));
  detail::checkFinite(findings, "points", Span<const Vec3d>(problem.points));
  detail::checkFinite(findings, "T_body_camera", Span<const SE3d>(problem.T_body_camera));
  detail::checkFinite(findings, "pixels", problem.pixels);
  checkAnchors(problem, findings);
  checkCameras(problem, findings);
  checkPixelInformation(problem, findings);
  checkStereo(problem, findings);
  checkAllPriors(problem, findings);
  if (!findings.hasErrors()) detail::findBundleWarnings(problem, findings);
  return findings.take();
}

}  // namespace v1
}  // namespace gslam
