#ifndef GSLAM_BASE_LOG_H
#define GSLAM_BASE_LOG_H

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

/// @file
/// The log hook: libraries write records, the program decides where they go. Off until it does.
///
///     gslam::setLogSink(gslam::streamLogSink(std::cerr), gslam::LogLevel::warning);
///     GSLAM_LOG(warning) << "lost track at frame " << id;

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

/// A sink that writes lines such as `warning tracker.cpp:42: lost track` to a stream, one at a
/// time. The stream must outlive the threads that log.
inline LogSink streamLogSink(std::ostream& stream) {
  std::shared_ptr<std::mutex> mutex = std::make_shared<std::mutex>();
  return [mutex, &stream](const LogRecord& record) {
    const std::string path = record.file;
    std::ostringstream line;
    line << logLevelName(record.level) << ' ' << path.substr(path.find_last_of("/\\") + 1) << ':'
         << record.line << ": " << record.message << '\n';
    std::lock_guard<std::mutex> lock(*mutex);
    stream << line.str() << std::flush;
  };
}

namespace detail {

// Collects one record and logs it at the end of the statement.
class LogLine {
 public:
  LogLine(LogLevel level, const char* file, int line) : record_{level, file, line, std::string()} {}
  LogLine(const LogLine&) = delete;
  LogLine& operator=(const LogLine&) = delete;
  ~LogLine() {
    try {
      record_.message = stream_.str();
    } catch (...) {  // NOLINT(bugprone-empty-catch): out of memory, the message stays empty
    }
    log(record_);
  }
  std::ostream& stream() { return stream_; }

 private:
  LogRecord record_;
  std::ostringstream stream_;
};

// Binds weaker than << and stronger than ?:, which makes GSLAM_LOG one expression.
struct LogNothing {
  void operator&(std::ostream&) const {}
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

/// Writes one record: `GSLAM_LOG(info) << "read " << n << " frames";`
/// Nothing to the right of it is evaluated when the level is off.
// NOLINTBEGIN(bugprone-macro-parentheses): it is one expression that << goes on with
#define GSLAM_LOG(level)                           \
  (!::gslam::logEnabled(::gslam::LogLevel::level)) \
      ? (void)0                                    \
      : ::gslam::detail::LogNothing() &            \
            ::gslam::detail::LogLine(::gslam::LogLevel::level, __FILE__, __LINE__).stream()
// NOLINTEND(bugprone-macro-parentheses)

#endif  // GSLAM_BASE_LOG_H
