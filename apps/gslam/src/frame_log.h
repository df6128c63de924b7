#ifndef GSLAM_APPS_FRAME_LOG_H
#define GSLAM_APPS_FRAME_LOG_H

#include <gslam/evaluation/frame_times.h>

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "run_folder.h"

namespace app {

/// What became of the frames of a run.
struct FrameRecords {
  std::vector<gslam::FrameTime> frames;  ///< by id
  std::size_t unreadable = 0;            ///< frames that could not be read, and have no id
};

/// Writes what became of each frame while the run goes on: the lines of frameTimesCsv() with the
/// column `unreadable`. A frame whose pose comes late has two lines, of which the last counts.
/// Thread-safe.
class FrameLog {
 public:
  /// @throws FileError
  explicit FrameLog(const std::string& path);

  void add(const gslam::FrameTime& frame);
  void addUnreadable();
  /// @throws FileError when something could not be written
  void check() const { file_.check(); }

 private:
  std::mutex mutex_;
  LineFile file_;
};

/// Reads what FrameLog wrote, also where a crash cut it off; of no file, nothing.
/// @throws ParseError for what FrameLog does not write
FrameRecords readFrames(const std::string& path);
/// Writes all again, one line a frame by id.
/// @throws FileError
void writeFrames(const std::string& path, const FrameRecords& records);

}  // namespace app

#endif  // GSLAM_APPS_FRAME_LOG_H
