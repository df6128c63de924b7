// The last blocks that were unpacked.
#ifndef GSLAM_DATASETS_ROS_SRC_BYTES_BLOCK_CACHE_H
#define GSLAM_DATASETS_ROS_SRC_BYTES_BLOCK_CACHE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace ros {

/// Keeps a few unpacked blocks, for messages that are read one after another. Threads may share
/// one: a block that two want is unpacked once, and different blocks at the same time.
class BlockCache {
 public:
  using Block = std::shared_ptr<const std::vector<std::uint8_t>>;

  /// The block at an offset; `unpack()` gives it where it is not there.
  template <class Unpack>
  Block get(std::uint64_t offset, const Unpack& unpack) {
    const std::shared_ptr<Slot> slot = slotOf(offset);
    const std::lock_guard<std::mutex> lock(slot->mutex);
    if (!slot->block) slot->block = std::make_shared<const std::vector<std::uint8_t>>(unpack());
    return slot->block;
  }

 private:
  static constexpr std::size_t kBlocks = 6;  // threads that load, and some for the other topics

  struct Slot {
    std::uint64_t offset = 0;
    std::mutex mutex;
    Block block;
  };

  std::shared_ptr<Slot> slotOf(std::uint64_t offset) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found =
        std::find_if(slots_.begin(), slots_.end(),
                     [&](const std::shared_ptr<Slot>& slot) { return slot->offset == offset; });
    if (found != slots_.end()) {
      slots_.splice(slots_.begin(), slots_, found);
      return slots_.front();
    }
    if (slots_.size() == kBlocks) slots_.pop_back();
    slots_.push_front(std::make_shared<Slot>());
    slots_.front()->offset = offset;
    return slots_.front();
  }

  std::mutex mutex_;
  std::list<std::shared_ptr<Slot>> slots_;  // the last one that was asked for first
};

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_BYTES_BLOCK_CACHE_H
