#ifndef GSLAM_OPTIMIZER_SRC_SPARSE_ELIMINATION_H
#define GSLAM_OPTIMIZER_SRC_SPARSE_ELIMINATION_H

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "no_block.h"

// In which order the blocks of a sparse symmetric matrix are eliminated, and what its Cholesky
// factor looks like then. Names follow T. Davis, "Direct Methods for Sparse Linear Systems", 2006.

namespace gslam {
inline namespace v1 {
namespace detail {

using BlockIndex = std::uint32_t;
using BlockPair = std::pair<BlockIndex, BlockIndex>;  // row and column of a block, which differ

// Columns of a factor that are stored as one dense panel: `columns` from `first` on, and the rows
// below them.
struct Supernode {
  BlockIndex first = 0;
  BlockIndex columns = 0;
  BlockIndex parent = kNoBlock;   // a supernode
  std::vector<BlockIndex> below;  // in ascending order
};

struct Elimination {
  std::vector<BlockIndex> position;   // of each block in the order
  std::vector<BlockIndex> supernode;  // of each position
  std::vector<Supernode> supernodes;
};

// Neighbours of each block.
class BlockAdjacency {
 public:
  BlockAdjacency(std::size_t blocks, const std::vector<BlockPair>& pairs) : begin_(blocks + 1, 0) {
    for (const BlockPair& p : pairs) ++begin_[p.first + 1], ++begin_[p.second + 1];
    for (std::size_t i = 0; i < blocks; ++i) begin_[i + 1] += begin_[i];
    neighbours_.resize(begin_[blocks]);
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const BlockPair& p : pairs) {
      neighbours_[next[p.first]++] = p.second;
      neighbours_[next[p.second]++] = p.first;
    }
  }
  std::size_t size() const { return begin_.size() - 1; }
  const BlockIndex* begin(std::size_t block) const { return neighbours_.data() + begin_[block]; }
  const BlockIndex* end(std::size_t block) const { return neighbours_.data() + begin_[block + 1]; }

 private:
  std::vector<std::size_t> begin_;
  std::vector<BlockIndex> neighbours_;
};

// Blocks in the order of approximate minimum degree (Amestoy, Davis, Duff, SIAM J. Matrix Anal.
// Appl. 17(4), 1996).
inline std::vector<BlockIndex> minimumDegreeOrder(std::size_t blocks,
                                                  const std::vector<BlockPair>& pairs) {
  using Pattern = Eigen::SparseMatrix<double>;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * pairs.size() + blocks);
  for (const BlockPair& p : pairs) {
    const int row = static_cast<int>(p.first), column = static_cast<int>(p.second);
    entries.emplace_back(row, column, 1.0);
    entries.emplace_back(column, row, 1.0);
  }
  const int n = static_cast<int>(blocks);
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
  Pattern pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), order);
  std::vector<BlockIndex> result(blocks);
  for (int k = 0; k < n; ++k) {
    result[static_cast<std::size_t>(k)] = static_cast<BlockIndex>(order.indices()[k]);
  }
  return result;
}

// Parents in the elimination tree (Davis, section 4.1).
inline std::vector<BlockIndex> eliminationTree(const BlockAdjacency& graph,
                                               const std::vector<BlockIndex>& order,
                                               const std::vector<BlockIndex>& position) {
  std::vector<BlockIndex> parent(order.size(), kNoBlock), ancestor(order.size(), kNoBlock);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const BlockIndex column = static_cast<BlockIndex>(k);
    for (const BlockIndex* n = graph.begin(order[k]); n != graph.end(order[k]); ++n) {
      BlockIndex i = position[*n];
      while (i < column) {
        const BlockIndex next = ancestor[i];
        ancestor[i] = column;
        if (next == kNoBlock) parent[i] = column;
        i = next;
      }
    }
  }
  return parent;
}

// Children before parents, and each subtree in one piece.
inline std::vector<BlockIndex> postOrder(const std::vector<BlockIndex>& parent) {
  const std::size_t n = parent.size();
  std::vector<BlockIndex> first_child(n, kNoBlock), sibling(n, kNoBlock), result, stack;
  for (std::size_t i = n; i-- > 0;) {
    if (parent[i] == kNoBlock) continue;
    sibling[i] = first_child[parent[i]];
    first_child[parent[i]] = static_cast<BlockIndex>(i);
  }
  result.reserve(n);
  for (std::size_t root = 0; root < n; ++root) {
    if (parent[root] != kNoBlock) continue;
    stack.push_back(static_cast<BlockIndex>(root));
    while (!stack.empty()) {
      const BlockIndex top = stack.back();
      const BlockIndex child = first_child[top];
      if (child == kNoBlock) {
        result.push_back(top);
        stack.pop_back();
      } else {
        first_child[top] = sibling[child];
        stack.push_back(child);
      }
    }
  }
  return result;
}

