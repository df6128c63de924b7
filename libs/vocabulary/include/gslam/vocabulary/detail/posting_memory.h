// The memory of inverted lists: blocks that are never moved, so that they are read while others are
// made.
#ifndef GSLAM_VOCABULARY_DETAIL_POSTING_MEMORY_H
#define GSLAM_VOCABULARY_DETAIL_POSTING_MEMORY_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace gslam {
inline namespace v1 {
namespace detail {

// The head of a block of a word's list. Behind it lie `capacity` values, and then as many numbers
// of entries, which ascend. The list goes on with the block before: entries there are older.
struct PostingBlock {
  std::atomic<std::uint16_t> size;  // what is behind it is not read
  std::uint16_t capacity;
  std::uint32_t older;  // its place; 0: none

  double* values() noexcept { return reinterpret_cast<double*>(this + 1); }
  const double* values() const noexcept { return reinterpret_cast<const double*>(this + 1); }
  std::uint16_t* entries() noexcept {
    return reinterpret_cast<std::uint16_t*>(values() + capacity);
  }
  const std::uint16_t* entries() const noexcept {
    return reinterpret_cast<const std::uint16_t*>(values() + capacity);
  }
};
static_assert(sizeof(PostingBlock) == 8, "values follow it");

// Places are counted in cache lines. The first block of a word is one line, which holds five
// entries; each further one is twice as large.
//
// One thread makes blocks. Others may read those whose places they were told.
class PostingMemory {
 public:
  static constexpr std::size_t kLine = 64;
  enum : unsigned { kMostLines = 32 };  // of a block: 204 entries; needs no definition in C++11

  // Whether so many blocks of any size can be made.
  bool hasRoomFor(std::size_t blocks) const noexcept {
    return blocks <= (kMost - used_) / kMostLines;
  }

  // Nothing changes where this throws.
  std::uint32_t make(std::uint32_t older) {
    const unsigned lines = older == 0 ? 1 : std::min<unsigned>(kMostLines, 2 * linesOf(*at(older)));
    if (chunks_ == 0 || sizeOf(chunks_ - 1) - end_ < lines) addChunk();
    const std::uint32_t place = static_cast<std::uint32_t>((chunks_ - 1) << kOffsetBits | end_);
    PostingBlock* const block = new (bytesAt(place)) PostingBlock;
    block->size.store(0, std::memory_order_relaxed);
    block->capacity = static_cast<std::uint16_t>((lines * kLine - sizeof(PostingBlock)) / 10);
    block->older = older;
    end_ += lines;
    used_ += lines;
    return place;
  }

  PostingBlock* at(std::uint32_t place) noexcept {
    return reinterpret_cast<PostingBlock*>(bytesAt(place));
  }
  const PostingBlock* at(std::uint32_t place) const noexcept {
    return reinterpret_cast<const PostingBlock*>(bytesAt(place));
  }

  std::size_t bytes() const noexcept {
    std::size_t lines = 0;
    for (std::size_t i = 0; i < chunks_; ++i) lines += sizeOf(i);
    return lines * kLine;
  }

 private:
  // A place has the number of a chunk and an offset in it. Chunks double.
  static constexpr unsigned kOffsetBits = 26;
  static constexpr std::size_t kChunks = 16;
  static constexpr std::size_t kFirstLines = 512;
  static constexpr std::size_t kMost = kFirstLines << (kChunks - 1);  // half of chunks: 1 GB

  static std::size_t sizeOf(std::size_t chunk) noexcept { return kFirstLines << chunk; }
  static unsigned linesOf(const PostingBlock& block) noexcept {
    return static_cast<unsigned>((block.capacity * 10u + 10 + sizeof(PostingBlock)) / kLine);
  }

  unsigned char* bytesAt(std::uint32_t place) const noexcept {
    const std::size_t offset = place & ((1u << kOffsetBits) - 1);
    return begins_[place >> kOffsetBits] + offset * kLine;
  }

  void addChunk() {
    const std::size_t size = sizeOf(chunks_) * kLine;
    memory_[chunks_].reset(new unsigned char[size + kLine]);
    const std::uintptr_t at = reinterpret_cast<std::uintptr_t>(memory_[chunks_].get());
    begins_[chunks_] = memory_[chunks_].get() + (kLine - at % kLine) % kLine;
    end_ = chunks_ == 0 ? 1 : 0;  // place 0 means none
    ++chunks_;
  }

  std::unique_ptr<unsigned char[]> memory_[kChunks];
  unsigned char* begins_[kChunks] = {};
  std::size_t chunks_ = 0;
  std::size_t end_ = 0;   // lines of the last chunk that are taken
  std::size_t used_ = 0;  // lines of blocks
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_POSTING_MEMORY_H
