// Which functions read and write a file, by its suffix.
#ifndef GSLAM_SVAR_DETAIL_FILE_FORMATS_H
#define GSLAM_SVAR_DETAIL_FILE_FORMATS_H

#include <gslam/base/error.h>
#include <gslam/svar/json.h>

#include <mutex>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

struct FileFormat {
  std::string suffix;  // with its dot, in lower case
  Svar (*load)(const std::string& path);
  void (*save)(const std::string& path, const Svar& value);
};

/// The formats of this program. Thread-safe.
class GSLAM_PUBLIC FileFormats {
 public:
  static FileFormats& ofProgram() {
    static FileFormats formats;
    return formats;
  }

  /// Replaces one of the same suffix.
  void add(const FileFormat& format) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (FileFormat& one : formats_) {
      if (one.suffix != format.suffix) continue;
      one = format;
      return;
    }
    formats_.push_back(format);
  }

  /// @throws FileError where the suffix of the path is unknown
  FileFormat of(const std::string& path) const {
    const std::size_t name = path.find_last_of('/') + 1;
    const std::size_t dot = path.rfind('.');
    std::string suffix = dot == std::string::npos || dot < name ? "" : path.substr(dot);
    for (char& c : suffix) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const std::lock_guard<std::mutex> lock(mutex_);
    std::string known;
    for (const FileFormat& one : formats_) {
      if (one.suffix == suffix) return one;
      known += (known.empty() ? "" : ", ") + one.suffix;
    }
    const bool elsewhere = suffix == ".yaml" || suffix == ".yml" || suffix == ".xml";
    throw FileError(path, (suffix.empty() ? "has no suffix" : "has the unknown suffix " + suffix) +
                              "; known are " + known +
                              (elsewhere ? "; for this one include <gslam/svar_formats.h> and link "
                                           "GSLAM::svar_formats"
                                         : ""));
  }

 private:
  FileFormats() {
    formats_.push_back({".json", [](const std::string& path) { return loadJson(path); },
                        [](const std::string& path, const Svar& value) { saveJson(path, value); }});
  }

  mutable std::mutex mutex_;
  std::vector<FileFormat> formats_;
};

}  // namespace detail

inline Svar Svar::load(const std::string& path) {
  return detail::FileFormats::ofProgram().of(path).load(path);
}

inline void Svar::save(const std::string& path) const {
  detail::FileFormats::ofProgram().of(path).save(path, *this);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_FILE_FORMATS_H