// Finds the panels of a factor, column by column.
class SupernodeFinder {
 public:
  SupernodeFinder(const BlockAdjacency& graph, const std::vector<BlockIndex>& order,
                  Elimination& result)
      : graph_(graph), order_(order), result_(result), mark_(order.size(), kNoBlock) {}

  void find() {
    const std::vector<BlockIndex> parent = eliminationTree(graph_, order_, result_.position);
    std::vector<std::vector<BlockIndex>> children(order_.size());
    for (std::size_t i = 0; i < parent.size(); ++i) {
      if (parent[i] != kNoBlock) children[parent[i]].push_back(static_cast<BlockIndex>(i));
    }
    rows_.resize(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const BlockIndex column = static_cast<BlockIndex>(k);
      collectRows(column, children[k]);
      append(column, parent);
      for (const BlockIndex child : children[k]) std::vector<BlockIndex>().swap(rows_[child]);
    }
    finish();
  }

 private:
  void collectRows(BlockIndex column, const std::vector<BlockIndex>& children) {
    std::vector<BlockIndex>& rows = rows_[column];
    mark_[column] = column;
    const auto add = [&](BlockIndex row) {
      if (row <= column || mark_[row] == column) return;
      mark_[row] = column;
      rows.push_back(row);
    };
    const BlockIndex block = order_[column];
    for (const BlockIndex* n = graph_.begin(block); n != graph_.end(block); ++n) {
      add(result_.position[*n]);
    }
    for (const BlockIndex child : children) {
      for (const BlockIndex row : rows_[child]) add(row);
    }
    std::sort(rows.begin(), rows.end());
  }

  // A new panel of one column, joined with those before it that are its children as long as few
  // zeros are stored for it.
  void append(BlockIndex column, const std::vector<BlockIndex>& parent) {
    std::vector<Supernode>& all = result_.supernodes;
    Supernode node;
    node.first = column;
    node.columns = 1;
    node.below = rows_[column];
    double numbers = 1 + static_cast<double>(node.below.size());
    while (!all.empty()) {
      const Supernode& last = all.back();
      const BlockIndex end = last.first + last.columns;
      if (end != node.first || parent[end - 1] == kNoBlock) break;
      if (parent[end - 1] >= node.first + node.columns) break;
      const double width = static_cast<double>(last.columns + node.columns);
      const double joined =
          width * (width + 1) / 2 + width * static_cast<double>(node.below.size());
      const double sum = numbers + numbers_.back();
      if (joined - sum > allowedZeros(width) * joined) break;
      node.first = last.first;
      node.columns += last.columns;
      numbers = sum;
      all.pop_back();
      numbers_.pop_back();
    }
    all.push_back(std::move(node));
    numbers_.push_back(numbers);
  }

  static double allowedZeros(double width) { return width <= 4 ? 0.4 : width <= 12 ? 0.15 : 0.05; }

  void finish() {
    std::vector<Supernode>& all = result_.supernodes;
    result_.supernode.resize(order_.size());
    for (std::size_t s = 0; s < all.size(); ++s) {
      for (BlockIndex c = 0; c < all[s].columns; ++c) {
        result_.supernode[all[s].first + c] = static_cast<BlockIndex>(s);
      }
    }
    for (Supernode& node : all) {
      if (!node.below.empty()) node.parent = result_.supernode[node.below.front()];
    }
  }

  const BlockAdjacency& graph_;
  const std::vector<BlockIndex>& order_;
  Elimination& result_;
  std::vector<BlockIndex> mark_;  // the last column that a row was found in
  std::vector<std::vector<BlockIndex>> rows_;
  std::vector<double> numbers_;  // of each supernode: blocks that are not zero
};

// `pairs`: the blocks beside the diagonal, in either triangle.
inline Elimination planElimination(std::size_t blocks, const std::vector<BlockPair>& pairs) {
  const BlockAdjacency graph(blocks, pairs);
  Elimination result;
  result.position.resize(blocks);
  std::vector<BlockIndex> order = minimumDegreeOrder(blocks, pairs);
  const auto number = [&] {
    for (std::size_t k = 0; k < blocks; ++k) {
      result.position[order[k]] = static_cast<BlockIndex>(k);
    }
  };
  number();
  const std::vector<BlockIndex> post = postOrder(eliminationTree(graph, order, result.position));
  std::vector<BlockIndex> reordered(blocks);
  for (std::size_t k = 0; k < blocks; ++k) reordered[k] = order[post[k]];
  order.swap(reordered);
  number();
  SupernodeFinder(graph, order, result).find();
  return result;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_SPARSE_ELIMINATION_H
