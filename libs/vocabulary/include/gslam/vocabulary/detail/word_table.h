// Where the list of a word begins.
#ifndef GSLAM_VOCABULARY_DETAIL_WORD_TABLE_H
#define GSLAM_VOCABULARY_DETAIL_WORD_TABLE_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace gslam {
inline namespace v1 {
namespace detail {

// A hash table from words to places, which are not 0: a vocabulary may have millions of words of
// which few are there. Its size is fixed. One thread changes it; others may search meanwhile.
class WordTable {
 public:
  // Of so many words at most, which fill five of eight slots.
  explicit WordTable(std::size_t words) {
    unsigned bits = 10;
    while ((std::size_t(1) << bits) / 8 * 5 < words) ++bits;
    mask_ = (std::size_t(1) << bits) - 1;
    shift_ = 64 - bits;
    slots_.reset(new std::atomic<std::uint64_t>[mask_ + 1]);
    for (std::size_t i = 0; i <= mask_; ++i) slots_[i].store(0, std::memory_order_relaxed);
  }
  // A larger one with the same content.
  WordTable(const WordTable& other, std::size_t words) : WordTable(words) {
    entries_.store(other.entries(), std::memory_order_relaxed);
    for (std::size_t i = 0; i <= other.mask_; ++i) {
      const std::uint64_t slot = other.slots_[i].load(std::memory_order_relaxed);
      if (slot != 0) set(static_cast<std::uint32_t>(slot >> 32), static_cast<std::uint32_t>(slot));
    }
  }

  bool hasRoomFor(std::size_t words) const noexcept { return used_ + words <= (mask_ + 1) / 8 * 5; }
  std::size_t used() const noexcept { return used_; }
  std::size_t bytes() const noexcept { return (mask_ + 1) * sizeof(std::uint64_t); }

  // 0 for a word that is not there.
  std::uint32_t find(std::uint32_t word) const noexcept {
    const std::uint64_t slot = slots_[slotOf(word)].load(std::memory_order_acquire);
    return slot >> 32 == word ? static_cast<std::uint32_t>(slot) : 0;
  }
  // There must be room for one that is new.
  void set(std::uint32_t word, std::uint32_t place) noexcept {
    const std::size_t i = slotOf(word);
    if (slots_[i].load(std::memory_order_relaxed) == 0) ++used_;
    slots_[i].store(std::uint64_t(word) << 32 | place, std::memory_order_release);
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
  std::size_t hashOf(std::uint32_t word) const noexcept {
    return static_cast<std::size_t>(word * 0x9E3779B97F4A7C15u >> shift_);
  }
  // Its own, or the free one that it would get.
  std::size_t slotOf(std::uint32_t word) const noexcept {
    std::size_t i = hashOf(word);
    for (;; i = (i + 1) & mask_) {
      const std::uint64_t slot = slots_[i].load(std::memory_order_relaxed);
      if (slot == 0 || slot >> 32 == word) return i;
    }
  }

  std::size_t mask_;
  unsigned shift_;
  std::unique_ptr<std::atomic<std::uint64_t>[]> slots_;
  std::size_t used_ = 0;
  std::atomic<std::uint32_t> entries_{0};
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_WORD_TABLE_H
