#include "bundle/fast_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "factors/loss.h"
#include "factors/reprojection.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

std::size_t roundedUp(std::size_t n) {
  return (n + kLanes - 1) / kLanes * kLanes;
}

}  // namespace

std::unique_ptr<FastScratch> FastScratches::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_.empty()) return std::unique_ptr<FastScratch>(new FastScratch());
  std::unique_ptr<FastScratch> scratch = std::move(free_.back());
  free_.pop_back();
  return scratch;
}

void FastScratches::giveBack(std::unique_ptr<FastScratch> scratch) {
  const std::lock_guard<std::mutex> lock(mutex_);
  free_.push_back(std::move(scratch));
}

FastTask FastSweep::task(std::size_t number) const {
  FastTask task;
  task.first_point = structure_.task_begin[number];
  task.last_point = structure_.task_begin[number + 1];
  task.first = structure_.point_begin[task.first_point];
  task.last = structure_.point_begin[task.last_point];
  return task;
}

// Rows a page apart would share the sets of the cache.
void FastSweep::prepare(FastScratch& scratch) const {
  if (scratch.stride != 0) return;
  scratch.stride = roundedUp(structure_.most_in_task) + 8;
  scratch.point_stride = scratch.stride;  // each point has an observation
  scratch.rows.assign(kObservationRows * scratch.stride, 0);
  scratch.points.assign(kPointRows * scratch.point_stride, 0);
  scratch.factors.assign(3 * scratch.stride, 0);
}

void FastSweep::fill(const FastState& state, const FastTask& task, std::size_t first,
                     std::size_t& point, FastLanes& lanes) const {
  const std::size_t numbers = viewNumbers(structure_);
  const std::size_t count = std::min(kLanes, task.last - first);
  const std::uint32_t* const views = structure_.view_of.data() + first;
  for (std::size_t j = 0; j < kLanes; ++j) lanes.view_index[j] = views[std::min(j, count - 1)];
  kernels_.gather(state.views.data(), numbers, lanes.view_index, numbers, lanes.view);
  const std::uint32_t* const begin = structure_.point_begin.data() + 1;
  for (std::size_t j = 0; j < kLanes; ++j) {
    point += j < count && begin[point] <= first + j ? 1U : 0U;
    for (std::size_t i = 0; i < 3; ++i) lanes.world[i][j] = state.points[3 * point + i];
  }
}

void FastSweep::project(std::size_t first, std::size_t count, bool with_slopes,
                        FastLanes& lanes) const {
  with_slopes ? kernels_.plainSlopes(lanes, structure_.freedom == 9) : kernels_.plainPixel(lanes);
  if (structure_.all_plain) return;
  // A plain camera keeps its derivatives by intrinsics beside one that is not.
  for (std::size_t j = 0; j < kLanes; ++j) {
    const std::size_t k = first + std::min(j, count - 1);
    const FastView& view = structure_.views[structure_.view_of[k]];
    if (view.is_plain) continue;
    const Vec3d local = {lanes.local[0][j], lanes.local[1][j], lanes.local[2][j]};
    Vec2d pixel{};
    Mat<double, 2, 3> slope{};
    if (!projectEverywhere(problem_.cameras[view.camera], local, pixel,
                           with_slopes ? &slope : nullptr)) {
      pixel = {std::numeric_limits<double>::quiet_NaN(), 0};
    }
    lanes.pixel[0][j] = pixel[0];
    lanes.pixel[1][j] = pixel[1];
    for (std::size_t i = 0; i < 6; ++i) lanes.slope[i][j] = slope.values[i];
    for (std::size_t i = 0; i < 6; ++i) lanes.intrinsics[i][j] = 0;
  }
}

void FastSweep::residuals(const FastState& state, const FastTask& task, Pass pass,
                          const double* steps, FastScratch& scratch) const {
  FastLanes& lanes = scratch.lanes;
  double* const rows = scratch.rows.data();
  std::size_t point = task.first_point;
  for (std::size_t first = task.first; first < task.last; first += kLanes) {
    const std::size_t count = std::min(kLanes, task.last - first);
    const std::size_t column = first - task.first;
    fill(state, task, first, point, lanes);
    kernels_.toCamera(lanes);
    project(first, count, pass != Pass::Residuals, lanes);
    if (pass == Pass::Derivatives) {
      kernels_.jacobians(lanes, structure_.has_rig, structure_.freedom, rows + column,
                         scratch.stride);
    } else if (pass == Pass::Changes) {
      for (std::size_t j = 0; j < kLanes; ++j) {
        const std::uint32_t block = structure_.block_of_view[lanes.view_index[j]];
        const bool has_block = block != kNoBlock;
        lanes.block_index[j] =
            has_block ? block : static_cast<std::uint32_t>(structure_.blocks.size());
      }
      kernels_.gather(steps, kStepNumbers, lanes.block_index, kStepNumbers, lanes.step);
      kernels_.changes(lanes, structure_.has_rig, structure_.freedom, rows + column,
                       scratch.stride);
    }
    double* const u = rows + kResidual * scratch.stride + column;
    double* const v = u + scratch.stride;
    const double* const seen_u = structure_.seen_u.data() + first;
    const double* const seen_v = structure_.seen_v.data() + first;
    for (std::size_t j = 0; j < count; ++j) {
      u[j] = lanes.pixel[0][j] - seen_u[j];
      v[j] = lanes.pixel[1][j] - seen_v[j];
    }
    for (std::size_t j = count; j < kLanes; ++j) u[j] = v[j] = 0;
  }
}

