#include <gslam/base/parallel.h>

#include <algorithm>
#include <cstdint>

#include "bundle/fast_schur.h"

// Products of the reduced matrix and a vector.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr std::size_t kGroups = 16;
constexpr std::size_t kBlocksOfGroup = 2000;

void multiplyBlock(const double* block, std::size_t freedom, const double* x, double* y) {
  for (std::size_t r = 0; r < freedom; ++r) {
    double sum = 0;
    for (std::size_t c = 0; c < freedom; ++c) sum += block[placeInBlock(r, c)] * x[c];
    y[r] = sum;
  }
}

}  // namespace

// Rows with about as many blocks: groups write to vectors of their own, which are summed in their
// order, whoever computes them.
template <class T>
void FastSchur<T>::makeGroups() {
  const std::size_t slots = pattern_.columns.size();
  const std::size_t count = std::min(kGroups, 1 + slots / kBlocksOfGroup);
  groups_.assign(1, 0);
  for (std::size_t row = 0; row < blocks(); ++row) {
    if (pattern_.row_begin[row + 1] * count >= slots * groups_.size() && row + 1 < blocks() &&
        groups_.size() < count) {
      groups_.push_back(row + 1);
    }
  }
  groups_.push_back(blocks());
  y_.assign((groups_.size() - 1) * 16 * blocks(), T(0));
}

template <class T>
void FastSchur<T>::multiply(const std::vector<double>& x, std::vector<double>& y) {
  for (std::size_t b = 0; b < blocks(); ++b) {
    for (std::size_t c = 0; c < freedom(); ++c) {
      x_[16 * b + c] = static_cast<T>(x[b * freedom() + c]);
    }
  }
  is_explicit_ ? multiplyExplicit(x, y) : multiplyImplicit(x, y);
}

template <class T>
void FastSchur<T>::multiplyExplicit(const std::vector<double>& x, std::vector<double>& y) {
  parallelFor(
      0, groups_.size() - 1, [&](std::size_t g) { multiplyGroup(g); }, fastParallel(1, threads_));
  parallelChunks(
      0, blocks(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) sumGroups(b, x.data(), y.data());
      },
      fastParallel(256, threads_));
}

template <class T>
void FastSchur<T>::multiplyGroup(std::size_t group) {
  const std::size_t length = 16 * blocks();
  T* const sums = y_.data() + group * length;
  std::fill(sums + 16 * groups_[group], sums + length, T(0));
  for (std::size_t row = groups_[group]; row < groups_[group + 1]; ++row) {
    FastProduct<T> product;
    const std::size_t begin = pattern_.row_begin[row];
    product.blocks = off_diagonal_ + begin * blockStride(freedom());
    product.corners = corners_.data() + (freedom() == 9 ? begin : 0);
    product.columns = pattern_.columns.data() + begin;
    product.count = pattern_.row_begin[row + 1] - begin;
    product.x = x_.data();
    product.y = sums;
    kernels_.multiplyRow(product, row, freedom());
  }
}

// A block of the product: what the groups found, in their order, and the diagonal.
template <class T>
void FastSchur<T>::sumGroups(std::size_t block, const double* x, double* y) const {
  double sums[16] = {};
  for (std::size_t g = 0; g + 1 < groups_.size() && groups_[g] <= block; ++g) {
    const T* const part = y_.data() + 16 * (g * blocks() + block);
    for (std::size_t c = 0; c < 16; ++c) sums[c] += static_cast<double>(part[c]);
  }
  for (std::size_t c = 9; c < 16; ++c) sums[8] += sums[c];
  double* const result = y + block * freedom();
  multiplyBlock(diagonal(block), freedom(), x + block * freedom(), result);
  for (std::size_t r = 0; r < freedom(); ++r) result[r] += sums[r];
}

// y = (whole matrix of the blocks) x - W H^-1 W^T x, with V V^T for the latter.
template <class T>
void FastSchur<T>::multiplyImplicit(const std::vector<double>& x, std::vector<double>& y) {
  for (std::size_t b = 0; b < blocks(); ++b) {
    multiplyBlock(whole(b), freedom(), &x[b * freedom()], &y[b * freedom()]);
  }
  for (std::size_t number = 0; number < windows_.size(); ++number) {
    if (!is_resident_ && windows_.size() > 1) fillWindow(number, *state_, damping_);
    sumByPoint(number);
    subtractByBlock(number, y);
  }
}

// V^T x of each point of the window.
template <class T>
void FastSchur<T>::sumByPoint(std::size_t number) {
  const Window& window = windows_[number];
  const FastRecord<T>* const records = recordsOf(number);
  const auto sumTask = [&](std::size_t i) {
    const FastTask task = sweep_.task(i);
    for (std::size_t p = task.first_point; p < task.last_point; ++p) {
      const std::size_t first = structure_.point_begin[p] - window.first;
      const std::size_t last = structure_.point_begin[p + 1] - window.first;
      double sums[3] = {};
      for (std::size_t k = first; k < records[first].end; ++k) {
        const T* const from = x_.data() + 16 * std::size_t(records[k].block);
        for (std::size_t row = 0; row < 3; ++row) {
          T sum = records[k].ninth[row] * from[8];
          for (std::size_t c = 0; c < 8; ++c) sum += records[k].v[row][c] * from[c];
          sums[row] += static_cast<double>(sum);
        }
      }
      for (std::size_t k = first; k < last; ++k) std::copy_n(sums, 3, &by_point_[3 * k]);
    }
  };
  parallelFor(window.first_task, window.last_task, sumTask, fastParallel(4, threads_));
}

// y -= V of what sumByPoint() found.
template <class T>
void FastSchur<T>::subtractByBlock(std::size_t number, std::vector<double>& y) {
  const Window& window = windows_[number];
  const FastRecord<T>* const records = recordsOf(number);
  const std::uint32_t* const from = cuts_.data() + number * blocks();
  const auto subtractRow = [&](std::size_t row) {
    double sums[9] = {};
    for (std::size_t i = from[row]; i < from[blocks() + row]; ++i) {
      const std::size_t k = structure_.row[i] - window.first;
      for (std::size_t e = 0; e < 3; ++e) {
        const double t = by_point_[3 * k + e];
        for (std::size_t c = 0; c < 8; ++c) sums[c] += double(records[k].v[e][c]) * t;
        sums[8] += double(records[k].ninth[e]) * t;
      }
    }
    for (std::size_t c = 0; c < freedom(); ++c) y[row * freedom() + c] -= sums[c];
  };
  parallelFor(0, blocks(), subtractRow,
              fastParallel(std::max<std::size_t>(1, blocks() / 64), threads_));
}

template void FastSchur<float>::makeGroups();
template void FastSchur<double>::makeGroups();
template void FastSchur<float>::multiply(const std::vector<double>&, std::vector<double>&);
template void FastSchur<double>::multiply(const std::vector<double>&, std::vector<double>&);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
