#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SCHUR_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SCHUR_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bundle/fast_kernels.h"
#include "bundle/fast_pattern.h"
#include "bundle/fast_state.h"
#include "bundle/fast_structure.h"
#include "bundle/fast_sweep.h"
#include "bundle/fast_views.h"
#include "raw_vector.h"

// The reduced matrix: what is left of the normal equations when points are eliminated.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// The matrix in numbers of type T, with its diagonal in double. Memory: observations pass through
// a window; only a matrix that is not formed keeps them, if they are few.
template <class T>
class FastSchur {
 public:
  // `pattern`: that of the structure where the matrix is explicit. `wants_whole`: whole() is asked
  // for, or it is not explicit.
  FastSchur(const FastStructure& structure, FastPattern pattern, const FastSweep& sweep,
            bool is_explicit, bool wants_whole, unsigned threads);

  // At the state; the cost there.
  double build(const FastState& state, double damping);
  double gradientMax() const { return gradient_max_; }
  // y = A x, with damping. Vectors have `freedom` numbers for each block.
  void multiply(const std::vector<double>& x, std::vector<double>& y);
  // A step of the blocks goes on to the points.
  FastPointStep movePoints(const FastState& state, const std::vector<double>& step,
                           FastState& moved);
  std::size_t countInliers(const FastState& state);

  // What build() and a look at its step cost, in products.
  double productsOfBuild() const { return products_of_build_; }

  std::size_t blocks() const { return structure_.blocks.size(); }
  std::size_t freedom() const { return structure_.freedom; }
  std::size_t size() const { return blocks() * freedom(); }
  bool isExplicit() const { return is_explicit_; }
  const FastPattern& pattern() const { return pattern_; }
  // Element of a block right of the diagonal.
  double element(std::size_t slot, std::size_t row, std::size_t column) const {
    const std::size_t place = placeInBlock(row, column);
    const std::size_t stride = blockStride(freedom());
    return static_cast<double>(place < stride ? off_diagonal_[slot * stride + place]
                                              : corners_[slot]);
  }
  // kMostBlock numbers a block: of A, and of the matrix before points are eliminated, with damping.
  // Of the latter only the diagonal where it is not wanted.
  const double* diagonal(std::size_t block) const { return &damped_[block * kMostBlock]; }
  const double* whole(std::size_t block) const { return &outer_[block * kMostBlock]; }
  // The negative gradient of the reduced system, and the gradient itself.
  const std::vector<double>& rightSide() const { return right_side_; }
  const std::vector<double>& gradient() const { return gradient_; }

 private:
  struct Window {
    std::size_t first_task, last_task;
    std::uint32_t first, last;  // observations
  };

  void makeWindows();
  void makeGroups();
  void fillWindow(std::size_t number, const FastState& state, double damping);
  void addWindow(std::size_t number);
  void finish(double damping);
  void multiplyExplicit(const std::vector<double>& x, std::vector<double>& y);
  void multiplyGroup(std::size_t group);
  void sumGroups(std::size_t block, const double* x, double* y) const;
  void multiplyImplicit(const std::vector<double>& x, std::vector<double>& y);
  void sumByPoint(std::size_t number);
  void subtractByBlock(std::size_t number, std::vector<double>& y);
  FastRecord<T>* recordsOf(std::size_t window) {
    return records_.data() + (is_resident_ ? windows_[window].first : 0);
  }

  const FastStructure& structure_;
  const FastSweep& sweep_;
  const FastBlockKernels<T>& kernels_;
  const bool is_explicit_;
  const bool wants_whole_;
  const unsigned threads_;
  FastPattern pattern_;
  FastScratches scratches_;
  std::vector<Window> windows_;
  std::vector<std::uint32_t> cuts_;  // for each window and block: place in the row where it begins
  bool is_resident_ = false;         // whether all windows have records of their own
  std::vector<FastRecord<T>> records_;
  std::vector<FastSide<T>> sides_;
  RawVector<T> roots_;  // kRootNumbers of each point
  RawVector<T> off_diagonal_storage_;
  T* off_diagonal_ = nullptr;  // aligned
  std::vector<T> corners_;
  std::vector<double> diagonal_, outer_, damped_;
  std::vector<double> gradient_, reduced_, right_side_;
  std::vector<double> task_cost_, task_gradient_;
  double gradient_max_ = 0;
  double products_of_build_ = 0;
  std::vector<std::size_t> groups_;  // first rows of the groups of a product; one more as the end
  std::vector<T> x_, y_;             // of products
  std::vector<double> steps_;        // kStepNumbers of each block, then zeros
  std::vector<double> by_point_;     // of products that are not formed
  const FastState* state_ = nullptr;
  double damping_ = 0;
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SCHUR_H