void FastSweep::whiten(const FastTask& task, Pass pass, FastScratch& scratch) const {
  const std::size_t n = task.observations(), padded = roundedUp(n), stride = scratch.stride;
  double* const roots = scratch.factors.data();
  for (std::size_t k = 0; k < padded; ++k) {
    const Vec3d& w = problem_.information[structure_.sources[task.first + std::min(k, n - 1)]];
    const double a = std::sqrt(std::max(0.0, w[0]));
    const double b = a > 0 ? w[1] / a : 0.0;
    roots[k] = a;
    roots[padded + k] = b;
    roots[2 * padded + k] = std::sqrt(std::max(0.0, w[2] - b * b));
  }
  const auto whitenRows = [&](std::size_t first, std::size_t width) {
    kernels_.whiten(roots, scratch.rows.data() + first * stride, stride, width, padded);
  };
  whitenRows(kResidual, 1);
  if (pass == Pass::Residuals) return;
  whitenRows(kByPoint, 3);
  pass == Pass::Changes ? whitenRows(kChange, 1) : whitenRows(kByBlock, structure_.freedom);
}

double FastSweep::weigh(const FastTask& task, Pass pass, FastScratch& scratch) const {
  const std::size_t n = task.observations(), stride = scratch.stride;
  const double* const u = scratch.rows.data() + kResidual * stride;
  const double* const v = u + stride;
  double sum = 0;
  if (loss_.kind == LossKind::Squared) {
    double sums[4] = {};  // apart, so that they need not wait for each other
    for (std::size_t k = 0; k < n; ++k) sums[k % 4] += u[k] * u[k] + v[k] * v[k];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) / 2;
  }
  std::fill(scratch.factors.begin(), scratch.factors.end(), 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const LossValue value = lossAt(loss_, u[k] * u[k] + v[k] * v[k]);
    sum += value.rho;
    scratch.factors[k] = std::sqrt(value.first);
  }
  const auto scaleRows = [&](std::size_t first, std::size_t count) {
    kernels_.scale(scratch.factors.data(), scratch.rows.data() + first * stride, stride, count,
                   roundedUp(n));
  };
  if (pass != Pass::Residuals) {
    scaleRows(kResidual, 2);
    scaleRows(kByPoint, 6);
    pass == Pass::Changes ? scaleRows(kChange, 2) : scaleRows(kByBlock, 2 * structure_.freedom);
  }
  return sum / 2;
}

double FastSweep::evaluate(const FastState& state, const FastTask& task, Pass pass,
                           const double* steps, FastScratch& scratch) const {
  prepare(scratch);
  residuals(state, task, pass, steps, scratch);
  if (!problem_.information.empty()) whiten(task, pass, scratch);
  return weigh(task, pass, scratch);
}

// H and gradient of each point, then their inverse roots.
void FastSweep::sumPoints(const FastTask& task, FastScratch& scratch) const {
  kernels_.products(scratch.rows.data(), scratch.stride, roundedUp(task.observations()));
  const double* const products = scratch.rows.data() + kProducts * scratch.stride;
  for (std::size_t p = 0; p < task.points(); ++p) {
    const std::size_t first = structure_.point_begin[task.first_point + p] - task.first;
    const std::size_t last = structure_.point_begin[task.first_point + p + 1] - task.first;
    double sums[9] = {};
    for (std::size_t k = first; k < last; ++k) {
      for (std::size_t i = 0; i < 9; ++i) sums[i] += products[i * scratch.stride + k];
    }
    for (std::size_t i = 0; i < 9; ++i) {
      scratch.points[(kHessian + i) * scratch.point_stride + p] = sums[i];
    }
  }
}

double FastSweep::linearize(const FastState& state, const FastTask& task, double damping,
                            FastScratch& scratch) const {
  const double cost = evaluate(state, task, Pass::Derivatives, nullptr, scratch);
  sumPoints(task, scratch);
  kernels_.factorPoints(scratch.points.data(), scratch.point_stride, roundedUp(task.points()),
                        damping);
  if (problem_.point_fixed.empty()) return cost;
  for (std::size_t p = 0; p < task.points(); ++p) {
    if (!isFixed(task.first_point + p)) continue;
    for (std::size_t i = kHessian; i < kPointRows; ++i) {
      scratch.points[i * scratch.point_stride + p] = 0;
    }
  }
  return cost;
}

