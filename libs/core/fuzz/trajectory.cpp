// Any bytes are a trajectory that goes to text and back to the bit, or are refused with a
// gslam::Error.
#include <gslam/core/trajectory_file.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

using gslam::Trajectory;
using gslam::TrajectoryFileOptions;
using gslam::TrajectoryFormat;

bool isSame(const Trajectory& a, const Trajectory& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].stamp != b[i].stamp) return false;
    if (std::memcmp(&a[i].pose, &b[i].pose, sizeof(a[i].pose)) != 0) return false;
  }
  return true;
}

void roundTrip(const std::string& text, const TrajectoryFileOptions& options) {
  try {
    const Trajectory trajectory = gslam::parseTrajectory(text, "fuzz", options);
    TrajectoryFileOptions again;
    for (const TrajectoryFormat format : {TrajectoryFormat::tum, TrajectoryFormat::euroc}) {
      again.format = format;
      again.may_be_empty = true;
      const std::string printed = gslam::printTrajectory(trajectory, format);
      if (!isSame(gslam::parseTrajectory(printed, "printed", again), trajectory)) std::abort();
    }
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  TrajectoryFileOptions options;
  for (const TrajectoryFormat format : {TrajectoryFormat::any, TrajectoryFormat::tum,
                                        TrajectoryFormat::euroc, TrajectoryFormat::kitti}) {
    options.format = format;
    roundTrip(text, options);
  }
  options.duplicates = gslam::DuplicateStamps::keep_last;
  options.tum_stamps = gslam::StampUnit::microseconds;
  roundTrip(text, options);
  return 0;
}
