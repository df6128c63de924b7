#ifndef GSLAM_PLUGINS_SLAM_VISUAL_SCENE_SCENE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_SCENE_SCENE_H

#include <gslam/core.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "scene/eye.h"
#include "scene/view.h"

namespace visual {

/// The map, and what its keyframes saw. A copy is a snapshot, made in microseconds, for another
/// thread to read.
struct Scene {
  /// What is known of a keyframe beside the map; kept when it is removed.
  struct Facts {
    std::shared_ptr<const View> view;  ///< null when it was removed
    /// Those that see the same points, most first, as it was lately.
    std::shared_ptr<const std::vector<gslam::Covisible>> neighbours;
    gslam::KeyframeId parent{};  ///< the one it was added beside; of the first one itself
    /// Of lengths around it, since it was added and until it was removed; see Scene::stretch().
    double stretch = 1;
    gslam::SE3d T_parent_body;  ///< of one that was removed, at that time
    double parent_stretch = 1;  ///< and Scene::stretch() of the parent then
  };

  Eye eye;
  gslam::Map map;            ///< poses are those of the body
  std::vector<Facts> facts;  ///< by the number of the keyframe

  const Facts& of(gslam::KeyframeId id) const { return facts[std::uint32_t(id)]; }
  const View& view(gslam::KeyframeId id) const { return *of(id).view; }
  gslam::Span<const gslam::Covisible> neighbours(gslam::KeyframeId id) const {
    const auto& list = of(id).neighbours;
    return list == nullptr ? gslam::Span<const gslam::Covisible>()
                           : gslam::Span<const gslam::Covisible>(*list);
  }
  gslam::SE3d T_world_camera(gslam::KeyframeId id) const {
    return map.at(id).T_world_body * eye.T_body_camera;
  }
  /// The keyframe that was added last; none must have been removed since, but for others.
  gslam::KeyframeId newest() const noexcept { return gslam::KeyframeId(facts.size() - 1); }
  /// Where a keyframe went that is no more: the one that stands for it, and the pose of its body in
  /// the body of that one. Of one that is there: itself.
  gslam::KeyframeId standIn(gslam::KeyframeId id, gslam::SE3d& T_stand_in_body) const;
  /// Lengths around a keyframe, be it there or not, are so many times what they were when it was
  /// added.
  double stretch(gslam::KeyframeId id) const;
};

/// Where a point can be found again: as far away as it was seen, more or less, and from the same
/// side.
struct Visibility {
  double nearest = 0;   ///< metres from the camera
  double farthest = 0;  ///< metres
  double seen_at = 0;   ///< distance from which it was seen first
  int octave = 0;       ///< on which it was seen there
};
/// Of a point of the map, as its first observation tells.
Visibility visibilityOf(const Scene& scene, gslam::PointId id);

/// How many rays say where a point is: one for each keyframe that sees it, two where that measured
/// its depth.
std::size_t rayCount(const Scene& scene, gslam::PointId id);

/// The depth of most of what a keyframe sees, 0 where it sees nothing.
double medianDepth(const Scene& scene, gslam::KeyframeId id);

/// The feature that sees a point in a keyframe; -1: none.
std::int64_t featureOf(const gslam::Map& map, gslam::PointId point, gslam::KeyframeId keyframe);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_SCENE_SCENE_H
