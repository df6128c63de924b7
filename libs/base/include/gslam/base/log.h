#ifndef GSLAM_BASE_LOG_H
#define GSLAM_BASE_LOG_H

#include <gslam/base/log_hook.h>

#include <memory>
#include <mutex>
#include <ostream>
#include <sstream>
#include <string>

/// @file
/// The log: libraries write records, the program decides where they go. Off until it does.
///
///     gslam::setLogSink(gslam::streamLogSink(std::cerr), gslam::LogLevel::warning);
///     GSLAM_LOG(warning) << "lost track at frame " << id;

namespace gslam {
inline namespace v1 {

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
