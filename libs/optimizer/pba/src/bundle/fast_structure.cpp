#include "bundle/fast_structure.h"

#include <gslam/base/parallel.h>
#include <gslam/base/platform.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "bundle/fast_views.h"
#include "solvers.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr std::size_t kTaskObservations = 256;
constexpr std::size_t kGrain = std::size_t(1) << 16;  // observations

// Stable order of `items` by a key from 0 to `most`; those with the key kNoBlock are the last.
void sortByKey(const std::vector<std::uint32_t>& key, std::size_t most,
               std::vector<std::uint32_t>& items) {
  std::vector<std::uint32_t> begin(most + 2, 0);
  const auto bucket = [&](std::uint32_t item) { return std::min<std::size_t>(key[item], most); };
  for (const std::uint32_t item : items) ++begin[bucket(item) + 1];
  for (std::size_t b = 0; b <= most; ++b) begin[b + 1] += begin[b];
  std::vector<std::uint32_t> sorted(items.size());
  for (const std::uint32_t item : items) sorted[begin[bucket(item)]++] = item;
  items.swap(sorted);
}

// Observations by the points of the problem: those of point p are
// sources[begin[p] .. begin[p + 1]), in the order of their blocks.
struct ByPoint {
  std::vector<std::uint32_t> begin;
  RawVector<std::uint32_t> sources;
  std::vector<std::uint32_t> first_block, second_block;
};

// Sorts a point's observations by block and source; they are few.
class PointSorter {
 public:
  PointSorter(const FastStructure& structure, const RawVector<std::uint32_t>& view_of)
      : structure_(structure), view_of_(view_of) {}

  void sort(ByPoint& by_point, std::size_t point) {
    std::uint32_t* const first = by_point.sources.data() + by_point.begin[point];
    std::uint32_t* const last = by_point.sources.data() + by_point.begin[point + 1];
    keys_.clear();
    for (const std::uint32_t* k = first; k < last; ++k) {
      keys_.push_back((std::uint64_t(structure_.block_of_view[view_of_[*k]]) << 32) | *k);
    }
    if (!std::is_sorted(keys_.begin(), keys_.end())) std::sort(keys_.begin(), keys_.end());
    std::uint32_t* to = first;
    for (const std::uint64_t key : keys_) *to++ = static_cast<std::uint32_t>(key & 0xffffffffU);
    if (keys_.size() > 0) by_point.first_block[point] = static_cast<std::uint32_t>(keys_[0] >> 32);
    if (keys_.size() > 1) by_point.second_block[point] = static_cast<std::uint32_t>(keys_[1] >> 32);
  }

 private:
  const FastStructure& structure_;
  const RawVector<std::uint32_t>& view_of_;
  std::vector<std::uint64_t> keys_;
};

// Whoever comes first takes a place; then sorting makes the order the same for any threads.
ByPoint sortByPoint(const BundleProblem& problem, const RawVector<std::uint32_t>& view_of,
                    std::vector<std::atomic<std::uint32_t>>& seen_by, unsigned threads,
                    const FastStructure& structure) {
  const std::size_t n = problem.points.size();
  ByPoint by_point;
  by_point.begin.assign(n + 1, 0);
  for (std::size_t p = 0; p < n; ++p) {
    const std::uint32_t count = seen_by[p].load(std::memory_order_relaxed);
    by_point.begin[p + 1] = by_point.begin[p] + count;
    seen_by[p].store(by_point.begin[p], std::memory_order_relaxed);
  }
  by_point.sources.resize(by_point.begin[n]);
  parallelFor(
      0, view_of.size(),
      [&](std::size_t k) {
        if (view_of[k] == kNoBlock) return;
        std::atomic<std::uint32_t>& next = seen_by[problem.observation_point[k]];
        by_point.sources[next.fetch_add(1, std::memory_order_relaxed)] =
            static_cast<std::uint32_t>(k);
      },
      fastParallel(kGrain, threads));
  by_point.first_block.assign(n, kNoBlock);
  by_point.second_block.assign(n, kNoBlock);
  parallelChunks(
      0, n,
      [&](std::size_t first, std::size_t last) {
        PointSorter sorter(structure, view_of);
        for (std::size_t p = first; p < last; ++p) sorter.sort(by_point, p);
      },
      fastParallel(kGrain / 8, threads));
  return by_point;
}

