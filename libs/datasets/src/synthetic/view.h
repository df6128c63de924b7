// A scene as seen from one place: its surfaces in camera coordinates, the nearest first.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_VIEW_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_VIEW_H

#include <gslam/geometry/se3.h>

#include <array>
#include <cstdint>
#include <vector>

#include "rays.h"
#include "scene.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// A surface in camera coordinates, with what its rays need.
struct SeenPrimitive {
  const Primitive* from = nullptr;
  Vec3f origin{}, u{}, v{}, n{};
  float along_u = 0, along_v = 0, along_n = 0;  ///< of the origin, metres
  float near = 0;                               ///< nothing of it is nearer, metres
  int corner_count = 0;                         ///< 0: a ball around `middle`; -1: everywhere
  std::array<Vec3f, 4> corners{};
  Vec3f middle{};
  float reach = 0;
};

struct View {
  View(const Scene& all, const SE3d& T_world_camera, double seconds);

  /// Whether something of a surface may be within these planes.
  static bool mayBeInside(const SeenPrimitive& primitive, const TileBounds& bounds);

  const Scene* scene;
  std::vector<SeenPrimitive> primitives;  ///< the nearest first
  std::array<Vec3f, 3> world_rows{};      ///< rotation from camera to world
  Vec3f position{};                       ///< of the camera, world

  Vec3f toWorld(const Vec3f& direction) const {
    return {
        {world_rows[0].dot(direction), world_rows[1].dot(direction), world_rows[2].dot(direction)}};
  }

 private:
  void add(const Primitive& primitive, const SE3d& T_camera_world, double seconds);
};

/// What the rays of a tile meet: places in View::primitives, -1 for the sky, and how far away.
struct TileHits {
  float distance[kTileSize];
  std::int32_t primitive[kTileSize];
};

/// Finds the nearest surface of each ray.
/// @param candidates  places in View::primitives, the nearest first
void trace(const View& view, const RayTile& rays, const std::vector<std::int32_t>& candidates,
           TileHits& hits);

/// The same for one direction of length 1.
/// @return place in View::primitives, or -1
std::int32_t traceOne(const View& view, const Vec3f& ray,
                      const std::vector<std::int32_t>& candidates, float& distance);

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_VIEW_H
