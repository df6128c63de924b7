#include "loops/loop_graph.h"

#include <gslam/optimizer/pose_graph.h>
#include <gslam/optimizer_pba.h>

#include <algorithm>

namespace visual {

using gslam::KeyframeId;
using gslam::SE3d;
using gslam::SIM3d;

namespace {

constexpr std::uint32_t kManyShared = 100;  // points of a pair that counts beside the tree
constexpr std::uint32_t kFewShared = 15;    // of a pair of which nothing is known

double depthOf(const Scene& scene, KeyframeId id) {
  const gslam::Vec3d centre = scene.T_world_camera(id).translation();
  std::vector<double> distances;
  for (const gslam::PointId point : scene.map.pointsSeen(id)) {
    if (point == gslam::kNoPoint) continue;
    distances.push_back((scene.map.at(point).position - centre).norm());
  }
  if (distances.empty()) return 1;
  const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::max(*middle, 1e-9);
}

SIM3d groupOf(const SIM3d& S, const SIM3d*) {
  return S;
}
SE3d groupOf(const SIM3d& S, const SE3d*) {
  return S.rigid();
}

template <class Group>
bool optimizeAs(LoopGraph& graph, const std::vector<std::int64_t>& row_of,
                const gslam::OptimizerOptions& options, std::string& report) {
  const Group* const kind = nullptr;
  gslam::PoseGraph<Group> problem;
  for (const SIM3d& S : graph.S_world_camera) problem.T_world_body.push_back(groupOf(S, kind));
  problem.pose_fixed.assign(graph.keyframes.size(), 0);
  problem.pose_fixed[0] = 1;
  for (const LoopGraph::Edge& edge : graph.edges) {
    const auto to = std::size_t(row_of[std::uint32_t(edge.to)]);
    problem.from.push_back(std::uint32_t(row_of[std::uint32_t(edge.from)]));
    problem.to.push_back(std::uint32_t(to));
    problem.T_from_to.push_back(groupOf(edge.S_from_to, kind));
    problem.information.push_back(informationOf<Group>(edge.weight, graph.depth[to]));
  }
  const gslam::OptimizerSummary summary = gslam::optimizePoseGraph(problem.problem(), options);
  report = briefReport(summary);
  if (!summary.is_usable) return false;
  for (std::size_t i = 0; i < problem.T_world_body.size(); ++i) {
    graph.S_world_camera[i] = SIM3d(problem.T_world_body[i]);
  }
  return true;
}

}  // namespace

LoopGraph::LoopGraph(const Scene& scene) : row_of(scene.facts.size(), -1) {
  for (const auto& keyframe : scene.map.keyframes()) {
    row_of[std::uint32_t(keyframe.id)] = std::int64_t(keyframes.size());
    keyframes.push_back(keyframe.id);
    S_world_camera.push_back(SIM3d(scene.T_world_camera(keyframe.id)));
    depth.push_back(depthOf(scene, keyframe.id));
  }
  for (const gslam::CovisibleEdge& pair : covisibilityGraph(scene.map, kFewShared)) {
    const bool is_branch = scene.of(pair.a).parent == pair.b || scene.of(pair.b).parent == pair.a;
    if (is_branch || pair.shared >= kManyShared) addEdge(pair.a, pair.b, pair.shared);
  }
  for (const KeyframeId id : keyframes) {
    const KeyframeId parent = scene.of(id).parent;
    if (parent == id || !has(parent)) continue;
    const bool is_there = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      return (edge.from == id && edge.to == parent) || (edge.from == parent && edge.to == id);
    });
    if (!is_there) addEdge(parent, id, kFewShared);
  }
  for (const auto& edge : scene.map.edges()) {
    if (edge.value.kind != gslam::EdgeKind::loop) continue;
    addEdge(edge.value.from, edge.value.to, kManyShared);
  }
}

void LoopGraph::addEdge(KeyframeId from, KeyframeId to, double weight) {
  edges.push_back({from, to, pose(from).inverse() * pose(to), weight});
}

bool LoopGraph::optimize(bool has_scale, const std::string& backend, std::string& report) {
  gslam::OptimizerOptions options;
  options.backend = backend;
  return has_scale ? optimizeAs<SIM3d>(*this, row_of, options, report)
                   : optimizeAs<SE3d>(*this, row_of, options, report);
}

}  // namespace visual
