#include "imu.h"

#include <gslam/geometry/random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hash.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

const Vec3d kGravity = {{0, 0, 9.81}};  // what a unit at rest feels, world

}  // namespace

Imu::Imu(const SyntheticOptions& o, std::int64_t end) : key_(keyOf(o.seed, 31)) {
  calibration_.rate = o.imu_rate;
  calibration_.gyro_noise = o.noise * o.gyro_noise;
  calibration_.accel_noise = o.noise * o.accel_noise;
  calibration_.gyro_bias_walk = o.noise * o.gyro_bias_walk;
  calibration_.accel_bias_walk = o.noise * o.accel_bias_walk;
  Generator random(keyOf(o.seed, 30));
  Bias bias = {o.noise * o.gyro_bias * randomNormal<double, 3>(random),
               o.noise * o.accel_bias * randomNormal<double, 3>(random)};
  const double step = std::sqrt(1 / o.imu_rate);
  for (std::int64_t i = 0; timeOf(i) <= end; ++i) {
    biases_.push_back(bias);
    bias.gyro += calibration_.gyro_bias_walk * step * randomNormal<double, 3>(random);
    bias.accel += calibration_.accel_bias_walk * step * randomNormal<double, 3>(random);
  }
}

std::int64_t Imu::timeOf(std::int64_t i) const {
  return static_cast<std::int64_t>(std::llround(double(i) * 1e9 / calibration_.rate));
}

std::vector<ImuSample> Imu::samples(const Motion& motion, std::int64_t from, std::int64_t to,
                                    std::int64_t origin) const {
  std::vector<ImuSample> samples;
  auto i =
      static_cast<std::int64_t>(double(std::max<std::int64_t>(from, 0)) * 1e-9 * calibration_.rate);
  i = std::max<std::int64_t>(i - 1, 0);
  for (; i < static_cast<std::int64_t>(biases_.size()) && timeOf(i) <= to; ++i) {
    if (timeOf(i) <= from) continue;
    samples.push_back(sample(motion, i));
    samples.back().stamp += origin;
  }
  return samples;
}

ImuSample Imu::sample(const Motion& motion, std::int64_t i) const {
  const SplineSample<SE3d> at = motion.sampleAt(timeOf(i));
  const Vec3d v = at.velocity.segment<3>(0), w = at.velocity.segment<3>(3);
  const Vec3d a = at.acceleration.segment<3>(0);
  const Vec3d force = a + w.cross(v) + at.value.rotation().inverse() * kGravity;
  Generator random(keyOf(key_, 0, static_cast<std::uint64_t>(i)));
  const double scale = std::sqrt(calibration_.rate);
  const Bias& bias = biases_[static_cast<std::size_t>(i)];
  const Vec3d gyro_noise = calibration_.gyro_noise * scale * randomNormal<double, 3>(random);
  const Vec3d accel_noise = calibration_.accel_noise * scale * randomNormal<double, 3>(random);
  return {timeOf(i), w + bias.gyro + gyro_noise, force + bias.accel + accel_noise};
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
