#include "bundle/fast_schur.h"

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr std::size_t kWindowObservations = 8192;
constexpr std::size_t kWideWindow = 32768;                   // passes a large matrix less often
constexpr std::size_t kLargeMatrix = std::size_t(32) << 20;  // bytes, more than a cache has

}  // namespace

template <class T>
FastSchur<T>::FastSchur(const FastStructure& structure, FastPattern pattern, const FastSweep& sweep,
                        bool is_explicit, bool wants_whole, unsigned threads)
    : structure_(structure),
      sweep_(sweep),
      kernels_(fastBlockKernels<T>()),
      is_explicit_(is_explicit),
      wants_whole_(wants_whole || !is_explicit),
      threads_(threads),
      pattern_(std::move(pattern)) {
  if (is_explicit) {
    const std::size_t slots = pattern_.columns.size();
    off_diagonal_storage_.resize(slots * blockStride(freedom()) + 64 / sizeof(T));
    const auto address = reinterpret_cast<std::uintptr_t>(off_diagonal_storage_.data());
    off_diagonal_ = off_diagonal_storage_.data() + (64 - address % 64) % 64 / sizeof(T);
    if (freedom() == 9) corners_.resize(slots);
    makeGroups();
  }
  makeWindows();
  std::size_t most = 0;
  for (const Window& window : windows_)
    most = std::max<std::size_t>(most, window.last - window.first);
  is_resident_ = !is_explicit && isResident<T>(structure.observationCount());
  records_.resize(is_resident_ ? structure.observationCount() : most);
  sides_.resize(most);
  if (!is_explicit) by_point_.resize(3 * most);
  roots_.resize(kRootNumbers * structure.points.size());
  steps_.assign(kStepNumbers * (blocks() + 1), 0);
  diagonal_.resize(blocks() * kMostBlock);
  outer_.resize(blocks() * kMostBlock);
  damped_.resize(blocks() * kMostBlock);
  gradient_.resize(blocks() * 9);
  reduced_.resize(blocks() * 9);
  right_side_.resize(size());
  task_cost_.resize(sweep.taskCount());
  task_gradient_.resize(sweep.taskCount());
  x_.assign(16 * blocks(), T(0));
  const FastPrices prices = pricesOf(sizesOf<T>(structure, pattern_), is_explicit);
  products_of_build_ = prices.build / std::max(1.0, prices.product);
}

template <class T>
void FastSchur<T>::makeWindows() {
  const std::size_t matrix = pattern_.columns.size() * blockStride(freedom()) * sizeof(T);
  const std::size_t most = matrix > kLargeMatrix ? kWideWindow : kWindowObservations;
  std::size_t first_task = 0;
  for (std::size_t i = 0; i < sweep_.taskCount(); ++i) {
    const std::size_t first = sweep_.task(first_task).first, last = sweep_.task(i).last;
    const bool is_last = i + 1 == sweep_.taskCount();
    const bool is_full = !is_last && sweep_.task(i + 1).last - first > most;
    if (!is_last && !is_full) continue;
    windows_.push_back(
        {first_task, i + 1, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)});
    first_task = i + 1;
  }
  cuts_.resize((windows_.size() + 1) * blocks());
  const auto cutRow = [&](std::size_t block) {
    std::uint32_t at = structure_.row_begin[block];
    const std::uint32_t end = structure_.row_begin[block + 1];
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      cuts_[i * blocks() + block] = at;
      while (at < end && structure_.row[at] < windows_[i].last) ++at;
    }
    cuts_[windows_.size() * blocks() + block] = at;
  };
  parallelFor(0, blocks(), cutRow, fastParallel(1 + blocks() / 64, threads_));
}

template <class T>
double FastSchur<T>::build(const FastState& state, double damping) {
  state_ = &state;
  damping_ = damping;
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0);
  std::fill(outer_.begin(), outer_.end(), 0.0);
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  std::fill(reduced_.begin(), reduced_.end(), 0.0);
  if (is_explicit_) {
    parallelChunks(
        0, off_diagonal_storage_.size(),
        [&](std::size_t first, std::size_t last) {
          std::fill_n(off_diagonal_storage_.data() + first, last - first, T(0));
        },
        fastParallel(std::size_t(1) << 18, threads_));
    std::fill(corners_.begin(), corners_.end(), T(0));
  }
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    fillWindow(i, state, damping);
    addWindow(i);
  }
  finish(damping);
  double cost = 0;
  for (const double part : task_cost_) cost += part;
  return cost;
}

template <class T>
void FastSchur<T>::fillWindow(std::size_t number, const FastState& state, double damping) {
  const Window& window = windows_[number];
  FastRecord<T>* const records = recordsOf(number);
  parallelChunks(
      window.first_task, window.last_task,
      [&](std::size_t first, std::size_t last) {
        std::unique_ptr<FastScratch> scratch = scratches_.take();
        for (std::size_t i = first; i < last; ++i) {
          const FastTask task = sweep_.task(i);
          task_cost_[i] = sweep_.linearize(state, task, damping, *scratch);
          task_gradient_[i] = sweep_.gradientMax(task, *scratch);
          sweep_.keepRoots(task, *scratch, roots_.data() + task.first_point * kRootNumbers);
          sweep_.eliminate(task, *scratch);
          const std::size_t begin = task.first - window.first;
          kernels_.makeRecords(scratch->rows.data(), scratch->stride, freedom(),
                               task.observations(), records + begin, sides_.data() + begin);
          for (std::size_t p = task.first_point; p < task.last_point; ++p) {
            std::size_t end = structure_.point_begin[p + 1];
            const std::size_t start = structure_.point_begin[p];
            while (end > start && structure_.blockOf(end - 1) == kNoBlock) --end;
            for (std::size_t k = start; k < structure_.point_begin[p + 1]; ++k) {
              FastRecord<T>& record = records[k - window.first];
              record.block = structure_.blockOf(k);
              record.end = static_cast<std::uint32_t>(end) - window.first;
            }
          }
        }
        scratches_.giveBack(std::move(scratch));
      },
      fastParallel(4, threads_));
}

