// A file that appears when it is whole.
#ifndef GSLAM_BASE_DETAIL_NEW_FILE_H
#define GSLAM_BASE_DETAIL_NEW_FILE_H

#include <gslam/base/detail/file_target.h>
#include <gslam/base/error.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// A file that is written under another name, and gets its own when all is in it: other programs see
// the old content or the new. Without commit() nothing is left of it, unless the process is ended.
// Links stay: what they lead to is replaced, and keeps its mode. A pipe or device is no file that
// could be replaced: the bytes go straight into it.
//
// When it has to be on the disk is left to the system: to wait for that (fsync) would cost those
// who write thousands of files minutes. So after the power failed there may be less in it.
class NewFile {
 public:
  explicit NewFile(const std::string& path) : path_(path) {
    if (isSpecialFile(path)) {
      errno = 0;
      file_ = std::fopen(path.c_str(), "wb");
      if (file_ == nullptr) throw FileError(path, "cannot be written", errno);
    } else {
      target_ = withoutLinks(path);
      openTemporary();
      copyMode(target_, file_);
    }
    std::setvbuf(file_, nullptr, _IONBF, 0);  // who writes comes with large pieces
  }
  ~NewFile() {
    if (file_ != nullptr) std::fclose(file_);
    if (!temporary_.empty()) std::remove(temporary_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(const void* bytes, std::size_t count) {
    errno = 0;
    if (std::fwrite(bytes, 1, count, file_) == count) return;
    throw FileError(path_, "cannot be written", errno);
  }

  void commit() {
    std::FILE* const file = file_;
    file_ = nullptr;
    errno = 0;
    if (std::fclose(file) != 0) throw FileError(path_, "cannot be written", errno);
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) {
      throw FileError(path_, "cannot be replaced", errno);
    }
    temporary_.clear();
  }

 private:
  // Who is ended while it writes leaves a name that others cannot have.
  void openTemporary() {
    std::string name;
    for (int i = 0; i < 10000 && file_ == nullptr; ++i) {
      name = target_ + "." + std::to_string(i) + ".tmp";
      errno = 0;
      file_ = std::fopen(name.c_str(), "wbx");
      if (file_ == nullptr && errno != EEXIST) throw FileError(path_, "cannot be written", errno);
    }
    if (file_ == nullptr) throw FileError(path_, "cannot be written: " + name + " is there");
    temporary_.swap(name);
  }

  std::string path_;
  std::string target_;     // where the path leads to
  std::string temporary_;  // what is there as long as it is not whole; empty for none
  std::FILE* file_ = nullptr;
};

// A whole file in one step.
inline void writeTextFile(const std::string& path, const std::string& text) {
  NewFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_DETAIL_NEW_FILE_H
