#ifndef GSLAM_EVALUATION_LIMITS_H
#define GSLAM_EVALUATION_LIMITS_H

#include <gslam/evaluation/export.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// @file
/// Runs on fewer cores and with less memory than the machine has, as on a smaller one.
///
///     gslam::setCpuAffinity(gslam::parseCpuList("0-3", "--cpus"), "--cpus");
///     const gslam::MemoryLimit limit(gslam::parseMemorySize("4G", "--memory"));
///     std::cerr << limit.text() << '\n';

namespace gslam {
inline namespace v1 {

/// Numbers of cores, ascending, each once.
/// @param text      such as "0,1" or "0-3,8"
/// @param argument  what it is called in errors
/// @throws ArgumentError when it is no such list, or has a number above 1023
GSLAM_EVALUATION_EXPORT std::vector<int> parseCpuList(const std::string& text,
                                                      const std::string& argument = "--cpus");

/// Bytes.
/// @param text      a number above 0 with K, M, G or T (times 1024) or nothing behind it: "4G",
///                  "1.5G", "512MiB"
/// @param argument  what it is called in errors
/// @throws ArgumentError when it is no such number, or above 2^63
GSLAM_EVALUATION_EXPORT std::uint64_t parseMemorySize(const std::string& text,
                                                      const std::string& argument = "--memory");

/// The cores that the calling thread may run on, ascending.
/// @throws Error when the system does not tell, as no other than Linux does
GSLAM_EVALUATION_EXPORT std::vector<int> cpuAffinity();

/// Has all threads of this process, and all threads and processes that they start from now on, run
/// on these cores only.
/// @param cpus      as parseCpuList() gives
/// @param argument  what it is called in errors
/// @throws ArgumentError when none of them is there or allowed, or one is not there; Error when
/// this
///   system cannot
GSLAM_EVALUATION_EXPORT void setCpuAffinity(const std::vector<int>& cpus,
                                            const std::string& argument = "--cpus");

/// Where MemoryLimit works.
struct MemoryLimitOptions {
  std::string proc = "/proc";  ///< of the process's own files
  bool may_use_cgroup = true;  ///< otherwise as if there were none
};

/// Limits memory of this process and all that it starts, as long as it lives. There should be one
/// at a time, made first thing. (To limit a SLAM system alone, run it in a process that limits
/// itself, as `gslam run` does.)
///
/// Where a control group (cgroup v2) can be made, which needs the rights to do it (root, or
/// systemd's delegation to a user), this process moves to a new one, which has the limit for all
/// that is in it together, without swap: the system ends what goes beyond. What this process had
/// before stays in its old group and does not count. Processes that live on keep the limit. The
/// group of a process that was killed stays; the next MemoryLimit or removeEndedMemoryGroups()
/// removes it.
///
/// Otherwise it is a limit of each process (RLIMIT_DATA): of what it writes to and does not share,
/// whether used or not; beyond it malloc() fails and operator new throws std::bad_alloc. Each
/// thread counts with its stack, usually 8 MiB, so that std::thread may fail first. It is never
/// more than the limit that there was. Limiting addresses (RLIMIT_AS) would count what programs
/// merely reserve, such as libraries and drivers.
///
/// Linux only: elsewhere the constructor throws Error.
class GSLAM_EVALUATION_EXPORT MemoryLimit {
 public:
  /// @param bytes    above 0
  /// @param options  how
  /// @throws ArgumentError for 0; Error when neither can be done
  explicit MemoryLimit(std::uint64_t bytes, const MemoryLimitOptions& options = {});
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;
  /// Ends the limit for this process and removes the group, where nobody is in it any more.
  ~MemoryLimit();

  /// Which was used and why, in words: "memory limited to 4.00 GiB by cgroup v2 (/sys/...)".
  const std::string& text() const noexcept;
  /// Whether a control group was made.
  bool isCgroup() const noexcept;
  /// Its folder, such as "/sys/fs/cgroup/user.slice/gslam-1234"; empty: there is none.
  const std::string& group() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Removes control groups that a MemoryLimit of a process made which is gone, such as one that had
/// more memory than it may. For who started it; does nothing where there are none.
GSLAM_EVALUATION_EXPORT void removeEndedMemoryGroups(const MemoryLimitOptions& options = {});

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_LIMITS_H
