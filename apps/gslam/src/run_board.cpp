#include "run_board.h"

#include <fcntl.h>
#include <gslam/base/error.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <new>

namespace app {
namespace {

// Of several processes, so no lock may be inside.
static_assert(std::atomic<std::uint64_t>::is_always_lock_free &&
                  std::atomic<RunPhase>::is_always_lock_free &&
                  std::atomic<bool>::is_always_lock_free,
              "the board is shared by processes");

void* mapped(int file) {
  void* const memory = mmap(nullptr, sizeof(RunBoard), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) {
    close(file);
    throw gslam::FileError("shared memory", "cannot be mapped", errno);
  }
  return memory;
}

}  // namespace

void RunBoard::enter(RunPhase next) noexcept {
  since = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  phase = next;
}

SharedBoard::SharedBoard() : file_(memfd_create("gslam run", MFD_CLOEXEC)) {
  if (file_ < 0 || ftruncate(file_, sizeof(RunBoard)) != 0) {
    const int error = errno;
    if (file_ >= 0) close(file_);
    throw gslam::FileError("shared memory", "cannot be made", error);
  }
  board_ = new (mapped(file_)) RunBoard;
}

SharedBoard::SharedBoard(int file) : file_(file) {
  struct stat facts = {};
  if (fstat(file, &facts) != 0 || facts.st_size != sizeof(RunBoard)) {
    throw gslam::Error("this is for `gslam run`, not to be typed");
  }
  fcntl(file, F_SETFD, FD_CLOEXEC);
  board_ = static_cast<RunBoard*>(mapped(file));
}

SharedBoard::~SharedBoard() {
  munmap(board_, sizeof(RunBoard));
  close(file_);
}

}  // namespace app
