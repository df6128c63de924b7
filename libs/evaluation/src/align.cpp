#include <gslam/base/error.h>
#include <gslam/evaluation/align.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/nearest_rotation.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace {

constexpr const char* kAlignmentNames[] = {"none", "origin", "se3", "sim3", "scale", "yaw"};
// Spread across a line, as part of that along it, below which positions lie on the line: the last
// digits of usual files.
constexpr double kThin = 1e-6;

using Points = Span<const Vec3d>;

// Means and second moments about them, divided by the count (Umeyama 34 to 38).
struct Moments {
  Vec3d reference_mean{}, estimate_mean{};
  Mat3d reference{}, estimate{};
  Mat3d cross{};       // reference by estimate
  double largest = 0;  // of all numbers: what rounding is measured by

  Moments(Points a, Points b) {
    const double part = 1 / double(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      reference_mean += part * a[i];
      estimate_mean += part * b[i];
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec3d x = a[i] - reference_mean, y = b[i] - estimate_mean;
      reference += part * outer(x, x);
      estimate += part * outer(y, y);
      cross += part * outer(x, y);
      for (std::size_t k = 0; k < 3; ++k) {
        largest = std::max({largest, std::fabs(a[i][k]), std::fabs(b[i][k])});
      }
    }
  }
};

double trace(const Mat3d& m) {
  return m(0, 0) + m(1, 1) + m(2, 2);
}

// How positions lie, by their standard deviations along the main axes.
enum class Extent : std::uint8_t { point, line, wide };

Extent extentOf(const Mat3d& covariance, double largest) {
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * largest;
  const Vec3d variances = detail::SymmetricEigen<double, 3>(covariance).values;
  const double along = std::sqrt(std::max(variances[0], 0.0));
  const double across = std::sqrt(std::max(variances[1], 0.0));
  if (!(along > rounding)) return Extent::point;
  return across > kThin * along && across > rounding ? Extent::wide : Extent::line;
}

Alignment refused(const std::string& reason) {
  Alignment result;
  result.reason = reason;
  return result;
}

Alignment found(const SO3d& rotation, const Moments& m, double scale) {
  Alignment result;
  result.is_valid = true;
  const Vec3d moved = scale * (rotation * m.estimate_mean);
  result.S_world_map = SIM3d(rotation, m.reference_mean - moved, scale);
  return result;
}

// Whether the cross-covariance has a clearly negative determinant: not of a flat shape, whose sign
// is noise.
bool isMirrored(const Mat3d& cross) {
  const Vec3d squares = detail::SymmetricEigen<double, 3>(cross.transpose() * cross).values;
  const bool is_solid = std::sqrt(std::max(squares[2], 0.0)) > 0.05 * std::sqrt(squares[1]);
  return is_solid && detail::determinant(cross) < 0;
}

const char* nameOf(bool is_reference) {
  return is_reference ? "the reference" : "the estimate";
}

// Empty where both positions are wide enough for a rotation in space.
std::string problemOf(const Moments& m, std::size_t count) {
  if (count < 3) {
    return std::to_string(count) + (count == 1 ? " pair does" : " pairs do") +
           " not fix a rotation, 3 are needed";
  }
  for (const bool is_reference : {true, false}) {
    const Extent shape = extentOf(is_reference ? m.reference : m.estimate, m.largest);
    if (shape == Extent::wide) continue;
    return std::string("all positions of ") + nameOf(is_reference) +
           (shape == Extent::point ? " are the same" : " lie on a line") + ", so any rotation" +
           (shape == Extent::point ? "" : " about it") + " fits as well";
  }
  return "";
}

Alignment alignInSpace(const Moments& m, std::size_t count, bool has_scale) {
  const std::string hint = "; --align origin or none works";
  const std::string problem = problemOf(m, count);
  if (!problem.empty()) return refused(problem + hint);
  const NearestRotation<double> nearest = nearestRotation(m.cross);
  if (!nearest.is_unique) {
    return refused("several rotations fit as well: the two do not correspond, or one is mirrored" +
                   hint);
  }
  // tr(R^T S) is Umeyama's tr(D S).
  const double together = trace(nearest.rotation.matrix().transpose() * m.cross);
  const double scale = has_scale ? together / trace(m.estimate) : 1;
  if (!(scale > 0) || !std::isfinite(scale)) {
    return refused("no scale above 0 fits: the two do not correspond" + hint);
  }
  Alignment result = found(nearest.rotation, m, scale);
  result.is_mirrored = isMirrored(m.cross);
  return result;
}

Alignment alignScale(const Moments& m) {
  for (const bool is_reference : {true, false}) {
    if (extentOf(is_reference ? m.reference : m.estimate, m.largest) != Extent::point) continue;
    return refused(std::string("all positions of ") + nameOf(is_reference) +
                   " are the same, so they have no scale; --align origin or none works");
  }
  const double scale =
      trace(nearestRotation(m.cross).rotation.matrix().transpose() * m.cross) / trace(m.estimate);
  if (!(scale > 0) || !std::isfinite(scale)) {
    return refused("no scale above 0 fits: the two do not correspond");
  }
  Alignment result;
  result.is_valid = true;
  result.S_world_map = SIM3d(SO3d(), Vec3d{}, scale);
  return result;
}