double FastSweep::gradientMax(const FastTask& task, const FastScratch& scratch) const {
  double most = 0;
  for (std::size_t i = 6; i < 9; ++i) {
    const double* const row = scratch.points.data() + (kHessian + i) * scratch.point_stride;
    for (std::size_t p = 0; p < task.points(); ++p) most = std::max(most, std::fabs(row[p]));
  }
  return most;
}

void FastSweep::eliminate(const FastTask& task, FastScratch& scratch) const {
  double* const factors = scratch.rows.data() + kFactor * scratch.stride;
  const double* const points = scratch.points.data() + kInverse * scratch.point_stride;
  for (std::size_t p = 0; p < task.points(); ++p) {
    const std::size_t first = structure_.point_begin[task.first_point + p] - task.first;
    const std::size_t last = structure_.point_begin[task.first_point + p + 1] - task.first;
    for (std::size_t i = 0; i < 9; ++i) {
      const double number = points[i * scratch.point_stride + p];
      double* const row = factors + i * scratch.stride;
      for (std::size_t k = first; k < last; ++k) row[k] = number;
    }
  }
  kernels_.eliminate(scratch.rows.data(), scratch.stride, roundedUp(task.observations()));
}

template <class T>
void FastSweep::keepRoots(const FastTask& task, const FastScratch& scratch, T* roots) const {
  static_assert(kU == kInverse + 6 && kRootNumbers == 9, "rows of roots stand together");
  const double* const rows = scratch.points.data() + kInverse * scratch.point_stride;
  for (std::size_t p = 0; p < task.points(); ++p) {
    for (std::size_t i = 0; i < kRootNumbers; ++i) {
      roots[p * kRootNumbers + i] = static_cast<T>(rows[i * scratch.point_stride + p]);
    }
  }
}

// With c = J step, the change of residuals by the blocks: the step of a point is
// -L^-T (u + L^-1 J_p^T c).
template <class T>
FastPointStep FastSweep::movePoints(const FastState& state, const FastTask& task,
                                    const std::vector<double>& steps, const T* roots,
                                    FastState& moved, FastScratch& scratch) const {
  FastPointStep result;
  (void)evaluate(state, task, Pass::Changes, steps.data(), scratch);
  const std::size_t stride = scratch.stride;
  kernels_.pull(scratch.rows.data(), stride, roundedUp(task.observations()));
  const double* const pulled = scratch.rows.data() + kProducts * stride;
  double* const point_step = scratch.rows.data() + kPointStep * stride;
  for (std::size_t p = 0; p < task.points(); ++p) {
    const std::size_t point = task.first_point + p;
    const std::size_t first = structure_.point_begin[point] - task.first;
    const std::size_t last = structure_.point_begin[point + 1] - task.first;
    double g[3] = {};
    for (std::size_t k = first; k < last; ++k) {
      for (std::size_t i = 0; i < 3; ++i) g[i] += pulled[i * stride + k];
    }
    double r[kRootNumbers];
    for (std::size_t i = 0; i < kRootNumbers; ++i) {
      r[i] = static_cast<double>(roots[point * kRootNumbers + i]);
    }
    const double w0 = r[6] + r[0] * g[0], w1 = r[7] + r[1] * g[0] + r[2] * g[1];
    const double w2 = r[8] + r[3] * g[0] + r[4] * g[1] + r[5] * g[2];
    const double d[3] = {-(r[0] * w0 + r[1] * w1 + r[3] * w2), -(r[2] * w1 + r[4] * w2),
                         -(r[5] * w2)};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = first; k < last; ++k) point_step[i * stride + k] = d[i];
      const double x = state.points[3 * point + i];
      moved.points[3 * point + i] = x + d[i];
      result.squared_step += d[i] * d[i];
      result.squared_points += x * x;
    }
  }
  result.model_decrease = kernels_.modelDecrease(scratch.rows.data(), stride, task.observations());
  result.cost = cost(moved, task, scratch);
  return result;
}

double FastSweep::cost(const FastState& state, const FastTask& task, FastScratch& scratch) const {
  return evaluate(state, task, Pass::Residuals, nullptr, scratch);
}

std::size_t FastSweep::countInliers(const FastState& state, const FastTask& task,
                                    FastScratch& scratch) const {
  if (loss_.kind == LossKind::Squared) return task.observations();
  (void)cost(state, task, scratch);
  std::size_t inliers = 0;
  for (std::size_t k = 0; k < task.observations(); ++k) {
    inliers += scratch.factors[k] * scratch.factors[k] >= 0.5 ? 1 : 0;
  }
  return inliers;
}

template void FastSweep::keepRoots(const FastTask&, const FastScratch&, float*) const;
template void FastSweep::keepRoots(const FastTask&, const FastScratch&, double*) const;
template FastPointStep FastSweep::movePoints(const FastState&, const FastTask&,
                                             const std::vector<double>&, const float*, FastState&,
                                             FastScratch&) const;
template FastPointStep FastSweep::movePoints(const FastState&, const FastTask&,
                                             const std::vector<double>&, const double*, FastState&,
                                             FastScratch&) const;

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
