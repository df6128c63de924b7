// The last blocks that were unpacked.
#ifndef GSLAM_DATASETS_ROS_SRC_BYTES_BLOCK_CACHE_H
#define GSLAM_DATASETS_ROS_SRC_BYTES_BLOCK_CACHE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
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

  /// @param most  bytes that are kept, but for a single block, which may be larger
  explicit BlockCache(std::size_t most = std::size_t(256) << 20) : most_(most) {}

  /// The block at an offset; `unpack()` gives it where it is not there.
  template <class Unpack>
  Block get(std::uint64_t offset, const Unpack& unpack) {
    const std::shared_ptr<Slot> slot = slotOf(offset);
    Block block;
    {
      const std::lock_guard<std::mutex> lock(slot->mutex);
      if (slot->block) return slot->block;
      block = slot->block = std::make_shared<const std::vector<std::uint8_t>>(unpack());
    }
    makeRoom(slot, block->size());
    return block;
  }

  /// Bytes of all blocks that are kept.
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return size_;
  }

 private:
  static constexpr std::size_t kBlocks = 6;  // threads that load, and some for the other topics

  struct Slot {
    std::uint64_t offset = 0;
    std::mutex mutex;  // of the block
    Block block;
    std::size_t size = 0;  // of the block, once it counts
    bool is_kept = true;
  };
  using Slots = std::list<std::shared_ptr<Slot>>;

  std::shared_ptr<Slot> slotOf(std::uint64_t offset) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found =
        std::find_if(slots_.begin(), slots_.end(),
                     [&](const std::shared_ptr<Slot>& slot) { return slot->offset == offset; });
    if (found != slots_.end()) {
      slots_.splice(slots_.begin(), slots_, found);
      return slots_.front();
    }
    if (slots_.size() == kBlocks) drop(std::prev(slots_.end()));
    slots_.push_front(std::make_shared<Slot>());
    slots_.front()->offset = offset;
    return slots_.front();
  }

  // Counts a block that was unpacked, and lets go of those that were not asked for longest.
  void makeRoom(const std::shared_ptr<Slot>& slot, std::size_t size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!slot->is_kept) return;
    slot->size = size;
    size_ += size;
    for (auto last = slots_.end(); size_ > most_ && last != slots_.begin();) {
      --last;
      if (*last != slot && (*last)->size > 0) last = drop(last);
    }
  }

  Slots::iterator drop(Slots::iterator slot) {
    size_ -= (*slot)->size;
    (*slot)->is_kept = false;
    return slots_.erase(slot);
  }

  std::size_t most_;
  mutable std::mutex mutex_;
  Slots slots_;  // the last one that was asked for first
  std::size_t size_ = 0;
};

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_BYTES_BLOCK_CACHE_H
