// Training on more descriptors than the memory holds.
#ifndef GSLAM_VOCABULARY_DETAIL_STREAM_TRAINING_H
#define GSLAM_VOCABULARY_DETAIL_STREAM_TRAINING_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/random.h>
#include <gslam/vocabulary/detail/row_buffer.h>
#include <gslam/vocabulary/detail/training.h>
#include <gslam/vocabulary/image_source.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// One use. Nodes with more descriptors than the memory holds are split by a sample of them; what is
// below them is trained on all of its descriptors, as many nodes in a pass as fit. So only centres
// that are means of very many come from a sample.
class StreamTraining {
 public:
  StreamTraining(std::size_t image_count, const ImageSource& image, Training& training)
      : image_count_(image_count),
        image_(image),
        training_(training),
        sample_random_(training.options.seed) {}

  Vocabulary run() {
    takeSample();
    training_.report.images = image_count_;
    training_.report.descriptors = total_;
    if (!isCancelled()) {
      const std::vector<std::uint8_t> some_row(rows_->row(0), rows_->row(0) + rows_->stride());
      grow();
      growOnlyChild(training_.settings, some_row.data(), training_.tree);
    }
    rows_.reset();
    return training_.finish([&](WordCounts& counts) {
      pass([&](const Descriptors& image, std::size_t i) { counts.add(image, i); });
    });
  }

 private:
  bool isCancelled() const noexcept { return training_.progress.isCancelled(); }

  // visit(image, number) for all of them
  template <class Visitor>
  void pass(const Visitor& visit) {
    ++training_.report.passes;
    for (std::size_t i = 0; i < image_count_; ++i) {
      if (!training_.progress.goesOn()) return;
      visit(image_(i), i);
    }
  }

  // Each descriptor with the same chance: J. S. Vitter, "Random sampling with a reservoir", ACM
  // TOMS 1985, algorithm R. All, in their order, when they fit.
  void takeSample() {
    FloatRange range;
    pass([&](const Descriptors& image, std::size_t i) {
      if (image.count == 0) return;
      if (rows_ == nullptr) makeRoom(image, i);
      checkImage(image, i, format_);
      checkCount(total_ + image.count, training_.options.depth);
      for (std::size_t j = 0; j < image.count; ++j) {
        copyRow(image, i, j, spare_.data(), spare_.size());
        if (!image.is_binary) range.add(reinterpret_cast<float*>(spare_.data()), image.size);
        const std::uint64_t place =
            total_ < rows_->rows() ? total_ : sample_random_.below(total_ + 1);
        ++total_;
        if (place >= rows_->rows()) continue;
        std::memcpy(rows_->row(static_cast<std::size_t>(place)), spare_.data(), spare_.size());
      }
    });
    if (isCancelled()) return;
    checkCount(total_, training_.options.depth);
    training_.setFormat(format_, range);
  }

  // With each row there are its label, distance, place and bounds.
  void makeRoom(const Descriptors& image, std::size_t number) {
    checkDescriptorSize(image, number);
    format_ = rowFormat(image);
    checkStorage(training_.options.storage, format_);
    const std::size_t stride = strideOf(format_);
    const std::size_t per_row = stride + 17;
    const std::size_t least = std::size_t(kLeastPerChild) * training_.options.branching;
    const std::size_t rows = std::min<std::size_t>(training_.options.memory / per_row, kNone);
    if (rows < least) {
      throw ArgumentError("options.memory", "is " + std::to_string(training_.options.memory) +
                                                ", expected at least " +
                                                std::to_string(least * per_row) +
                                                " for these descriptors");
    }
    rows_.reset(new RowBuffer(rows, stride));
    spare_.resize(stride);
  }

  void grow() {
    training_.progress.setTotal(total_ * training_.options.depth);
    if (total_ <= rows_->rows()) {
      training_.grow(rows_->row(0), {training_.root(static_cast<std::size_t>(total_))});
      return;
    }
    Branch root;
    root.root = training_.root(0);
    root.count = total_;
    root.kept = rows_->rows();
    splitBySample(root, branches_);
    while (!branches_.empty() && !isCancelled()) {
      countRows();
      growRound();
    }
  }

  // A leaf, for now, below which the tree goes on.
  struct Branch {
    GrowingNode root;
    std::uint64_t count = 0;  // of its descriptors
    std::uint64_t kept = 0;   // of these, in memory: no more than fit
    std::uint64_t seen = 0;   // in a pass
    std::size_t next = 0;     // row for the next one
  };

  // Splits a node by its rows in memory, and so on as long as those below have more than half of
  // what fits, and enough rows to tell. They become branches.
  void splitBySample(const Branch& branch, std::vector<Branch>& branches) {
    const double kept = static_cast<double>(branch.kept);
    const double half_full = static_cast<double>(rows_->rows()) / 2;
    const auto least = static_cast<std::size_t>(
        std::max(half_full * kept / static_cast<double>(branch.count) + 1,
                 static_cast<double>(kLeastPerChild * training_.options.branching)));
    GrowingNode root = branch.root;
    root.first = 0;
    root.count = static_cast<std::size_t>(branch.kept);
    NodeSplitter splitter(training_.settings, training_.options.parallel, training_.progress);
    const std::function<bool(double)> nobody;
    TrainingProgress unused(nobody);  // of a sample: countRows() says what it was good for
    const std::vector<GrowingNode> rest =
        growBig(splitter, rows_->row(0), rows_->stride(), {root}, least, training_.tree, unused);
    training_.counts += splitter.counts();
    for (const GrowingNode& node : rest) {
      if (node.levels == 0) continue;
      Branch next;
      next.root = node;
      branches.push_back(next);
    }
  }

