#include "byte_source.h"

#include <fcntl.h>
#include <gslam/base/error.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace ros {

ByteSource::ByteSource(std::string name, std::uint64_t size)
    : name_(std::move(name)), size_(size) {}

void ByteSource::fail(std::uint64_t offset, const std::string& problem) const {
  throw FileError(name_, "at byte " + std::to_string(offset) + ": " + problem);
}

void ByteSource::read(std::uint64_t offset, std::uint8_t* to, std::size_t size) const {
  if (offset > size_ || size > size_ - offset) {
    fail(offset, "expected " + std::to_string(size) + " bytes, but the file ends at byte " +
                     std::to_string(size_));
  }
  if (size > 0) get(offset, to, size);
}

std::vector<std::uint8_t> ByteSource::read(std::uint64_t offset, std::uint64_t size) const {
  if (offset > size_ || size > size_ - offset) read(offset, nullptr, std::size_t(size));
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  read(offset, bytes.data(), bytes.size());
  return bytes;
}

namespace {

class FileSource : public ByteSource {
 public:
  FileSource(const std::string& path, int file, std::uint64_t size)
      : ByteSource(path, size), file_(file) {}
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override { ::close(file_); }

 private:
  void get(std::uint64_t offset, std::uint8_t* to, std::size_t size) const override {
    while (size > 0) {
      const ssize_t got = ::pread(file_, to, size, static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw FileError(name(), "cannot be read", errno);
      if (got == 0) fail(offset, "the file ends here: it became shorter while it was read");
      to += got;
      offset += std::uint64_t(got);
      size -= std::size_t(got);
    }
  }

  int file_;
};

class MemorySource : public ByteSource {
 public:
  MemorySource(std::vector<std::uint8_t> bytes, const std::string& name)
      : ByteSource(name, bytes.size()), bytes_(std::move(bytes)) {}

 private:
  void get(std::uint64_t offset, std::uint8_t* to, std::size_t size) const override {
    std::memcpy(to, bytes_.data() + offset, size);
  }

  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::shared_ptr<const ByteSource> openFile(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw FileError(path, "cannot be opened", errno);
  struct stat facts;
  if (::fstat(file, &facts) != 0 || !S_ISREG(facts.st_mode)) {
    ::close(file);
    throw FileError(path, "is no file");
  }
  return std::make_shared<FileSource>(path, file, static_cast<std::uint64_t>(facts.st_size));
}

std::shared_ptr<const ByteSource> openMemory(std::vector<std::uint8_t> bytes,
                                             const std::string& name) {
  return std::make_shared<MemorySource>(std::move(bytes), name);
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
