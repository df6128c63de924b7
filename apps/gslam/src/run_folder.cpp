#include "run_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace app {

namespace fs = std::filesystem;

void RunFolder::prepare() const {
  std::error_code error;
  fs::create_directories(path_, error);
  std::error_code ignored;
  if (fs::exists(path_, ignored) && !fs::is_directory(path_, ignored)) {
    throw gslam::FileError(path_, "is no folder");
  }
  if (error) throw gslam::FileError(path_, "cannot be made", error.value());
  if (access(path_.c_str(), W_OK | X_OK) != 0) {
    throw gslam::FileError(path_, "cannot be written to", errno);
  }
  clear();
}

void RunFolder::clear(int first_repeat) const {
  for (const std::string& file :
       {trajectory(), final(), truth(), frames(), map(), report(), metrics()}) {
    if (std::remove(file.c_str()) != 0 && errno != ENOENT) {
      throw gslam::FileError(file, "of a run before cannot be removed", errno);
    }
  }
  for (int number = first_repeat; fs::is_directory(repeat(number).path()); ++number) {
    repeat(number).clear();
    std::error_code error;
    fs::remove(repeat(number).path(), error);  // unless something else is in it
  }
}

LineFile::LineFile(const std::string& path)
    : path_(path),
      file_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_ < 0) throw gslam::FileError(path, "cannot be written", errno);
}

LineFile::~LineFile() {
  close(file_);
}

void LineFile::append(const std::string& lines) noexcept {
  for (std::size_t done = 0; done < lines.size() && error_ == 0;) {
    const ssize_t size = write(file_, lines.data() + done, lines.size() - done);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) {
      error_ = errno;
    } else {
      done += std::size_t(size);
    }
  }
}

void LineFile::check() const {
  if (error_ != 0) throw gslam::FileError(path_, "cannot be written", error_);
}

}  // namespace app
