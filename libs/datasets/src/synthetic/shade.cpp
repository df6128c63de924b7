#include "shade.h"

#include <algorithm>
#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kQuarterTurn = 1.57079633F;

// A place of a texture, and how it is looked at: a pixel covers an ellipse there.
struct TexturePoint {
  float s, t;            // metres
  float along_s, along_t;  // where the long axis of the ellipse points, any length
  float cosine;          // of the angle to the normal: short axis by long axis
  float light;
};

// Round things are lit from above and one side.
float lightOn(float x, float y, float z) {
  return 0.72F + 0.28F * (0.36F * x + 0.48F * y + 0.8F * z);
}

// Goes evenly enough from 0 to 4 around the circle.
float diamondAngle(float x, float y) {
  const float part = y / std::max(std::fabs(x) + std::fabs(y), 1e-9F);
  return x >= 0 ? (y >= 0 ? part : 4 + part) : 2 - part;
}

TexturePoint onPlane(const SeenPrimitive& p, const Vec3f& ray, float t) {
  const float ru = p.u.dot(ray), rv = p.v.dot(ray);
  const float half = p.from->shape == Shape::disc ? p.from->a : 0;
  return {t * ru - p.along_u + half, t * rv - p.along_v + half, ru, rv,
          std::fabs(p.n.dot(ray)), 1};
}

TexturePoint onCylinder(const SeenPrimitive& p, const Vec3f& ray, float t) {
  const float ru = p.u.dot(ray), rv = p.v.dot(ray), rn = p.n.dot(ray);
  const float nu = (t * ru - p.along_u) / p.from->a, nv = (t * rv - p.along_v) / p.from->a;
  const Vec3f world = nu * p.from->u + nv * p.from->v;
  return {diamondAngle(nu, nv) * kQuarterTurn * p.from->a, t * rn - p.along_n, rv * nu - ru * nv,
          rn, std::fabs(ru * nu + rv * nv), lightOn(world[0], world[1], world[2])};
}

// The sphere is folded into a square as an octahedron is.
TexturePoint onSphere(const SeenPrimitive& p, const Vec3f& ray, float t) {
  const Vec3f normal = (t * ray - p.origin) / p.from->a;
  const float x = normal.dot(p.u), y = normal.dot(p.v), z = normal.dot(p.n);
  const float sum = std::fabs(x) + std::fabs(y) + std::fabs(z);
  float s = x / sum, w = y / sum;
  if (z < 0) {
    const float folded = (1 - std::fabs(w)) * (s >= 0 ? 1.0F : -1.0F);
    w = (1 - std::fabs(s)) * (w >= 0 ? 1.0F : -1.0F);
    s = folded;
  }
  const float half = 1.7725F * p.from->a;  // the square has the sphere's area
  return {(s + 1) * half, (w + 1) * half, 1, 1, std::max(std::fabs(normal.dot(ray)), 0.5F),
          lightOn(x, y, z)};
}

TexturePoint onTerrain(const View& view, const Vec3f& ray, float t) {
  const Vec3f world = view.toWorld(ray);
  const float half = view.scene->terrain->half();
  return {view.position[0] + t * world[0] + half, view.position[1] + t * world[1] + half, world[0],
          world[1], std::fabs(world[2]), 1};
}

TexturePoint texturePoint(const View& view, const SeenPrimitive& p, const Vec3f& ray, float t) {
  switch (p.from->shape) {
    case Shape::cylinder:
      return onCylinder(p, ray, t);
    case Shape::sphere:
      return onSphere(p, ray, t);
    case Shape::terrain:
      return onTerrain(view, ray, t);
    default:
      return onPlane(p, ray, t);
  }
}

// Averages over the ellipse by up to five round places along its long axis.
float sample(const Texture& texture, const TexturePoint& at, float footprint) {
  const float scale = texture.texelsPerMetre();
  const float small = footprint * scale;
  const float ratio = 1 / std::max(at.cosine, 0.05F);
  const float s = at.s * scale, t = at.t * scale;
  const int count = small * ratio <= 1 || ratio < 1.6F ? 1 : std::min(5, static_cast<int>(ratio + 0.7F));
  const float each = std::max(small, small * ratio / static_cast<float>(count));
  const float level = each <= 1 ? 0 : fastLog2(each);
  if (count == 1) return texture.at(s, t, level);
  const float length = std::sqrt(at.along_s * at.along_s + at.along_t * at.along_t);
  const float step = small * ratio / static_cast<float>(count) / std::max(length, 1e-6F);
  float sum = 0;
  for (int i = 0; i < count; ++i) {
    const float way = step * (static_cast<float>(i) - 0.5F * static_cast<float>(count - 1));
    sum += texture.at(s + way * at.along_s, t + way * at.along_t, level);
  }
  return sum / static_cast<float>(count);
}

}  // namespace

Colour shade(const View& view, const SeenPrimitive& primitive, const Vec3f& ray, float distance,
             float pitch) {
  const Primitive& from = *primitive.from;
  TexturePoint at = texturePoint(view, primitive, ray, distance);
  at.s += from.shift_s;
  at.t += from.shift_t;
  const float part = sample(*from.surface.texture, at, distance * pitch) / 255;
  return mixed(from.surface.dark, from.surface.bright, part) * (from.light * at.light);
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
