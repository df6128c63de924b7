#include "proc_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#if defined(__unix__) || defined(__APPLE__)
#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/syscall.h>
#endif
#define GSLAM_DETAIL_HAS_FILES 1
#else
#define GSLAM_DETAIL_HAS_FILES 0
#endif

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

bool isDecimal(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

#if GSLAM_DETAIL_HAS_FILES

int readFile(const std::string& path, std::string& out) {
  out.clear();
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  int problem = 0;
  for (;;) {
    const std::size_t size = out.size();
    out.resize(std::max(out.capacity(), size + 2048));
    const ssize_t count = ::read(file, &out[size], out.size() - size);
    if (count < 0) problem = errno;
    out.resize(size + (count > 0 ? std::size_t(count) : 0));
    if (count == 0 || (count < 0 && problem != EINTR)) break;
    problem = 0;
  }
  ::close(file);
  return problem;
}

std::vector<std::string> namesIn(const std::string& folder, const std::string& begin) {
  std::vector<std::string> names;
  DIR* const open = ::opendir(folder.c_str());
  if (open == nullptr) return names;
  while (const dirent* entry = ::readdir(open)) {  // NOLINT(concurrency-mt-unsafe): our own stream
    const std::string name = entry->d_name;
    if (name != "." && name != ".." && name.compare(0, begin.size(), begin) == 0) {
      names.push_back(name);
    }
  }
  ::closedir(open);
  std::sort(names.begin(), names.end());
  return names;
}

namespace {

void addNumber(const char* name, std::vector<long>& out) {
  long number = 0;
  const char* c = name;
  for (; isDecimal(*c) && number < 1000000000; ++c) number = 10 * number + (*c - '0');
  if (c != name && *c == '\0') out.push_back(number);
}

}  // namespace

#if defined(__linux__)

// Without opendir(), which allocates 32 KB.
bool numbersIn(const std::string& folder, std::vector<long>& out) {
  out.clear();
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return false;
  alignas(8) char buffer[4096];
  for (;;) {
    const long size = ::syscall(SYS_getdents64, file, buffer, sizeof buffer);
    if (size <= 0) break;
    // getdents(2): inode and offset of 8 bytes, the entry's length of 2, a byte, the name.
    for (long at = 0; at + 19 < size;) {
      std::uint16_t length = 0;
      std::memcpy(&length, buffer + at + 16, sizeof length);
      addNumber(buffer + at + 19, out);
      if (length == 0) break;
      at += length;
    }
  }
  ::close(file);
  return true;
}

#else

bool numbersIn(const std::string& folder, std::vector<long>& out) {
  out.clear();
  DIR* const open = ::opendir(folder.c_str());
  if (open == nullptr) return false;
  while (const dirent* entry = ::readdir(open)) addNumber(entry->d_name, out);
  ::closedir(open);
  return true;
}

#endif  // __linux__

#else

int readFile(const std::string&, std::string& out) {
  out.clear();
  return ENOENT;
}
std::vector<std::string> namesIn(const std::string&, const std::string&) {
  return {};
}
bool numbersIn(const std::string&, std::vector<long>& out) {
  out.clear();
  return false;
}

#endif  // GSLAM_DETAIL_HAS_FILES

bool takeNumber(const std::string& text, std::size_t& at, std::uint64_t& out) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
  const bool is_negative = at < text.size() && text[at] == '-';  // some fields are -1 for "none"
  if (is_negative) ++at;
  if (at >= text.size() || !isDecimal(text[at])) return false;
  std::uint64_t value = 0;
  for (; at < text.size() && isDecimal(text[at]); ++at) {
    value = 10 * value + std::uint64_t(text[at] - '0');
  }
  out = is_negative ? 0 : value;
  return true;
}

std::uint64_t numberOf(const std::string& text, const char* name, std::uint64_t missing) {
  const std::size_t length = std::strlen(name);
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const bool begins_line = at == 0 || text[at - 1] == '\n';
    std::size_t behind = at + length;
    std::uint64_t value = 0;
    if (begins_line && behind < text.size() && text[behind] == ':' &&
        takeNumber(text, ++behind, value)) {
      return value;
    }
  }
  return missing;
}

bool parseStat(const std::string& text, ProcStat& out) {
  const std::size_t bracket = text.rfind(')');  // a program's name may hold others
  if (bracket == std::string::npos || bracket + 3 >= text.size()) return false;
  out = ProcStat();
  out.state = text[bracket + 2];
  std::size_t at = bracket + 3;
  // proc(5): the state is field 3.
  std::uint64_t* const fields[] = {&out.parent,       nullptr,
                                   nullptr,           nullptr,
                                   nullptr,           nullptr,
                                   &out.minor_faults, &out.reaped_minor_faults,
                                   &out.major_faults, &out.reaped_major_faults,
                                   &out.user,         &out.system,
                                   &out.reaped_user,  &out.reaped_system,
                                   nullptr,           nullptr,
                                   &out.threads,      nullptr,
                                   &out.start};
  for (std::uint64_t* const field : fields) {
    std::uint64_t value = 0;
    if (!takeNumber(text, at, value)) return false;
    if (field != nullptr) *field = value;
  }
  return true;
}

std::vector<CoreTicks> parseCores(const std::string& text) {
  std::vector<CoreTicks> cores;
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t end = std::min(text.find('\n', line), text.size());
    CoreTicks core;
    std::uint64_t number = 0;
    std::size_t at = line + 3;
    if (text.compare(line, 3, "cpu") == 0 && at < end && isDecimal(text[at]) &&
        takeNumber(text, at, number)) {
      core.core = std::size_t(number);
      // user nice system idle iowait irq softirq steal; guests are part of user
      std::uint64_t ticks = 0;
      for (int i = 0; i < 8 && at < end && takeNumber(text, at, ticks); ++i) {
        core.all += ticks;
        if (i != 3 && i != 4 && i != 7) core.busy += ticks;
      }
      cores.push_back(core);
    }
    line = end + 1;
  }
  return cores;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
