// From a list of nodes to a tree that can be searched.
#ifndef GSLAM_VOCABULARY_DETAIL_BUILD_TREE_H
#define GSLAM_VOCABULARY_DETAIL_BUILD_TREE_H

#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/vocabulary.h>

#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// Checks everything (cycles, nodes without a parent, ids twice, words twice or missing, too many
// children, too deep, weights that are not finite or negative, lists of other lengths) and throws
// ParseError(source, 0, 0, problem) that names the node.
Vocabulary buildVocabulary(const TreeData& data, const std::string& source);

// The other way, for writers: nodes breadth first, with their ids.
TreeData treeDataOf(const Vocabulary& vocabulary);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_BUILD_TREE_H
