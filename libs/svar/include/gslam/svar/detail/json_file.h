// JSON files. What json.h says of loadJson() and saveJson() is done here.
#ifndef GSLAM_SVAR_DETAIL_JSON_FILE_H
#define GSLAM_SVAR_DETAIL_JSON_FILE_H

#include <gslam/base/detail/new_file.h>
#include <gslam/base/error.h>
#include <gslam/svar/json.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

/// An open file, which closes itself.
class JsonFile {
 public:
  /// Not open where it cannot be; errno says why.
  explicit JsonFile(const std::string& path) : file_(std::fopen(path.c_str(), "rb")) {}
  ~JsonFile() {
    if (file_ != nullptr) std::fclose(file_);
  }
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;

  bool isOpen() const noexcept { return file_ != nullptr; }

  /// Sets `text` to all that follows.
  bool read(std::string& text) {
    const std::size_t step = 1 << 16;
    std::size_t size = 0;
    do {
      if (text.size() - size < step) text.resize(2 * text.size() + step);
      errno = 0;
      size += std::fread(&text[size], 1, text.size() - size, file_);
    } while (size == text.size());
    text.resize(size);
    return std::ferror(file_) == 0;
  }

 private:
  std::FILE* file_;
};

/// The whole content of a file.
inline std::string readFile(const std::string& path) {
  JsonFile file(path);
  if (!file.isOpen()) throw FileError(path, "cannot be opened", errno);
  std::string text;
  if (!file.read(text)) throw FileError(path, "cannot be read", errno);
  return text;
}

}  // namespace detail

inline Svar loadJson(const std::string& path, const JsonOptions& options) {
  return parseJson(detail::readFile(path), path, options);
}

inline void saveJson(const std::string& path, const Svar& value, int indent) {
  detail::writeTextFile(path, printJson(value, indent) + "\n");
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_JSON_FILE_H
