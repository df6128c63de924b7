#include "graph/graph_layout.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "parts.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

// Lists of what belongs to each of `count` owners, in the order in which it is named.
// `forEach(add)` calls add(owner, term) and is called twice.
template <class ForEach>
TermLists listTerms(std::size_t count, const ForEach& for_each) {
  TermLists lists;
  lists.begin.assign(count + 1, 0);
  for_each([&](std::size_t owner, std::size_t) { ++lists.begin[owner + 1]; });
  for (std::size_t i = 0; i < count; ++i) lists.begin[i + 1] += lists.begin[i];
  lists.term.resize(lists.begin[count]);
  std::vector<std::uint32_t> next(lists.begin.begin(), lists.begin.end() - 1);
  for_each([&](std::size_t owner, std::size_t term) {
    lists.term[next[owner]++] = static_cast<std::uint32_t>(term);
  });
  return lists;
}

// Edges of the same two variables share a block.
void pairVariables(GraphLayout& layout) {
  using Key = std::tuple<BlockIndex, BlockIndex, std::uint32_t>;  // larger, smaller, term
  std::vector<Key> keys;
  for (std::size_t i = 0; i < layout.terms.size(); ++i) {
    const GraphTerm& t = layout.terms[i];
    if (t.from == kNoBlock || t.to == kNoBlock) continue;
    const bool is_transposed = t.from < t.to;
    keys.emplace_back(std::max(t.from, t.to), std::min(t.from, t.to),
                      static_cast<std::uint32_t>(2 * i + (is_transposed ? 1 : 0)));
  }
  std::sort(keys.begin(), keys.end());
  for (const Key& key : keys) {
    const BlockPair pair(std::get<0>(key), std::get<1>(key));
    if (layout.pairs.empty() || layout.pairs.back() != pair) {
      layout.pair_terms.begin.push_back(static_cast<std::uint32_t>(layout.pair_terms.term.size()));
      layout.pairs.push_back(pair);
    }
    layout.pair_terms.term.push_back(std::get<2>(key));
  }
  layout.pair_terms.begin.push_back(static_cast<std::uint32_t>(layout.pair_terms.term.size()));
}

}  // namespace

GraphLayout layOutGraph(std::size_t poses, Span<const std::uint8_t> pose_fixed,
                        Span<const std::uint32_t> from, Span<const std::uint32_t> to,
                        Span<const std::uint32_t> prior_pose) {
  Parts parts(poses);
  for (std::size_t e = 0; e < from.size(); ++e) parts.join(from[e], to[e]);
  std::vector<char> is_anchored(poses, 0);  // of the lowest pose of each part
  const auto isFixed = [&](std::size_t i) { return !pose_fixed.empty() && pose_fixed[i] != 0; };
  for (std::size_t i = 0; i < poses; ++i) {
    if (isFixed(i)) is_anchored[parts.rootOf(static_cast<std::uint32_t>(i))] = 1;
  }
  for (const std::uint32_t p : prior_pose) is_anchored[parts.rootOf(p)] = 1;

  GraphLayout layout;
  layout.variable.assign(poses, kNoBlock);
  for (std::size_t i = 0; i < poses; ++i) {
    const std::uint32_t part = parts.rootOf(static_cast<std::uint32_t>(i));
    if (isFixed(i) || (part == i && is_anchored[part] == 0)) continue;
    layout.variable[i] = static_cast<BlockIndex>(layout.pose.size());
    layout.pose.push_back(static_cast<std::uint32_t>(i));
  }
  layout.terms.reserve(from.size() + prior_pose.size());
  for (std::size_t e = 0; e < from.size(); ++e) {
    layout.terms.push_back({layout.variable[from[e]], layout.variable[to[e]]});
  }
  for (const std::uint32_t p : prior_pose) layout.terms.push_back({kNoBlock, layout.variable[p]});
  layout.variable_terms = listTerms(layout.pose.size(), [&](const auto& add) {
    for (std::size_t i = 0; i < layout.terms.size(); ++i) {
      const GraphTerm& t = layout.terms[i];
      if (t.from != kNoBlock) add(t.from, 2 * i);
      if (t.to != kNoBlock) add(t.to, 2 * i + 1);
    }
  });
  pairVariables(layout);
  return layout;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
