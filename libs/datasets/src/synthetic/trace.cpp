// The loops over the rays of a tile, without branches so that compilers make vectors of them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "view.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kNear = 0.02F;  // of the camera itself nothing is seen

// Each hit() gives the distance along one ray of length 1, or something that is not above kNear.

struct RectangleHit {
  explicit RectangleHit(const SeenPrimitive& p)
      : u(p.u),
        v(p.v),
        n(p.n),
        along_u(p.along_u),
        along_v(p.along_v),
        along_n(p.along_n),
        a(p.from->a),
        b(p.from->b) {}
  float operator()(float x, float y, float z) const {
    const float t = along_n / (n[0] * x + n[1] * y + n[2] * z);
    const float s = t * (u[0] * x + u[1] * y + u[2] * z) - along_u;
    const float w = t * (v[0] * x + v[1] * y + v[2] * z) - along_v;
    const bool is_inside = (s >= 0) & (s <= a) & (w >= 0) & (w <= b);
    return is_inside ? t : -1.0F;
  }
  Vec3f u, v, n;
  float along_u, along_v, along_n, a, b;
};

struct DiscHit {
  explicit DiscHit(const SeenPrimitive& p)
      : c(p.origin), n(p.n), along_n(p.along_n), squared(p.from->a * p.from->a) {}
  float operator()(float x, float y, float z) const {
    const float t = along_n / (n[0] * x + n[1] * y + n[2] * z);
    const float dx = t * x - c[0], dy = t * y - c[1], dz = t * z - c[2];
    return dx * dx + dy * dy + dz * dz <= squared ? t : -1.0F;
  }
  Vec3f c, n;
  float along_n, squared;
};

struct SphereHit {
  explicit SphereHit(const SeenPrimitive& p) : c(p.origin), squared(p.from->a * p.from->a) {}
  float operator()(float x, float y, float z) const {
    const float middle = c[0] * x + c[1] * y + c[2] * z;
    const float dx = middle * x - c[0], dy = middle * y - c[1], dz = middle * z - c[2];
    const float rest = squared - (dx * dx + dy * dy + dz * dz);
    return rest >= 0 ? middle - std::sqrt(std::max(rest, 0.0F)) : -1.0F;
  }
  Vec3f c;
  float squared;
};

// The circle that the cylinder is seen along its axis.
struct CylinderHit {
  explicit CylinderHit(const SeenPrimitive& p)
      : u(p.u),
        v(p.v),
        n(p.n),
        cu(p.along_u),
        cv(p.along_v),
        cn(p.along_n),
        squared(p.from->a * p.from->a),
        length(p.from->b) {}
  float operator()(float x, float y, float z) const {
    const float ru = u[0] * x + u[1] * y + u[2] * z;
    const float rv = v[0] * x + v[1] * y + v[2] * z;
    const float across = std::max(ru * ru + rv * rv, 1e-12F);
    const float middle = (cu * ru + cv * rv) / across;
    const float du = middle * ru - cu, dv = middle * rv - cv;
    const float rest = squared - (du * du + dv * dv);
    const float t = middle - std::sqrt(std::max(rest, 0.0F) / across);
    const float h = t * (n[0] * x + n[1] * y + n[2] * z) - cn;
    const bool is_hit = (rest >= 0) & (h >= 0) & (h <= length);
    return is_hit ? t : -1.0F;
  }
  Vec3f u, v, n;
  float cu, cv, cn, squared, length;
};

template <class Hit>
void hitTile(const Hit& hit, const RayTile& rays, std::int32_t place, TileHits& hits) {
  for (int i = 0; i < kTileSize; ++i) {
    const float t = hit(rays.x[i], rays.y[i], rays.z[i]);
    const bool is_nearer = (t > kNear) & (t < hits.distance[i]);
    hits.distance[i] = is_nearer ? t : hits.distance[i];
    hits.primitive[i] = is_nearer ? place : hits.primitive[i];
  }
}

float hitTerrain(const View& view, const Vec3f& ray) {
  float distance = -1;
  Vec3f normal{};
  return view.scene->terrain->intersect(view.position, view.toWorld(ray), distance, normal)
             ? distance
             : -1.0F;
}

void hitTileTerrain(const View& view, const RayTile& rays, std::int32_t place, TileHits& hits) {
  for (int i = 0; i < kTileSize; ++i) {
    const float t = hitTerrain(view, {{rays.x[i], rays.y[i], rays.z[i]}});
    if (t <= kNear || t >= hits.distance[i]) continue;
    hits.distance[i] = t;
    hits.primitive[i] = place;
  }
}

}  // namespace

void trace(const View& view, const RayTile& rays, const std::vector<std::int32_t>& candidates,
           TileHits& hits) {
  std::fill_n(hits.distance, kTileSize, kFar);
  std::fill_n(hits.primitive, kTileSize, -1);
  float farthest = kFar;
  for (const std::int32_t place : candidates) {
    const SeenPrimitive& p = view.primitives[static_cast<std::size_t>(place)];
    if (p.near > farthest) return;
    switch (p.from->shape) {
      case Shape::rectangle:
        hitTile(RectangleHit(p), rays, place, hits);
        break;
      case Shape::disc:
        hitTile(DiscHit(p), rays, place, hits);
        break;
      case Shape::sphere:
        hitTile(SphereHit(p), rays, place, hits);
        break;
      case Shape::cylinder:
        hitTile(CylinderHit(p), rays, place, hits);
        break;
      case Shape::terrain:
        hitTileTerrain(view, rays, place, hits);
        break;
    }
    farthest = 0;
    for (const float distance : hits.distance) farthest = std::max(farthest, distance);
  }
}

std::int32_t traceOne(const View& view, const Vec3f& ray,
                      const std::vector<std::int32_t>& candidates, float& distance) {
  distance = kFar;
  std::int32_t found = -1;
  for (const std::int32_t place : candidates) {
    const SeenPrimitive& p = view.primitives[static_cast<std::size_t>(place)];
    if (p.near > distance) break;
    float t = -1;
    switch (p.from->shape) {
      case Shape::rectangle:
        t = RectangleHit(p)(ray[0], ray[1], ray[2]);
        break;
      case Shape::disc:
        t = DiscHit(p)(ray[0], ray[1], ray[2]);
        break;
      case Shape::sphere:
        t = SphereHit(p)(ray[0], ray[1], ray[2]);
        break;
      case Shape::cylinder:
        t = CylinderHit(p)(ray[0], ray[1], ray[2]);
        break;
      case Shape::terrain:
        t = hitTerrain(view, ray);
        break;
    }
    if (t <= kNear || t >= distance) continue;
    distance = t;
    found = place;
  }
  return found;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