// What the angle about the vertical gains is cosine * dot + sine * cross.
Alignment alignYaw(const Moments& m, const Vec3d& up) {
  const Vec3d u = up.normalized();
  const double cosine = trace(m.cross) - u.dot(m.cross * u);
  const Vec3d turn = {{m.cross(2, 1) - m.cross(1, 2), m.cross(0, 2) - m.cross(2, 0),
                       m.cross(1, 0) - m.cross(0, 1)}};
  const double sine = u.dot(turn);
  const double size = trace(m.reference) + trace(m.estimate);
  const double rounding = std::numeric_limits<double>::epsilon() * m.largest;
  if (!(std::hypot(cosine, sine) > kThin * kThin * size + 64 * rounding * rounding)) {
    return refused(
        "seen from above all positions are the same, or the two do not correspond, so "
        "any heading fits as well; --align origin or none works");
  }
  return found(SO3d::exp(std::atan2(sine, cosine) * u), m, 1);
}

void checkPositions(Points reference, Points estimate) {
  if (reference.size() != estimate.size()) {
    throw ArgumentError("estimate", "has " + std::to_string(estimate.size()) +
                                        " positions, expected as many as the reference's " +
                                        std::to_string(reference.size()));
  }
  if (reference.empty()) throw ArgumentError("positions", "are none, expected one pair at least");
  for (const Points list : {reference, estimate}) {
    for (const Vec3d& p : list) {
      if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
      throw ArgumentError("positions", "have an element that is not finite");
    }
  }
}

std::vector<Vec3d> positionsOf(const std::vector<SE3d>& poses) {
  std::vector<Vec3d> positions;
  positions.reserve(poses.size());
  for (const SE3d& pose : poses) positions.push_back(pose.translation());
  return positions;
}

}  // namespace

const char* alignmentMethodName(AlignmentMethod method) noexcept {
  const auto i = static_cast<std::size_t>(method);
  return i < 6 ? kAlignmentNames[i] : "unknown";
}

AlignmentOptions parseAlignment(const std::string& text) {
  AlignmentOptions options;
  for (std::uint8_t i = 0; i < 6; ++i) {
    if (text != kAlignmentNames[i]) continue;
    options.method = static_cast<AlignmentMethod>(i);
    return options;
  }
  const std::string prefix = "first:";
  if (text.compare(0, prefix.size(), prefix) == 0) {
    const std::string digits = text.substr(prefix.size());
    const bool is_number = !digits.empty() && digits.size() <= 9 &&
                           digits.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) options.first = std::strtoul(digits.c_str(), nullptr, 10);
    if (options.first > 0) return options;
  }
  throw ArgumentError("alignment", "is '" + text +
                                       "', expected none, origin, se3, sim3, scale, yaw or first:N "
                                       "with a number of pairs N");
}

std::string alignmentText(const AlignmentOptions& options) {
  std::string name = alignmentMethodName(options.method);
  if (options.first == 0) return name;
  const std::string count = std::to_string(options.first);
  return options.method == AlignmentMethod::se3 ? "first:" + count : name + ", first " + count;
}

Alignment align(const PosePairs& pairs, const AlignmentOptions& options) {
  if (pairs.size() == 0) throw ArgumentError("pairs", "are none, expected one at least");
  Alignment result;
  if (options.method == AlignmentMethod::none || options.method == AlignmentMethod::origin) {
    result.is_valid = true;
    if (options.method == AlignmentMethod::origin) {
      result.S_world_map = SIM3d(pairs.reference[0] * pairs.estimate[0].inverse());
    }
    return result;
  }
  return alignPositions(positionsOf(pairs.reference), positionsOf(pairs.estimate), options);
}

Alignment alignPositions(Points reference, Points estimate, const AlignmentOptions& options) {
  checkPositions(reference, estimate);
  const std::size_t count =
      options.first == 0 ? reference.size() : std::min(options.first, reference.size());
  const Moments moments(reference.first(count), estimate.first(count));
  switch (options.method) {
    case AlignmentMethod::se3:
    case AlignmentMethod::sim3:
      return alignInSpace(moments, count, options.method == AlignmentMethod::sim3);
    case AlignmentMethod::scale:
      return alignScale(moments);
    case AlignmentMethod::yaw:
      if (!(options.up.norm() > 0)) throw ArgumentError("up", "has no length");
      return alignYaw(moments, options.up);
    default:
      break;
  }
  throw ArgumentError("alignment", std::string("is ") + alignmentMethodName(options.method) +
                                       ", which positions alone do not know");
}

}  // namespace v1
}  // namespace gslam
