#ifndef GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_LAYOUT_H
#define GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_LAYOUT_H

#include <gslam/base/span.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sparse/elimination.h"

// Which poses are free, and where edges and priors stand in the normal equations.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// An edge or a prior, and the blocks of its variables; kNoBlock where there is none or it is fixed.
struct GraphTerm {
  BlockIndex from = kNoBlock;
  BlockIndex to = kNoBlock;
};

// Lists of one length or another, one after the other.
struct TermLists {
  std::vector<std::uint32_t> begin;  // of each list; one more than there are lists
  std::vector<std::uint32_t> term;   // twice the number of the term, plus 1 where it is the `to`
                                     // of the term (or stands transposed in the pair)
};

struct GraphLayout {
  std::vector<BlockIndex> variable;  // of each pose; kNoBlock: it stays where it is
  std::vector<std::uint32_t> pose;   // of each variable
  std::vector<GraphTerm> terms;      // edges, then priors
  std::vector<BlockPair> pairs;      // of variables that share edges
  TermLists variable_terms;
  TermLists pair_terms;
};

// A part of the graph without an anchor and without a prior is held at its first pose.
GraphLayout layOutGraph(std::size_t poses, Span<const std::uint8_t> pose_fixed,
                        Span<const std::uint32_t> from, Span<const std::uint32_t> to,
                        Span<const std::uint32_t> prior_pose);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_LAYOUT_H
