#include "bundle_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "parts.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// Rays that differ by less do not tell a distance: half a pixel of a focal length of 500.
constexpr double kLeastParallax = 1e-3;  // radians

bool isSet(Span<const std::uint8_t> flags, std::size_t i) {
  return !flags.empty() && flags[i] != 0;
}

template <std::size_t N>
bool hasTranslation(const Mat<double, N, N>& information) {
  return information(0, 0) != 0 || information(1, 1) != 0 || information(2, 2) != 0;
}
bool hasRotation(const Mat<double, 6, 6>& information) {
  return information(3, 3) != 0 || information(4, 4) != 0 || information(5, 5) != 0;
}

// What is known of a part of the bundle: how many places, how many orientations, some length.
struct Knowledge {
  std::size_t places = 0;
  std::size_t orientations = 0;
  bool has_length = false;
  bool is_used = false;

  bool fixesPosition() const { return places != 0; }
  bool fixesOrientation() const { return orientations != 0 || places >= 3; }
  bool fixesScale() const { return has_length || places >= 2; }
};

// One pass over observations keeps four bytes a point: its first observation, and what the others
// added.
class BundleScan {
 public:
  explicit BundleScan(const BundleProblem& problem)
      : problem_(problem),
        parts_(problem.T_world_body.size()),
        seen_(problem.points.size(), 0),
        pose_is_used_(problem.T_world_body.size(), 0),
        camera_is_used_(problem.cameras.size(), 0) {}

  void run();
  void report(Findings& findings);

 private:
  static constexpr std::uint32_t kOnce = std::uint32_t(1) << 30;
  static constexpr std::uint32_t kWithoutParallax = std::uint32_t(2) << 30;
  static constexpr std::uint32_t kWell = std::uint32_t(3) << 30;  // its distance is known
  static constexpr std::uint32_t kFlags = kWell;

  std::size_t cameraOf(std::size_t observation) const {
    return problem_.observation_camera.empty() ? 0 : problem_.observation_camera[observation];
  }
  Vec3d centreOf(std::size_t observation) const {
    const SE3d& T_world_body = problem_.T_world_body[problem_.observation_pose[observation]];
    if (problem_.T_body_camera.empty()) return T_world_body.translation();
    return T_world_body * problem_.T_body_camera[cameraOf(observation)].translation();
  }
  bool isStereo(std::size_t observation) const {
    return !problem_.right_u.empty() && !std::isnan(problem_.right_u[observation]);
  }
  bool hasParallax(std::size_t first, std::size_t second, const Vec3d& point) const {
    const Vec3d a = point - centreOf(first), b = point - centreOf(second);
    const double bound = kLeastParallax * kLeastParallax * a.squaredNorm() * b.squaredNorm();
    return a.cross(b).squaredNorm() > bound || a.dot(b) < 0;
  }
  void add(std::size_t observation);
  void addPriors();
  void gatherKnowledge();
  void reportUnused(Findings& findings) const;
  void reportPoints(Findings& findings) const;
  void reportGauge(Findings& findings);
  void reportFixed(Findings& findings) const;

  const BundleProblem& problem_;
  Parts parts_;  // of poses, joined by points that both see
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint8_t> pose_is_used_;
  std::vector<std::uint8_t> camera_is_used_;
  std::vector<Knowledge> known_;  // of parts, at their roots
};

void BundleScan::add(std::size_t observation) {
  const std::uint32_t pose = problem_.observation_pose[observation];
  const std::uint32_t point = problem_.observation_point[observation];
  pose_is_used_[pose] = 1;
  camera_is_used_[cameraOf(observation)] = 1;
  std::uint32_t& seen = seen_[point];
  if (seen == 0) {
    seen = static_cast<std::uint32_t>(observation) | (isStereo(observation) ? kWell : kOnce);
    return;
  }
  const std::uint32_t first = seen & ~kFlags;
  if (parts_.count() > 1) parts_.join(problem_.observation_pose[first], pose);
  if ((seen & kFlags) == kWell) return;
  const bool is_well =
      isStereo(observation) || hasParallax(first, observation, problem_.points[point]);
  seen = first | (is_well ? kWell : kWithoutParallax);
}

void BundleScan::addPriors() {
  for (const PositionPrior& prior : problem_.position_priors) pose_is_used_[prior.pose] = 1;
  for (const AbsolutePosePrior& prior : problem_.pose_priors) pose_is_used_[prior.pose] = 1;
  for (const RelativePosePrior& prior : problem_.relative_priors) {
    pose_is_used_[prior.from] = pose_is_used_[prior.to] = 1;
    parts_.join(prior.from, prior.to);
  }
  for (const WindowPrior& prior : problem_.window_priors) {
    for (const std::uint32_t pose : prior.poses) {
      pose_is_used_[pose] = 1;
      parts_.join(prior.poses.front(), pose);
    }
  }
}

void BundleScan::run() {
  for (std::size_t i = 0; i < problem_.pixels.size(); ++i) add(i);
  addPriors();
  gatherKnowledge();
}

