#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SWEEP_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SWEEP_H

#include <gslam/optimizer/options.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "bundle/fast_kernels.h"
#include "bundle/fast_state.h"
#include "bundle/fast_structure.h"

// What is done with the observations and points of a task: residuals, derivatives, elimination.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Of a point: kInverse and kU.
constexpr std::size_t kRootNumbers = 9;

// What a task is computed in.
struct FastScratch {
  FastLanes lanes;
  std::size_t stride = 0;        // of observations
  std::size_t point_stride = 0;  // of points
  std::vector<double> rows;      // kObservationRows of `stride`
  std::vector<double> points;    // kPointRows of `point_stride`
  std::vector<double> factors;   // roots of the information or of weights
};

// Scratches for as many threads as are at work.
class FastScratches {
 public:
  std::unique_ptr<FastScratch> take();
  void giveBack(std::unique_ptr<FastScratch> scratch);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<FastScratch>> free_;
};

struct FastTask {
  std::size_t first_point, last_point, first, last;  // points and observations
  std::size_t observations() const { return last - first; }
  std::size_t points() const { return last_point - first_point; }
};

// What a step does to the points of a task.
struct FastPointStep {
  double cost = 0;            // after it
  double model_decrease = 0;  // of the observations
  double squared_step = 0;
  double squared_points = 0;
};

class FastSweep {
 public:
  FastSweep(const BundleProblem& problem, const FastStructure& structure, const RobustLoss& loss)
      : problem_(problem), structure_(structure), loss_(loss), kernels_(fastKernels()) {}

  std::size_t taskCount() const { return structure_.task_begin.size() - 1; }
  FastTask task(std::size_t number) const;
  void prepare(FastScratch& scratch) const;

  // Weighted residuals and derivatives, and the points' H, gradient and inverse roots. The cost.
  double linearize(const FastState& state, const FastTask& task, double damping,
                   FastScratch& scratch) const;
  // After linearize(): rows kHalf, kRoot and kReduced.
  void eliminate(const FastTask& task, FastScratch& scratch) const;
  // Moves the points to go with the step of the blocks, and looks at the result. `roots`: what
  // keepRoots() made of all points at the state; `steps`: kStepNumbers of each block, then zeros.
  template <class T>
  FastPointStep movePoints(const FastState& state, const FastTask& task,
                           const std::vector<double>& steps, const T* roots, FastState& moved,
                           FastScratch& scratch) const;
  // After linearize(): kRootNumbers of each point of the task.
  template <class T>
  void keepRoots(const FastTask& task, const FastScratch& scratch, T* roots) const;
  // After linearize(): the largest element of a point's gradient.
  double gradientMax(const FastTask& task, const FastScratch& scratch) const;
  double cost(const FastState& state, const FastTask& task, FastScratch& scratch) const;
  // Observations whose weight is at least a half.
  std::size_t countInliers(const FastState& state, const FastTask& task,
                           FastScratch& scratch) const;

 private:
  bool isFixed(std::size_t point) const {
    return !problem_.point_fixed.empty() && problem_.point_fixed[structure_.points[point]] != 0;
  }
  enum class Pass { Residuals, Derivatives, Changes };  // what is computed

  // The cost; rows of residuals, and of what else is computed, weighted.
  double evaluate(const FastState& state, const FastTask& task, Pass pass, const double* steps,
                  FastScratch& scratch) const;
  void residuals(const FastState& state, const FastTask& task, Pass pass, const double* steps,
                 FastScratch& scratch) const;
  // Places observations from `first` on in lanes; `point` is that of the first, then of the next.
  void fill(const FastState& state, const FastTask& task, std::size_t first, std::size_t& point,
            FastLanes& lanes) const;
  void project(std::size_t first, std::size_t count, bool with_slopes, FastLanes& lanes) const;
  void whiten(const FastTask& task, Pass pass, FastScratch& scratch) const;
  double weigh(const FastTask& task, Pass pass, FastScratch& scratch) const;
  void sumPoints(const FastTask& task, FastScratch& scratch) const;

  const BundleProblem& problem_;
  const FastStructure& structure_;
  const RobustLoss loss_;
  const FastKernels& kernels_;
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_FAST_SWEEP_H
