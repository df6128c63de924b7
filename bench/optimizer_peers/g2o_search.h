// What the rows of g2o have in common.
#ifndef GSLAM_BENCH_OPTIMIZER_PEERS_G2O_SEARCH_H
#define GSLAM_BENCH_OPTIMIZER_PEERS_G2O_SEARCH_H

#include <g2o/core/optimization_algorithm_levenberg.h>
#include <g2o/core/sparse_optimizer.h>
#include <g2o/core/sparse_optimizer_terminate_action.h>
#include <g2o/types/slam3d/se3quat.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <utility>

#include "measure.h"

inline g2o::SE3Quat quatOf(const gslam::SE3d& T) {
  const auto& q = T.rotation().quaternion();
  const auto& t = T.translation();
  return {g2o::Quaternion(q[3], q[0], q[1], q[2]), g2o::Vector3(t[0], t[1], t[2])};
}

inline gslam::SE3d poseOf(const g2o::SE3Quat& T) {
  const g2o::Quaternion& q = T.rotation();
  const g2o::Vector3& t = T.translation();
  return {gslam::SO3d::fromQuaternion(q.x(), q.y(), q.z(), q.w()), {t[0], t[1], t[2]}};
}

/// Writes down how a search goes. The clock starts when the structure of the equations is there,
/// as with the others; every trial of a damping factor is an iteration, as with the others.
class SearchLog : public g2o::HyperGraphAction {
 public:
  SearchLog(g2o::SparseOptimizer& optimizer, g2o::OptimizationAlgorithmLevenberg& levenberg)
      : optimizer_(optimizer), levenberg_(levenberg) {}

  void start() {
    optimizer_.computeActiveErrors();
    start_ = Clock::now();
    course_.add(0.5 * optimizer_.activeRobustChi2(), 0);
  }
  g2o::HyperGraphAction* operator()(const g2o::HyperGraph*, Parameters*) override {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    for (int i = 1; i < levenberg_.levenbergIteration(); ++i) {
      course_.add(course_.costs.back(), seconds);
    }
    course_.add(0.5 * optimizer_.activeRobustChi2(), seconds);
    return this;
  }
  const Course& course() const { return course_; }

 private:
  using Clock = std::chrono::steady_clock;

  g2o::SparseOptimizer& optimizer_;
  g2o::OptimizationAlgorithmLevenberg& levenberg_;
  Clock::time_point start_;
  Course course_;
};

/// A block solver that tells when it has built its structure.
template <class Blocks>
class LoggedBlocks : public Blocks {
 public:
  using Blocks::Blocks;
  bool buildStructure(bool zero_blocks = false) override {
    const bool is_good = Blocks::buildStructure(zero_blocks);
    if (log != nullptr) log->start();
    return is_good;
  }

  SearchLog* log = nullptr;  ///< or nobody
};

/// An optimizer of Levenberg and Marquardt.
/// @tparam Blocks  a g2o::BlockSolver
/// @tparam Linear  solves for its PoseMatrixType
template <class Blocks, template <class> class Linear>
class G2oSearch {
 public:
  explicit G2oSearch(std::unique_ptr<Linear<typename Blocks::PoseMatrixType>> linear) {
    auto blocks = std::make_unique<LoggedBlocks<Blocks>>(std::move(linear));
    blocks_ = blocks.get();
    levenberg_ = new g2o::OptimizationAlgorithmLevenberg(std::move(blocks));
    graph.setAlgorithm(levenberg_);  // and owns it
  }

  /// @param iterations  at most; each may try several damping factors
  Course run(std::size_t iterations) {
    graph.initializeOptimization();
    SearchLog log(graph, *levenberg_);
    blocks_->log = &log;
    graph.addPostIterationAction(&log);
    graph.optimize(static_cast<int>(iterations));
    graph.removePostIterationAction(&log);
    blocks_->log = nullptr;
    return log.course();
  }

  /// Ends as the others do: when an iteration gains less than 1e-6 of the cost.
  void runAsLongAsItGains() {
    g2o::SparseOptimizerTerminateAction stop;
    stop.setGainThreshold(1e-6);
    graph.addPostIterationAction(&stop);
    run(50);
    graph.removePostIterationAction(&stop);
  }

  g2o::SparseOptimizer graph;  ///< add vertices and edges here

 private:
  LoggedBlocks<Blocks>* blocks_;
  g2o::OptimizationAlgorithmLevenberg* levenberg_;
};

#endif  // GSLAM_BENCH_OPTIMIZER_PEERS_G2O_SEARCH_H
