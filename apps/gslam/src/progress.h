#ifndef GSLAM_APPS_PROGRESS_H
#define GSLAM_APPS_PROGRESS_H

#include <gslam/core/player.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>

namespace app {

/// A line on stderr that says how far the work is; nothing where stderr is no terminal.
class Progress {
 public:
  /// @param unit  what is counted
  explicit Progress(const char* unit = "frame") : unit_(unit) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Shows what a player plays, for as long as both live.
  void follow(const gslam::Messenger& messenger);
  /// Shows frames that are done, of all; 0: of how many is not known.
  void show(std::uint64_t done, std::uint64_t total);
  /// Shows which part of some work is done, from 0 to 1.
  void showPart(const char* work, double part);

 private:
  using Clock = std::chrono::steady_clock;

  bool isTime(Clock::time_point now);

  const char* const unit_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
  const bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
  gslam::Subscriber subscriber_;
};

}  // namespace app

#endif  // GSLAM_APPS_PROGRESS_H
