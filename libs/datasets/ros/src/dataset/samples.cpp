#include "samples.h"

#include <gslam/core/stamp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "messages/decode.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

// Reads all messages of a topic into samples, in order.
template <class Message, class Sample, class Convert>
std::vector<Sample> readSamples(const Recording& recording, std::size_t topic, bool by_header,
                                reading::Remarks& remarks, std::string& frame_id,
                                const Convert& convert) {
  const std::string& name = recording.topics()[topic].name;
  std::vector<Sample> samples;
  for (const MessageRef& ref : recording.messages({topic})) {
    const Message message = readMessage<Message>(recording, ref);
    if (frame_id.empty()) frame_id = message.header.frame_id;
    const std::int64_t measured = by_header ? message.header.stamp : ref.stamp;
    if (measured == 0) {
      remarks.say("messages of " + name + " have no stamp: when they were received was taken");
    }
    const std::int64_t stamp = measured != 0 ? measured : ref.stamp;
    Sample sample;
    if (convert(message, stamp, sample)) {
      samples.push_back(sample);
    } else {
      remarks.skip("samples of " + name + " that are not finite, or out of range",
                   "at " + secondsText(stamp) + " s");
    }
  }
  const auto earlier = [](const Sample& a, const Sample& b) { return a.stamp < b.stamp; };
  if (!std::is_sorted(samples.begin(), samples.end(), earlier)) {
    remarks.say("messages of " + name + " are out of order: they were sorted by their stamps");
    std::stable_sort(samples.begin(), samples.end(), earlier);
  }
  return samples;
}

Vec3d toVec(const Triple& values) noexcept {
  return {values[0], values[1], values[2]};
}

bool isFinite(const Vec3d& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

bool isFinite(const std::array<double, 9>& values) noexcept {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

double radians(double degrees) noexcept {
  return degrees * (3.14159265358979323846 / 180);
}

GnssFix fixOf(std::int8_t status) noexcept {
  if (status < 0) return GnssFix::none;
  return status == 0 ? GnssFix::single : GnssFix::augmented;  // 1: SBAS, 2: GBAS
}

}  // namespace

GnssSample gnssSampleOf(const NavSatFix& message, std::int64_t stamp) {
  GnssSample sample{};
  sample.stamp = stamp;
  sample.fix = fixOf(message.status);
  sample.position = {radians(message.latitude), radians(message.longitude), message.altitude};
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  sample.velocity = {unknown, unknown, unknown};
  const bool is_known = message.covariance_type != 0;
  // Zero stands for unknown, as GnssSample has it.
  if (is_known && isFinite(message.covariance)) {
    std::copy(message.covariance.begin(), message.covariance.end(), sample.covariance.data());
  }
  return sample;
}

ImuList readImu(const Recording& recording, std::size_t topic, bool by_header,
                reading::Remarks& remarks) {
  ImuList list;
  list.samples = readSamples<ImuMessage, ImuSample>(
      recording, topic, by_header, remarks, list.frame_id,
      [](const ImuMessage& message, std::int64_t stamp, ImuSample& sample) {
        sample = {stamp, toVec(message.angular_velocity), toVec(message.linear_acceleration)};
        return isFinite(sample.gyro) && isFinite(sample.accel);
      });
  return list;
}

GnssList readGnss(const Recording& recording, std::size_t topic, bool by_header,
                  reading::Remarks& remarks) {
  GnssList list;
  list.samples = readSamples<NavSatFix, GnssSample>(
      recording, topic, by_header, remarks, list.frame_id,
      [&](const NavSatFix& message, std::int64_t stamp, GnssSample& sample) {
        sample = gnssSampleOf(message, stamp);
        const bool is_place = std::fabs(message.latitude) <= 90 &&
                              std::fabs(message.longitude) <= 360 &&
                              std::isfinite(message.altitude);
        if (message.covariance_type != 0 && !isFinite(message.covariance)) {
          remarks.skip("covariances of " + recording.topics()[topic].name + " that are not finite",
                       "at " + secondsText(stamp) + " s");
        }
        return sample.fix == GnssFix::none || is_place;
      });
  return list;
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
