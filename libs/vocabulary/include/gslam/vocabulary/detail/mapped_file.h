// A file as memory that is read when it is touched.
#ifndef GSLAM_VOCABULARY_DETAIL_MAPPED_FILE_H
#define GSLAM_VOCABULARY_DETAIL_MAPPED_FILE_H

#include <gslam/base/error.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#if defined(__unix__) || defined(__APPLE__)
#define GSLAM_DETAIL_HAS_MMAP 1
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#else
#define GSLAM_DETAIL_HAS_MMAP 0
#endif

namespace gslam {
inline namespace v1 {
namespace detail {

// Read only. On systems without mmap the file is read into memory.
class MappedFile {
 public:
  MappedFile() = default;
  // Throws FileError. An empty file has no data.
  explicit MappedFile(const std::string& path);
  MappedFile(MappedFile&& other) noexcept { swap(other); }
  MappedFile& operator=(MappedFile&& other) noexcept {
    swap(other);
    return *this;
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  const void* data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }

 private:
  void swap(MappedFile& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  void* data_ = nullptr;
  std::size_t size_ = 0;
};

#if GSLAM_DETAIL_HAS_MMAP

inline MappedFile::MappedFile(const std::string& path) {
  // A pipe must not wait for somebody who writes; for files the flag means nothing.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw FileError(path, "cannot be opened", errno);
  struct stat facts;
  const bool is_known = ::fstat(file, &facts) == 0;
  const bool is_file = is_known && S_ISREG(facts.st_mode);
  int problem = is_known ? 0 : errno;
  if (is_file && facts.st_size > 0) {
    void* const memory =
        ::mmap(nullptr, static_cast<std::size_t>(facts.st_size), PROT_READ, MAP_SHARED, file, 0);
    if (memory == MAP_FAILED) {
      problem = errno;
    } else {
      data_ = memory;
      size_ = static_cast<std::size_t>(facts.st_size);
    }
  }
  ::close(file);
  if (problem != 0) throw FileError(path, "cannot be read", problem);
  if (!is_file) throw FileError(path, "is no file");
}

inline MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

#else

inline MappedFile::MappedFile(const std::string& path) {
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) throw FileError(path, "cannot be opened", errno);
  std::string bytes;
  char piece[65536];
  while (const std::size_t count = std::fread(piece, 1, sizeof piece, file.get())) {
    bytes.append(piece, count);
  }
  if (std::ferror(file.get()) != 0) throw FileError(path, "cannot be read", errno);
  if (bytes.empty()) return;
  data_ = new char[bytes.size()];
  size_ = bytes.copy(static_cast<char*>(data_), bytes.size());
}

inline MappedFile::~MappedFile() {
  delete[] static_cast<char*>(data_);
}

#endif

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_MAPPED_FILE_H
