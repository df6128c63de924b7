// Files of bytes: one that is read piece by piece, one that appears when it is whole.
#ifndef GSLAM_CORE_DETAIL_BINARY_FILE_H
#define GSLAM_CORE_DETAIL_BINARY_FILE_H

#include <gslam/base/error.h>
#include <gslam/core/detail/file_target.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// The bytes of a file, or of a block in memory, from the first to the last.
class ByteSource {
 public:
  explicit ByteSource(const std::string& path) : name_(path) {
    errno = 0;
    file_.open(path, std::ios::binary | std::ios::ate);
    if (!file_) throw FileError(path, "cannot be opened", errno);
    const std::streamoff size = file_.tellg();
    if (size < 0) throw FileError(path, "has no size: it is no ordinary file", errno);
    remaining_ = static_cast<std::uint64_t>(size);
    file_.seekg(0);
  }
  // The block must outlive it.
  ByteSource(const std::uint8_t* data, std::size_t size, const std::string& name)
      : name_(name), memory_(data), remaining_(size) {}

  const std::string& name() const noexcept { return name_; }
  std::uint64_t remaining() const noexcept { return remaining_; }
  std::uint64_t offset() const noexcept { return offset_; }

  // There must be as many.
  void read(std::uint8_t* bytes, std::size_t count) {
    if (memory_ != nullptr) {
      if (count != 0) std::memcpy(bytes, memory_ + offset_, count);
    } else {
      errno = 0;
      file_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count));
      if (file_.eof()) throw FileError(name_, "became shorter while it was read");
      if (!file_) throw FileError(name_, "cannot be read", errno);
    }
    offset_ += count;
    remaining_ -= count;
  }

 private:
  std::string name_;
  std::ifstream file_;
  const std::uint8_t* memory_ = nullptr;
  std::uint64_t remaining_ = 0;
  std::uint64_t offset_ = 0;
};

// All that is left. It grows as it is read: a folder, for one, has a size that means nothing.
inline std::vector<std::uint8_t> readAll(ByteSource& source) {
  std::vector<std::uint8_t> bytes;
  while (source.remaining() != 0) {
    const std::size_t before = bytes.size();
    const std::uint64_t step = std::max<std::uint64_t>(before, 1 << 20);
    bytes.resize(before + static_cast<std::size_t>(std::min(step, source.remaining())));
    source.read(bytes.data() + before, bytes.size() - before);
  }
  return bytes;
}

// A file that is written under another name, and gets its own when all is in it: others see the
// old content or the new. Without commit() nothing is left of it. Links stay: what they lead to is
// replaced, and keeps its mode. A pipe or device is no file that could be replaced: the bytes go
// straight into it.
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
  void openTemporary() {
    std::string name;
    for (int i = 0; i < 100 && file_ == nullptr; ++i) {
      name = target_ + "." + std::to_string(i) + ".tmp";
      errno = 0;
      file_ = std::fopen(name.c_str(), "wbx");
      if (file_ == nullptr && errno != EEXIST) throw FileError(path_, "cannot be written", errno);
    }
    if (file_ == nullptr) throw FileError(path_, "cannot be written: " + name + " is there, too");
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

#endif  // GSLAM_CORE_DETAIL_BINARY_FILE_H
