#include "features/view_maker.h"

#include <gslam/base/error.h>

#include <cmath>
#include <utility>
#include <vector>

#include "features/view_makers.h"

namespace visual {
namespace {

using gslam::CameraSensor;
using gslam::SensorRig;
using gslam::Vec2d;
using gslam::Vec3d;

bool isUsable(const CameraSensor& sensor) {
  return gslam::isPhotographic(sensor.kind) && sensor.camera.isValid();
}

// Whether one camera sees what is far away in the middle of the other one's image.
bool seesMiddleOf(const CameraSensor& other, const CameraSensor& sensor) {
  const Vec2d middle = {(other.camera.width() - 1) / 2.0, (other.camera.height() - 1) / 2.0};
  Vec3d bearing;
  Vec2d pixel;
  if (!other.camera.unproject(middle, bearing)) return false;
  const auto turn = sensor.T_body_camera.rotation().inverse() * other.T_body_camera.rotation();
  return sensor.camera.project(turn * bearing, pixel) && sensor.camera.isInImage(pixel);
}

bool isPair(const CameraSensor& a, const CameraSensor& b) {
  const Vec3d way = b.T_body_camera.translation() - a.T_body_camera.translation();
  return way.norm() > 1e-6 && seesMiddleOf(a, b) && seesMiddleOf(b, a);
}

bool standAbove(const CameraSensor& a, const CameraSensor& b) {
  const Vec3d way = (a.T_body_camera.inverse() * b.T_body_camera).translation();
  return std::fabs(way[1]) > std::fabs(way[0]);
}

bool findUsable(const SensorRig& rig, std::size_t& camera) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    camera = i;
    if (isUsable(rig.cameras[i])) return true;
  }
  return false;
}

bool findDepth(const SensorRig& rig, std::size_t& camera) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    camera = i;
    const CameraSensor& sensor = rig.cameras[i];
    if (sensor.kind == gslam::ImageKind::depth && sensor.camera.isValid()) return true;
  }
  return false;
}

bool findPair(const SensorRig& rig, bool may_stand_above, CameraChoice& choice) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    for (std::size_t j = i + 1; j < rig.cameras.size(); ++j) {
      const CameraSensor &a = rig.cameras[i], &b = rig.cameras[j];
      if (!isUsable(a) || !isUsable(b) || !isPair(a, b)) continue;
      if (!may_stand_above && standAbove(a, b)) continue;
      choice = {SensorKind::stereo, i, j};
      return true;
    }
  }
  return false;
}

[[noreturn]] void refuse(const std::string& sensor, const std::string& lacks) {
  throw gslam::ArgumentError("sensor", "is \"" + sensor + "\", but the dataset lacks " + lacks);
}

void checkNeeds(const SensorRig& rig, const std::string& sensor, int cameras, bool depth) {
  gslam::SensorNeeds needs;
  needs.cameras = cameras;
  needs.depth = depth;
  const std::string missing = gslam::missingSensors(needs, rig);
  if (!missing.empty()) refuse(sensor, missing);
}

CameraChoice chooseAuto(const SensorRig& rig) {
  CameraChoice choice;
  checkNeeds(rig, "auto", 1, false);
  if (findUsable(rig, choice.first) && findDepth(rig, choice.second)) {
    choice.kind = SensorKind::rgbd;
  } else if (!findPair(rig, false, choice)) {
    findUsable(rig, choice.first);
  }
  return choice;
}

CameraChoice choose(const SensorRig& rig, const std::string& sensor) {
  CameraChoice choice;
  if (sensor == "auto") return chooseAuto(rig);
  if (sensor == "mono") {
    checkNeeds(rig, sensor, 1, false);
    findUsable(rig, choice.first);
  } else if (sensor == "rgbd") {
    checkNeeds(rig, sensor, 1, true);
    findUsable(rig, choice.first);
    findDepth(rig, choice.second);
    choice.kind = SensorKind::rgbd;
  } else if (sensor == "stereo") {
    checkNeeds(rig, sensor, 2, false);
    if (!findPair(rig, false, choice) && !findPair(rig, true, choice)) {
      refuse(sensor, "two cameras side by side that see the same");
    }
  } else {
    throw gslam::ArgumentError("sensor",
                               "is \"" + sensor + "\", expected one of: auto, mono, stereo, rgbd");
  }
  return choice;
}

}  // namespace

std::unique_ptr<ViewMaker> makeViewMaker(const SensorRig& rig, const Options& options) {
  const CameraChoice cameras = choose(rig, options.sensor);
  if (cameras.kind == SensorKind::stereo) return makeStereo(rig, cameras, options);
  if (cameras.kind == SensorKind::rgbd) return makeRgbd(rig, cameras, options);
  return makeMono(rig, cameras, options);
}

double focalOfEye(const gslam::Camera& camera, const std::string& name) {
  const Vec2d middle = {(camera.width() - 1) / 2.0, (camera.height() - 1) / 2.0};
  constexpr double kStep = 0.5;  // pixels
  Vec3d left, right, top, bottom;
  if (camera.unproject(middle - Vec2d{kStep, 0}, left) &&
      camera.unproject(middle + Vec2d{kStep, 0}, right) &&
      camera.unproject(middle - Vec2d{0, kStep}, top) &&
      camera.unproject(middle + Vec2d{0, kStep}, bottom)) {
    const double focal = std::sqrt(1 / ((right - left).norm() * (bottom - top).norm()));
    if (std::isfinite(focal)) return focal;
  }
  throw gslam::ArgumentError("camera", "'" + name + "' has no direction for its middle pixel");
}

const gslam::CameraImage* imageOf(const gslam::Frame& frame, std::size_t camera,
                                  const std::string& name, std::string& problem) {
  if (camera < frame.images.size()) return &frame.images[camera];
  problem = "the frame has " + std::to_string(frame.images.size()) + " images, that of camera '" +
            name + "' is missing";
  return nullptr;
}

std::shared_ptr<View> viewOf(const gslam::Frame& frame, gslam::KeyframeContent&& content,
                             std::size_t camera, const Eye& eye) {
  auto view = std::make_shared<View>();
  view->frame = frame.id;
  view->stamp = frame.stamp;
  for (gslam::Feature& feature : content.features) feature.camera = std::uint16_t(camera);
  view->grid = FeatureGrid(content.features, eye.camera.width(), eye.camera.height());
  view->content = std::make_shared<const gslam::KeyframeContent>(std::move(content));
  return view;
}

}  // namespace visual
