// Puts boxes, posters, columns into a scene.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_BUILDER_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_BUILDER_H

#include <cstdint>
#include <vector>

#include "hash.h"
#include "painter.h"
#include "scene.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

const Vec3f kUp = {{0, 0, 1}};

class Builder {
 public:
  /// @param detail  all texels are this many times as large
  Builder(Scene& scene, std::uint64_t seed, float detail);

  Generator random;

  /// A new texture in new colours.
  /// @param texel  metres, for detail 1
  Surface paint(Material material, float width, float height, float texel);
  /// `count` of them, to choose from.
  std::vector<Surface> paintMany(Material material, int count, float width, float height,
                                 float texel);
  /// One of several, at random.
  const Surface& any(const std::vector<Surface>& surfaces);

  /// A rectangle that faces where u x v points.
  void rectangle(const Vec3f& corner, const Vec3f& u, const Vec3f& v, float a, float b,
                 const Surface& surface);
  /// An upright wall from one place to another, seen from its right.
  void wall(const Vec3f& from, const Vec3f& to, float height, const Surface& surface);
  /// A rectangle that lies on the ground, seen from above; or from below.
  void floor(float x, float y, float z, float width, float length, const Surface& surface);
  void ceiling(float x, float y, float z, float width, float length, const Surface& surface);
  /// An upright box, turned about its axis. Its faces have different parts of the texture.
  /// @param base     middle of its lower face
  /// @param size     along its own axes
  /// @param extent   of the textures, metres
  void box(const Vec3f& base, const Vec3f& size, float yaw, const Surface& sides,
           const Surface& top, float extent, int mover = -1, bool has_bottom = false);
  void cylinder(const Vec3f& base, float radius, float height, const Surface& side,
                const Surface& top, int mover = -1);
  void sphere(const Vec3f& middle, float radius, const Surface& surface, int mover = -1);

 private:
  void face(const Vec3f& middle, const Vec3f& u, const Vec3f& v, float a, float b,
            const Surface& surface, float extent, int mover);
  Primitive& add(Shape shape, const Surface& surface, int mover);

  Scene& scene_;
  Painter painter_;
  float detail_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_BUILDER_H
