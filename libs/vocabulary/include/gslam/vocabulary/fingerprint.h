#ifndef GSLAM_VOCABULARY_FINGERPRINT_H
#define GSLAM_VOCABULARY_FINGERPRINT_H

#include <gslam/base/detail/checksum.h>
#include <gslam/base/detail/little_endian.h>
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

// Folds lists of numbers into one number, piece by piece; the same with every order of bytes.
class Fingerprint {
 public:
  // What a function says of 0, 1, 2..., whose bits are an Unsigned.
  template <class Unsigned, class Function>
  void addEach(std::size_t count, const Function& number_of) {
    std::uint8_t bytes[1024 * sizeof(Unsigned)];
    for (std::size_t begin = 0; begin < count;) {
      const std::size_t piece = std::min<std::size_t>(1024, count - begin);
      for (std::size_t i = 0; i < piece; ++i) {
        const auto number = number_of(begin + i);
        static_assert(sizeof number == sizeof(Unsigned), "bits of a number");
        Unsigned bits;
        std::memcpy(&bits, &number, sizeof bits);
        storeLittle(bytes + i * sizeof bits, bits);
      }
      addPiece(bytes, piece * sizeof(Unsigned));
      begin += piece;
    }
  }
  // Numbers in memory.
  template <class Unsigned>
  void addAll(const std::uint8_t* numbers, std::size_t count) {
    addEach<Unsigned>(count, [numbers](std::size_t i) {
      Unsigned bits;
      std::memcpy(&bits, numbers + i * sizeof bits, sizeof bits);
      return bits;
    });
  }
  // Never 0.
  std::uint64_t value() const {
    const std::uint64_t sum = Xxh64::of(sums_.data(), sums_.size());
    return sum == 0 ? 1 : sum;
  }

 private:
  void addPiece(const std::uint8_t* bytes, std::size_t size) {
    sums_.resize(sums_.size() + 8);
    storeLittle(&sums_[sums_.size() - 8], Xxh64::of(bytes, size));
  }

  std::vector<std::uint8_t> sums_;
};

}  // namespace detail

/// A number that is the same for vocabularies that give the same words, nodes and weights to
/// descriptors, and most surely another for others; never 0. How bags are compared
/// (Vocabulary::scoring()) is no part of it, nor is the file that the vocabulary came from.
/// Reads the whole tree. The same on all machines.
inline std::uint64_t fingerprint(const Vocabulary& vocabulary) {
  const detail::TreeView& tree = vocabulary.tree();
  detail::Fingerprint sum;
  const std::uint32_t facts[] = {static_cast<std::uint32_t>(tree.format.type),
                                 static_cast<std::uint32_t>(tree.format.size),
                                 static_cast<std::uint32_t>(tree.weighting),
                                 tree.depth,  // the levels of features hang on it
                                 tree.node_count,
                                 tree.word_count};
  sum.addEach<std::uint32_t>(6, [&](std::size_t i) { return facts[i]; });
  const float steps[] = {tree.format.scale, tree.format.offset};
  sum.addEach<std::uint32_t>(2, [&](std::size_t i) { return steps[i]; });
  const std::size_t bytes = tree.node_count * tree.stride;
  if (tree.format.type == DescriptorType::float32) {
    sum.addAll<std::uint32_t>(tree.descriptors, bytes / 4);
  } else if (tree.format.type == DescriptorType::float16) {
    sum.addAll<std::uint16_t>(tree.descriptors, bytes / 2);
  } else {
    sum.addAll<std::uint8_t>(tree.descriptors, bytes);
  }
  sum.addEach<std::uint32_t>(tree.node_count, [&](std::size_t i) { return tree.links[i]; });
  sum.addAll<std::uint8_t>(tree.child_counts, tree.node_count);
  sum.addEach<std::uint64_t>(tree.word_count, [&](std::size_t i) {
    return detail::weightOf(tree, static_cast<std::uint32_t>(i));
  });
  sum.addEach<std::uint32_t>(tree.node_count, [&](std::size_t i) {
    return detail::nodeId(tree, static_cast<std::uint32_t>(i));
  });
  return sum.value();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_FINGERPRINT_H
