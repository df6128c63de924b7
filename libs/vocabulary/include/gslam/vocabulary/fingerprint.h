#ifndef GSLAM_VOCABULARY_FINGERPRINT_H
#define GSLAM_VOCABULARY_FINGERPRINT_H

#include <gslam/base/detail/checksum.h>
#include <gslam/vocabulary/vocabulary.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

/// @file
/// A number that tells vocabularies apart, so that a database is not used with another one than it
/// was made with.

namespace gslam {
inline namespace v1 {

namespace detail {

// Folds lists of numbers into one number, piece by piece.
class Fingerprint {
 public:
  void add(const void* bytes, std::size_t size) {
    sums_.push_back(Xxh64::of(static_cast<const std::uint8_t*>(bytes), size));
  }
  // What a function says of 0, 1, 2...
  template <class Number, class Function>
  void addEach(std::uint32_t count, const Function& number_of) {
    Number numbers[1024];
    for (std::uint32_t begin = 0; begin < count;) {
      const std::uint32_t piece = std::min<std::uint32_t>(1024, count - begin);
      for (std::uint32_t i = 0; i < piece; ++i) numbers[i] = number_of(begin + i);
      add(numbers, piece * sizeof(Number));
      begin += piece;
    }
  }
  // Never 0.
  std::uint64_t value() const {
    const std::uint64_t sum = Xxh64::of(reinterpret_cast<const std::uint8_t*>(sums_.data()),
                                        sums_.size() * sizeof(std::uint64_t));
    return sum == 0 ? 1 : sum;
  }

 private:
  std::vector<std::uint64_t> sums_;
};

}  // namespace detail

/// A number that is the same for vocabularies that give the same words, nodes and weights to
/// descriptors, and most surely another for others; never 0. How bags are compared
/// (Vocabulary::scoring()) is no part of it, nor is the file that the vocabulary came from.
/// Reads the whole tree. The same on all machines with the same order of bytes.
inline std::uint64_t fingerprint(const Vocabulary& vocabulary) {
  const detail::TreeView& tree = vocabulary.tree();
  detail::Fingerprint sum;
  const std::uint32_t facts[] = {
      static_cast<std::uint32_t>(tree.format.type), static_cast<std::uint32_t>(tree.format.size),
      static_cast<std::uint32_t>(tree.weighting), tree.node_count, tree.word_count};
  sum.add(facts, sizeof facts);
  const float steps[] = {tree.format.scale, tree.format.offset};
  sum.add(steps, sizeof steps);
  sum.add(tree.descriptors, tree.node_count * tree.stride);
  sum.add(tree.links, tree.node_count * sizeof(std::uint32_t));
  sum.add(tree.child_counts, tree.node_count);
  sum.addEach<double>(tree.word_count, [&](std::uint32_t i) { return detail::weightOf(tree, i); });
  sum.addEach<std::uint32_t>(tree.node_count,
                             [&](std::uint32_t i) { return detail::nodeId(tree, i); });
  return sum.value();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_FINGERPRINT_H
