#include "progress.h"

#include <cstdio>
#include <string>

namespace app {

void Progress::follow(const gslam::Messenger& messenger) {
  subscriber_ = messenger.subscribe<gslam::RunStatus>(
      "/run/status",
      [this](const gslam::RunStatus& status) { show(status.frame, status.frame_count); });
}

Progress::~Progress() {
  subscriber_.unsubscribe();
  if (is_shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::uint64_t done, std::uint64_t total) {
  const Clock::time_point now = Clock::now();
  if (!is_terminal_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  is_shown_ = true;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const auto frame = static_cast<unsigned long long>(done);
  const double rate = seconds > 0 ? double(frame) / seconds : 0;
  if (total == 0) {
    std::fprintf(stderr, "\r\033[Kframe %llu, %.1f a second", frame, rate);
  } else {
    const auto count = static_cast<unsigned long long>(total);
    std::fprintf(stderr, "\r\033[Kframe %llu of %llu (%.0f %%), %.1f a second", frame, count,
                 100.0 * double(frame) / double(count), rate);
  }
  std::fflush(stderr);
}

}  // namespace app
