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

bool Progress::isTime(Clock::time_point now) {
  if (!is_terminal_ || now < next_) return false;
  next_ = now + std::chrono::milliseconds(100);
  is_shown_ = true;
  return true;
}

void Progress::showPart(const char* work, double part) {
  if (!isTime(Clock::now())) return;
  std::fprintf(stderr, "\r\033[K%s %.0f %%", work, 100 * part);
  std::fflush(stderr);
}

void Progress::show(std::uint64_t done, std::uint64_t total) {
  const Clock::time_point now = Clock::now();
  if (!isTime(now)) return;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const auto frame = static_cast<unsigned long long>(done);
  const double rate = seconds > 0 ? double(frame) / seconds : 0;
  if (total == 0) {
    std::fprintf(stderr, "\r\033[K%s %llu, %.1f a second", unit_, frame, rate);
  } else {
    const auto count = static_cast<unsigned long long>(total);
    std::fprintf(stderr, "\r\033[K%s %llu of %llu (%.0f %%), %.1f a second", unit_, frame, count,
                 100.0 * double(frame) / double(count), rate);
  }
  std::fflush(stderr);
}

}  // namespace app
