#ifndef GSLAM_VOCABULARY_VOCABULARY_H
#define GSLAM_VOCABULARY_VOCABULARY_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/storage.h>
#include <gslam/vocabulary/detail/tree_view.h>
#include <gslam/vocabulary/weighting.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

/// @file
/// A vocabulary: a tree of descriptors whose leaves are the words that images are described by.

namespace gslam {
inline namespace v1 {

/// A vocabulary tree (D. Nister, H. Stewenius, "Scalable Recognition with a Vocabulary Tree", CVPR
/// 2006): a descriptor goes from the root to the nearest child until there is none, and is the
/// word of that leaf.
///
///     const gslam::Vocabulary vocabulary = gslam::loadVocabulary("ORBvoc.txt");
///     gslam::BowVector bow;
///     transform(vocabulary, gslam::binaryDescriptors(orb.data(), 1000, 32), bow);
///
/// Made by loadVocabulary() (load.h), openVocabulary() (file.h) and trainVocabulary() (train.h).
///
/// Immutable; a copy shares the tree, which may be a file that is mapped into the memory. Words are
/// numbered from 0. Nodes have the ids of the file they came from, the root has 0.
///
/// Thread-safety: all may be called by any number of threads at once.
class Vocabulary {
 public:
  /// An empty one: it has no word.
  Vocabulary() = default;

  bool empty() const noexcept { return tree_.word_count == 0; }  ///< whether there is no word
  std::uint32_t wordCount() const noexcept { return tree_.word_count; }  ///< leaves
  std::uint32_t nodeCount() const noexcept { return tree_.node_count; }  ///< with the root
  std::uint32_t branching() const noexcept { return tree_.branching; }   ///< K: most children
  std::uint32_t depth() const noexcept { return tree_.depth; }  ///< L: levels below the root
  const DescriptorFormat& format() const noexcept { return tree_.format; }  ///< of descriptors
  Weighting weighting() const noexcept { return tree_.weighting; }  ///< how much a word counts
  Scoring scoring() const noexcept { return tree_.scoring; }        ///< how bags are compared

  /// The weight of a word. 0: it is left out of bags.
  /// @throws ArgumentError when there is no such word
  double weight(std::uint32_t word) const {
    if (word >= tree_.word_count) {
      throw ArgumentError("word", "is " + std::to_string(word) + ", but there are " +
                                      std::to_string(tree_.word_count));
    }
    return detail::weightOf(tree_, word);
  }

  /// The same tree, whose words count in another way. The weights stay: where they were made for
  /// one that does not need any (tf, binary), they are 1.
  Vocabulary withWeighting(Weighting weighting) const {
    Vocabulary other = *this;
    other.tree_.weighting = weighting;
    return other;
  }
  /// The same tree, whose bags are compared in another way.
  Vocabulary withScoring(Scoring scoring) const {
    Vocabulary other = *this;
    other.tree_.scoring = scoring;
    return other;
  }

  /// Bytes of the tree: of a file that is mapped, or of memory.
  std::size_t bytes() const noexcept { return storage_ == nullptr ? 0 : storage_->size(); }
  /// Whether the tree is a file that is mapped into the memory, and so shared by processes.
  bool isMapped() const noexcept { return storage_ != nullptr && storage_->isMapped(); }

  /// @{
  /// For those who build, write and search trees: see gslam/vocabulary/detail/tree_view.h.
  Vocabulary(std::shared_ptr<const detail::Storage> storage, const detail::TreeView& tree)
      : storage_(std::move(storage)), tree_(tree) {}
  const detail::TreeView& tree() const noexcept { return tree_; }
  const std::shared_ptr<const detail::Storage>& storage() const noexcept { return storage_; }
  /// @}

 private:
  std::shared_ptr<const detail::Storage> storage_;
  detail::TreeView tree_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_VOCABULARY_H
