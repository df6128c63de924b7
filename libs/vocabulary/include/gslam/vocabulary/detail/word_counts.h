// In how many images each word is, and the weights that follow.
#ifndef GSLAM_VOCABULARY_DETAIL_WORD_COUNTS_H
#define GSLAM_VOCABULARY_DETAIL_WORD_COUNTS_H

#include <gslam/base/error.h>
#include <gslam/base/parallel.h>
#include <gslam/base/span.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/descend.h>
#include <gslam/vocabulary/detail/training_rows.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/vocabulary.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// What an image of descriptors for this vocabulary has.
inline DescriptorFormat rowFormat(const Vocabulary& vocabulary) noexcept {
  DescriptorFormat format = vocabulary.format();
  if (format.type != DescriptorType::binary) format.type = DescriptorType::float32;
  return format;
}

// The leaf of each descriptor of an image, which was checked.
inline std::vector<std::uint32_t> leavesOf(const Vocabulary& vocabulary, const Descriptors& image) {
  std::vector<std::uint32_t> nodes(image.count);
  std::vector<std::uint8_t> rows;
  descend(vocabulary.tree(), image, 0, nodes.data(), nullptr, rows);
  return nodes;
}

inline bool needsFrequency(Weighting weighting) noexcept {
  return weighting == Weighting::tf_idf || weighting == Weighting::idf;
}

// In how many images each word is, where the weighting asks for it. Thread-safe.
class WordCounts {
 public:
  explicit WordCounts(const Vocabulary& vocabulary)
      : vocabulary_(vocabulary), format_(rowFormat(vocabulary)), counts_(vocabulary.wordCount()) {}

  // Throws ArgumentError when the image is not one for the vocabulary.
  void add(const Descriptors& image, std::size_t number) {
    images_.fetch_add(1, std::memory_order_relaxed);
    checkImage(image, number, format_);
    checkNumbers(image, number);
    if (!needsFrequency(vocabulary_.weighting())) return;
    std::vector<std::uint32_t> nodes = leavesOf(vocabulary_, image);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const std::uint32_t node : nodes) {
      const std::uint32_t word = wordOf(vocabulary_.tree(), node);
      if (word != kNone) counts_[word].fetch_add(1, std::memory_order_relaxed);
    }
  }

  // As DBoW2: the logarithm of how few of the images have it; 0 for a word in none.
  double inverseFrequency(std::uint32_t word) const {
    const std::uint32_t count = counts_[word].load(std::memory_order_relaxed);
    if (count == 0) return 0;
    return std::log(static_cast<double>(images_.load()) / static_cast<double>(count));
  }

 private:
  const Vocabulary& vocabulary_;
  const DescriptorFormat format_;
  std::vector<std::atomic<std::uint32_t>> counts_;
  std::atomic<std::uint64_t> images_{0};
};

// An image is left out where `goes_on()` says no.
template <class GoesOn>
void countWords(Span<const Descriptors> images, const ParallelOptions& parallel,
                const GoesOn& goes_on, WordCounts& counts) {
  ParallelOptions one_by_one = parallel;
  one_by_one.grain = 1;
  const auto count = [&](std::size_t i) {
    if (goes_on()) counts.add(images[i], i);
  };
  parallelFor(0, images.size(), count, one_by_one);
}

// Weights of nodes that have words.
inline void setWeights(const WordCounts& counts, TreeData& data) {
  for (std::size_t i = 0; i < data.words.size(); ++i) {
    if (data.words[i] != kNone) data.weights[i] = counts.inverseFrequency(data.words[i]);
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_WORD_COUNTS_H
