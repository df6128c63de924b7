// An inertial unit on an exact motion.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_IMU_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_IMU_H

#include <gslam/core/sensor.h>
#include <gslam/datasets/synthetic.h>

#include <cstdint>
#include <vector>

#include "motion.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// Immutable, shared by threads.
class Imu {
 public:
  /// @param end  time of the last sample, nanoseconds since the first frame
  Imu(const SyntheticOptions& options, std::int64_t end);

  const ImuCalibration& calibration() const { return calibration_; }
  /// The samples after `from`, up to `to`, nanoseconds since the first frame; their stamps are
  /// `origin` later.
  std::vector<ImuSample> samples(const Motion& motion, std::int64_t from, std::int64_t to,
                                 std::int64_t origin) const;

 private:
  struct Bias {
    Vec3d gyro, accel;
  };
  std::int64_t timeOf(std::int64_t i) const;
  ImuSample sample(const Motion& motion, std::int64_t i) const;

  ImuCalibration calibration_;
  std::uint64_t key_;
  std::vector<Bias> biases_;  // of each sample
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_IMU_H
