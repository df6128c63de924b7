// Graphs of which the truth is known.
#ifndef GSLAM_OPTIMIZER_TESTS_POSE_GRAPH_INSTANCES_H
#define GSLAM_OPTIMIZER_TESTS_POSE_GRAPH_INSTANCES_H

#include <gslam/optimizer/pose_graph.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>

namespace pose_graph_test {

template <class Group>
struct Graph : gslam::PoseGraph<Group> {
  void add(std::size_t i, std::size_t j, const Group& between,
           const typename Group::Jacobian& weight = Group::Jacobian::identity()) {
    this->from.push_back(static_cast<std::uint32_t>(i));
    this->to.push_back(static_cast<std::uint32_t>(j));
    this->T_from_to.push_back(between);
    this->information.push_back(weight);
  }
  void addPrior(std::size_t i, const Group& pose,
                const typename Group::Jacobian& weight = Group::Jacobian::identity()) {
    this->prior_pose.push_back(static_cast<std::uint32_t>(i));
    this->prior_T_world_body.push_back(pose);
    this->prior_information.push_back(weight);
  }
};

class GraphRandom {
 public:
  explicit GraphRandom(std::uint64_t seed) : random_(seed) {}
  double normal() { return normal_(random_); }
  std::size_t below(std::size_t n) { return random_() % n; }
  template <class Group>
  Group pose(double size) {
    typename Group::Tangent t;
    for (std::size_t i = 0; i < Group::kFreedom; ++i) t[i] = size * normal();
    return Group::exp(t);
  }
  template <class Group>
  typename Group::Jacobian information() {
    typename Group::Jacobian m = Group::Jacobian::identity();
    for (std::size_t k = 0; k < Group::kFreedom; ++k) {
      double row[Group::kFreedom];
      for (double& value : row) value = normal();
      for (std::size_t i = 0; i < Group::kFreedom; ++i) {
        for (std::size_t j = 0; j < Group::kFreedom; ++j) m(i, j) += row[i] * row[j];
      }
    }
    return m;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

// A walk with loops to random poses before it; poses are the truth.
template <class Group>
Graph<Group> walk(std::size_t poses, std::size_t loops, double noise, std::uint64_t seed) {
  GraphRandom random(seed);
  Graph<Group> graph;
  graph.T_world_body.push_back(random.pose<Group>(0.5));
  for (std::size_t i = 1; i < poses; ++i) {
    graph.T_world_body.push_back(graph.T_world_body.back() * random.pose<Group>(0.4));
  }
  const auto connect = [&](std::size_t i, std::size_t j) {
    const Group exact = graph.T_world_body[i].inverse() * graph.T_world_body[j];
    graph.add(i, j, exact * random.pose<Group>(noise), random.information<Group>());
    graph.is_robust.push_back(i + 1 != j);
  };
  for (std::size_t i = 1; i < poses; ++i) connect(i - 1, i);
  for (std::size_t k = 0; k < loops; ++k) {
    const std::size_t i = random.below(poses), j = random.below(poses);
    if (i != j) connect(i, j);
  }
  return graph;
}

// The truth with noise, but for the poses that are held.
template <class Group>
void disturb(Graph<Group>& graph, double noise, std::uint64_t seed, std::size_t first = 1) {
  GraphRandom random(seed);
  for (std::size_t i = first; i < graph.T_world_body.size(); ++i) {
    if (graph.pose_fixed.empty() || graph.pose_fixed[i] == 0)
      graph.T_world_body[i] *= random.pose<Group>(noise);
  }
}

template <class Group>
bool sameBits(const Group& a, const Group& b) {
  return std::memcmp(&a, &b, sizeof(Group)) == 0;
}

}  // namespace pose_graph_test

#endif  // GSLAM_OPTIMIZER_TESTS_POSE_GRAPH_INSTANCES_H
