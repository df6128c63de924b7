#ifndef GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_PLAN_H
#define GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_PLAN_H

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "sparse/elimination.h"
#include "sparse/panel_kernels.h"

// Where the numbers of a factor stand, and who works on them when.

namespace gslam {
inline namespace v1 {
namespace detail {

struct Panel {
  std::size_t offset;  // in all numbers
  std::size_t columns;
  std::size_t rows;    // with those of the columns
  std::size_t stride;  // rows, rounded up
};
// What rows [begin, below.size()) of a supernode subtract from another one's columns, which are
// its rows [begin, end).
struct PanelUpdate {
  BlockIndex from;
  BlockIndex begin;
  BlockIndex end;
};
// Where a block of the matrix stands in a panel.
struct PanelEntry {
  std::size_t source;  // among the diagonal or the pairs
  std::size_t row;     // in its panel, in blocks
  std::size_t column;
  bool is_diagonal;
  bool is_transposed;
};

struct PanelPlan {
  PanelPlan() = default;
  PanelPlan(Elimination planned, std::size_t block_size, const std::vector<BlockPair>& pairs)
      : elimination(std::move(planned)), size(block_size) {
    layOutPanels();
    listUpdates();
    listEntries(pairs);
    cutSubtrees();
  }

  Elimination elimination;
  std::size_t size = 0;  // of a block
  std::vector<Panel> panels;
  std::vector<std::vector<PanelUpdate>> updates;  // that each supernode takes, in their order
  std::vector<std::vector<PanelEntry>> entries;   // of each supernode
  std::vector<std::pair<std::size_t, std::size_t>> subtrees;  // of supernodes
  std::vector<std::size_t> top;                               // the other supernodes
  std::size_t longest = 0;                                    // column
  std::size_t numbers = 0;

 private:
  void layOutPanels() {
    std::size_t offset = 0;
    for (const Supernode& node : elimination.supernodes) {
      Panel panel;
      panel.offset = offset;
      panel.columns = node.columns * size;
      panel.rows = panel.columns + node.below.size() * size;
      panel.stride = (panel.rows + kPanelPadding - 1) / kPanelPadding * kPanelPadding;
      offset += panel.columns * panel.stride + kPanelPadding;  // the last column is read beyond
      longest = std::max(longest, panel.stride);
      panels.push_back(panel);
    }
    numbers = offset;
  }

  void listUpdates() {
    updates.resize(panels.size());
    for (std::size_t s = 0; s < panels.size(); ++s) {
      const std::vector<BlockIndex>& rows = elimination.supernodes[s].below;
      for (std::size_t begin = 0; begin < rows.size();) {
        const BlockIndex target = elimination.supernode[rows[begin]];
        std::size_t end = begin + 1;
        while (end < rows.size() && elimination.supernode[rows[end]] == target) ++end;
        updates[target].push_back({static_cast<BlockIndex>(s), static_cast<BlockIndex>(begin),
                                   static_cast<BlockIndex>(end)});
        begin = end;
      }
    }
  }

  void listEntries(const std::vector<BlockPair>& pairs) {
    entries.resize(panels.size());
    for (std::size_t i = 0; i < elimination.position.size(); ++i)
      addEntry(i, elimination.position[i], elimination.position[i]);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      addEntry(i, elimination.position[pairs[i].first], elimination.position[pairs[i].second]);
    }
  }

  void addEntry(std::size_t source, BlockIndex row, BlockIndex column) {
    PanelEntry entry;
    entry.source = source;
    entry.is_diagonal = row == column;
    entry.is_transposed = row < column;
    if (entry.is_transposed) std::swap(row, column);
    const BlockIndex s = elimination.supernode[column];
    const Supernode& node = elimination.supernodes[s];
    entry.column = column - node.first;
    if (row < node.first + node.columns) {
      entry.row = row - node.first;
    } else {
      const auto found = std::lower_bound(node.below.begin(), node.below.end(), row);
      entry.row = node.columns + static_cast<std::size_t>(found - node.below.begin());
    }
    entries[s].push_back(entry);
  }

  // Subtrees of at most an eighth of the work, for threads; what is above is done after them.
  void cutSubtrees() {
    std::vector<double> work(panels.size(), 0);
    double total = 0;
    for (std::size_t s = 0; s < panels.size(); ++s) {
      const double rows = static_cast<double>(panels[s].rows);
      const double own = rows * rows * static_cast<double>(panels[s].columns);
      work[s] += own;
      total += own;
      const BlockIndex parent = elimination.supernodes[s].parent;
      if (parent != kNoBlock) work[parent] += work[s];
    }
    const double limit = total / 8;
    std::size_t begin = 0;
    for (std::size_t s = 0; s < panels.size(); ++s) {
      if (work[s] > limit) {
        top.push_back(s);
        begin = s + 1;
        continue;
      }
      const BlockIndex parent = elimination.supernodes[s].parent;
      if (parent != kNoBlock && work[parent] <= limit) continue;
      subtrees.emplace_back(begin, s + 1);
      begin = s + 1;
    }
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_SPARSE_PANEL_PLAN_H
