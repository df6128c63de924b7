// Short lists by id, which copies share until one of them writes.
#ifndef GSLAM_CORE_DETAIL_LIST_TABLE_H
#define GSLAM_CORE_DETAIL_LIST_TABLE_H

#include <gslam/base/span.h>
#include <gslam/core/detail/record_table.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// The lists of a chunk's ids, one behind the other in one block: a list costs 14 bytes beside its
// elements, and a copy of the chunk two allocations.
template <class T>
class ListChunk {
 public:
  Span<const T> list(std::uint32_t slot) const noexcept {
    const Place* const place = places_.find(slot);
    if (place == nullptr) return Span<const T>();
    return Span<const T>(pool_.data() + place->begin, place->size);
  }

  void add(std::uint32_t slot, const T& element) {
    Place* place = places_.find(slot);
    if (place == nullptr) place = &places_.insert(slot, Place{end(), 0, 0});
    if (place->size == place->capacity) grow(*place);
    pool_[place->begin + place->size++] = element;
  }

  // For a slot that has no list.
  void assign(std::uint32_t slot, Span<const T> elements) {
    if (elements.empty()) return;
    const std::uint32_t size = static_cast<std::uint32_t>(elements.size());
    reserve(size);
    places_.insert(slot, Place{end(), size, size});
    pool_.insert(pool_.end(), elements.begin(), elements.end());
  }

  // The first that is equal; the order of the others stays.
  void remove(std::uint32_t slot, const T& element) {
    Place* const place = places_.find(slot);
    if (place == nullptr) return;
    T* const first = pool_.data() + place->begin;
    T* const last = first + place->size;
    T* const found = std::find(first, last, element);
    if (found == last) return;
    std::copy(found + 1, last, found);
    if (--place->size == 0) clear(slot);
  }

  void clear(std::uint32_t slot) {
    const Place* const place = places_.find(slot);
    if (place == nullptr) return;
    waste_ += place->capacity;
    places_.erase(slot);
    if (waste_ > pool_.size() / 4) compact(0);
  }

  bool empty() const noexcept { return places_.empty(); }

 private:
  friend struct MapLayout;

  struct Place {
    std::uint32_t begin;
    std::uint32_t size;
    std::uint32_t capacity;
  };

  std::uint32_t end() const noexcept { return static_cast<std::uint32_t>(pool_.size()); }

  // Moves a list that is full to the end, with more room; in place where it is there already.
  void grow(Place& place) {
    const std::uint32_t more = std::max<std::uint32_t>(2, place.capacity / 2);
    if (waste_ + place.capacity > (pool_.size() + place.capacity + more) / 4) compact(more);
    if (place.begin + place.capacity == pool_.size()) {
      reserve(more);
      pool_.resize(pool_.size() + more);
    } else {
      const std::uint32_t begin = end();
      reserve(place.capacity + more);
      pool_.resize(pool_.size() + place.capacity + more);
      std::copy_n(pool_.begin() + place.begin, place.size, pool_.begin() + begin);
      waste_ += place.capacity;
      place.begin = begin;
    }
    place.capacity += more;
  }

  // Less ahead than std::vector would take, which is most of the memory of a map.
  void reserve(std::size_t more) {
    const std::size_t needed = pool_.size() + more;
    if (needed > pool_.capacity()) pool_.reserve(needed + needed / 8);
  }

  // Takes the gaps out.
  void compact(std::size_t more) {
    std::vector<T> pool;
    pool.reserve(pool_.size() - waste_ + more);
    for (std::uint32_t slot = places_.next(0); slot < kChunkSize; slot = places_.next(slot + 1)) {
      Place& place = *places_.find(slot);
      const auto first = pool_.begin() + place.begin;
      place.begin = static_cast<std::uint32_t>(pool.size());
      pool.insert(pool.end(), first, first + place.capacity);
    }
    pool_.swap(pool);
    waste_ = 0;
  }

  RecordChunk<Place> places_;
  std::vector<T> pool_;
  std::size_t waste_ = 0;  // elements of the pool that are in no list
};

template <class T>
class ListTable {
 public:
  // Valid until the table changes.
  Span<const T> list(std::uint32_t id) const noexcept {
    const ListChunk<T>* const chunk = chunks_.find(id / kChunkSize);
    return chunk == nullptr ? Span<const T>() : chunk->list(id % kChunkSize);
  }
  void add(std::uint32_t id, const T& element, CowOwner& owner) {
    chunks_.edit(id / kChunkSize, owner).add(id % kChunkSize, element);
  }
  // For an id that has no list.
  void assign(std::uint32_t id, Span<const T> elements, CowOwner& owner) {
    if (elements.empty()) return;
    chunks_.edit(id / kChunkSize, owner).assign(id % kChunkSize, elements);
  }
  void remove(std::uint32_t id, const T& element, CowOwner& owner) {
    if (list(id).empty()) return;
    ListChunk<T>& chunk = chunks_.edit(id / kChunkSize, owner);
    chunk.remove(id % kChunkSize, element);
    if (chunk.empty()) chunks_.erase(id / kChunkSize, owner);
  }
  void clear(std::uint32_t id, CowOwner& owner) {
    if (list(id).empty()) return;
    ListChunk<T>& chunk = chunks_.edit(id / kChunkSize, owner);
    chunk.clear(id % kChunkSize);
    if (chunk.empty()) chunks_.erase(id / kChunkSize, owner);
  }

 private:
  PagedTable<ListChunk<T>> chunks_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_LIST_TABLE_H