void BundleScan::gatherKnowledge() {
  known_.resize(problem_.T_world_body.size());
  const auto of = [&](std::uint32_t pose) -> Knowledge& { return known_[parts_.rootOf(pose)]; };
  const auto know = [](Knowledge& part, bool place, bool orientation) {
    part.places += place;
    part.orientations += orientation;
  };
  for (std::uint32_t pose = 0; pose < known_.size(); ++pose) {
    if (pose_is_used_[pose] == 0) continue;
    Knowledge& part = of(pose);
    part.is_used = true;
    if (isSet(problem_.pose_fixed, pose)) know(part, true, true);
  }
  for (const PositionPrior& prior : problem_.position_priors) {
    know(of(prior.pose), hasTranslation(prior.information), false);
  }
  for (const AbsolutePosePrior& prior : problem_.pose_priors) {
    know(of(prior.pose), hasTranslation(prior.information), hasRotation(prior.information));
  }
  for (const RelativePosePrior& prior : problem_.relative_priors) {
    if (hasTranslation(prior.information)) of(prior.from).has_length = true;
  }
  for (const WindowPrior& prior : problem_.window_priors) {
    if (prior.poses.empty()) continue;
    know(of(prior.poses.front()), true, true);
    of(prior.poses.front()).has_length = true;
  }
  for (std::size_t point = 0; point < problem_.point_fixed.size(); ++point) {
    if (problem_.point_fixed[point] == 0 || seen_[point] == 0) continue;
    know(of(problem_.observation_pose[seen_[point] & ~kFlags]), true, false);
  }
  // Lengths inside a body: a stereo pair, or cameras of a rig apart from each other.
  bool is_rig = false;
  for (std::size_t i = 1; i < problem_.T_body_camera.size(); ++i) {
    is_rig |= !isSet(problem_.T_body_camera_free, i) && !isSet(problem_.T_body_camera_free, 0) &&
              problem_.T_body_camera[i].translation() != problem_.T_body_camera[0].translation();
  }
  for (std::size_t i = 0; i < problem_.right_u.size(); ++i) {
    if (isStereo(i)) of(problem_.observation_pose[i]).has_length = true;
  }
  for (Knowledge& part : known_) part.has_length |= is_rig;
}

void BundleScan::reportUnused(Findings& findings) const {
  Counted poses, cameras;
  for (std::size_t i = 0; i < pose_is_used_.size(); ++i) {
    if (pose_is_used_[i] == 0 && !isSet(problem_.pose_fixed, i)) poses.note(i);
  }
  for (std::size_t i = 0; i < camera_is_used_.size(); ++i) {
    if (camera_is_used_[i] == 0) cameras.note(i);
  }
  findings.warnings("T_world_body", poses, "has neither observations nor priors: it stays");
  findings.warnings("cameras", cameras, "has no observations: it stays");
}

void BundleScan::reportPoints(Findings& findings) const {
  Counted unseen, once, flat;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (isSet(problem_.point_fixed, i)) continue;
    const std::uint32_t flag = seen_[i] & kFlags;
    if (flag == 0) unseen.note(i);
    if (flag == kOnce) once.note(i);
    if (flag == kWithoutParallax) flat.note(i);
  }
  findings.warnings("points", unseen, "has no observations: it stays");
  findings.warnings("points", once, "is seen once: its distance is not determined");
  findings.warnings("points", flat,
                    "is seen without parallax, along rays less than a milliradian apart: its "
                    "distance is hardly determined");
}

void BundleScan::reportGauge(Findings& findings) {
  std::size_t parts = 0;
  for (const Knowledge& part : known_) parts += part.is_used;
  Counted loose;
  std::string free;
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const Knowledge& part = known_[i];
    if (!part.is_used) continue;
    if (part.fixesPosition() && part.fixesOrientation() && part.fixesScale()) continue;
    if (loose.count == 0) {
      if (!part.fixesPosition()) free += "position";
      if (!part.fixesOrientation()) free += std::string(free.empty() ? "" : ", ") + "orientation";
      if (!part.fixesScale()) free += std::string(free.empty() ? "" : ", ") + "scale";
    }
    loose.note(i);
  }
  if (loose.count == 0) return;
  if (parts == 1) {
    findings.warning("T_world_body",
                     "is free as a whole: nothing fixes its " + free + ". It stays near the start");
    return;
  }
  findings.warnings("T_world_body", loose,
                    "begins one of " + std::to_string(parts) +
                        " parts without common points, and nothing fixes its " + free +
                        ". It stays near the start");
}

void BundleScan::reportFixed(Findings& findings) const {
  const auto all_fixed = [](Span<const std::uint8_t> fixed, std::size_t count) {
    return count == 0 || (!fixed.empty() && std::all_of(fixed.begin(), fixed.end(),
                                                        [](std::uint8_t f) { return f != 0; }));
  };
  const auto is_free = [](const CameraFreedom& freedom) { return freedom.parameters != 0; };
  if (all_fixed(problem_.pose_fixed, problem_.T_world_body.size()) &&
      all_fixed(problem_.point_fixed, problem_.points.size()) &&
      std::none_of(problem_.camera_freedom.begin(), problem_.camera_freedom.end(), is_free) &&
      std::none_of(problem_.T_body_camera_free.begin(), problem_.T_body_camera_free.end(),
                   [](std::uint8_t f) { return f != 0; })) {
    findings.warning("problem", "has no variables: all of it is fixed");
  }
}

void BundleScan::report(Findings& findings) {
  reportFixed(findings);
  reportGauge(findings);
  reportUnused(findings);
  reportPoints(findings);
}

}  // namespace

void findBundleWarnings(const BundleProblem& problem, Findings& findings) {
  BundleScan scan(problem);
  scan.run();
  scan.report(findings);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
