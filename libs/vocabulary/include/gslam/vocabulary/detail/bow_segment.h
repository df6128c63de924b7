// Some thousand entries of a database and their inverted lists.
#ifndef GSLAM_VOCABULARY_DETAIL_BOW_SEGMENT_H
#define GSLAM_VOCABULARY_DETAIL_BOW_SEGMENT_H

#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/detail/posting_memory.h>
#include <gslam/vocabulary/detail/word_table.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

// What an entry is made of; it does not change.
struct BowEntry {
  BowVector bow;
  FeatureVector features;
};

// As the database numbers it.
struct BowRecord {
  std::uint64_t id = 0;
  std::shared_ptr<const BowEntry> entry;
  std::atomic<bool> is_erased{false};
};

// What a query adds up for an entry.
struct BowSum {
  double sum;
  std::uint32_t common_words;
};

// The words of a query with their values, and what Term::own() says of each (where it says any).
struct BowQuery {
  const BowVector* bow;
  const double* own;
};

// Says to the processor that memory will be read.
inline void prefetch(const void* memory) noexcept {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(memory);
#else
  static_cast<void>(memory);
#endif
}

// Entries are numbered from 0, in the order of their ids. One thread adds and erases; others may
// read what WordTable::entries() says that is there, meanwhile.
class BowSegment {
 public:
  static constexpr std::uint32_t kMostEntries = 8192;

  bool isFull() const noexcept { return count_ == kMostEntries; }
  bool hasRoomFor(std::size_t words) const noexcept {
    return count_ == 0 || (!isFull() && memory_.hasRoomFor(words));
  }
  std::uint32_t count() const noexcept { return count_; }  // with those that were erased
  std::uint32_t live() const noexcept { return live_; }    // without
  std::size_t postingBytes() const noexcept { return memory_.bytes(); }

  const BowRecord& record(std::uint32_t number) const noexcept {
    return records_[number / kPage][number % kPage];
  }
  BowRecord& record(std::uint32_t number) noexcept {
    return records_[number / kPage][number % kPage];
  }

  // The first of `count` entries whose id is not below.
  std::uint32_t lowerBound(std::uint64_t id, std::uint32_t count) const noexcept {
    std::uint32_t first = 0;
    while (count != 0) {
      const std::uint32_t half = count / 2;
      const bool is_below = record(first + half).id < id;
      first = is_below ? first + half + 1 : first;
      count = is_below ? count - half - 1 : half;
    }
    return first;
  }

  // The table must have room for its words. Where memory runs out, an entry that was erased
  // remains.
  void add(std::uint64_t id, std::shared_ptr<const BowEntry> entry, WordTable& table) {
    if (count_ % kPage == 0) records_[count_ / kPage].reset(new BowRecord[kPage]);
    BowRecord& added = record(count_);
    added.id = id;
    try {
      const BowVector& bow = entry->bow;
      for (std::size_t i = 0; i < bow.size(); ++i) addPosting(bow.words[i], bow.values[i], table);
    } catch (...) {
      added.is_erased.store(true, std::memory_order_relaxed);
      table.setEntries(++count_);
      throw;
    }
    added.entry = std::move(entry);
    ++live_;
    table.setEntries(++count_);
  }

  // Whether it was there.
  bool erase(std::uint32_t number) noexcept {
    if (record(number).is_erased.exchange(true, std::memory_order_acq_rel)) return false;
    --live_;
    return true;
  }

