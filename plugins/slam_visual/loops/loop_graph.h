#ifndef GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_GRAPH_H
#define GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_GRAPH_H

#include <gslam/core.h>

#include <string>
#include <vector>

#include "scene/scene.h"

namespace visual {

/// Of a relative pose that is known by points: their number is the inverse variance of its rotation
/// (and of the logarithm of its scale), and that of its translation in units of their distance.
template <class Group>
typename Group::Jacobian informationOf(double points, double distance) {
  typename Group::Jacobian information{};
  for (std::size_t i = 0; i < Group::kFreedom; ++i) {
    information(i, i) = i < 3 ? points / (distance * distance) : points;
  }
  return information;
}

/// The poses of all keyframes and what is known of two of them together. A pose takes coordinates
/// of the camera, in lengths of the map around it, to those of the world.
struct LoopGraph {
  struct Edge {
    gslam::KeyframeId from;
    gslam::KeyframeId to;
    gslam::SIM3d S_from_to;
    double weight;  ///< points that both see; more of them know the pose better
  };

  /// Of a scene as it is: its spanning tree, its pairs that share many points, its old loops.
  explicit LoopGraph(const Scene& scene);

  bool has(gslam::KeyframeId id) const { return row_of[std::uint32_t(id)] >= 0; }
  gslam::SIM3d& pose(gslam::KeyframeId id) { return S_world_camera[row(id)]; }
  const gslam::SIM3d& pose(gslam::KeyframeId id) const { return S_world_camera[row(id)]; }

  /// Distance of what a keyframe sees, the middle one, in the lengths around it.
  double depthAt(gslam::KeyframeId id) const { return depth[row(id)]; }

  /// Finds the poses that fit the edges best; the first keyframe stays.
  /// @param has_scale  whether lengths may differ from place to place
  /// @param backend    of the optimizer; empty: its choice
  /// @param report     result: a line for people
  /// @return whether there are such poses; else they are what they were
  bool optimize(bool has_scale, const std::string& backend, std::string& report);

  std::vector<gslam::KeyframeId> keyframes;
  std::vector<gslam::SIM3d> S_world_camera;  ///< of these
  std::vector<double> depth;
  std::vector<Edge> edges;

 private:
  std::size_t row(gslam::KeyframeId id) const { return std::size_t(row_of[std::uint32_t(id)]); }
  void addEdge(gslam::KeyframeId from, gslam::KeyframeId to, double weight);

  std::vector<std::int64_t> row_of;  // by the number of the keyframe; -1: it is gone
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_LOOPS_LOOP_GRAPH_H
