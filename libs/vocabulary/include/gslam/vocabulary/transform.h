#ifndef GSLAM_VOCABULARY_TRANSFORM_H
#define GSLAM_VOCABULARY_TRANSFORM_H

#include <gslam/base/error.h>
#include <gslam/base/parallel.h>
#include <gslam/base/span.h>
#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/descend.h>
#include <gslam/vocabulary/detail/radix_order.h>
#include <gslam/vocabulary/score.h>
#include <gslam/vocabulary/vocabulary.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// From the descriptors of an image to its bag of words.

namespace gslam {
inline namespace v1 {

/// Memory that transform() works in. Who keeps one, and the results, allocates nothing any more
/// once all have grown to the size of the images. One thread at a time may use it.
struct TransformMemory {
  /// @{
  /// Its content means nothing to others.
  std::vector<std::uint32_t> nodes, passed;
  std::vector<std::uint64_t> by_word, by_node, spare;
  std::vector<std::uint8_t> rows;
  std::uint32_t last_passed = 0;
  /// @}
};

namespace detail {

inline void checkDescriptors(const Vocabulary& vocabulary, const Descriptors& descriptors) {
  if (descriptors.count == 0 || vocabulary.empty()) return;
  if (descriptors.count >= kNone) throw ArgumentError("descriptors", "are more than 32 bits count");
  const DescriptorFormat& format = vocabulary.format();
  const bool wants_binary = format.type == DescriptorType::binary;
  if (descriptors.is_binary == wants_binary && descriptors.size == format.size) {
    const std::size_t row = wants_binary ? format.size : format.size * sizeof(float);
    if (descriptors.data == nullptr || descriptors.stride < row) {
      throw ArgumentError("descriptors", "have no data, or less than " + std::to_string(row) +
                                             " bytes from one to the next");
    }
    return;
  }
  const auto shape = [](bool is_binary, std::uint32_t size) {
    return std::to_string(size) + (is_binary ? " bytes of bits" : " floats");
  };
  throw ArgumentError("descriptors", "have " + shape(descriptors.is_binary, descriptors.size) +
                                         " each, but the vocabulary is of " +
                                         shape(wants_binary, format.size));
}

// The leaf of each descriptor, and the node that it passed.
inline void findNodes(const TreeView& tree, const Descriptors& descriptors, std::uint32_t levels_up,
                      bool has_passed, TransformMemory& memory) {
  memory.nodes.resize(descriptors.count);
  if (has_passed) memory.passed.resize(descriptors.count);
  const std::uint32_t level = tree.depth > levels_up ? tree.depth - levels_up : 0;
  descend(tree, descriptors, level, memory.nodes.data(),
          has_passed ? memory.passed.data() : nullptr, memory.rows);
  if (!has_passed) return;
  memory.last_passed = *std::max_element(memory.passed.begin(), memory.passed.end());
}

// Puts words in place of leaves, while the memory of their weights is fetched.
inline void findWeights(const TreeView& tree, std::vector<std::uint32_t>& nodes) {
  for (std::uint32_t& node : nodes) {
    node = wordOf(tree, node);
    if (node == kNone) continue;
    if (tree.weight_numbers != nullptr) {
      fetch(tree.weight_numbers + node);
    } else {
      fetch(tree.weights + node);
    }
  }
}

// The words of all descriptors that have a weight, ascending, with their values.
inline void gatherWords(const Vocabulary& vocabulary, const std::vector<std::uint64_t>& items,
                        BowVector& bow) {
  const bool adds =
      vocabulary.weighting() == Weighting::tf_idf || vocabulary.weighting() == Weighting::tf;
  bow.words.resize(items.size());
  bow.values.resize(items.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < items.size(); ++count) {
    const std::uint32_t word = keyOf(items[i]);
    const double weight = weightOf(vocabulary.tree(), word);
    double value = weight;
    for (++i; i < items.size() && keyOf(items[i]) == word; ++i) {
      if (adds) value += weight;
    }
    bow.words[count] = word;
    bow.values[count] = value;
  }
  bow.words.resize(count);
  bow.values.resize(count);
}

inline void gatherFeatures(const std::vector<std::uint64_t>& items, FeatureVector& features) {
  features.nodes.resize(items.size());
  features.begins.resize(items.size() + 1);
  features.features.resize(items.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    features.features[i] = indexOf(items[i]);
    if (i != 0 && keyOf(items[i]) == keyOf(items[i - 1])) continue;
    features.nodes[count] = keyOf(items[i]);
    features.begins[count] = static_cast<std::uint32_t>(i);
    ++count;
  }
  features.nodes.resize(count);
  features.begins.resize(count == 0 ? 0 : count + 1);
  if (count != 0) features.begins[count] = static_cast<std::uint32_t>(items.size());
}

// In the order of DBoW: what is to be of norm 1 is divided by its norm; of the rest, frequencies by
// the number of words.
inline void finishBow(const Vocabulary& vocabulary, BowVector& bow) {
  if (vocabulary.scoring() != Scoring::dot) {
    normalize(bow, vocabulary.scoring());
  } else if (vocabulary.weighting() == Weighting::tf_idf ||
             vocabulary.weighting() == Weighting::tf) {
    const double words = static_cast<double>(bow.size());
    for (double& value : bow.values) value /= words;
  }
}

// The bag; and, where `features` is not null, the features by node.
inline void transformTo(const Vocabulary& vocabulary, const Descriptors& descriptors,
                        std::uint32_t levels_up, BowVector& bow, FeatureVector* features,
                        TransformMemory& memory) {
  checkDescriptors(vocabulary, descriptors);
  bow.clear();
  if (features != nullptr) features->clear();
  if (vocabulary.empty() || descriptors.count == 0) return;
  const TreeView& tree = vocabulary.tree();
  findNodes(tree, descriptors, levels_up, features != nullptr, memory);
  memory.by_word.resize(descriptors.count);
  memory.by_node.resize(descriptors.count);
  findWeights(tree, memory.nodes);
  std::size_t count = 0;
  for (std::size_t i = 0; i < descriptors.count; ++i) {
    const std::uint32_t word = memory.nodes[i];
    if (word == kNone || !(weightOf(tree, word) > 0)) continue;
    memory.by_word[count] = keyed(word, static_cast<std::uint32_t>(i));
    if (features != nullptr) {
      memory.by_node[count] = keyed(nodeId(tree, memory.passed[i]), static_cast<std::uint32_t>(i));
    }
    ++count;
  }
  memory.by_word.resize(count);
  orderByKey(memory.by_word, memory.spare, bitsBelow(tree.word_count));
  gatherWords(vocabulary, memory.by_word, bow);
  finishBow(vocabulary, bow);
  if (features == nullptr) return;
  memory.by_node.resize(count);
  const std::uint32_t last = tree.node_ids != nullptr ? tree.node_count - 1 : memory.last_passed;
  orderByKey(memory.by_node, memory.spare, bitsBelow(last + 1));
  gatherFeatures(memory.by_node, *features);
}

}  // namespace detail

/// The bag of words of an image: DBoW's transform(), with the same words, and the same values to
/// the last bit.
///
/// A descriptor goes from the root to the nearest child until it is at a leaf; of children that
/// are equally near the first is taken. Distances of floats are exact: none is rounded so that
/// another child seems nearer, whatever the SIMD variant. A descriptor with a NaN goes to the first
/// child. Words with weight 0 are left out. The values of a bag are of norm 1 where the scoring
/// of the vocabulary needs that.
/// @param vocabulary   where it is empty, so is the bag
/// @param descriptors  of the image
/// @param[out] bow     keeps its memory
/// @param memory       to work in
/// @throws ArgumentError when the descriptors are of another kind or size than the vocabulary's
inline void transform(const Vocabulary& vocabulary, const Descriptors& descriptors, BowVector& bow,
                      TransformMemory& memory) {
  detail::transformTo(vocabulary, descriptors, 0, bow, nullptr, memory);
}
/// As above, with memory of its own.
/// @param vocabulary   where it is empty, so is the bag
/// @param descriptors  of the image
/// @param[out] bow     keeps its memory
/// @throws ArgumentError as above
inline void transform(const Vocabulary& vocabulary, const Descriptors& descriptors,
                      BowVector& bow) {
  TransformMemory memory;
  transform(vocabulary, descriptors, bow, memory);
}

/// The bag of words of an image, and its features by node, in one pass.
/// @param vocabulary     where it is empty, so is the bag
/// @param descriptors    of the image
/// @param levels_up      levels above the lowest of the tree at which nodes are taken, as DBoW
///                       counts: depth() or more is the root alone; 4 is usual for six levels
/// @param[out] bow       keeps its memory
/// @param[out] features  keeps its memory. A leaf that is above the level stands for itself (DBoW
///                       leaves the node undefined then)
/// @param memory         to work in
/// @throws ArgumentError when the descriptors are of another kind or size than the vocabulary's
inline void transform(const Vocabulary& vocabulary, const Descriptors& descriptors,
                      std::uint32_t levels_up, BowVector& bow, FeatureVector& features,
                      TransformMemory& memory) {
  detail::transformTo(vocabulary, descriptors, levels_up, bow, &features, memory);
}
/// As above, with memory of its own.
/// @param vocabulary     where it is empty, so is the bag
/// @param descriptors    of the image
/// @param levels_up      levels above the lowest
/// @param[out] bow       keeps its memory
/// @param[out] features  keeps its memory
/// @throws ArgumentError as above
inline void transform(const Vocabulary& vocabulary, const Descriptors& descriptors,
                      std::uint32_t levels_up, BowVector& bow, FeatureVector& features) {
  TransformMemory memory;
  transform(vocabulary, descriptors, levels_up, bow, features, memory);
}

/// The word of each descriptor, also of those without weight; 0xFFFFFFFF in a damaged vocabulary.
/// @param vocabulary   not empty
/// @param descriptors  of any number of images
/// @param[out] words   as many as descriptors
/// @throws ArgumentError as transform(), for another number of words, and for an empty vocabulary
inline void findWords(const Vocabulary& vocabulary, const Descriptors& descriptors,
                      Span<std::uint32_t> words) {
  detail::checkDescriptors(vocabulary, descriptors);
  if (vocabulary.empty()) throw ArgumentError("vocabulary", "is empty");
  if (words.size() != descriptors.count) {
    throw ArgumentError("words", "have room for " + std::to_string(words.size()) +
                                     ", but there are " + std::to_string(descriptors.count) +
                                     " descriptors");
  }
  std::vector<std::uint8_t> rows;
  detail::descend(vocabulary.tree(), descriptors, 0, words.data(), nullptr, rows);
  for (std::uint32_t& word : words) word = detail::wordOf(vocabulary.tree(), word);
}

/// The bags of many images, on several threads. The same as one after the other.
/// @param vocabulary  as transform()
/// @param images      the descriptors of each
/// @param[out] bows   one for each image; keep their memory
/// @param options     threads; a grain of a few images is best
/// @throws ArgumentError as transform(), and for another number of bags
inline void transformAll(const Vocabulary& vocabulary, Span<const Descriptors> images,
                         Span<BowVector> bows, const ParallelOptions& options = ParallelOptions()) {
  if (bows.size() != images.size()) {
    throw ArgumentError("bows", "are " + std::to_string(bows.size()) + " for " +
                                    std::to_string(images.size()) + " images");
  }
  parallelChunks(
      0, images.size(),
      [&](std::size_t begin, std::size_t end) {
        TransformMemory memory;
        for (std::size_t i = begin; i < end; ++i) transform(vocabulary, images[i], bows[i], memory);
      },
      options);
}

/// As above, with the features by node of each.
/// @param vocabulary     as transform()
/// @param images         the descriptors of each
/// @param levels_up      as transform()
/// @param[out] bows      one for each image; keep their memory
/// @param[out] features  one for each image; keep their memory
/// @param options        threads; a grain of a few images is best
/// @throws ArgumentError as transform(), and for another number of bags or features
inline void transformAll(const Vocabulary& vocabulary, Span<const Descriptors> images,
                         std::uint32_t levels_up, Span<BowVector> bows,
                         Span<FeatureVector> features,
                         const ParallelOptions& options = ParallelOptions()) {
  if (bows.size() != images.size() || features.size() != images.size()) {
    throw ArgumentError("bows and features", "are " + std::to_string(bows.size()) + " and " +
                                                 std::to_string(features.size()) + " for " +
                                                 std::to_string(images.size()) + " images");
  }
  parallelChunks(
      0, images.size(),
      [&](std::size_t begin, std::size_t end) {
        TransformMemory memory;
        for (std::size_t i = begin; i < end; ++i) {
          transform(vocabulary, images[i], levels_up, bows[i], features[i], memory);
        }
      },
      options);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_TRANSFORM_H
