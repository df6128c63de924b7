// JSON files. What json.h says of loadJson() and saveJson() is done here.
#ifndef GSLAM_SVAR_DETAIL_JSON_FILE_H
#define GSLAM_SVAR_DETAIL_JSON_FILE_H

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
  JsonFile(const std::string& path, const char* mode) : file_(std::fopen(path.c_str(), mode)) {}
  ~JsonFile() { close(); }
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

  bool write(const std::string& text) noexcept {
    return std::fwrite(text.data(), 1, text.size(), file_) == text.size();
  }

  bool close() noexcept {
    std::FILE* const file = file_;
    file_ = nullptr;
    return file == nullptr || std::fclose(file) == 0;
  }

 private:
  std::FILE* file_;
};

/// The whole content of a file.
inline std::string readFile(const std::string& path) {
  JsonFile file(path, "rb");
  if (!file.isOpen()) throw FileError(path, "cannot be opened", errno);
  std::string text;
  if (!file.read(text)) throw FileError(path, "cannot be read", errno);
  return text;
}

/// Makes the file `name`, which must not exist. False where it does.
inline bool writeNewFile(const std::string& path, const std::string& name,
                         const std::string& text) {
  errno = 0;
  JsonFile file(name, "wbx");
  if (!file.isOpen() && errno == EEXIST) return false;
  if (!file.isOpen()) throw FileError(path, "cannot be written", errno);
  errno = 0;
  const bool written = file.write(text);
  const int problem = errno;
  if (file.close() && written) return true;
  const int reason = written ? errno : problem;
  std::remove(name.c_str());
  throw FileError(path, "cannot be written", reason);
}

/// Puts the text into a file in one step: a reader sees the old content or the new.
inline void replaceFile(const std::string& path, const std::string& text) {
  std::string name;
  for (int i = 0;; ++i) {
    if (i == 100) throw FileError(path, "cannot be written: " + name + " is there, too");
    name = path + "." + std::to_string(i) + ".tmp";
    if (writeNewFile(path, name, text)) break;
  }
  if (std::rename(name.c_str(), path.c_str()) == 0) return;
  const int reason = errno;
  std::remove(name.c_str());
  throw FileError(path, "cannot be replaced", reason);
}

}  // namespace detail

inline Svar loadJson(const std::string& path, const JsonOptions& options) {
  return parseJson(detail::readFile(path), path, options);
}

inline void saveJson(const std::string& path, const Svar& value, int indent) {
  detail::replaceFile(path, printJson(value, indent) + "\n");
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_JSON_FILE_H
