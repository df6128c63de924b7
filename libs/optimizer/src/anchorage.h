#ifndef GSLAM_OPTIMIZER_SRC_ANCHORAGE_H
#define GSLAM_OPTIMIZER_SRC_ANCHORAGE_H

#include <gslam/optimizer/pose_graph_problem.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parts.h"

// What holds the poses of a graph: fixed ones and priors, each its connected part.

namespace gslam {
inline namespace v1 {
namespace detail {

class Anchorage {
 public:
  // Of a problem whose indices are there.
  template <class Group>
  explicit Anchorage(const PoseGraphProblem<Group>& problem)
      : parts_(problem.T_world_body.size()),
        is_used_(problem.T_world_body.size(), 0),
        is_anchored_(problem.T_world_body.size(), 0) {
    for (std::size_t i = 0; i < problem.from.size(); ++i) {
      parts_.join(problem.from[i], problem.to[i]);
      is_used_[problem.from[i]] = is_used_[problem.to[i]] = 1;
    }
    bool has_anchor = false;
    const auto anchor = [&](std::uint32_t pose) {
      is_used_[pose] = has_anchor = true;
      is_anchored_[parts_.rootOf(pose)] = 1;
    };
    for (std::uint32_t i = 0; i < problem.pose_fixed.size(); ++i) {
      if (problem.pose_fixed[i] != 0) anchor(i);
    }
    for (const std::uint32_t pose : problem.prior_pose) anchor(pose);
    // Where there is none at all, the first pose is one.
    if (!has_anchor && !is_anchored_.empty()) is_anchored_[0] = 1;
  }

  // Whether it has an edge, is fixed, or something is known about it.
  bool isUsed(std::uint32_t pose) const noexcept { return is_used_[pose] != 0; }
  // Whether edges connect it to an anchor.
  bool isHeld(std::uint32_t pose) noexcept { return is_anchored_[parts_.rootOf(pose)] != 0; }
  // Whether it is the lowest of its part.
  bool isFirst(std::uint32_t pose) noexcept { return parts_.rootOf(pose) == pose; }

 private:
  Parts parts_;
  std::vector<std::uint8_t> is_used_, is_anchored_;  // the latter at roots
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_ANCHORAGE_H
