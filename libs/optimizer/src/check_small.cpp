#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "check_input.h"
#include "findings.h"
#include "finite.h"
#include "information.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

void requireSize(const char* name, std::size_t size, std::size_t expected, const char* as,
                 bool may_be_empty) {
  if (size == expected || (may_be_empty && size == 0)) return;
  throw ArgumentError(name, "has " + std::to_string(size) + " elements, expected " +
                                std::to_string(expected) + " as of " + as +
                                (may_be_empty ? ", or none" : ""));
}

[[noreturn]] void refuseElement(const char* name, std::size_t index, const std::string& problem) {
  throw ArgumentError(elementOf(name, index), problem);
}

std::string textOf(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// Elements of a type that is nothing but double, so that they are one array.
template <class T>
void requireFinite(const char* name, Span<const T> values) {
  static_assert(sizeof(T) % sizeof(double) == 0, "");
  const double* const numbers = reinterpret_cast<const double*>(values.data());
  if (allFinite(numbers, values.size() * (sizeof(T) / sizeof(double)))) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!isFinite(values[i])) refuseElement(name, i, "is not finite");
  }
}

void requireWeights(const char* name, Span<const double> values) {
  bool is_good = true;
  // Written so that NaN fails.
  for (const double value : values) is_good &= value >= 0 && value <= 1e300;
  if (is_good) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= 0 && values[i] <= 1e300)) {
      refuseElement(name, i, "is " + textOf(values[i]) + ", expected 0 or more, and finite");
    }
  }
}

template <class Matrix>
void requireInformation(const char* name, Span<const Matrix> values, std::size_t n) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* const complaint = complaintAbout(informationKind(values[i].data(), n, n));
    if (*complaint != 0) refuseElement(name, i, complaint);
  }
}

// Unit vectors of the first three numbers of each.
template <class T>
void requireUnit(const char* name, Span<const T> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = values[i][0], y = values[i][1], z = values[i][2];
    const double norm = std::sqrt(x * x + y * y + z * z);
    if (!(std::abs(norm - 1) <= 1e-6)) {
      refuseElement(name, i, "has a length of " + textOf(norm) + ", expected 1");
    }
  }
}

void checkStereo(const PoseProblem& problem) {
  if (problem.right_u.empty()) return;
  bool has_infinity = false;
  for (const double u : problem.right_u) has_infinity |= std::isinf(u);
  for (std::size_t i = 0; has_infinity && i < problem.right_u.size(); ++i) {
    if (std::isinf(problem.right_u[i])) refuseElement("right_u", i, "is not finite");
  }
  if (!(problem.baseline > 0 && std::isfinite(problem.baseline))) {
    throw ArgumentError("baseline",
                        "is " + textOf(problem.baseline) + ", expected above 0 with right_u");
  }
}

void checkCameras(const PoseProblem& problem) {
  if (problem.cameras.empty()) throw ArgumentError("cameras", "is empty, expected one or more");
  for (std::size_t i = 0; i < problem.cameras.size(); ++i) {
    if (!problem.cameras[i].isValid()) refuseElement("cameras", i, "is no camera");
  }
  requireSize("T_body_camera", problem.T_body_camera.size(), problem.cameras.size(), "cameras",
              true);
  requireFinite("T_body_camera", problem.T_body_camera);
  requireSize("camera_of", problem.camera_of.size(), problem.points.size(), "points", true);
  const std::size_t count = problem.cameras.size();
  bool is_good = true;
  for (const std::uint32_t camera : problem.camera_of) is_good &= camera < count;
  for (std::size_t i = 0; !is_good && i < problem.camera_of.size(); ++i) {
    if (problem.camera_of[i] >= count) {
      refuseElement("camera_of", i,
                    "is " + std::to_string(problem.camera_of[i]) + ", expected below " +
                        std::to_string(count));
    }
  }
}

}  // namespace

void checkStart(const char* name, const double* values, std::size_t count) {
  if (!allFinite(values, count)) throw ArgumentError(name, "is not finite");
}

