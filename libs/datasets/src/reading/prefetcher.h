// Loads the images of frames ahead, in several threads, and hands them out in order.
#ifndef GSLAM_DATASETS_SRC_READING_PREFETCHER_H
#define GSLAM_DATASETS_SRC_READING_PREFETCHER_H

#include <gslam/core/frame.h>

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {

/// The threads begin at the first next(). At most `ahead` frames are loaded, or being loaded, and
/// not taken; after a seek() it is one a thread at first, and twice as many with each frame that is
/// taken, so that jumping about loads little in vain (what threads load when seek() is called comes
/// on top of it). One thread at a time may use it.
class Prefetcher {
 public:
  using Images = std::vector<CameraImage>;

  /// @param count    of frames
  /// @param threads  that load; 0: next() does
  /// @param ahead    1 or more
  /// @param load     called by these threads at once
  Prefetcher(std::size_t count, int threads, int ahead, std::function<Images(std::size_t)> load);
  ~Prefetcher();
  Prefetcher(const Prefetcher&) = delete;
  Prefetcher& operator=(const Prefetcher&) = delete;

  /// The frame that next() gives; `count` behind the last one.
  std::size_t position() const noexcept { return position_; }
  /// Takes a frame, which must be there, and goes on to the next one, whatever happens.
  /// @throws what loading it threw
  Images next();
  void seek(std::size_t position);

 private:
  struct Slot {
    bool is_loaded = false;
    Images images;
    std::exception_ptr failure;
  };

  void start();
  void work();
  std::size_t firstWindow() const {
    return std::min(std::max<std::size_t>(threads_, 1), slots_.size());
  }
  Slot& slotOf(std::size_t frame) { return slots_[frame % slots_.size()]; }

  const std::size_t count_;
  const std::size_t threads_;
  const std::function<Images(std::size_t)> load_;

  std::mutex mutex_;  // guards all below
  std::condition_variable wanted_, loaded_;
  std::size_t position_ = 0;    // written by the one who uses it
  std::size_t asked_ = 0;       // the next frame that a thread takes up
  std::size_t window_;          // how many frames from position_ on may be taken up
  std::size_t generation_ = 0;  // grows with each seek(): what was asked before is not wanted
  bool stopping_ = false;
  std::vector<Slot> slots_;
  std::vector<std::thread> workers_;
};

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_PREFETCHER_H
