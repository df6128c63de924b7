// Files of /proc and /sys: read at once, parsed by names.
#ifndef GSLAM_EVALUATION_SRC_PROC_FILES_H
#define GSLAM_EVALUATION_SRC_PROC_FILES_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Puts a file's content into `out`, which keeps its memory from file to file. Returns 0, or errno.
int readFile(const std::string& path, std::string& out);

// Names in a folder that begin with some text, ascending; none where there is no such folder.
std::vector<std::string> namesIn(const std::string& folder, const std::string& begin = "");

// Names in a folder that are numbers; false where there is no such folder.
bool numbersIn(const std::string& folder, std::vector<long>& out);

// A number, after blanks; false where there is none. `at` is behind it then.
bool takeNumber(const std::string& text, std::size_t& at, std::uint64_t& out);

// The number in the line that begins with "<name>:", such as VmRSS in /proc/N/status; `missing`
// where there is no such line.
std::uint64_t numberOf(const std::string& text, const char* name, std::uint64_t missing = 0);

// Some of /proc/N/stat. Times are ticks; "reaped" is of children that ended and were waited for.
struct ProcStat {
  char state = '?';
  std::uint64_t parent = 0;
  std::uint64_t minor_faults = 0, reaped_minor_faults = 0;
  std::uint64_t major_faults = 0, reaped_major_faults = 0;
  std::uint64_t user = 0, system = 0, reaped_user = 0, reaped_system = 0;
  std::uint64_t threads = 0;
  std::uint64_t start = 0;  // ticks since the system began: with the number, which process it is
};

// False where it is no such file. The name of the program may hold blanks and brackets.
bool parseStat(const std::string& text, ProcStat& out);

// What one core did, from /proc/stat; ticks.
struct CoreTicks {
  std::size_t core = 0;
  std::uint64_t busy = 0;
  std::uint64_t all = 0;
};

std::vector<CoreTicks> parseCores(const std::string& text);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SRC_PROC_FILES_H
