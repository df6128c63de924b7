#ifndef GSLAM_APPS_PROGRESS_H
#define GSLAM_APPS_PROGRESS_H

#include <gslam/core/player.h>

#include <chrono>

namespace app {

/// A line on stderr that says how far the player is; nothing where stderr is no terminal.
class Progress {
 public:
  explicit Progress(const gslam::Messenger& messenger);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

 private:
  void show(const gslam::RunStatus& status);

  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
  bool is_shown_ = false;
  gslam::Subscriber subscriber_;
};

}  // namespace app

#endif  // GSLAM_APPS_PROGRESS_H
