#ifndef GSLAM_EVALUATION_PROCESS_USAGE_H
#define GSLAM_EVALUATION_PROCESS_USAGE_H

#include <gslam/evaluation/export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

/// @file
/// What a process and all that it started have used, from /proc.
///
///     gslam::ProcessTree own;                              // or {slam.processNumber()}
///     const gslam::ProcessUsage before = own.read();
///     ...
///     const gslam::ProcessUsage used = gslam::usedBetween(before, own.read());
///     used.cpu_seconds;

namespace gslam {
inline namespace v1 {

/// What processes use at a time, and have used until then.
///
/// Thread-safety: plain data.
struct ProcessUsage {
  std::int64_t time = 0;      ///< of the reading, nanoseconds of std::chrono::steady_clock
  std::size_t processes = 0;  ///< that live; 0: all are gone
  std::size_t threads = 0;    ///< of these

  /// @{
  /// Now, bytes. `rss_bytes` is the sum over processes, so that memory that two of them share, such
  /// as libraries or the frames of an IsolatedSlam, counts for each; `private_bytes` (RssAnon) has
  /// nothing of it but what is shared since a fork. `pss_bytes`, where it was asked for, divides
  /// what is shared by those who share it, which only adds up where all of these are in the tree.
  std::uint64_t rss_bytes = 0, private_bytes = 0, pss_bytes = 0;
  /// @}
  /// Most of `rss_bytes`, bytes. Of one process the system's own record (VmHWM), which goes back to
  /// its start; of more the most that any reading found, and at least the record of each.
  std::uint64_t peak_rss_bytes = 0;

  double cpu_seconds = 0;                  ///< user and system, to nanoseconds
  double user_seconds = 0;                 ///< to ticks of 10 ms, as the system tells
  double system_seconds = 0;               ///< to ticks of 10 ms
  std::uint64_t voluntary_switches = 0;    ///< of context: a thread waits
  std::uint64_t involuntary_switches = 0;  ///< of context: another thread had its turn
  std::uint64_t minor_faults = 0;          ///< pages that were there, or were made
  std::uint64_t major_faults = 0;          ///< pages that were read from a disk
};

/// What was used from one reading to a later one: CPU, switches and faults are differences (of
/// numbers, never below 0), all else is as in the later.
GSLAM_EVALUATION_EXPORT ProcessUsage usedBetween(const ProcessUsage& earlier,
                                                 const ProcessUsage& later);

/// How ProcessTree reads.
struct ProcessTreeOptions {
  long root = 0;               ///< number of the process at the root; 0: this one (and not the
                               ///< IsolatedSlam whose processNumber() is 0: it has none any more)
  bool has_pss = false;        ///< whether to find out ProcessUsage::pss_bytes, which takes about a
                               ///< millisecond for each 100 MB of memory
  std::string proc = "/proc";  ///< where the files are
};

/// A process and all that descend from it. Once seen, a descendant belongs to it, also when its
/// parent ends before it.
///
/// CPU, switches and faults never go backwards: of a process that ended, what its parent has been
/// told counts (as exact as it gets), or else its last reading; whether it was told, page faults
/// show. A process that starts and ends
/// between two readings is known by what its parent is told: CPU and faults, no switches.
///
/// All members are thread-safe. Files are parsed by names and after the last ')' of a program's
/// name; what is missing in them counts 0.
///
/// Linux only: elsewhere the constructor throws Error.
class GSLAM_EVALUATION_EXPORT ProcessTree {
 public:
  /// @throws FileError when there is no such process, or no /proc
  explicit ProcessTree(const ProcessTreeOptions& options = {});
  ProcessTree(const ProcessTree&) = delete;
  ProcessTree& operator=(const ProcessTree&) = delete;
  ~ProcessTree();

  /// Reads all. About 0.05 ms for a process, and 0.01 ms for each of its threads.
  ProcessUsage read();

  /// CPU time, user and system, of the processes that the last read() found and of those that
  /// ended before it, nanoseconds: for a single frame. About 1 us. Never goes backwards, and is
  /// ahead of ProcessUsage::cpu_seconds by what was used since. A process that gets the number of
  /// one that ended is not counted where the clock was found gone or behind in between.
  std::int64_t cpuTime();

  /// Number of the process at the root.
  long root() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_PROCESS_USAGE_H
