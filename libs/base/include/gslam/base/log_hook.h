#ifndef GSLAM_BASE_LOG_HOOK_H
#define GSLAM_BASE_LOG_HOOK_H

#include <atomic>
#include <functional>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

/// @file
/// The log hook without streams, which cost those who include them: records, levels and the sink.
/// log.h has what one writes records with.

namespace gslam {
inline namespace v1 {

/// How much a record matters.
enum class LogLevel { debug, info, warning, error };

/// The name as streamLogSink() prints it, e.g. "warning".
inline const char* logLevelName(LogLevel level) {
  static const char* const names[] = {"debug", "info", "warning", "error"};
  return names[static_cast<int>(level)];
}

/// What a sink gets.
struct LogRecord {
  LogLevel level;       ///< how much it matters
  const char* file;     ///< source file; lives as long as the code that wrote the record
  int line;             ///< line in that file, from 1
  std::string message;  ///< what was written, as it is
};

/// Takes records. It is called in the thread that logs, without a lock held, and from several
/// threads at once if several log. What it throws is dropped: logging never fails. What it logs
/// itself is dropped, too.
using LogSink = std::function<void(const LogRecord&)>;

namespace detail {

constexpr int kLogOff = 1 + static_cast<int>(LogLevel::error);

struct LogState {
  std::atomic<int> least{kLogOff};
  std::mutex mutex;  // guards sink
  std::shared_ptr<const LogSink> sink;
};

// Never destroyed, so that static destructors may still log.
inline LogState& logState() {
  static LogState* const state = new LogState;
  return *state;
}

}  // namespace detail

/// Sends records of at least this level to the sink; an empty sink turns logging off.
///
/// Holds for the program, and for each shared library that sees the same symbols; a plugin built
/// with hidden visibility has a hook of its own, which its host sets. A record that another thread
/// is just writing may still reach the old sink: what a sink refers to must outlive the threads
/// that log. Thread-safe.
inline void setLogSink(LogSink sink, LogLevel least = LogLevel::info) {
  detail::LogState& state = detail::logState();
  const int level = sink ? static_cast<int>(least) : detail::kLogOff;
  std::shared_ptr<const LogSink> next = std::make_shared<const LogSink>(std::move(sink));
  std::lock_guard<std::mutex> lock(state.mutex);
  state.sink.swap(next);
  state.least.store(level, std::memory_order_relaxed);
}

/// Whether a record of this level would reach a sink: one relaxed atomic load.
inline bool logEnabled(LogLevel level) noexcept {
  return static_cast<int>(level) >= detail::logState().least.load(std::memory_order_relaxed);
}

/// Hands a record to the sink, if there is one for its level. Never throws. Thread-safe.
inline void log(const LogRecord& record) noexcept {
  static thread_local bool inside = false;  // a sink that logs must not call itself
  if (inside || !logEnabled(record.level)) return;
  inside = true;
  try {
    detail::LogState& state = detail::logState();
    std::shared_ptr<const LogSink> sink;
    {
      std::lock_guard<std::mutex> lock(state.mutex);
      sink = state.sink;
    }
    if (sink && *sink) (*sink)(record);
  } catch (...) {  // NOLINT(bugprone-empty-catch): a broken sink must not break the SLAM system
  }
  inside = false;
}

namespace detail {

// Logs text of several parts, which are put together only where a sink wants them.
inline void logParts(LogLevel level, const char* file, int line,
                     std::initializer_list<const char*> parts) noexcept {
  if (!logEnabled(level)) return;
  try {
    std::string text;
    for (const char* part : parts) text += part;
    log({level, file, line, std::move(text)});
  } catch (...) {  // NOLINT(bugprone-empty-catch): out of memory, and logging never fails
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_LOG_HOOK_H
