#ifndef GSLAM_OPTIMIZER_SRC_INITIALIZE_POSES_ROOTS_H
#define GSLAM_OPTIMIZER_SRC_INITIALIZE_POSES_ROOTS_H

#include <gslam/optimizer/pose_graph_problem.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "factors/pose_edge.h"

// Where the initialisation of a pose graph begins, and the one that follows a tree from there.

namespace gslam {
inline namespace v1 {
namespace detail {

// Weights of the relaxations: of rotations, translations and log scales.
template <class Group>
struct StartWeight {
  double kappa = 1;
  double tau = 1;
  double scale = 1;

  static StartWeight of(const typename Group::Jacobian& information) {
    StartWeight weight;
    const EdgeWeight<Group> chordal = edgeWeight<Group>(PoseGraphResidual::Chordal, information);
    weight.kappa = chordal.kappa_root * chordal.kappa_root;
    weight.tau = chordal.tau_root * chordal.tau_root;
    if (Group::kFreedom == 7) weight.scale = information.values[7 * 7 - 1];
    return weight;
  }
  bool isComplete() const { return kappa > 0 && tau > 0 && scale > 0; }
};

// Edges at each pose: twice the edge, plus 1 at its `to`.
class EdgesOfPoses {
 public:
  EdgesOfPoses(std::size_t poses, Span<const std::uint32_t> from, Span<const std::uint32_t> to)
      : begin_(poses + 1, 0), edges_(2 * from.size()) {
    for (std::size_t e = 0; e < from.size(); ++e) ++begin_[from[e] + 1], ++begin_[to[e] + 1];
    for (std::size_t i = 0; i < poses; ++i) begin_[i + 1] += begin_[i];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t e = 0; e < from.size(); ++e) {
      edges_[next[from[e]]++] = 2 * e;
      edges_[next[to[e]]++] = 2 * e + 1;
    }
  }
  Span<const std::size_t> at(std::size_t pose) const {
    return {edges_.data() + begin_[pose], begin_[pose + 1] - begin_[pose]};
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> edges_;
};

// Walks through the graph in breadth, from its roots.
template <class Group>
class PoseTree {
 public:
  explicit PoseTree(const PoseGraphProblem<Group>& problem)
      : problem_(problem),
        edges_(problem.T_world_body.size(), problem.from, problem.to),
        is_known(problem.T_world_body.size(), 0),
        poses(problem.T_world_body.begin(), problem.T_world_body.end()),
        is_reached_(problem.T_world_body.size(), 0) {
    for (std::size_t i = 0; i < problem.pose_fixed.size(); ++i) {
      if (problem.pose_fixed[i] != 0) begin(i, true);
    }
    walk();
    for (std::size_t k = 0; k < problem.prior_pose.size(); ++k) {
      const std::size_t pose = problem.prior_pose[k];
      if (is_reached_[pose] != 0) continue;
      if (!StartWeight<Group>::of(problem.prior_information[k]).isComplete()) continue;
      poses[pose] = problem.prior_T_world_body[k];
      begin(pose, false);
      walk();
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (is_reached_[i] != 0) continue;
      begin(i, true);
      walk();
    }
  }

 private:
  const PoseGraphProblem<Group>& problem_;
  EdgesOfPoses edges_;

 public:
  std::vector<char> is_known;  // fixed, or held where it is because nothing else is
  std::vector<Group> poses;

 private:
  void begin(std::size_t pose, bool is_held) {
    is_known[pose] = is_held ? 1 : 0;
    is_reached_[pose] = 1;
    queue_.push_back(pose);
  }

  void walk() {
    while (!queue_.empty()) {
      const std::size_t pose = queue_.front();
      queue_.pop_front();
      for (const std::size_t entry : edges_.at(pose)) {
        const std::size_t edge = entry / 2;
        const bool is_forward = entry % 2 == 0;
        const std::size_t other = is_forward ? problem_.to[edge] : problem_.from[edge];
        if (is_reached_[other] != 0) continue;
        const Group& step = problem_.T_from_to[edge];
        poses[other] = (poses[pose] * (is_forward ? step : step.inverse())).normalized();
        is_reached_[other] = 1;
        queue_.push_back(other);
      }
    }
  }

  std::vector<char> is_reached_;
  std::deque<std::size_t> queue_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_INITIALIZE_POSES_ROOTS_H
