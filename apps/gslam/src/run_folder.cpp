#include "run_folder.h"

#include <fcntl.h>
#include <gslam/svar/json.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace app {

namespace fs = std::filesystem;

namespace {

// Of a file alone, so not remove(), which takes empty folders as well.
void removeFile(const std::string& path) {
  if (unlink(path.c_str()) != 0 && errno != ENOENT) {
    throw gslam::FileError(path, "of a run before cannot be removed", errno);
  }
}

}  // namespace

gslam::Svar RunFolder::ownReport() const {
  try {
    if (!fs::is_regular_file(report())) return nullptr;
    const gslam::Svar found = gslam::loadJson(report());
    const bool is_own = found.type() == gslam::SvarType::object &&
                        found.get<gslam::Svar>("program", nullptr) == gslam::Svar(kRunProgram);
    return is_own ? found : gslam::Svar();
  } catch (const gslam::Error&) {
    return nullptr;
  } catch (const fs::filesystem_error&) {
    return nullptr;
  }
}

// Of repeated runs the first comes before the file of all.
bool RunFolder::isOwn() const {
  if (!ownReport().isNull()) return true;
  return std::distance(fs::directory_iterator(path_), {}) == 1 && !repeat(1).ownReport().isNull();
}

void RunFolder::check() const {
  std::error_code error;
  const fs::file_status found = fs::status(path_, error);
  if (found.type() == fs::file_type::not_found) return;
  if (!fs::is_directory(found)) throw gslam::FileError(path_, "is no folder");
  fs::directory_iterator entry(path_, error);
  if (error) throw gslam::FileError(path_, "cannot be read", error.value());
  if (entry == fs::directory_iterator() || isOwn()) return;
  throw gslam::FileError(path_, "has '" + entry->path().filename().string() +
                                    "', but no run.json of `gslam run`: results go to a folder "
                                    "that is new, empty, or has those of a run before");
}

void RunFolder::prepare() const {
  check();
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw gslam::FileError(path_, "cannot be made", error.value());
  if (access(path_.c_str(), W_OK | X_OK) != 0) {
    throw gslam::FileError(path_, "cannot be written to", errno);
  }
  clear(1);
}

void RunFolder::removeResults() const {
  for (const std::string& file : {trajectory(), final(), truth(), frames(), map(), metrics()}) {
    removeFile(file);
  }
}

void RunFolder::clear(int first_repeat) const {
  removeResults();
  for (int number = first_repeat; fs::is_directory(repeat(number).path()); ++number) {
    const RunFolder one = repeat(number);
    if (one.ownReport().isNull()) continue;
    one.removeResults();
    removeFile(one.report());
    std::error_code error;
    fs::remove(one.path(), error);  // unless something else is in it
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
