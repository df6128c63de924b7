#ifndef GSLAM_PLUGINS_SLAM_VISUAL_SCENE_WORLD_H
#define GSLAM_PLUGINS_SLAM_VISUAL_SCENE_WORLD_H

#include <gslam/core.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace visual {

/// The scene as it grows, and what only those who make it need to know.
///
/// One thread writes it; others get copies of its scene.
class World {
 public:
  explicit World(const Eye& eye);

  const Scene& scene() const noexcept { return scene_; }
  const gslam::Map& map() const noexcept { return scene_.map; }
  const Eye& eye() const noexcept { return scene_.eye; }

  /// @{
  /// Keyframes. The parent is the one that it was added beside; the first one's is itself.
  gslam::KeyframeId addKeyframe(const std::shared_ptr<const View>& view,
                                const gslam::SE3d& T_world_body);
  /// Its children get its parent; what only it saw goes.
  void removeKeyframe(gslam::KeyframeId id);
  gslam::KeyframeId parent(gslam::KeyframeId id) const { return of(id).parent; }
  void setParent(gslam::KeyframeId id, gslam::KeyframeId parent) { of(id).parent = parent; }
  /// Moves a keyframe, where lengths around it are `stretch` times what they were.
  void moveKeyframe(gslam::KeyframeId id, const gslam::SE3d& T_world_body, double stretch = 1);
  /// By how much lengths around a keyframe were stretched since it was added.
  double stretch(gslam::KeyframeId id) const { return of(id).stretch; }
  /// Number of keyframes that were ever added.
  std::uint32_t keyframesAdded() const noexcept { return std::uint32_t(scene_.facts.size()); }
  gslam::KeyframeId newest() const noexcept { return scene_.newest(); }
  /// Looks anew who sees the same points.
  void refreshNeighbours(gslam::KeyframeId id);
  void addEdge(const gslam::PoseEdge& edge) { scene_.map.add(edge); }
  /// @}

  /// @{
  /// Points
  gslam::PointId addPoint(const gslam::Vec3d& position, gslam::KeyframeId keyframe,
                          std::uint32_t feature);
  void movePoint(gslam::PointId id, const gslam::Vec3d& position);
  void removePoint(gslam::PointId id);
  /// Says that a feature sees a point, which no other feature of the keyframe sees.
  void observe(gslam::PointId point, gslam::KeyframeId keyframe, std::uint32_t feature);
  /// Takes an observation away, and the point with it where nothing says any more where it is.
  void forget(gslam::KeyframeId keyframe, std::uint32_t feature);
  /// All who see `gone` see `kept` from now on.
  void merge(gslam::PointId kept, gslam::PointId gone);
  /// Chooses the descriptor that is nearest to all others, and the mean direction of view.
  void refresh(gslam::PointId id);
  /// @}

  /// How often a point should have been seen, and was.
  struct Sightings {
    std::uint32_t expected = 0;
    std::uint32_t found = 0;
    std::uint32_t born = 0;  ///< keyframesAdded() when it was made
  };
  Sightings& sightings(gslam::PointId id) { return sightings_[std::uint32_t(id)]; }

 private:
  Scene::Facts& of(gslam::KeyframeId id) { return scene_.facts[std::uint32_t(id)]; }
  const Scene::Facts& of(gslam::KeyframeId id) const { return scene_.of(id); }
  bool isDetermined(gslam::PointId id) const;

  Scene scene_;
  std::vector<Sightings> sightings_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_SCENE_WORLD_H