template <class T>
void FastSchur<T>::addWindow(std::size_t number) {
  const Window& window = windows_[number];
  const FastRecord<T>* const records = recordsOf(number);
  const std::uint32_t* const from = cuts_.data() + number * blocks();
  const std::uint32_t* const to = from + blocks();
  const std::size_t grain = std::max<std::size_t>(1, blocks() / 64);
  parallelChunks(
      0, blocks(),
      [&](std::size_t first, std::size_t last) {
        static thread_local std::vector<std::uint32_t> slot_of;
        if (slot_of.size() < blocks()) slot_of.resize(blocks());
        for (std::size_t row = first; row < last; ++row) {
          if (from[row] == to[row]) continue;
          FastRow<T> target;
          if (is_explicit_) {
            const std::size_t begin = pattern_.row_begin[row];
            const std::size_t end = pattern_.row_begin[row + 1];
            for (std::size_t i = begin; i < end; ++i) {
              slot_of[pattern_.columns[i]] = static_cast<std::uint32_t>(i - begin);
            }
            target.blocks = off_diagonal_ + begin * blockStride(freedom());
            target.corners = corners_.data() + (freedom() == 9 ? begin : 0);
            target.slot_of = slot_of.data();
          }
          target.diagonal = &diagonal_[row * kMostBlock];
          target.outer = &outer_[row * kMostBlock];
          target.gradient = &gradient_[row * 9];
          target.reduced = &reduced_[row * 9];
          target.is_whole = wants_whole_;
          kernels_.addRow(records, sides_.data(), structure_.row.data() + from[row],
                          to[row] - from[row], window.first, freedom(), target);
        }
      },
      fastParallel(grain, threads_));
}

// Diagonals with damping, right side, largest gradient.
template <class T>
void FastSchur<T>::finish(double damping) {
  gradient_max_ = 0;
  for (const double part : task_gradient_) gradient_max_ = std::max(gradient_max_, part);
  for (std::size_t b = 0; b < blocks(); ++b) {
    double* const outer = &outer_[b * kMostBlock];
    const double* const diagonal = &diagonal_[b * kMostBlock];
    double* const damped = &damped_[b * kMostBlock];
    for (std::size_t i = 0; i < kMostBlock; ++i) {
      outer[i] += diagonal[i];
      damped[i] = diagonal[i];
    }
    for (std::size_t c = 0; c < freedom(); ++c) {
      const std::size_t place = placeInBlock(c, c);
      // What no residual depends on stays where it is.
      const double added =
          outer[place] > 0
              ? damping * std::min(std::max(outer[place], kLeastDiagonal), kMostDiagonal)
              : 1.0;
      outer[place] += added;
      damped[place] += added;
      right_side_[b * freedom() + c] = -reduced_[b * 9 + c];
      gradient_max_ = std::max(gradient_max_, std::fabs(gradient_[b * 9 + c]));
    }
  }
}

template <class T>
FastPointStep FastSchur<T>::movePoints(const FastState& state, const std::vector<double>& step,
                                       FastState& moved) {
  for (std::size_t b = 0; b < blocks(); ++b) {
    std::copy_n(&step[b * freedom()], freedom(), &steps_[b * kStepNumbers]);
  }
  return parallelReduce(
      0, sweep_.taskCount(), FastPointStep(),
      [&](std::size_t first, std::size_t last) {
        FastPointStep sum;
        std::unique_ptr<FastScratch> scratch = scratches_.take();
        for (std::size_t i = first; i < last; ++i) {
          const FastTask task = sweep_.task(i);
          const FastPointStep part =
              sweep_.movePoints(state, task, steps_, roots_.data(), moved, *scratch);
          sum.cost += part.cost;
          sum.model_decrease += part.model_decrease;
          sum.squared_step += part.squared_step;
          sum.squared_points += part.squared_points;
        }
        scratches_.giveBack(std::move(scratch));
        return sum;
      },
      [](FastPointStep sum, const FastPointStep& part) {
        sum.cost += part.cost;
        sum.model_decrease += part.model_decrease;
        sum.squared_step += part.squared_step;
        sum.squared_points += part.squared_points;
        return sum;
      },
      fastParallel(4, threads_));
}

template <class T>
std::size_t FastSchur<T>::countInliers(const FastState& state) {
  return parallelReduce(
      0, sweep_.taskCount(), std::size_t(0),
      [&](std::size_t first, std::size_t last) {
        std::size_t inliers = 0;
        std::unique_ptr<FastScratch> scratch = scratches_.take();
        for (std::size_t i = first; i < last; ++i) {
          inliers += sweep_.countInliers(state, sweep_.task(i), *scratch);
        }
        scratches_.giveBack(std::move(scratch));
        return inliers;
      },
      [](std::size_t sum, std::size_t part) { return sum + part; }, fastParallel(4, threads_));
}

template class FastSchur<float>;
template class FastSchur<double>;

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
