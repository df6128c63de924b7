#include "silence.h"

#include <glog/logging.h>

#include <mutex>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

struct GlogThreshold {
  std::mutex mutex;
  int silences = 0;
  bool is_raised = false;
  int before = 0;
};

GlogThreshold& glogThreshold() {
  static GlogThreshold threshold;
  return threshold;
}

}  // namespace

SilentGlog::SilentGlog() {
  GlogThreshold& threshold = glogThreshold();
  const std::lock_guard<std::mutex> lock(threshold.mutex);
  if (threshold.silences++ != 0 || google::IsGoogleLoggingInitialized()) return;
  threshold.before = FLAGS_minloglevel;
  threshold.is_raised = threshold.before < google::GLOG_FATAL;
  if (threshold.is_raised) FLAGS_minloglevel = google::GLOG_FATAL;
}

SilentGlog::~SilentGlog() {
  GlogThreshold& threshold = glogThreshold();
  const std::lock_guard<std::mutex> lock(threshold.mutex);
  if (--threshold.silences != 0 || !threshold.is_raised) return;
  threshold.is_raised = false;
  FLAGS_minloglevel = threshold.before;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
