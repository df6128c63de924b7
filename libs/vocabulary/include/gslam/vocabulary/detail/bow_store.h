// The entries of a database: one thread at a time changes them, any number reads meanwhile.
#ifndef GSLAM_VOCABULARY_DETAIL_BOW_STORE_H
#define GSLAM_VOCABULARY_DETAIL_BOW_STORE_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/bow_segment.h>
#include <gslam/vocabulary/detail/word_table.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

struct BowSegmentView {
  std::shared_ptr<BowSegment> segment;
  std::shared_ptr<WordTable> table;
  std::uint64_t first_id;
};
using BowSegments = std::vector<BowSegmentView>;  // in the order of ids; the last one grows

// Readers take a view, which is whole and stays as it is, but for what is added to its last segment
// and what is erased. So they wait for nobody, except for the moment in which the pointer to it is
// copied. When a table is too small, or a segment is full or has more dead than living entries, a
// new view gets a new one; the old one lives as long as somebody reads it.
class BowStore {
 public:
  std::shared_ptr<const BowSegments> view() const {
    std::lock_guard<std::mutex> lock(view_mutex_);
    return view_;
  }
  std::size_t size() const noexcept { return size_.load(std::memory_order_acquire); }
  std::uint64_t nextId() const noexcept { return next_id_.load(std::memory_order_acquire); }

  std::uint64_t add(std::shared_ptr<const BowEntry> entry) {
    std::lock_guard<std::mutex> lock(write_mutex_);
    const std::uint64_t id = nextId();
    insert(id, std::move(entry));
    return id;
  }
  // For readers of files. The id must not be below nextId().
  void addWithId(std::uint64_t id, std::shared_ptr<const BowEntry> entry) {
    std::lock_guard<std::mutex> lock(write_mutex_);
    insert(id, std::move(entry));
  }
  void setNextId(std::uint64_t id) noexcept { next_id_.store(id, std::memory_order_release); }

  // Whether it was there.
  bool erase(std::uint64_t id) {
    std::lock_guard<std::mutex> lock(write_mutex_);
    const std::size_t i = segmentOf(*view_, id);
    if (i == view_->size()) return false;
    BowSegment& segment = *(*view_)[i].segment;
    const std::uint32_t number = segment.lowerBound(id, segment.count());
    if (number == segment.count() || segment.record(number).id != id) return false;
    if (!segment.erase(number)) return false;
    size_.fetch_sub(1, std::memory_order_acq_rel);
    const bool is_worth_it = segment.count() >= kLeastTidied || segment.live() == 0;
    if (is_worth_it && 2 * segment.live() < segment.count()) tidyIfPossible(i);
    return true;
  }

  void clear() {
    const std::shared_ptr<const BowSegments> empty = std::make_shared<BowSegments>();
    std::lock_guard<std::mutex> lock(write_mutex_);
    publish(empty);
    size_.store(0, std::memory_order_release);
  }

  // Null where there is none.
  std::shared_ptr<const BowEntry> find(std::uint64_t id) const {
    const std::shared_ptr<const BowSegments> segments = view();
    const std::size_t i = segmentOf(*segments, id);
    if (i == segments->size()) return nullptr;
    const BowSegment& segment = *(*segments)[i].segment;
    const std::uint32_t count = (*segments)[i].table->entries();
    const std::uint32_t number = segment.lowerBound(id, count);
    if (number == count || segment.record(number).id != id) return nullptr;
    const BowRecord& record = segment.record(number);
    return record.is_erased.load(std::memory_order_acquire) ? nullptr : record.entry;
  }

  // All that are there, in the order of their ids.
  std::vector<std::pair<std::uint64_t, std::shared_ptr<const BowEntry>>> entries() const {
    std::vector<std::pair<std::uint64_t, std::shared_ptr<const BowEntry>>> all;
    const std::shared_ptr<const BowSegments> segments = view();
    for (const BowSegmentView& part : *segments) {
      const std::uint32_t count = part.table->entries();
      for (std::uint32_t i = 0; i < count; ++i) {
        const BowRecord& record = part.segment->record(i);
        if (record.is_erased.load(std::memory_order_acquire)) continue;
        all.emplace_back(record.id, record.entry);
      }
    }
    return all;
  }

 private:
  // Smaller segments stay as they are until all in them are dead.
  static constexpr std::uint32_t kLeastTidied = 64;
  // Two segments are not made one where their lists have more bytes than this.
  static constexpr std::size_t kMostMergedBytes = std::size_t(1) << 28;

