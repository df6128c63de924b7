// The colours of points of a surface, or of the sky.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_SHADE_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_SHADE_H

#include "view.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// Red, green, blue: 0 to 255, brighter where light is strong.
/// @param ray       direction of length 1, camera coordinates
/// @param distance  along it
/// @param pitch     radians from pixel to pixel: what is finer is averaged
Colour shade(const View& view, const SeenPrimitive& primitive, const Vec3f& ray, float distance,
             float pitch);

/// The same for all rays of a tile that sees nothing else: the brightness of the texture, 0 to 1,
/// and the light on it. (So that its arithmetic is done for several pixels at a time.)
struct TileShades {
  float part[kTileSize], light[kTileSize];
};
void shadeTile(const View& view, const SeenPrimitive& primitive, const RayTile& rays,
               const float* distances, TileShades& shades);

/// The sky, or the ground far away, in a direction of length 1, camera coordinates.
Colour shadeSky(const View& view, const Vec3f& ray);

inline Colour operator+(const Colour& a, const Colour& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
inline Colour operator*(const Colour& a, float factor) {
  return {a.r * factor, a.g * factor, a.b * factor};
}
inline Colour mixed(const Colour& a, const Colour& b, float part) {
  return a * (1 - part) + b * part;
}
/// Brightness as BT.601 has it.
inline float greyOf(const Colour& c) {
  return 0.299F * c.r + 0.587F * c.g + 0.114F * c.b;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_SHADE_H
