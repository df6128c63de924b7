// What plugins need of the system: files by name, the program's own place, the dynamic linker.
#ifndef GSLAM_CORE_DETAIL_SHARED_LIBRARY_H
#define GSLAM_CORE_DETAIL_SHARED_LIBRARY_H

#include <gslam/base/error.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <dirent.h>
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>
#define GSLAM_DETAIL_HAS_DLOPEN 1
#else
#define GSLAM_DETAIL_HAS_DLOPEN 0
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

// Which file it is, by whatever path.
struct FileIdentity {
  std::uint64_t device = 0, number = 0;
  friend bool operator==(const FileIdentity& a, const FileIdentity& b) noexcept {
    return a.device == b.device && a.number == b.number;
  }
};

enum class FileKind { none, file, folder, other };

#if GSLAM_DETAIL_HAS_DLOPEN

inline FileKind fileKind(const std::string& path, FileIdentity* identity = nullptr) {
  struct stat facts;
  if (::stat(path.c_str(), &facts) != 0) return FileKind::none;
  if (identity != nullptr) {
    identity->device = std::uint64_t(facts.st_dev);
    identity->number = std::uint64_t(facts.st_ino);
  }
  if (S_ISDIR(facts.st_mode)) return FileKind::folder;
  return S_ISREG(facts.st_mode) ? FileKind::file : FileKind::other;
}

// Names of all that is in a folder, sorted; none where it cannot be read.
inline std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  const auto close = [](DIR* one) { ::closedir(one); };
  const std::unique_ptr<DIR, void (*)(DIR*)> listing(::opendir(folder.c_str()), close);
  if (!listing) return names;
  while (const dirent* const one = ::readdir(listing.get())) names.push_back(one->d_name);
  std::sort(names.begin(), names.end());
  return names;
}

// The path of the running program; empty where the system does not tell.
inline std::string programPath() {
  std::vector<char> path(256);
  while (path.size() < (std::size_t(1) << 20)) {
    const ssize_t size = ::readlink("/proc/self/exe", path.data(), path.size());
    if (size <= 0) return "";
    if (std::size_t(size) < path.size()) return std::string(path.data(), std::size_t(size));
    path.resize(path.size() * 2);
  }
  return "";
}

// An object of a library that stays loaded until the process ends.
inline void* loadObject(const std::string& path, const char* name) {
  // A path without a slash would be searched for.
  const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* const reason = ::dlerror();
    throw FileError(path, "cannot be loaded: " + std::string(reason != nullptr ? reason : "?"));
  }
  return ::dlsym(library, name);
}

#else

inline FileKind fileKind(const std::string&, FileIdentity* = nullptr) {
  return FileKind::none;
}
inline std::vector<std::string> namesIn(const std::string&) {
  return {};
}
inline std::string programPath() {
  return "";
}
inline void* loadObject(const std::string& path, const char*) {
  throw FileError(path, "cannot be loaded: this system has no dlopen");
}

#endif

// The folder of a file, "." for a name alone.
inline std::string parentFolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

inline bool isLibraryName(const std::string& name) {
  return name.size() >= 3 && name.compare(name.size() - 3, 3, ".so") == 0;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_SHARED_LIBRARY_H
