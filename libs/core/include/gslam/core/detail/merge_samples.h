#ifndef GSLAM_CORE_DETAIL_MERGE_SAMPLES_H
#define GSLAM_CORE_DETAIL_MERGE_SAMPLES_H

#include <gslam/core/frame.h>

#include <memory>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// `later` with what was measured up to `earlier` before it, so that a frame that is dropped takes
// no measurement of inertia with it.
inline std::shared_ptr<const Frame> withSamplesBefore(const Frame& earlier,
                                                      const std::shared_ptr<const Frame>& later) {
  if (earlier.imu.empty() && earlier.gnss.empty()) return later;
  const std::shared_ptr<Frame> merged = std::make_shared<Frame>(*later);
  merged->imu.insert(merged->imu.begin(), earlier.imu.begin(), earlier.imu.end());
  merged->gnss.insert(merged->gnss.begin(), earlier.gnss.begin(), earlier.gnss.end());
  return merged;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_MERGE_SAMPLES_H
