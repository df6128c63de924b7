#ifndef GSLAM_OPTIMIZER_SRC_SPARSE_BLOCK_CHOLESKY_H
#define GSLAM_OPTIMIZER_SRC_SPARSE_BLOCK_CHOLESKY_H

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "sparse/elimination.h"
#include "sparse/panel_decomposition.h"
#include "sparse/panel_kernels.h"
#include "sparse/panel_plan.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Cholesky decomposition of a sparse symmetric matrix of (D x D) blocks, by supernodes that look
// left: each takes from its columns what all those before it contribute, in their order, and then
// is decomposed as a dense panel (E. Ng, B. Peyton, SIAM J. Sci. Comput. 14(5), 1993).
//
// The matrix is planned once and decomposed often. Same bits for any number of threads.
class BlockCholesky {
 public:
  BlockCholesky() = default;
  // `pairs`: the blocks beside the diagonal, in either triangle. Those that repeat are summed.
  BlockCholesky(std::size_t blocks, std::size_t block_size, const std::vector<BlockPair>& pairs)
      : BlockCholesky(planElimination(blocks, pairs), block_size, pairs) {}
  BlockCholesky(Elimination elimination, std::size_t block_size,
                const std::vector<BlockPair>& pairs)
      : plan_(std::move(elimination), block_size, pairs),
        size_(block_size),
        numbers_(plan_.numbers),
        is_good_(plan_.panels.size()),
        pivot_(plan_.panels.size()) {}

  std::size_t blocks() const { return plan_.elimination.position.size(); }
  std::size_t blockSize() const { return size_; }
  // Numbers that are stored for the factor.
  std::size_t storedNumbers() const { return numbers_.size(); }

  // Both in rows: `diagonal` a block for each variable, of which the lower triangle is read,
  // `beside` a block for each pair. Whether the matrix is positive definite.
  bool factorize(const double* diagonal, const double* beside, unsigned threads) {
    diagonal_ = diagonal;
    beside_ = beside;
    std::fill(is_good_.begin(), is_good_.end(), char(1));
    std::fill(pivot_.begin(), pivot_.end(), 1.0);
    ParallelOptions parallel;
    parallel.threads = threads;
    parallelFor(
        0, plan_.subtrees.size(),
        [&](std::size_t i) {
          Workspace workspace = takeWorkspace();
          for (std::size_t s = plan_.subtrees[i].first; s < plan_.subtrees[i].second; ++s) {
            if (!eliminate(s, workspace, 1)) break;
          }
          giveWorkspace(std::move(workspace));
        },
        parallel);
    Workspace workspace = takeWorkspace();
    bool is_good = isGood();
    for (std::size_t i = 0; is_good && i < plan_.top.size(); ++i) {
      is_good = eliminate(plan_.top[i], workspace, threads);
    }
    giveWorkspace(std::move(workspace));
    return is_good;
  }

  // How much of a diagonal element was left when it became a pivot, of the worst: 1e-16 or so where
  // the matrix is singular up to rounding.
  double leastPivot() const {
    return pivot_.empty() ? 1 : *std::min_element(pivot_.begin(), pivot_.end());
  }

  // x := matrix^-1 x, with blocks in the caller's order.
  void solve(double* x) const {
    std::vector<double> y(blocks() * size_ + kPanelPadding),
        rows(plan_.longest + 2 * kPanelPadding);
    reorder(x, y.data(), true);
    for (std::size_t s = 0; s < plan_.panels.size(); ++s) solveForward(s, y.data(), rows.data());
    for (std::size_t s = plan_.panels.size(); s-- > 0;) solveBackward(s, y.data(), rows.data());
    reorder(x, y.data(), false);
  }