void checkPoseProblem(const PoseProblem& problem, const SE3d& T_world_body) {
  const std::size_t n = problem.points.size();
  requireSize("pixels", problem.pixels.size(), n, "points", false);
  requireSize("information", problem.information.size(), n, "points", true);
  requireSize("right_u", problem.right_u.size(), n, "points", true);
  requireSize("inliers", problem.inliers.size(), n, "points", true);
  if (n < 3 && problem.prior == nullptr) {
    throw ArgumentError("points",
                        "has " + std::to_string(n) + " elements, expected 3 or more, or a prior");
  }
  checkStart("T_world_body", T_world_body.data(), 7);
  requireFinite("points", problem.points);
  requireFinite("pixels", problem.pixels);
  requireWeights("information", problem.information);
  checkCameras(problem);
  checkStereo(problem);
  if (problem.prior == nullptr) return;
  checkStart("prior.pose", problem.prior->pose.data(), 7);
  const char* const complaint =
      complaintAbout(informationKind(problem.prior->information.data(), 6, 6));
  if (*complaint != 0) throw ArgumentError("prior.information", complaint);
}

void checkAlignmentProblem(const AlignmentProblem& problem) {
  requireSize("points_a", problem.points_a.size(), problem.points_b.size(), "points_b", false);
  requireSize("point_information", problem.point_information.size(), problem.points_b.size(),
              "points_b", true);
  requireSize("planes_a", problem.planes_a.size(), problem.plane_points_b.size(), "plane_points_b",
              false);
  requireSize("plane_information", problem.plane_information.size(), problem.plane_points_b.size(),
              "plane_points_b", true);
  requireSize("line_origins_a", problem.line_origins_a.size(), problem.line_points_b.size(),
              "line_points_b", false);
  requireSize("line_directions_a", problem.line_directions_a.size(), problem.line_points_b.size(),
              "line_points_b", false);
  requireSize("line_information", problem.line_information.size(), problem.line_points_b.size(),
              "line_points_b", true);
  requireSize("T_a_body", problem.T_a_body.size(), problem.T_b_body.size(), "T_b_body", false);
  requireSize("pose_information", problem.pose_information.size(), problem.T_b_body.size(),
              "T_b_body", true);
  if (problem.points_b.empty() && problem.plane_points_b.empty() && problem.line_points_b.empty() &&
      problem.T_b_body.empty()) {
    throw ArgumentError("problem", "is empty, expected points, planes, lines or poses");
  }
  requireFinite("points_b", problem.points_b);
  requireFinite("points_a", problem.points_a);
  requireInformation("point_information", problem.point_information, 3);
  requireFinite("plane_points_b", problem.plane_points_b);
  requireFinite("planes_a", problem.planes_a);
  requireUnit("planes_a", problem.planes_a);
  requireWeights("plane_information", problem.plane_information);
  requireFinite("line_points_b", problem.line_points_b);
  requireFinite("line_origins_a", problem.line_origins_a);
  requireFinite("line_directions_a", problem.line_directions_a);
  requireUnit("line_directions_a", problem.line_directions_a);
  requireWeights("line_information", problem.line_information);
  requireFinite("T_b_body", problem.T_b_body);
  requireFinite("T_a_body", problem.T_a_body);
  requireInformation("pose_information", problem.pose_information, 6);
}

void checkTwoViewProblem(const TwoViewProblem& problem, const SE3d& T_first_second) {
  const std::size_t n = problem.first.size();
  requireSize("second", problem.second.size(), n, "first", false);
  requireSize("information", problem.information.size(), n, "first", true);
  requireSize("inverse_depths", problem.inverse_depths.size(), n, "first", false);
  requireSize("depth_information", problem.depth_information.size(), n, "first", true);
  if (n < 5) {
    throw ArgumentError("first", "has " + std::to_string(n) + " elements, expected 5 or more");
  }
  if (!problem.first_camera.isValid()) throw ArgumentError("first_camera", "is no camera");
  if (!problem.second_camera.isValid()) throw ArgumentError("second_camera", "is no camera");
  checkStart("T_first_second", T_first_second.data(), 7);
  requireFinite("first", problem.first);
  requireFinite("second", problem.second);
  requireWeights("information", problem.information);
  requireWeights("inverse_depths", problem.inverse_depths);
  requireWeights("depth_information", problem.depth_information);
  Vec3d bearing;
  for (std::size_t i = 0; i < n; ++i) {
    if (!problem.first_camera.unproject(problem.first[i], bearing)) {
      refuseElement("first", i, "cannot be unprojected by first_camera");
    }
  }
  const bool has_scale =
      std::any_of(problem.depth_information.begin(), problem.depth_information.end(),
                  [](double information) { return information > 0; });
  if (!has_scale && T_first_second.translation().norm() == 0) {
    throw ArgumentError(
        "T_first_second",
        "has a translation of 0, expected another one without depth_information above 0");
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
