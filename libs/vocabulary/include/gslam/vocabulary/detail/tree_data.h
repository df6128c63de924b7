// A tree as readers and the training bring it: in any order, with parents instead of children.
#ifndef GSLAM_VOCABULARY_DETAIL_TREE_DATA_H
#define GSLAM_VOCABULARY_DETAIL_TREE_DATA_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/weighting.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::uint32_t kMostChildren = 64;
constexpr std::uint32_t kMostDepth = 64;
constexpr std::uint32_t kMostDescriptorSize = 4096;

// All nodes but the root, which has the id 0. buildVocabulary() checks all of it but what is said
// below, and orders it.
struct TreeData {
  DescriptorFormat format;
  std::uint32_t branching = 0;  // as the file says; nodes with more children are an error
  std::uint32_t depth = 0;      // as the file says; a tree that is deeper is an error
  Weighting weighting = Weighting::tf_idf;
  Scoring scoring = Scoring::l1;

  // Of each node. Where two nodes are equally near, the first of them here is taken, as DBoW does:
  // so the order is that in which the file lists them.
  std::vector<std::uint32_t> ids;         // empty: 1, 2, 3...
  std::vector<std::uint32_t> parents;     // ids of theirs
  std::vector<double> weights;            // only those of leaves count; 0: a word that is left out
  std::vector<std::uint8_t> descriptors;  // bytesOf(format) for each
  // Words of nodes, kNone for inner ones. Empty: leaves are numbered in the order of this list.
  std::vector<std::uint32_t> words;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TREE_DATA_H
