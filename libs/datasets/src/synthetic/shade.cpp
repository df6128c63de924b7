#include "shade.h"

#include <algorithm>
#include <cmath>

#include "texture_point.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

// How a texture is read: at `count` places in a row, texels of its finest level.
struct Reading {
  float s, t, step_s, step_t, level, count;
};

// The ellipse that a pixel covers is averaged by up to four round places along its long axis.
inline Reading readingOf(const TexturePoint& at, float scale, float footprint) {
  const float small = footprint * scale;
  const float ratio = 1 / std::max(at.cosine, 0.05F);
  const float wanted = std::min(4.0F, static_cast<float>(static_cast<int>(0.6F * ratio + 0.55F)));
  const float count = small * ratio <= 1 ? 1.0F : wanted;
  const float step = small * ratio / count;
  const float each = std::max(std::max(small, step), 1.0F);
  const float length =
      std::sqrt(std::max(at.along_s * at.along_s + at.along_t * at.along_t, 1e-12F));
  const float way = step / length;
  const float first = -0.5F * (count - 1);
  const float step_s = way * at.along_s, step_t = way * at.along_t;
  return {at.s * scale + first * step_s,
          at.t * scale + first * step_t,
          step_s,
          step_t,
          fastLog2(each),
          count};
}

// 0 to 1.
inline float read(const Texture& texture, const Reading& r) {
  const int count = static_cast<int>(r.count);
  if (count == 1) return texture.at(r.s, r.t, r.level) * (1.0F / 255);
  float sum = 0;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<float>(i);
    sum += texture.at(r.s + k * r.step_s, r.t + k * r.step_t, r.level);
  }
  return sum / (255 * r.count);
}

template <class Point>
Colour shadeAs(const Point& point, const Surface& surface, const Vec3f& ray, float distance,
               float pitch) {
  const TexturePoint at = point(ray[0], ray[1], ray[2], distance);
  const Texture& texture = *surface.texture;
  const float part = read(texture, readingOf(at, texture.texelsPerMetre(), distance * pitch));
  return mixed(surface.dark, surface.bright, part) * at.light;
}

template <class Point>
void shadeTileAs(const Point& point, const Texture& texture, const RayTile& rays,
                 const float* distances, TileShades& shades) {
  float s[kTileSize], t[kTileSize], step_s[kTileSize], step_t[kTileSize];
  float level[kTileSize], count[kTileSize];
  const float scale = texture.texelsPerMetre();
  for (int i = 0; i < kTileSize; ++i) {
    const TexturePoint at = point(rays.x[i], rays.y[i], rays.z[i], distances[i]);
    const Reading reading = readingOf(at, scale, distances[i] * rays.pitch[i]);
    s[i] = reading.s;
    t[i] = reading.t;
    step_s[i] = reading.step_s;
    step_t[i] = reading.step_t;
    level[i] = reading.level;
    count[i] = reading.count;
    shades.light[i] = at.light;
  }
  for (int i = 0; i < kTileSize; ++i) {
    shades.part[i] = read(texture, {s[i], t[i], step_s[i], step_t[i], level[i], count[i]});
  }
}

}  // namespace

Colour shade(const View& view, const SeenPrimitive& p, const Vec3f& ray, float distance,
             float pitch) {
  const Surface& surface = p.from->surface;
  switch (p.from->shape) {
    case Shape::cylinder:
      return shadeAs(CylinderPoint(p), surface, ray, distance, pitch);
    case Shape::sphere:
      return shadeAs(SpherePoint(p), surface, ray, distance, pitch);
    case Shape::terrain:
      return shadeAs(TerrainPoint(view), surface, ray, distance, pitch);
    default:
      return shadeAs(PlanePoint(p), surface, ray, distance, pitch);
  }
}

void shadeTile(const View& view, const SeenPrimitive& p, const RayTile& rays,
               const float* distances, TileShades& shades) {
  const Texture& texture = *p.from->surface.texture;
  switch (p.from->shape) {
    case Shape::cylinder:
      return shadeTileAs(CylinderPoint(p), texture, rays, distances, shades);
    case Shape::sphere:
      return shadeTileAs(SpherePoint(p), texture, rays, distances, shades);
    case Shape::terrain:
      return shadeTileAs(TerrainPoint(view), texture, rays, distances, shades);
    default:
      return shadeTileAs(PlanePoint(p), texture, rays, distances, shades);
  }
}

Colour shadeSky(const View& view, const Vec3f& ray) {
  const Vec3f world = view.toWorld(ray);
  const Sky& sky = view.scene->sky;
  if (world[2] < 0) return mixed(sky.horizon, sky.ground, std::min(1.0F, -6 * world[2]));
  const Colour clear = mixed(sky.horizon, sky.zenith, std::sqrt(world[2]));
  if (view.scene->clouds == nullptr) return clear;
  const float scale = 0.06F / (world[2] + 0.12F);
  const float cloud = view.scene->clouds->at(world[0] * scale, world[1] * scale);
  const float part = std::min(std::max(1.4F * cloud + 0.1F, 0.0F), 0.85F);
  return mixed(clear, {238, 240, 244}, part * std::min(1.0F, 5 * world[2]));
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