// Points by their first and their second block, so that neighbours add to the same blocks.
void orderPoints(const ByPoint& by_point, FastStructure& structure) {
  for (std::size_t p = 0; p + 1 < by_point.begin.size(); ++p) {
    if (by_point.begin[p] == by_point.begin[p + 1]) continue;
    structure.points.push_back(static_cast<std::uint32_t>(p));
  }
  sortByKey(by_point.second_block, structure.blocks.size(), structure.points);
  sortByKey(by_point.first_block, structure.blocks.size(), structure.points);
  structure.point_begin.reserve(structure.points.size() + 1);
  structure.point_begin.assign(1, 0);
  for (const std::uint32_t point : structure.points) {
    structure.point_begin.push_back(structure.point_begin.back() + by_point.begin[point + 1] -
                                    by_point.begin[point]);
  }
}

// Points are far from each other in memory: each stage fetches what the next wants.
class AheadOfPoints {
 public:
  AheadOfPoints(const BundleProblem& problem, const RawVector<std::uint32_t>& view_of,
                const ByPoint& by_point, const std::vector<std::uint32_t>& points)
      : problem_(problem), view_of_(view_of), by_point_(by_point), points_(points) {}

  void fetch(std::size_t p) const {
#if GSLAM_HAS_VECTORS
    if (p + 3 * kAhead >= points_.size()) return;
    __builtin_prefetch(&by_point_.begin[points_[p + 3 * kAhead]]);
    __builtin_prefetch(&by_point_.sources[by_point_.begin[points_[p + 2 * kAhead]]]);
    const std::uint32_t source = by_point_.sources[by_point_.begin[points_[p + kAhead]]];
    __builtin_prefetch(&view_of_[source]);
    __builtin_prefetch(&problem_.pixels[source]);
#else
    (void)p;
#endif
  }

 private:
  static constexpr std::size_t kAhead = 8;
  const BundleProblem& problem_;
  const RawVector<std::uint32_t>& view_of_;
  const ByPoint& by_point_;
  const std::vector<std::uint32_t>& points_;
};

void placeObservations(const BundleProblem& problem, const RawVector<std::uint32_t>& view_of,
                       const ByPoint& by_point, unsigned threads, FastStructure& structure) {
  const std::size_t n = structure.point_begin.back();
  structure.sources.resize(n);
  structure.view_of.resize(n);
  structure.seen_u.resize(n);
  structure.seen_v.resize(n);
  const AheadOfPoints ahead(problem, view_of, by_point, structure.points);
  parallelFor(
      0, structure.points.size(),
      [&](std::size_t p) {
        ahead.fetch(p);
        std::size_t to = structure.point_begin[p];
        const std::uint32_t point = structure.points[p];
        for (std::size_t i = by_point.begin[point]; i < by_point.begin[point + 1]; ++i, ++to) {
          const std::uint32_t source = by_point.sources[i];
          structure.sources[to] = source;
          structure.view_of[to] = view_of[source];
          structure.seen_u[to] = problem.pixels[source][0];
          structure.seen_v[to] = problem.pixels[source][1];
        }
      },
      fastParallel(kGrain / 8, threads));
}