  // The one that would have it; the number of segments where there is none.
  static std::size_t segmentOf(const BowSegments& segments, std::uint64_t id) noexcept {
    const auto after = std::upper_bound(
        segments.begin(), segments.end(), id,
        [](std::uint64_t value, const BowSegmentView& part) { return value < part.first_id; });
    if (after == segments.begin()) return segments.size();
    return static_cast<std::size_t>(after - segments.begin()) - 1;
  }

  void publish(std::shared_ptr<const BowSegments> segments) {
    {
      std::lock_guard<std::mutex> lock(view_mutex_);
      view_.swap(segments);
    }  // the old one may be large: it goes when nobody waits for the lock
  }

  void insert(std::uint64_t id, std::shared_ptr<const BowEntry> entry) {
    const std::size_t words = entry->bow.size();
    if (id == std::numeric_limits<std::uint64_t>::max() ||
        words > PostingMemory::mostFirstBlocks()) {
      throw ArgumentError("bow", "has " + std::to_string(words) + " words and would get the id " +
                                     std::to_string(id) + ": a database has no room for it");
    }
    if (view_->empty() || !view_->back().segment->hasRoomFor(words)) {
      openSegment(id);
    }
    if (!view_->back().table->hasRoomFor(words)) growTable(words);
    const BowSegmentView& last = view_->back();
    next_id_.store(id + 1, std::memory_order_release);
    last.segment->add(id, std::move(entry), *last.table);
    size_.fetch_add(1, std::memory_order_acq_rel);
  }

  void openSegment(std::uint64_t id) {
    auto segments = std::make_shared<BowSegments>(*view_);
    segments->push_back({std::make_shared<BowSegment>(), std::make_shared<WordTable>(0), id});
    publish(std::move(segments));
  }

  static void makeRoom(BowSegmentView& part, std::size_t words) {
    if (part.table->hasRoomFor(words)) return;
    part.table = std::make_shared<WordTable>(*part.table, part.table->used() + words);
  }
  void growTable(std::size_t words) {
    auto segments = std::make_shared<BowSegments>(*view_);
    makeRoom(segments->back(), words);
    publish(std::move(segments));
  }

  // The entry is erased whether or not there is memory for this.
  void tidyIfPossible(std::size_t i) {
    try {
      auto segments = std::make_shared<BowSegments>(*view_);
      tidy(*segments, i);
      publish(std::move(segments));
    } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch): the next erase() tries again
    }
  }

  // Makes a segment that is mostly dead anew, together with its neighbours where the living are
  // few.
  static void tidy(BowSegments& segments, std::size_t i) {
    std::size_t live = segments[i].segment->live();
    const auto takes = [&](std::size_t other) {
      const BowSegment& segment = *segments[other].segment;
      if (live + segment.live() > BowSegment::kMostEntries / 2) return false;
      if (segment.postingBytes() > kMostMergedBytes) return false;
      live += segment.live();
      return true;
    };
    const bool may_merge = live != 0 && segments[i].segment->postingBytes() <= kMostMergedBytes;
    const std::size_t first = may_merge && i > 0 && takes(i - 1) ? i - 1 : i;
    const std::size_t last = may_merge && i + 1 < segments.size() && takes(i + 1) ? i + 1 : i;
    const std::size_t kept = live != 0 ? 1 : 0;
    if (kept != 0) segments[first] = livingOf(segments, first, last);
    const auto begin = segments.begin();
    segments.erase(begin + static_cast<std::ptrdiff_t>(first + kept),
                   begin + static_cast<std::ptrdiff_t>(last + 1));
  }

  static BowSegmentView livingOf(const BowSegments& segments, std::size_t first, std::size_t last) {
    BowSegmentView living = {std::make_shared<BowSegment>(), std::make_shared<WordTable>(0),
                             segments[first].first_id};
    for (std::size_t i = first; i <= last; ++i) {
      const BowSegment& segment = *segments[i].segment;
      for (std::uint32_t number = 0; number < segment.count(); ++number) {
        const BowRecord& record = segment.record(number);
        if (record.is_erased.load(std::memory_order_relaxed)) continue;
        makeRoom(living, record.entry->bow.size());
        living.segment->add(record.id, record.entry, *living.table);
      }
    }
    return living;
  }

  std::mutex write_mutex_;
  mutable std::mutex view_mutex_;
  std::shared_ptr<const BowSegments> view_ = std::make_shared<BowSegments>();
  std::atomic<std::size_t> size_{0};
  std::atomic<std::uint64_t> next_id_{0};
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_BOW_STORE_H