  // Adds what common words count to the sums of the entries below `limit`.
  template <class Term>
  void addUp(const WordTable& table, const BowQuery& query, std::uint32_t limit,
             BowSum* sums) const noexcept {
    const std::uint32_t* const words = query.bow->words.data();
    const std::size_t size = query.bow->size();
    std::uint32_t places[kAhead];
    double values[kAhead];
    for (std::size_t begin = 0; begin < size; begin += kAhead) {
      const std::size_t count = std::min<std::size_t>(kAhead, size - begin);
      if (begin == 0) prefetchSlots(table, words, count);
      for (std::size_t i = 0; i < count; ++i) {
        places[i] = table.find(words[begin + i], values[i]);
        if (isList(places[i])) prefetch(memory_.at(places[i]));
      }
      prefetchSlots(table, words + begin + count,
                    std::min<std::size_t>(kAhead, size - begin - count));
      for (std::size_t i = 0; i < count; ++i) {
        if (isList(places[i])) prefetchMore(places[i]);
      }
      for (std::size_t i = 0; i < count; ++i) {
        if (places[i] == 0) continue;
        const double own = Term::kHasOwn ? query.own[begin + i] : 0;
        const double value = query.bow->values[begin + i];
        if (isList(places[i])) {
          addList<Term>(places[i], value, own, limit, sums);
        } else {
          const std::uint32_t entry = places[i] & ~WordSlot::kOneEntry;
          if (entry < limit) addOne<Term>(value, own, values[i], sums[entry]);
        }
      }
    }
  }

 private:
  static constexpr std::uint32_t kPage = 256;
  // Words whose lists are fetched together; needs no definition in C++11.
  enum : std::size_t { kAhead = 32 };

  static void prefetchSlots(const WordTable& table, const std::uint32_t* words,
                            std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) prefetch(table.firstSlot(words[i]));
  }

  static bool isList(std::uint32_t place) noexcept {
    return place != 0 && (place & WordSlot::kOneEntry) == 0;
  }
  void prefetchMore(std::uint32_t place) const noexcept {
    const PostingBlock* const block = memory_.at(place);
    prefetch(block->entries());
    if (block->older != 0) prefetch(memory_.at(block->older));
  }

  void addPosting(std::uint32_t word, double value, WordTable& table) {
    double first_value = 0;
    const std::uint32_t place = table.find(word, first_value);
    if (place == 0) {
      table.add(word, count_, value);
    } else if (!isList(place)) {
      const std::uint32_t list = memory_.make(0);
      write(list, 0, place & ~WordSlot::kOneEntry, first_value);
      write(list, 1, count_, value);
      table.set(word, list);
    } else if (sizeOf(place) < memory_.at(place)->capacity) {
      write(place, sizeOf(place), count_, value);
    } else {
      const std::uint32_t next = memory_.make(place);
      write(next, 0, count_, value);
      table.set(word, next);
    }
  }
  std::uint16_t sizeOf(std::uint32_t place) const noexcept {
    return memory_.at(place)->size.load(std::memory_order_relaxed);
  }
  void write(std::uint32_t place, std::uint16_t size, std::uint32_t entry, double value) noexcept {
    PostingBlock* const block = memory_.at(place);
    block->values()[size] = value;
    block->entries()[size] = static_cast<std::uint16_t>(entry);
    block->size.store(static_cast<std::uint16_t>(size + 1), std::memory_order_release);
  }

  template <class Term>
  static void addOne(double value, double own, double entry_value, BowSum& sum) noexcept {
    sum.sum += Term::common(value, own, entry_value);
    ++sum.common_words;
  }
  template <class Term>
  void addList(std::uint32_t place, double value, double own, std::uint32_t limit,
               BowSum* sums) const noexcept {
    for (; place != 0; place = memory_.at(place)->older) {
      const PostingBlock* const block = memory_.at(place);
      if (block->older != 0) prefetchMore(block->older);
      const std::size_t size = block->size.load(std::memory_order_acquire);
      const double* const values = block->values();
      const std::uint16_t* const entries = block->entries();
      for (std::size_t i = 0; i < size && entries[i] < limit; ++i) {
        addOne<Term>(value, own, values[i], sums[entries[i]]);
      }
    }
  }

  PostingMemory memory_;
  std::unique_ptr<BowRecord[]> records_[kMostEntries / kPage];
  std::uint32_t count_ = 0;
  std::uint32_t live_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_BOW_SEGMENT_H
