#include "options.h"

#include <gslam/base/error.h>
#include <gslam/svar/detail/nearest_name.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr double kMostPixels = 1 << 24;
constexpr double kMostSamples = 1e7;

std::string numberText(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

void checkRange(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw ArgumentError(name, "is " + numberText(value) + ", expected " + numberText(low) + " to " +
                                numberText(high));
}

void checkName(const char* option, const std::string& value,
               const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), value) != names.end()) return;
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  throw ArgumentError(option, "is \"" + value + "\", expected one of " + known +
                                  detail::suggestion(detail::nearestName(value, names)));
}

void checkRanges(const char* name, const FrameRanges& ranges) {
  for (const FrameRange& range : ranges.ranges) {
    if (range.first >= 0 && range.first <= range.last) continue;
    throw ArgumentError(name, "has the range " + std::to_string(range.first) + " to " +
                                  std::to_string(range.last) +
                                  ", expected one from 0 on that does not end before it begins");
  }
}

void checkCamera(const CameraSensor& sensor) {
  const std::string name = "camera \"" + sensor.name + "\"";
  if (!sensor.camera.isValid()) throw ArgumentError(name, "has no model");
  if (double(sensor.camera.width()) * sensor.camera.height() > kMostPixels) {
    throw ArgumentError(name, "has more than 2^24 pixels");
  }
  switch (sensor.kind) {
    case ImageKind::grey:
    case ImageKind::rgb:
    case ImageKind::bgr:
    case ImageKind::depth:
      return;
    default:
      throw ArgumentError(name, std::string("is to give images of kind ") +
                                    imageKindName(sensor.kind) +
                                    ", expected grey, rgb, bgr or depth");
  }
}

void checkCameras(const SyntheticOptions& o) {
  if (o.cameras.size() > 64) throw ArgumentError("cameras", "are more than 64");
  for (const CameraSensor& sensor : o.cameras) checkCamera(sensor);
  if (!o.cameras.empty()) return;
  checkName("sensors", o.sensors, {"mono", "stereo", "rgbd", "multi"});
  checkRange("width", o.width, 2, 16384);
  checkRange("height", o.height, 2, 16384);
  checkRange("width * height", double(o.width) * o.height, 4, kMostPixels);
}

void checkErrors(const SyntheticOptions& o) {
  checkRange("baseline", o.baseline, 0, 100);
  checkRange("noise", o.noise, 0, 1000);
  checkRange("image_noise", o.image_noise, 0, 255);
  checkRange("exposure", o.exposure, 0, 1 / o.rate);
  checkRange("exposure_change", o.exposure_change, 0, 0.9);
  checkRange("vignette", o.vignette, 0, 1);
  checkRange("depth_noise", o.depth_noise, 0, 10);
  checkRange("depth_max", o.depth_max, 0, 1e6);
  checkRange("gyro_noise", o.gyro_noise, 0, 1e3);
  checkRange("accel_noise", o.accel_noise, 0, 1e3);
  checkRange("gyro_bias_walk", o.gyro_bias_walk, 0, 1e3);
  checkRange("accel_bias_walk", o.accel_bias_walk, 0, 1e3);
  checkRange("gyro_bias", o.gyro_bias, 0, 1e3);
  checkRange("accel_bias", o.accel_bias, 0, 1e3);
  checkRange("gnss_noise", o.gnss_noise, 0, 1e6);
}

}  // namespace

void checkOptions(const SyntheticOptions& o) {
  std::vector<std::string> names;
  for (const WorldFacts& world : worlds()) names.push_back(world.name);
  checkName("world", o.world, names);
  checkRange("frames", o.frames, 1, 100000);
  checkRange("rate", o.rate, 0.1, 1000);
  if (o.speed != 0) checkRange("speed", o.speed, 0.01, 1000);
  checkRange("movers", o.movers, 0, 50);
  checkRange("imu_rate", o.imu_rate, 1, 10000);
  checkRange("gnss_rate", o.gnss_rate, 0.1, 100);
  checkRange("threads", o.threads, 0, 1024);
  checkErrors(o);
  checkCameras(o);
  const double samples = o.frames / o.rate * o.imu_rate;
  if (o.imu && samples > kMostSamples) {
    throw ArgumentError("imu_rate",
                        "makes " + numberText(samples) + " samples, expected at most 10 millions");
  }
  checkRanges("pure_rotation", o.pure_rotation);
  checkRanges("low_texture", o.low_texture);
  checkRanges("dropped", o.dropped);
  checkRanges("occlusion", o.occlusion);
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