  // How many descriptors fall on each branch, and how many on none.
  void countRows() {
    makeTop();
    std::uint64_t work_left = 0;
    pass([&](const Descriptors& image, std::size_t number) {
      checkImage(image, number, format_);
      for (const std::uint32_t node : leavesOf(top_, image)) {
        if (branch_of_[node] == kNone) continue;
        Branch& branch = branches_[branch_of_[node]];
        ++branch.count;
        work_left += branch.root.levels;
      }
    });
    for (Branch& branch : branches_) {
      branch.kept = std::min<std::uint64_t>(branch.count, rows_->rows());
    }
    training_.progress.setDone(total_ * training_.options.depth - work_left);
  }

  // The top of the tree as a vocabulary, which finds the branch of a descriptor.
  void makeTop() {
    SplitSettings settings = training_.settings;
    settings.storage = settings.format;
    const std::vector<std::uint32_t> order = breadthFirst(training_.tree);
    std::vector<std::uint32_t> branch_of_grown(order.size(), kNone);
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      branch_of_grown[branches_[b].root.node] = static_cast<std::uint32_t>(b);
    }
    top_ = buildVocabulary(treeDataOf(training_.tree, order, settings, training_.options.depth),
                           "training");
    branch_of_.clear();
    for (const std::uint32_t grown : order) branch_of_.push_back(branch_of_grown[grown]);
  }

  // Trains the branches, as many in a pass as fit. What does not fit is split once more by a
  // sample, and its parts are the branches of the next round.
  void growRound() {
    std::vector<Branch> next_round;
    for (std::size_t first = 0; first < branches_.size();) {
      const std::size_t end = placeRows(first);
      takeRows(first, end);
      if (isCancelled()) return;
      if (isLarge(branches_[first])) {
        splitBySample(branches_[first], next_round);
      } else {
        growBranches(first, end);
      }
      first = end;
    }
    branches_.swap(next_round);
  }

  static bool isLarge(const Branch& branch) { return branch.kept < branch.count; }

  // Gives rows of the memory to a large branch, or to as many that are not as fit. Returns the one
  // behind them.
  std::size_t placeRows(std::size_t first) {
    std::size_t rows = 0;
    for (std::size_t b = first; b < branches_.size(); ++b) {
      Branch& branch = branches_[b];
      const bool fits = !isLarge(branch) && branch.kept <= rows_->rows() - rows;
      if (b != first && !fits) return b;
      branch.next = branch.root.first = rows;
      branch.root.count = static_cast<std::size_t>(branch.kept);
      rows += branch.root.count;
      if (isLarge(branch)) return b + 1;
    }
    return branches_.size();
  }

  void growBranches(std::size_t first, std::size_t end) {
    std::vector<GrowingNode> growing;
    for (std::size_t b = first; b < end; ++b) {
      if (branches_[b].count != 0) growing.push_back(branches_[b].root);
    }
    training_.grow(rows_->row(0), growing);
  }

  // Brings the descriptors of some branches into the memory.
  void takeRows(std::size_t first, std::size_t end) {
    pass([&](const Descriptors& image, std::size_t number) {
      takeRowsOf(image, number, first, end);
    });
    if (isCancelled()) return;
    for (std::size_t b = first; b < end; ++b) {
      if (branches_[b].seen != branches_[b].count) refusePass("fewer");
    }
  }

  // Of one image: all that fall on a branch, or an even part of them.
  void takeRowsOf(const Descriptors& image, std::size_t number, std::size_t first,
                  std::size_t end) {
    checkImage(image, number, format_);
    const std::vector<std::uint32_t> nodes = leavesOf(top_, image);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t b = branch_of_[nodes[i]];
      if (b < first || b >= end) continue;
      Branch& branch = branches_[b];
      if (branch.seen == branch.count) refusePass("more");
      const std::uint64_t before = branch.seen * branch.kept / branch.count;
      const std::uint64_t after = ++branch.seen * branch.kept / branch.count;
      if (after != before) copyRow(image, number, i, rows_->row(branch.next++), rows_->stride());
    }
  }

  [[noreturn]] static void refusePass(const char* how_many) {
    throw ArgumentError("image", std::string("gave ") + how_many +
                                     " descriptors of a kind than in the pass before, expected " +
                                     "the same in each");
  }

  static constexpr std::uint32_t kLeastPerChild = 64;

  const std::size_t image_count_;
  const ImageSource& image_;
  Training& training_;
  SplitMix64 sample_random_;
  DescriptorFormat format_;
  std::uint64_t total_ = 0;
  std::unique_ptr<RowBuffer> rows_;
  std::vector<std::uint8_t> spare_;  // one row
  std::vector<Branch> branches_;
  Vocabulary top_;
  std::vector<std::uint32_t> branch_of_;  // of nodes of top_; kNone: there is none
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_STREAM_TRAINING_H