// A part of the observations counts its own, so that all know where to write.
void makeRows(unsigned threads, FastStructure& structure) {
  const std::size_t blocks = structure.blocks.size(), n = structure.observationCount();
  const std::size_t grain = std::max({kGrain, n / 32 + 1, blocks});
  std::vector<std::vector<std::uint32_t>> next((n + grain - 1) / grain);
  const ParallelOptions parallel = fastParallel(grain, threads);
  parallelChunks(
      0, n,
      [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t>& counts = next[first / grain];
        counts.assign(blocks, 0);
        for (std::size_t k = first; k < last; ++k) {
          const std::uint32_t block = structure.blockOf(k);
          if (block != kNoBlock) ++counts[block];
        }
      },
      parallel);
  std::uint32_t sum = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    structure.row_begin.push_back(sum);
    for (std::vector<std::uint32_t>& counts : next) {
      const std::uint32_t count = counts[b];
      counts[b] = sum;
      sum += count;
    }
  }
  structure.row_begin.push_back(sum);
  structure.row.resize(sum);
  parallelChunks(
      0, n,
      [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t>& places = next[first / grain];
        for (std::size_t k = first; k < last; ++k) {
          const std::uint32_t block = structure.blockOf(k);
          if (block != kNoBlock) structure.row[places[block]++] = static_cast<std::uint32_t>(k);
        }
      },
      parallel);
}

void makeTasks(FastStructure& structure) {
  structure.task_begin.assign(1, 0);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < structure.points.size(); ++i) {
    const std::size_t end = structure.point_begin[i + 1];
    const bool is_last = i + 1 == structure.points.size();
    if (end - begin < kTaskObservations && !is_last) continue;
    structure.task_begin.push_back(static_cast<std::uint32_t>(i + 1));
    structure.most_in_task = std::max(structure.most_in_task, end - begin);
    begin = end;
  }
}

bool hasFastVariables(const BundleProblem& problem) {
  for (const std::uint32_t anchor : problem.point_anchor) {
    if (anchor != BundleProblem::kNoAnchor) return false;
  }
  for (const std::uint8_t is_free : problem.T_body_camera_free) {
    if (is_free != 0) return false;
  }
  for (const double u : problem.right_u) {
    if (!std::isnan(u)) return false;
  }
  return problem.position_priors.empty() && problem.pose_priors.empty() &&
         problem.relative_priors.empty() && problem.window_priors.empty() &&
         problem.pixels.size() < kNoBlock;
}

}  // namespace

bool isPlainCamera(const Camera& camera) {
  const std::string name = camera.modelName();
  return name == "pinhole" || (name == "radtan" && camera.parameterCount() <= 9);
}

bool isBalFreedom(const Camera& camera, const CameraFreedom& freedom) {
  constexpr std::uint32_t kFocalAndTwo = 1U | (1U << 4) | (1U << 5);
  const std::uint32_t parameters = freedom.parameters & ~2U;
  return freedom.keeps_aspect && parameters == kFocalAndTwo && camera.modelName() == "radtan" &&
         camera.parameterCount() <= 9;
}

bool isFastBundle(const BundleProblem& problem, const OptimizerOptions&) {
  if (!hasFastVariables(problem)) return false;
  if (problem.camera_freedom.empty()) return true;
  std::vector<std::uint32_t> pose_of(problem.cameras.size(), kNoBlock);
  std::vector<std::uint32_t> camera_of(problem.T_world_body.size(), kNoBlock);
  for (std::size_t k = 0; k < problem.pixels.size(); ++k) {
    const std::uint32_t camera = cameraOfObservation(problem, k);
    if (!isCameraFree(problem, camera)) continue;
    const std::uint32_t pose = problem.observation_pose[k];
    if (pose_of[camera] == kNoBlock && camera_of[pose] == kNoBlock) {
      if (!isBalFreedom(problem.cameras[camera], problem.camera_freedom[camera])) return false;
      pose_of[camera] = pose;
      camera_of[pose] = camera;
    }
    if (pose_of[camera] != pose || camera_of[pose] != camera) return false;
  }
  return true;
}

FastStructure makeFastStructure(const BundleProblem& problem, unsigned threads) {
  FastStructure structure;
  makeViews(problem, threads, structure);
  {
    std::vector<std::atomic<std::uint32_t>> seen_by(problem.points.size());
    const RawVector<std::uint32_t> view_of =
        viewOfObservations(problem, threads, structure, seen_by);
    const ByPoint by_point = sortByPoint(problem, view_of, seen_by, threads, structure);
    orderPoints(by_point, structure);
    placeObservations(problem, view_of, by_point, threads, structure);
  }
  makeRows(threads, structure);
  makeTasks(structure);
  return structure;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
