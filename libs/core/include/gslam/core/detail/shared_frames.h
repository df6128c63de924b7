// The pixels of frames in memory that two processes share.
//
// The memory is cut into slots, one for a frame. A slot begins with a word that its writer sets to
// 1 and its reader to 0 when the last image of the frame is gone: so a SLAM system may keep frames
// as long as it likes, and nothing is asked or answered. Slots are made as they are needed.
#ifndef GSLAM_CORE_DETAIL_SHARED_FRAMES_H
#define GSLAM_CORE_DETAIL_SHARED_FRAMES_H

#include <gslam/base/error.h>
#include <gslam/core/detail/child_process.h>
#include <gslam/core/detail/isolation_messages.h>
#include <gslam/core/frame.h>
#include <gslam/core/image.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

#if GSLAM_DETAIL_HAS_ISOLATION

static_assert(ATOMIC_INT_LOCK_FREE == 2, "the word of a slot is shared by processes");
using SlotWord = std::atomic<std::uint32_t>;

constexpr std::uint64_t kSlotHead = 64;  // pixels begin at a cache line, as they do in an Image

inline std::uint64_t roundedUp(std::uint64_t size, std::uint64_t step) noexcept {
  return (size + step - 1) / step * step;
}

// A size with few values, at most an eighth above what is needed, so that slots of frames whose
// sizes change are used again.
inline std::uint64_t slotSize(std::uint64_t needed, std::uint64_t page) noexcept {
  std::uint64_t step = page;
  while (step * 16 <= needed) step *= 2;
  return roundedUp(needed, step);
}

// The host's side: writes frames.
class FrameWriter {
 public:
  FrameWriter() : memory_(sharedMemory()), page_(pageSize()) {}

  const FileHandle& memory() const noexcept { return memory_; }
  // Bytes of all slots.
  std::uint64_t size() const noexcept { return end_; }

  // Copies the pixels of a frame into a slot that is free, which is taken then.
  // @param images  result: where they are
  SharedSlot write(const Frame& frame, std::vector<SharedImage>& images) {
    images.assign(frame.images.size(), SharedImage());
    std::uint64_t size = kSlotHead;
    for (std::size_t i = 0; i < images.size(); ++i)
      size = place(frame.images[i].image, size, images[i]);
    if (size == kSlotHead) return SharedSlot();
    const Slot& slot = freeSlot(size);
    for (std::size_t i = 0; i < images.size(); ++i) {
      copy(frame.images[i].image, images[i], slot.pages->data() + images[i].offset);
    }
    wordOf(slot).store(1, std::memory_order_release);
    return slot.where;
  }

  // Gives a slot back that nobody will read.
  void release(const SharedSlot& where) noexcept {
    for (const Slot& slot : slots_) {
      if (slot.where.offset == where.offset && where.size != 0) wordOf(slot).store(0);
    }
  }

 private:
  struct Slot {
    SharedSlot where;
    std::unique_ptr<MappedMemory> pages;
  };

  static SlotWord& wordOf(const Slot& slot) noexcept {
    return *reinterpret_cast<SlotWord*>(slot.pages->data());
  }

  // Says where an image goes, and returns where the next one may begin.
  static std::uint64_t place(const Image& image, std::uint64_t begin, SharedImage& placed) {
    placed.offset = begin;
    placed.width = image.width();
    placed.height = image.height();
    placed.channels = std::uint32_t(image.channels());
    placed.type = image.type();
    placed.stride = image.rowBytes();
    return roundedUp(begin + placed.stride * std::uint64_t(image.height()), kSlotHead);
  }

  static void copy(const Image& image, const SharedImage& placed, unsigned char* to) {
    const std::size_t row = image.rowBytes();
    if (image.empty()) return;
    if (image.isDense()) {
      std::memcpy(to, image.bytes(), row * std::size_t(image.height()));
      return;
    }
    for (int y = 0; y < image.height(); ++y) {
      std::memcpy(to + placed.stride * std::size_t(y), image.bytes(y), row);
    }
  }

  // The smallest that is free and large enough, or a new one.
  const Slot& freeSlot(std::uint64_t size) {
    const Slot* best = nullptr;
    for (const Slot& slot : slots_) {
      if (slot.where.size < size || wordOf(slot).load(std::memory_order_acquire) != 0) continue;
      if (best == nullptr || slot.where.size < best->where.size) best = &slot;
    }
    return best != nullptr ? *best : addSlot(slotSize(size, page_));
  }

  const Slot& addSlot(std::uint64_t size) {
    Slot slot;
    slot.where.offset = end_;
    slot.where.size = size;
    growMemory(memory_, end_, size);
    slot.pages.reset(new MappedMemory(memory_.get(), end_, size));
    new (slot.pages->data()) SlotWord(0);
    slots_.push_back(std::move(slot));
    end_ += size;
    return slots_.back();
  }

  FileHandle memory_;
  std::uint64_t page_;
  std::uint64_t end_ = 0;
  std::vector<Slot> slots_;
};

// The child's side: makes images of what is there.
class FrameReader {
 public:
  explicit FrameReader(int memory) : memory_(memory) {}

  // Gives a frame its pixels.
  void attach(const SharedSlot& slot, const std::vector<SharedImage>& images, Frame& frame) {
    const std::shared_ptr<void> lease = slot.size != 0 ? leaseOf(slot) : nullptr;
    unsigned char* const begin = static_cast<unsigned char*>(lease.get());
    for (std::size_t i = 0; i < images.size(); ++i) {
      const SharedImage& one = images[i];
      frame.images[i].image = one.height == 0
                                  ? Image(0, 0, one.type, int(one.channels))
                                  : Image::wrap(begin + one.offset, one.width, one.height, one.type,
                                                int(one.channels), std::size_t(one.stride), lease);
    }
  }

 private:
  // The slot, which is free when the last copy of this is gone, in whatever thread.
  std::shared_ptr<void> leaseOf(const SharedSlot& slot) {
    const std::shared_ptr<MappedMemory> pages = pagesOf(slot);
    SlotWord* const word = reinterpret_cast<SlotWord*>(pages->data());
    return std::shared_ptr<void>(
        pages->data(), [pages, word](void*) { word->store(0, std::memory_order_release); });
  }

  std::shared_ptr<MappedMemory> pagesOf(const SharedSlot& slot) {
    std::shared_ptr<MappedMemory>& pages = pages_[slot.offset];
    if (!pages) pages = std::make_shared<MappedMemory>(memory_, slot.offset, slot.size);
    return pages;
  }

  int memory_;
  std::map<std::uint64_t, std::shared_ptr<MappedMemory>> pages_;
};

#endif  // GSLAM_DETAIL_HAS_ISOLATION

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_SHARED_FRAMES_H
