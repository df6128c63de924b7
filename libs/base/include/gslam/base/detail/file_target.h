// What a file that is to be written is, and where it really lies.
#ifndef GSLAM_BASE_DETAIL_FILE_TARGET_H
#define GSLAM_BASE_DETAIL_FILE_TARGET_H

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

#if defined(__unix__) || defined(__APPLE__)

// Whether something is there that is no ordinary file: a pipe, a device, a folder.
inline bool isSpecialFile(const std::string& path) {
  struct stat facts;
  return ::stat(path.c_str(), &facts) == 0 && !S_ISREG(facts.st_mode);
}

// What a symbolic link names; empty for what is none.
inline std::string linkTarget(const std::string& path) {
  std::vector<char> bytes(4096);  // the longest path there is
  const auto size = ::readlink(path.c_str(), bytes.data(), bytes.size());
  return size < 0 ? std::string() : std::string(bytes.data(), static_cast<std::size_t>(size));
}

// The file that a path leads to, through links; it need not be there. A path whose links go in
// circles is given back: it cannot be written in any way.
inline std::string withoutLinks(const std::string& path) {
  std::string place = path;
  for (int i = 0; i < 40; ++i) {
    const std::string target = linkTarget(place);
    if (target.empty()) return place;
    const std::size_t name = place.find_last_of('/') + 1;  // 0 where there is no folder
    if (target[0] == '/') {
      place = target;
    } else {
      place.replace(name, std::string::npos, target);
    }
  }
  return path;
}

// Gives an open file the rights of another that it will replace, where that is there.
inline void copyMode(const std::string& path, std::FILE* file) {
  struct stat facts;
  if (::stat(path.c_str(), &facts) == 0) (void)!::fchmod(::fileno(file), facts.st_mode & 07777);
}

#else  // without links, devices among files, and rights

inline bool isSpecialFile(const std::string&) {
  return false;
}
inline std::string withoutLinks(const std::string& path) {
  return path;
}
inline void copyMode(const std::string&, std::FILE*) {}

#endif

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_DETAIL_FILE_TARGET_H
