// Where on a texture a ray ends, for each shape.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_TEXTURE_POINT_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_TEXTURE_POINT_H

#include <algorithm>
#include <cmath>

#include "view.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// A place of a texture, and how it is looked at: a pixel covers an ellipse there.
struct TexturePoint {
  float s, t;              // metres
  float along_s, along_t;  // where the long axis of the ellipse points, any length
  float cosine;            // of the angle to the normal: short axis by long axis
  float light;
};

// Each takes a ray of length 1 in camera coordinates, and how far it goes.

struct PlanePoint {
  explicit PlanePoint(const SeenPrimitive& p) : u(p.u), v(p.v), n(p.n), light(p.from->light) {
    const float middle = p.from->shape == Shape::disc ? p.from->a : 0;
    s = middle + p.from->shift_s - p.along_u;
    t = middle + p.from->shift_t - p.along_v;
  }
  TexturePoint operator()(float x, float y, float z, float distance) const {
    const float ru = u[0] * x + u[1] * y + u[2] * z, rv = v[0] * x + v[1] * y + v[2] * z;
    const float rn = n[0] * x + n[1] * y + n[2] * z;
    return {distance * ru + s, distance * rv + t, ru, rv, std::fabs(rn), light};
  }
  Vec3f u, v, n;
  float s, t, light;
};

// Seen from above; the slope of the hills is neglected.
struct TerrainPoint {
  explicit TerrainPoint(const View& view)
      : rows(view.world_rows),
        s(view.position[0] + view.scene->terrain->half()),
        t(view.position[1] + view.scene->terrain->half()) {}
  TexturePoint operator()(float x, float y, float z, float distance) const {
    const float wx = rows[0][0] * x + rows[0][1] * y + rows[0][2] * z;
    const float wy = rows[1][0] * x + rows[1][1] * y + rows[1][2] * z;
    const float wz = rows[2][0] * x + rows[2][1] * y + rows[2][2] * z;
    return {distance * wx + s, distance * wy + t, wx, wy, std::fabs(wz), 1};
  }
  std::array<Vec3f, 3> rows;
  float s, t;
};

// Round things are lit from above and one side.
inline float lightOnRound(float x, float y, float z) {
  return 0.72F + 0.28F * (0.36F * x + 0.48F * y + 0.8F * z);
}

// Goes evenly enough from 0 to 4 around the circle.
inline float diamondAngle(float x, float y) {
  const float part = y / std::max(std::fabs(x) + std::fabs(y), 1e-9F);
  return x >= 0 ? (y >= 0 ? part : 4 + part) : 2 - part;
}

struct CylinderPoint {
  explicit CylinderPoint(const SeenPrimitive& p) : p_(p) {}
  TexturePoint operator()(float x, float y, float z, float distance) const {
    constexpr float kQuarterTurn = 1.57079633F;
    const Vec3f ray = {{x, y, z}};
    const float ru = p_.u.dot(ray), rv = p_.v.dot(ray), rn = p_.n.dot(ray), a = p_.from->a;
    const float nu = (distance * ru - p_.along_u) / a, nv = (distance * rv - p_.along_v) / a;
    const Vec3f world = nu * p_.from->u + nv * p_.from->v;
    return {diamondAngle(nu, nv) * kQuarterTurn * a,
            distance * rn - p_.along_n,
            rv * nu - ru * nv,
            rn,
            std::fabs(ru * nu + rv * nv),
            lightOnRound(world[0], world[1], world[2])};
  }

 private:
  const SeenPrimitive& p_;
};

// The sphere is folded into a square as an octahedron is.
struct SpherePoint {
  explicit SpherePoint(const SeenPrimitive& p) : p_(p) {}
  TexturePoint operator()(float rx, float ry, float rz, float distance) const {
    const Vec3f ray = {{rx, ry, rz}};
    const Vec3f normal = (distance * ray - p_.origin) / p_.from->a;
    const float x = normal.dot(p_.u), y = normal.dot(p_.v), z = normal.dot(p_.n);
    const float sum = std::fabs(x) + std::fabs(y) + std::fabs(z);
    float s = x / sum, t = y / sum;
    if (z < 0) {
      const float folded = (1 - std::fabs(t)) * (s >= 0 ? 1.0F : -1.0F);
      t = (1 - std::fabs(s)) * (t >= 0 ? 1.0F : -1.0F);
      s = folded;
    }
    const float half = 1.7725F * p_.from->a;  // the square has the sphere's area
    return {(s + 1) * half,       (t + 1) * half, 1, 1, std::max(std::fabs(normal.dot(ray)), 0.5F),
            lightOnRound(x, y, z)};
  }

 private:
  const SeenPrimitive& p_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_TEXTURE_POINT_H
