#include "source.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

std::string quoted(const CameraSensor& camera) {
  return "camera '" + camera.name + "'";
}

void checkFileName(const std::string& name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) > 0x20 && c != '/' && c != '\\' && c != 0x7F;
  });
  if (is_plain && (name.empty() || name.front() != '.')) return;
  throw ArgumentError("sequence", "is '" + name + "', expected a file name without spaces");
}

}  // namespace

void Notes::add(std::vector<std::string>& list, const std::string& sentence) {
  if (std::find(list.begin(), list.end(), sentence) == list.end()) list.push_back(sentence);
}

void Notes::moveTo(ExportReport& report) const {
  report.left_out = left_out_;
  report.remarks = remarks_;
  for (const auto& count : counts_) {
    report.left_out.push_back(std::to_string(count.second) + " " + count.first.first + ": " +
                              count.first.second);
  }
}

Source::Source(const DatasetInfo& info, const std::string& format, const ExportOptions& options)
    : info_(info), format_(format), sequence_(options.sequence), depth_(kNone) {
  checkFileName(sequence_);
  for (std::size_t i = 0; i < rig().cameras.size(); ++i) {
    const CameraSensor& camera = rig().cameras[i];
    if (camera.kind == ImageKind::depth && depth_ == kNone) {
      depth_ = i;
    } else if (isPhotographic(camera.kind) && camera.kind != ImageKind::bayer) {
      cameras_.push_back(i);
    } else {
      notes.leftOut(quoted(camera) + ": " + format_ + " has no " + imageKindName(camera.kind) +
                    (camera.kind == ImageKind::depth ? " of a second camera" : " images"));
    }
  }
  if (cameras_.empty()) {
    throw ArgumentError("dataset", "has no camera for brightness or colour, which " + format_ +
                                       " cannot do without");
  }
}

std::string Source::sequence(const std::string& otherwise) const {
  return sequence_.empty() ? otherwise : sequence_;
}

std::string Source::title() const {
  std::string title = info_.name.empty() ? "unnamed" : info_.name;
  for (char& c : title) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return title;
}

const CameraSensor* Source::depth() const noexcept {
  return depth_ == kNone ? nullptr : &rig().cameras[depth_];
}

const CameraImage* Source::imageAt(const Frame& frame, std::size_t place) const {
  const CameraSensor& sensor = rig().cameras[place];
  const bool is_there = place < frame.images.size();
  const CameraImage* found = nullptr;
  if (is_there && (frame.images[place].name == sensor.name || frame.images[place].name.empty())) {
    found = &frame.images[place];
  } else if (!sensor.name.empty()) {
    found = findImage(frame, sensor.name);
  }
  return found == nullptr || found->image.empty() ? nullptr : found;
}

const CameraImage* Source::image(const Frame& frame, std::size_t i) const {
  return imageAt(frame, cameras_[i]);
}

const CameraImage* Source::depthImage(const Frame& frame) const {
  return depth_ == kNone ? nullptr : imageAt(frame, depth_);
}

void Source::keepCameras(std::size_t most) {
  for (std::size_t i = most; i < cameras_.size(); ++i) {
    notes.leftOut(quoted(camera(i)) + ": " + format_ + " has " +
                  (most == 1 ? "one camera" : std::to_string(most) + " cameras"));
  }
  cameras_.resize(std::min(most, cameras_.size()));
}

void Source::dropDepth() {
  if (depth_ != kNone) notes.leftOut(quoted(*depth()) + ": " + format_ + " has no depth");
  depth_ = kNone;
}

void Source::dropImu() {
  if (rig().has_imu) notes.leftOut("inertial samples: " + format_ + " has none");
}

void Source::dropGnss() {
  if (rig().has_gnss) notes.leftOut("satellite positions: " + format_ + " has none");
}

void Source::needModel(std::size_t i) const {
  if (camera(i).camera.isValid()) return;
  throw ArgumentError(quoted(camera(i)),
                      "has no camera model, which " + format_ + " cannot do without");
}

void Source::failModel(std::size_t i, const std::string& possible) const {
  const Camera& model = camera(i).camera;
  throw ArgumentError(quoted(camera(i)), "has the model " + model.modelName() + " with " +
                                             std::to_string(model.parameterCount()) +
                                             " parameters, but " + format_ + " can only have " +
                                             possible);
}

std::vector<StampedPose> Source::groundTruth(const SE3d& T_body_x) {
  std::vector<StampedPose> poses;
  poses.reserve(info_.ground_truth.size());
  for (const StampedPose& pose : info_.ground_truth) {
    if (isFinite(pose.pose)) {
      poses.push_back({pose.stamp, pose.pose * T_body_x});
    } else {
      notes.count("poses of the ground truth", "they are not finite");
    }
  }
  return poses;
}

bool Source::poseAt(std::int64_t stamp, const SE3d& T_body_x, SE3d& T_world_x) const {
  SE3d T_world_body;
  try {
    if (!info_.ground_truth.interpolate(stamp, T_world_body)) return false;
  } catch (const Error&) {
    return false;  // between poses that are not finite
  }
  if (!isFinite(T_world_body)) return false;
  T_world_x = T_world_body * T_body_x;
  return true;
}

bool isFinite(const SE3d& pose) noexcept {
  return std::all_of(pose.data(), pose.data() + 7, [](double x) { return std::isfinite(x); });
}

bool isFinite(const Vec3d& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
