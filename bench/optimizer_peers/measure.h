// One measurement for all: rows are problems, columns are implementations.
#ifndef GSLAM_BENCH_OPTIMIZER_PEERS_MEASURE_H
#define GSLAM_BENCH_OPTIMIZER_PEERS_MEASURE_H

#include <gslam/optimizer.h>

#include <cstddef>
#include <vector>

#include "scenes.h"

/// All that use threads get these.
constexpr unsigned kThreads = 2;

/// How a search went: the lowest cost and the time, at the start and after each iteration. A step
/// that was tried and taken back is an iteration, too.
struct Course {
  std::vector<double> costs;
  std::vector<double> seconds;

  /// @param cost  after the iteration, or of a step that was not kept
  void add(double cost, double at) {
    costs.push_back(costs.empty() || cost < costs.back() ? cost : costs.back());
    seconds.push_back(at);
  }
  std::size_t iterations() const { return costs.size() - 1; }
};

/// Solves in place with kThreads (local_ba with one) and at most so many iterations, each of which
/// is to be used.
using SolveBundle = Course (*)(BundleArrays& arrays, std::size_t iterations);
/// Registers `ba_.../peer` and `local_ba/peer`: wall time an iteration of Levenberg and Marquardt,
/// of 10; Venice only with GSLAM_PEERS_SLOW set. A row is an error where the cost of what was
/// written back is not the one claimed, or hardly lower than that of the start.
/// Counters: start_cost; cost; cpu_ms, CPU time of all threads an iteration, of those after the
/// first; peak_mb, the peak memory of the program, which is that of the row where it runs alone.
/// Where GSLAM_PEERS_SLOW is set, from a run of 50 iterations: seconds to 1 % and 0.1 % of the
/// lowest cost that pba finds.
bool addBundleRows(const char* peer, SolveBundle solve);

/// Registers `pose_50/peer`, `pose_200` and `pose_1000`: a call with everything.
using SolvePose = gslam::SE3d (*)(const PoseScene& scene);
bool addPoseRows(const char* peer, SolvePose solve);

/// Registers `sphere2500_g/peer` (Quaternion), `sphere2500_f` (Chordal) where the peer has that,
/// and the same of parking-garage: wall time from a chordal start to convergence. Counters: the
/// cost at the start and at the end, and cpu_ms of all threads. A row is an error where the end is
/// far from the lowest cost that pba finds.
using SolveGraph = void (*)(gslam::PoseGraph<gslam::SE3d>& graph,
                            gslam::PoseGraphResidual residual);
bool addGraphRows(const char* peer, SolveGraph solve, bool has_chordal = true);

#endif  // GSLAM_BENCH_OPTIMIZER_PEERS_MEASURE_H
