// What each pose graph that was read must be.
#ifndef GSLAM_OPTIMIZER_FUZZ_CHECK_GRAPH_H
#define GSLAM_OPTIMIZER_FUZZ_CHECK_GRAPH_H

#include <gslam/optimizer/pose_graph.h>

#include <cstddef>
#include <cstdlib>

struct CheckGraph {
  template <class Group>
  void operator()(const gslam::PoseGraph<Group>& graph) const {
    const std::size_t n = graph.from.size(), poses = graph.T_world_body.size();
    bool is_right = graph.to.size() == n && graph.T_from_to.size() == n;
    is_right = is_right && graph.information.size() == n && graph.ids.size() == poses;
    is_right = is_right && (graph.pose_fixed.empty() || graph.pose_fixed.size() == poses);
    for (std::size_t i = 0; is_right && i < n; ++i) {
      is_right = graph.from[i] < poses && graph.to[i] < poses && graph.from[i] != graph.to[i];
    }
    if (!is_right) std::abort();
  }
};

#endif  // GSLAM_OPTIMIZER_FUZZ_CHECK_GRAPH_H
