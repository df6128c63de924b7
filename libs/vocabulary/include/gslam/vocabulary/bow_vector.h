#ifndef GSLAM_VOCABULARY_BOW_VECTOR_H
#define GSLAM_VOCABULARY_BOW_VECTOR_H

#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// What an image looks like: a bag of words, and which of its features are alike.

namespace gslam {
inline namespace v1 {

/// A bag of words: how much of which word is in an image.
///
/// Two flat lists side by side, which keep their memory when they are filled anew. The words
/// ascend; each is there once. gslam/vocabulary/dbow_maps.h has the std::map of DBoW.
///
/// Thread-safety: plain data.
struct BowVector {
  std::vector<std::uint32_t> words;  ///< ascending, without repetition
  std::vector<double> values;        ///< of each word; 0 or more

  std::size_t size() const noexcept { return words.size(); }  ///< words that are there
  bool empty() const noexcept { return words.empty(); }       ///< whether there is none
  /// Forgets all, and keeps the memory.
  void clear() noexcept {
    words.clear();
    values.clear();
  }
};

/// Whether both have the same words and values.
inline bool operator==(const BowVector& a, const BowVector& b) {
  return a.words == b.words && a.values == b.values;
}
inline bool operator!=(const BowVector& a, const BowVector& b) {  ///< not ==
  return !(a == b);
}

/// The features of an image, by the node of the tree that they fall under at one level: features of
/// two images that can match lie under the same node.
///
/// Features under node `nodes[i]` are `features[begins[i]]` to `features[begins[i + 1] - 1]`.
///
/// Thread-safety: plain data.
struct FeatureVector {
  std::vector<std::uint32_t> nodes;     ///< ids, ascending, without repetition
  std::vector<std::uint32_t> begins;    ///< one more than there are nodes, from 0; empty: no nodes
  std::vector<std::uint32_t> features;  ///< numbers of descriptors, ascending within a node

  std::size_t size() const noexcept { return nodes.size(); }  ///< nodes that are there
  bool empty() const noexcept { return nodes.empty(); }       ///< whether there is none
  /// Forgets all, and keeps the memory.
  void clear() noexcept {
    nodes.clear();
    begins.clear();
    features.clear();
  }
};

/// Whether both have the same nodes and features.
inline bool operator==(const FeatureVector& a, const FeatureVector& b) {
  return a.nodes == b.nodes && a.begins == b.begins && a.features == b.features;
}
inline bool operator!=(const FeatureVector& a, const FeatureVector& b) {  ///< not ==
  return !(a == b);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_BOW_VECTOR_H
