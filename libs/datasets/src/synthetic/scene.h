// A world as the renderer sees it: simple surfaces with textures.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_SCENE_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_SCENE_H

#include <gslam/geometry/vec.h>

#include <deque>
#include <memory>
#include <vector>

#include "noise_field.h"
#include "terrain.h"
#include "texture.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

enum class Shape { rectangle, disc, cylinder, sphere, terrain };

/// Red, green, blue: 0 to 255.
struct Colour {
  float r, g, b;
};

/// A texture, and the colours of its darkest and its brightest parts.
struct Surface {
  const Texture* texture = nullptr;
  Colour dark{20, 20, 20};
  Colour bright{235, 235, 235};
};

/// One surface, seen from one side only: where n points, and from outside of round ones.
///
/// * rectangle: corner `origin`, a along u, b along v, n = u x v
/// * disc: centre `origin`, radius a, axes u and v
/// * cylinder: the side without its ends: from `origin` b along n, radius a
/// * sphere: centre `origin`, radius a
struct Primitive {
  Shape shape = Shape::rectangle;
  Vec3f origin{}, u{}, v{}, n{};
  float a = 0, b = 0;
  Surface surface;
  float shift_s = 0, shift_t = 0;  ///< where its texture begins, metres
  float light = 1;                 ///< factor on the brightness
  int mover = -1;                  ///< place in Scene::movers; -1: it stays
};

/// The way of something that moves, around a centre: x and y by sines, always upright.
struct Mover {
  Vec3f centre{};
  float reach_x = 0, reach_y = 0;
  float rate = 0;   ///< rounds a second
  float phase = 0;  ///< rounds

  /// Where it is after this many seconds.
  Vec3f at(double seconds) const;
};

/// What a ray meets that meets nothing.
struct Sky {
  Colour zenith{92, 128, 196};
  Colour horizon{196, 206, 218};
  Colour ground{96, 92, 84};
};

struct Scene {
  std::vector<Primitive> primitives;
  std::vector<Mover> movers;
  std::deque<Texture> textures;  ///< stay where they are
  std::unique_ptr<Terrain> terrain;
  std::unique_ptr<NoiseField> clouds;
  Sky sky;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_SCENE_H
