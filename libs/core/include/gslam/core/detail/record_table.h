// Records by id, which copies share until one of them writes.
#ifndef GSLAM_CORE_DETAIL_RECORD_TABLE_H
#define GSLAM_CORE_DETAIL_RECORD_TABLE_H

#include <gslam/core/detail/paged_table.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Up to kChunkSize records, without gaps in memory where ids have gaps: in a map that was cleaned
// up, most ids are gone.
template <class Record>
class RecordChunk {
 public:
  RecordChunk() noexcept { std::fill(std::begin(places_), std::end(places_), kEmpty); }

  const Record* find(std::uint32_t slot) const noexcept {
    return places_[slot] == kEmpty ? nullptr : records_.data() + places_[slot];
  }
  Record* find(std::uint32_t slot) noexcept {
    return places_[slot] == kEmpty ? nullptr : records_.data() + places_[slot];
  }

  Record& insert(std::uint32_t slot, Record record) {
    records_.push_back(std::move(record));
    places_[slot] = static_cast<std::uint16_t>(records_.size() - 1);
    return records_.back();
  }

  // The last record takes the place in memory of the one that goes.
  void erase(std::uint32_t slot) {
    const std::uint16_t place = places_[slot];
    const std::uint16_t last = static_cast<std::uint16_t>(records_.size() - 1);
    if (place != last) records_[place] = std::move(records_[last]);
    *std::find(std::begin(places_), std::end(places_), last) = place;
    places_[slot] = kEmpty;
    records_.pop_back();
  }

  // In no order.
  std::vector<Record>& records() noexcept { return records_; }

  bool empty() const noexcept { return records_.empty(); }

  // The first slot from `slot` on that is taken; kChunkSize where there is none.
  std::uint32_t next(std::uint32_t slot) const noexcept {
    while (slot < kChunkSize && places_[slot] == kEmpty) ++slot;
    return slot;
  }

 private:
  static constexpr std::uint16_t kEmpty = 0xFFFF;

  std::uint16_t places_[kChunkSize];
  std::vector<Record> records_;
};

template <class Record>
constexpr std::uint16_t RecordChunk<Record>::kEmpty;  // NOLINT(readability-redundant-declaration)

template <class Record>
class RecordTable {
 public:
  using Chunk = RecordChunk<Record>;

  // In the order of ids; valid until the table changes.
  class Iterator {
   public:
    Iterator(const PagedTable<Chunk>& chunks, std::uint32_t number)
        : chunks_(chunks), number_(number), slot_(0) {
      settle();
    }
    std::uint32_t id() const noexcept { return number_ * kChunkSize + slot_; }
    const Record& record() const noexcept { return *chunk_->find(slot_); }
    void advance() noexcept {
      slot_ = chunk_->next(slot_ + 1);
      if (slot_ < kChunkSize) return;
      slot_ = 0;
      ++number_;
      settle();
    }
    bool operator==(const Iterator& other) const noexcept {
      return number_ == other.number_ && slot_ == other.slot_;
    }

   private:
    void settle() noexcept {
      number_ = chunks_.next(number_);
      chunk_ = chunks_.find(number_);
      if (chunk_ != nullptr) slot_ = chunk_->next(0);
    }

    PagedTable<Chunk> chunks_;  // shared, so that it lives as long as it is walked through
    const Chunk* chunk_ = nullptr;
    std::uint32_t number_;
    std::uint32_t slot_;
  };

  Iterator begin() const noexcept { return Iterator(chunks_, 0); }
  Iterator end() const noexcept { return Iterator(chunks_, chunks_.endNumber()); }
  std::size_t size() const noexcept { return size_; }

  // Null where there is none; valid until the table changes.
  const Record* find(std::uint32_t id) const noexcept {
    const Chunk* const chunk = chunks_.find(id / kChunkSize);
    return chunk == nullptr ? nullptr : chunk->find(id % kChunkSize);
  }

  // For its owner alone; null where there is none.
  Record* edit(std::uint32_t id, CowOwner& owner) {
    if (find(id) == nullptr) return nullptr;
    return chunks_.edit(id / kChunkSize, owner).find(id % kChunkSize);
  }

  // Calls change(record) with each, for its owner alone.
  template <class Change>
  void editAll(CowOwner& owner, const Change& change) {
    const std::uint32_t end = chunks_.endNumber();
    for (std::uint32_t number = chunks_.next(0); number < end; number = chunks_.next(number + 1)) {
      for (Record& record : chunks_.edit(number, owner).records()) change(record);
    }
  }

  // The id must be free.
  Record& insert(std::uint32_t id, Record record, CowOwner& owner) {
    Record& inserted =
        chunks_.edit(id / kChunkSize, owner).insert(id % kChunkSize, std::move(record));
    ++size_;
    return inserted;
  }

  // Replaces or inserts.
  void set(std::uint32_t id, Record record, CowOwner& owner) {
    if (Record* const known = edit(id, owner)) {
      *known = std::move(record);
    } else {
      insert(id, std::move(record), owner);
    }
  }

  // Whether there was one.
  bool erase(std::uint32_t id, CowOwner& owner) {
    if (find(id) == nullptr) return false;
    Chunk& chunk = chunks_.edit(id / kChunkSize, owner);
    chunk.erase(id % kChunkSize);
    if (chunk.empty()) chunks_.erase(id / kChunkSize, owner);
    --size_;
    return true;
  }

 private:
  PagedTable<Chunk> chunks_;
  std::size_t size_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_RECORD_TABLE_H
