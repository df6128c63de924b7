// Where the list of a word begins.
#ifndef GSLAM_VOCABULARY_DETAIL_WORD_TABLE_H
#define GSLAM_VOCABULARY_DETAIL_WORD_TABLE_H

#include <gslam/vocabulary/detail/random.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace gslam {
inline namespace v1 {
namespace detail {

// Where a word is: in one entry, whose value stands in the table itself (most words are in few
// images), or in a list, which has a place.
struct WordSlot {
  // The word in the upper half, and in the lower one kOneEntry and the number of the entry, or the
  // place of the newest block of the list. 0: free.
  std::atomic<std::uint64_t> head{0};
  double value;  // of the one entry; it stays when there is a list

  static constexpr std::uint32_t kOneEntry = 0x80000000u;
};

// A hash table of words: a vocabulary may have millions of them, of which few are there. Its size
// is fixed. One thread changes it; others may search meanwhile.
class WordTable {
 public:
  // Of so many words at most, which fill five of eight slots.
  explicit WordTable(std::size_t words) {
    unsigned bits = 10;
    while ((std::size_t(1) << bits) / 8 * 5 < words) ++bits;
    mask_ = (std::size_t(1) << bits) - 1;
    shift_ = 64 - bits;
    slots_.reset(new WordSlot[mask_ + 1]);
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    const auto where = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(slots_.get()));
    factor_ = SplitMix64(static_cast<std::uint64_t>(now) ^ SplitMix64(where).next()).next() | 1;
  }
  // A larger one with the same content, in the same order, so that memory is written from one end
  // to the other.
  WordTable(const WordTable& other, std::size_t words) : WordTable(words) {
    factor_ = other.factor_;
    entries_.store(other.entries(), std::memory_order_relaxed);
    for (std::size_t i = 0; i <= other.mask_; ++i) {
      const std::uint64_t head = other.slots_[i].head.load(std::memory_order_relaxed);
      if (head == 0) continue;
      const auto word = static_cast<std::uint32_t>(head >> 32);
      slotOf(word).value = other.slots_[i].value;
      set(word, static_cast<std::uint32_t>(head));
    }
  }

  bool hasRoomFor(std::size_t words) const noexcept { return used_ + words <= (mask_ + 1) / 8 * 5; }
  std::size_t used() const noexcept { return used_; }

  // The lower half of the head; 0 for a word that is not there. The value is only set where it is
  // that of the one entry.
  std::uint32_t find(std::uint32_t word, double& value) const noexcept {
    std::uint64_t head;
    const WordSlot& slot = slotOf(word, head);
    if (head == 0) return 0;
    const auto where = static_cast<std::uint32_t>(head);
    if ((where & WordSlot::kOneEntry) != 0) value = slot.value;
    return where;
  }
  // A word that is new, with its first entry. There must be room.
  void add(std::uint32_t word, std::uint32_t entry, double value) noexcept {
    slotOf(word).value = value;
    set(word, WordSlot::kOneEntry | entry);
  }
  void set(std::uint32_t word, std::uint32_t where) noexcept {
    std::uint64_t head;
    WordSlot& slot = slotOf(word, head);
    if (head == 0) ++used_;
    slot.head.store(std::uint64_t(word) << 32 | where, std::memory_order_release);
  }
  // Where find() will look.
  const void* firstSlot(std::uint32_t word) const noexcept { return &slots_[hashOf(word)]; }

  // Entries of which all words are in this table: others are still being added, or were added to a
  // larger one.
  std::uint32_t entries() const noexcept { return entries_.load(std::memory_order_acquire); }
  void setEntries(std::uint32_t entries) noexcept {
    entries_.store(entries, std::memory_order_release);
  }

 private:
  // Tables have factors that nobody can foretell: else bags could be made whose words all want
  // the same slots, and a small file would take minutes.
  std::size_t hashOf(std::uint32_t word) const noexcept {
    const std::uint64_t product = word * factor_;
    return static_cast<std::size_t>((product ^ product >> 32) * 0x9E3779B97F4A7C15u >> shift_);
  }
  // Its own, or the free one that it would get; and the head that tells which.
  WordSlot& slotOf(std::uint32_t word, std::uint64_t& head) const noexcept {
    for (std::size_t i = hashOf(word);; i = (i + 1) & mask_) {
      head = slots_[i].head.load(std::memory_order_acquire);
      if (head == 0 || head >> 32 == word) return slots_[i];
    }
  }
  WordSlot& slotOf(std::uint32_t word) const noexcept {
    std::uint64_t head;
    return slotOf(word, head);
  }

  std::size_t mask_;
  unsigned shift_;
  std::uint64_t factor_;
  std::unique_ptr<WordSlot[]> slots_;
  std::size_t used_ = 0;
  std::atomic<std::uint32_t> entries_{0};
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_WORD_TABLE_H
