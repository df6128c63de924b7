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

// Pages of chunks. A copy copies one pointer; who writes first copies those to pages: 16 for 1e6
// ids.
template <class Chunk>
class PagedTable {
 public:
  // Null where there is none.
  const Chunk* find(std::uint32_t number) const noexcept {
    const Page* const page = pageOf(number);
    return page == nullptr ? nullptr : page->chunks[number % kPageSize].get();
  }

  // For its owner alone; makes one where there is none.
  Chunk& edit(std::uint32_t number, CowOwner& owner) {
    const std::size_t page = number / kPageSize;
    Pages& pages = pages_.edit(owner);
    if (page >= pages.size()) pages.resize(page + 1);
    return pages[page].edit(owner).chunks[number % kPageSize].edit(owner);
  }

  void erase(std::uint32_t number, CowOwner& owner) {
    if (find(number) == nullptr) return;
    Cow<Page>& page = pages_.edit(owner)[number / kPageSize];
    Page& edited = page.edit(owner);
    edited.chunks[number % kPageSize].reset();
    for (const Cow<Chunk>& chunk : edited.chunks) {
      if (chunk.get() != nullptr) return;
    }
    page.reset();
  }

  // The first number from `number` on that has a chunk; endNumber() where there is none.
  std::uint32_t next(std::uint32_t number) const noexcept {
    const std::uint32_t end = endNumber();
    while (number < end) {
      const Page* const page = pageOf(number);
      if (page == nullptr) {
        number = (number / kPageSize + 1) * kPageSize;
      } else if (page->chunks[number % kPageSize].get() == nullptr) {
        ++number;
      } else {
        return number;
      }
    }
    return end;
  }

  std::uint32_t endNumber() const noexcept {
    const Pages* const pages = pages_.get();
    return pages == nullptr ? 0 : static_cast<std::uint32_t>(pages->size()) * kPageSize;
  }

 private:
  friend struct MapLayout;

  struct Page {
    Cow<Chunk> chunks[kPageSize];
  };
  using Pages = std::vector<Cow<Page>>;

  const Page* pageOf(std::uint32_t number) const noexcept {
    const Pages* const pages = pages_.get();
    const std::size_t page = number / kPageSize;
    return pages != nullptr && page < pages->size() ? (*pages)[page].get() : nullptr;
  }

  Cow<Pages> pages_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_PAGED_TABLE_H
