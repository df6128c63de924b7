#ifndef GSLAM_VOCABULARY_QUALITY_H
#define GSLAM_VOCABULARY_QUALITY_H

#include <gslam/base/error.h>
#include <gslam/base/parallel.h>
#include <gslam/base/span.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/leaf_distance.h>
#include <gslam/vocabulary/detail/tree_view.h>
#include <gslam/vocabulary/detail/word_counts.h>
#include <gslam/vocabulary/reweight.h>
#include <gslam/vocabulary/vocabulary.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

/// @file
/// How well a vocabulary suits images.

namespace gslam {
inline namespace v1 {

/// What qualityOf() finds.
struct VocabularyQuality {
  std::uint32_t nodes = 0;             ///< with the root
  std::uint32_t words = 0;             ///< leaves
  std::uint32_t least_depth = 0;       ///< levels of the highest leaf below the root
  std::uint32_t most_depth = 0;        ///< levels of the lowest leaf below the root
  double mean_depth = 0;               ///< levels of all leaves
  double mean_children = 0;            ///< of nodes that have any
  std::uint32_t weightless_words = 0;  ///< of weight 0: they are left out of bags

  std::uint64_t images = 0;        ///< that it was tried on
  std::uint64_t descriptors = 0;   ///< in them
  std::uint32_t unseen_words = 0;  ///< that none of these descriptors is
  std::uint64_t largest_word = 0;  ///< descriptors of the most frequent word
  /// How evenly descriptors are spread over words: their entropy, as a part of what it would be if
  /// all words were equally frequent. From 0 (all are one word) to 1.
  double balance = 0;
  double mean_error = 0;  ///< mean distance of descriptors to their words: bits, or L2
  double rms_error = 0;   ///< root of the mean square of these distances
};

namespace detail {

// What trees are like without images.
inline void measureTree(const TreeView& tree, VocabularyQuality& quality) {
  quality.nodes = tree.node_count;
  quality.words = tree.word_count;
  std::vector<std::uint8_t> depths(tree.node_count, 0);
  std::uint64_t sum = 0, children_sum = 0, parents = 0, leaves = 0;
  quality.least_depth = kNone;
  for (std::uint32_t node = 0; node < tree.node_count; ++node) {  // parents come first
    const Children children = childrenOf(tree, node);
    const std::uint32_t depth = depths[node];
    children_sum += children.count;
    parents += children.count != 0 ? 1 : 0;
    for (std::uint32_t i = 0; i < children.count; ++i) {
      depths[children.first + i] = static_cast<std::uint8_t>(depth + 1);
    }
    if (children.count != 0) continue;
    ++leaves;
    sum += depth;
    quality.least_depth = std::min(quality.least_depth, depth);
    quality.most_depth = std::max(quality.most_depth, depth);
  }
  quality.mean_depth = static_cast<double>(sum) / static_cast<double>(leaves);
  quality.mean_children =
      static_cast<double>(children_sum) / static_cast<double>(std::max<std::uint64_t>(1, parents));
  for (std::uint32_t word = 0; word < tree.word_count; ++word) {
    quality.weightless_words += weightOf(tree, word) == 0 ? 1 : 0;
  }
}

// How often each word is, from counts of nodes.
inline void measureWords(const TreeView& tree,
                         const std::vector<std::atomic<std::uint64_t>>& counts,
                         VocabularyQuality& quality) {
  double entropy = 0;
  for (std::uint32_t node = 0; node < tree.node_count; ++node) {
    if (wordOf(tree, node) == kNone) continue;
    const std::uint64_t count = counts[node].load();
    quality.largest_word = std::max(quality.largest_word, count);
    if (count == 0) {
      ++quality.unseen_words;
      continue;
    }
    const double part = static_cast<double>(count) / static_cast<double>(quality.descriptors);
    entropy -= part * std::log(part);
  }
  const double most = std::log(static_cast<double>(tree.word_count));
  quality.balance = quality.descriptors == 0 ? 0 : most > 0 ? std::max(0.0, entropy / most) : 1;
}

struct ErrorSums {
  double distances = 0;
  double squares = 0;
};

}  // namespace detail

/// Tries a vocabulary on images, those of its training or others.
/// @param vocabulary  any
/// @param images      the descriptors of each; there may be none, then only the tree is described
/// @param parallel    threads; its grain does not matter, nor does their number for the result
/// @throws ArgumentError when the vocabulary is empty, or an image has descriptors of another kind
///         or size, or a number that is not finite or over 1e15: it names the image
inline VocabularyQuality qualityOf(const Vocabulary& vocabulary, Span<const Descriptors> images,
                                   const ParallelOptions& parallel = ParallelOptions()) {
  detail::requireWords(vocabulary);
  VocabularyQuality quality;
  const detail::TreeView& tree = vocabulary.tree();
  detail::measureTree(tree, quality);
  const DescriptorFormat format = detail::rowFormat(vocabulary);
  std::vector<std::atomic<std::uint64_t>> counts(tree.node_count);
  ParallelOptions one_by_one = parallel;
  one_by_one.grain = 1;
  const detail::ErrorSums sums = parallelReduce(
      0, images.size(), detail::ErrorSums(),
      [&](std::size_t i, std::size_t) {
        detail::checkImage(images[i], i, format);
        detail::checkNumbers(images[i], i);
        const std::vector<std::uint32_t> leaves = detail::leavesOf(vocabulary, images[i]);
        detail::ErrorSums part;
        for (std::size_t j = 0; j < leaves.size(); ++j) {
          counts[leaves[j]].fetch_add(1, std::memory_order_relaxed);
          const double distance = detail::leafDistance(tree, leaves[j], images[i].row(j));
          part.distances += distance;
          part.squares += distance * distance;
        }
        return part;
      },
      [](detail::ErrorSums all, const detail::ErrorSums& part) {
        all.distances += part.distances;
        all.squares += part.squares;
        return all;
      },
      one_by_one);
  quality.images = images.size();
  for (const Descriptors& image : images) quality.descriptors += image.count;
  detail::measureWords(tree, counts, quality);
  if (quality.descriptors == 0) return quality;
  quality.mean_error = sums.distances / static_cast<double>(quality.descriptors);
  quality.rms_error = std::sqrt(sums.squares / static_cast<double>(quality.descriptors));
  return quality;
}

/// A few lines for people.
inline std::string toText(const VocabularyQuality& quality) {
  char text[640];
  std::snprintf(text, sizeof text,
                "%lu nodes, %lu words %lu to %lu levels below the root, %.2f on average;\n"
                "%.2f children a node; %lu words of weight 0\n"
                "%llu images, %llu descriptors: %.3g from their words on average, %.3g rms;\n"
                "%lu words not seen, %llu descriptors in the largest, balance %.3f\n",
                static_cast<unsigned long>(quality.nodes),
                static_cast<unsigned long>(quality.words),
                static_cast<unsigned long>(quality.least_depth),
                static_cast<unsigned long>(quality.most_depth), quality.mean_depth,
                quality.mean_children, static_cast<unsigned long>(quality.weightless_words),
                static_cast<unsigned long long>(quality.images),
                static_cast<unsigned long long>(quality.descriptors), quality.mean_error,
                quality.rms_error, static_cast<unsigned long>(quality.unseen_words),
                static_cast<unsigned long long>(quality.largest_word), quality.balance);
  return text;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_QUALITY_H