  // The (D x D) block of the inverse that belongs to one variable, row by row: with L Y = unit
  // columns it is Y^T Y, and Y is zero outside the path from the variable to its root.
  void inverseBlock(std::size_t block, double* result) const {
    const std::size_t n = blocks() * size_;
    std::vector<double> y(n + kPanelPadding), rows(plan_.longest + 2 * kPanelPadding), columns;
    std::vector<std::size_t> path;
    const BlockIndex position = plan_.elimination.position[block];
    for (BlockIndex s = plan_.elimination.supernode[position]; s != kNoBlock;
         s = plan_.elimination.supernodes[s].parent) {
      path.push_back(s);
    }
    std::size_t length = 0;
    for (std::size_t k = 0; k < size_; ++k) {
      y[position * size_ + k] = 1;
      for (const std::size_t s : path) {
        solveForward(s, y.data(), rows.data());
        double* const first = y.data() + plan_.elimination.supernodes[s].first * size_;
        columns.insert(columns.end(), first, first + plan_.panels[s].columns);
        std::fill(first, first + plan_.panels[s].columns, 0.0);
      }
      if (k == 0) length = columns.size();
    }
    for (std::size_t a = 0; a < size_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double sum = 0;
        for (std::size_t i = 0; i < length; ++i) {
          sum += columns[a * length + i] * columns[b * length + i];
        }
        result[a * size_ + b] = result[b * size_ + a] = sum;
      }
    }
  }

 private:
  struct Workspace {
    std::vector<BlockIndex> place;  // of each position among the rows of a panel
    std::vector<double> product;
  };
  struct Workspaces {
    std::mutex mutex;
    std::vector<Workspace> free;
  };

  bool isGood() const {
    return std::find(is_good_.begin(), is_good_.end(), char(0)) == is_good_.end();
  }

  Workspace takeWorkspace() {
    {
      std::lock_guard<std::mutex> lock(workspaces_->mutex);
      if (!workspaces_->free.empty()) {
        Workspace workspace = std::move(workspaces_->free.back());
        workspaces_->free.pop_back();
        return workspace;
      }
    }
    Workspace workspace;
    workspace.place.resize(blocks());
    workspace.product.resize(plan_.longest * columnGroup() * size_ + kPanelPadding);
    return workspace;
  }
  void giveWorkspace(Workspace workspace) {
    std::lock_guard<std::mutex> lock(workspaces_->mutex);
    workspaces_->free.push_back(std::move(workspace));
  }

  bool eliminate(std::size_t s, Workspace& workspace, unsigned threads) {
    const Supernode& node = plan_.elimination.supernodes[s];
    double* const panel = numbers_.data() + plan_.panels[s].offset;
    std::fill(panel, panel + plan_.panels[s].columns * plan_.panels[s].stride, 0.0);
    for (const PanelEntry& entry : plan_.entries[s]) copyEntry(entry, plan_.panels[s], panel);
    for (BlockIndex c = 0; c < node.columns; ++c) workspace.place[node.first + c] = c;
    for (std::size_t i = 0; i < node.below.size(); ++i) {
      workspace.place[node.below[i]] = node.columns + static_cast<BlockIndex>(i);
    }
    std::vector<double> largest(plan_.panels[s].columns);
    for (std::size_t c = 0; c < largest.size(); ++c)
      largest[c] = panel[c + c * plan_.panels[s].stride];
    if (threads == 1) {
      applyUpdates(s, node.first, node.first + node.columns, workspace.place, workspace.product);
    } else {
      shareUpdates(s, workspace.place, threads);
    }
    is_good_[s] =
        decomposePanel(plan_.panels[s], panel, largest.data(), threads, pivot_[s]) ? 1 : 0;
    return is_good_[s] != 0;
  }

  void copyEntry(const PanelEntry& entry, const Panel& layout, double* panel) const {
    const std::size_t d = size_;
    const double* const from = (entry.is_diagonal ? diagonal_ : beside_) + entry.source * d * d;
    double* const to = panel + entry.row * d + entry.column * d * layout.stride;
    for (std::size_t c = 0; c < d; ++c) {
      for (std::size_t r = 0; r < d; ++r) {
        to[r + c * layout.stride] += entry.is_transposed ? from[c * d + r] : from[r * d + c];
      }
    }
  }

  // Threads have columns of their own, so that nothing depends on their number.
  void shareUpdates(std::size_t s, const std::vector<BlockIndex>& place, unsigned threads) {
    const Supernode& node = plan_.elimination.supernodes[s];
    ParallelOptions parallel;
    parallel.threads = threads;
    parallel.grain = columnGroup();
    parallelChunks(
        node.first, node.first + node.columns,
        [&](std::size_t first, std::size_t last) {
          Workspace workspace = takeWorkspace();
          applyUpdates(s, static_cast<BlockIndex>(first), static_cast<BlockIndex>(last), place,
                       workspace.product);
          giveWorkspace(std::move(workspace));
        },
        parallel);
  }

  // All that is subtracted from columns [first, last) of a supernode.
  void applyUpdates(std::size_t s, BlockIndex first, BlockIndex last,
                    const std::vector<BlockIndex>& place, std::vector<double>& product) {
    for (const PanelUpdate& update : plan_.updates[s]) {
      const std::vector<BlockIndex>& below = plan_.elimination.supernodes[update.from].below;
      const auto begin =
          std::lower_bound(below.begin() + update.begin, below.begin() + update.end, first);
      const auto end = std::lower_bound(begin, below.begin() + update.end, last);
      applyUpdate(update.from, static_cast<std::size_t>(begin - below.begin()),
                  static_cast<std::size_t>(end - below.begin()), plan_.panels[s], place, product);
    }
  }

  // By groups of columns, whose products stay in the cache.
  void applyUpdate(std::size_t s, std::size_t begin, std::size_t end, const Panel& layout,
                   const std::vector<BlockIndex>& place, std::vector<double>& buffer) {
    const std::vector<BlockIndex>& below = plan_.elimination.supernodes[s].below;
    const Panel& from = plan_.panels[s];
    const std::size_t group = columnGroup();
    for (std::size_t first = begin; first < end; first += group) {
      const std::size_t count = std::min(group, end - first);
      PanelProduct product;
      product.a = numbers_.data() + from.offset + from.columns + first * size_;
      product.b = product.a;
      product.stride = from.stride;
      product.rows = (below.size() - first) * size_;
      product.columns = count * size_;
      product.depth = from.columns;
      product.c = buffer.data();
      product.c_stride = plan_.longest;
      product.is_subtracted = false;
      panelKernels().multiply(product);
      for (std::size_t c = 0; c < count; ++c) {
        subtractColumns(product.c + c * size_ * plan_.longest, below.data() + first, c,
                        below.size() - first, layout, place);
      }
    }
  }

  std::size_t columnGroup() const { return std::max<std::size_t>(1, 48 / size_); }

  // A column of blocks, number `diagonal` of those whose rows are `names`, from the diagonal on.
  void subtractColumns(const double* product, const BlockIndex* names, std::size_t diagonal,
                       std::size_t rows, const Panel& layout,
                       const std::vector<BlockIndex>& place) {
    double* const column =
        numbers_.data() + layout.offset + place[names[diagonal]] * size_ * layout.stride;
    for (std::size_t r = diagonal; r < rows;) {
      const BlockIndex first = place[names[r]];
      std::size_t end = r + 1;
      while (end < rows && place[names[end]] == first + (end - r)) ++end;
      for (std::size_t k = 0; k < size_; ++k) {
        double* const to = column + first * size_ + k * layout.stride;
        const double* const by = product + r * size_ + k * plan_.longest;
        for (std::size_t i = 0; i < (end - r) * size_; ++i) to[i] -= by[i];
      }
      r = end;
    }
  }

  void solveForward(std::size_t s, double* y, double* rows) const {
    const Panel& layout = plan_.panels[s];
    const double* const panel = numbers_.data() + layout.offset;
    double* const x = y + plan_.elimination.supernodes[s].first * size_;
    for (std::size_t c = 0; c < layout.columns; ++c) {
      const double* const column = panel + c * layout.stride;
      x[c] /= column[c];
      for (std::size_t r = c + 1; r < layout.columns; ++r) x[r] -= column[r] * x[c];
    }
    const std::vector<BlockIndex>& below = plan_.elimination.supernodes[s].below;
    if (below.empty()) return;
    const std::size_t count = layout.rows - layout.columns;
    std::fill(rows, rows + count, 0.0);
    panelKernels().addProduct(panel + layout.columns, layout.stride, count, layout.columns, x,
                              rows);
    for (std::size_t i = 0; i < below.size(); ++i) {
      for (std::size_t k = 0; k < size_; ++k) y[below[i] * size_ + k] -= rows[i * size_ + k];
    }
  }

  void solveBackward(std::size_t s, double* y, double* rows) const {
    const Panel& layout = plan_.panels[s];
    const double* const panel = numbers_.data() + layout.offset;
    double* const x = y + plan_.elimination.supernodes[s].first * size_;
    const std::vector<BlockIndex>& below = plan_.elimination.supernodes[s].below;
    for (std::size_t i = 0; i < below.size(); ++i) {
      for (std::size_t k = 0; k < size_; ++k) rows[i * size_ + k] = y[below[i] * size_ + k];
    }
    for (std::size_t c = layout.columns; c-- > 0;) {
      const double* const column = panel + c * layout.stride;
      double sum = panelKernels().dot(column + layout.columns, rows, layout.rows - layout.columns);
      for (std::size_t r = c + 1; r < layout.columns; ++r) sum += column[r] * x[r];
      x[c] = (x[c] - sum) / column[c];
    }
  }

  void reorder(double* x, double* y, bool is_forward) const {
    for (std::size_t i = 0; i < blocks(); ++i) {
      double* const outside = x + i * size_;
      double* const inside = y + plan_.elimination.position[i] * size_;
      for (std::size_t k = 0; k < size_; ++k) {
        (is_forward ? inside : outside)[k] = (is_forward ? outside : inside)[k];
      }
    }
  }

  PanelPlan plan_;
  std::size_t size_ = 0;
  std::vector<double> numbers_;
  std::vector<char> is_good_;  // of each supernode
  std::vector<double> pivot_;
  std::unique_ptr<Workspaces> workspaces_ = std::make_unique<Workspaces>();  // so that it moves
  const double* diagonal_ = nullptr;
  const double* beside_ = nullptr;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_SPARSE_BLOCK_CHOLESKY_H
