// Chunks by number, which copies share until one of them writes.
#ifndef GSLAM_CORE_DETAIL_PAGED_TABLE_H
#define GSLAM_CORE_DETAIL_PAGED_TABLE_H

#include <gslam/core/detail/cow.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::uint32_t kChunkBits = 8;                // ids in a chunk: what one write copies
constexpr std::uint32_t kChunkSize = 1 << kChunkBits;  // at most, after a snapshot
constexpr std::uint32_t kPageSize = 256;               // chunks in a page

// Pages of chunks. A copy copies the pointers to pages: 16 for 1e6 ids.
template <class Chunk>
class PagedTable {
 public:
  // Null where there is none.
  const Chunk* find(std::uint32_t number) const noexcept {
    const std::size_t page = number / kPageSize;
    const Page* const found = page < pages_.size() ? pages_[page].get() : nullptr;
    return found == nullptr ? nullptr : found->chunks[number % kPageSize].get();
  }

  // For its owner alone; makes one where there is none.
  Chunk& edit(std::uint32_t number, CowOwner& owner) {
    const std::size_t page = number / kPageSize;
    if (page >= pages_.size()) pages_.resize(page + 1);
    return pages_[page].edit(owner).chunks[number % kPageSize].edit(owner);
  }

  void erase(std::uint32_t number, CowOwner& owner) {
    if (find(number) == nullptr) return;
    Page& page = pages_[number / kPageSize].edit(owner);
    page.chunks[number % kPageSize].reset();
    for (const Cow<Chunk>& chunk : page.chunks) {
      if (chunk.get() != nullptr) return;
    }
    pages_[number / kPageSize].reset();
  }

  // The first number from `number` on that has a chunk; endNumber() where there is none.
  std::uint32_t next(std::uint32_t number) const noexcept {
    const std::uint32_t end = endNumber();
    while (number < end) {
      if (pages_[number / kPageSize].get() == nullptr) {
        number = (number / kPageSize + 1) * kPageSize;
      } else if (find(number) == nullptr) {
        ++number;
      } else {
        return number;
      }
    }
    return end;
  }

  std::uint32_t endNumber() const noexcept {
    return static_cast<std::uint32_t>(pages_.size()) * kPageSize;
  }

 private:
  friend struct MapLayout;

  struct Page {
    Cow<Chunk> chunks[kPageSize];
  };

  std::vector<Cow<Page>> pages_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_PAGED_TABLE_H
