#include "view.h"

#include <algorithm>
#include <cmath>

#include "pi.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

float clamp(float x, float low, float high) {
  return std::min(std::max(x, low), high);
}

// From the camera, at the origin, to a rectangle.
float distanceTo(const SeenPrimitive& p, float a, float b) {
  const float du = clamp(-p.along_u, 0, a) + p.along_u;
  const float dv = clamp(-p.along_v, 0, b) + p.along_v;
  return std::sqrt(du * du + dv * dv + p.along_n * p.along_n);
}

void setCorners(SeenPrimitive& p, const Vec3f& first, float a, float b) {
  p.corner_count = 4;
  p.corners = {{first, first + a * p.u, first + b * p.v, first + a * p.u + b * p.v}};
}

void setBall(SeenPrimitive& p, const Vec3f& middle, float reach) {
  p.middle = middle;
  p.reach = reach;
  p.near = std::max(0.0F, middle.norm() - reach);
}

// False for what shows its back.
bool setBounds(SeenPrimitive& p) {
  const float a = p.from->a, b = p.from->b;
  switch (p.from->shape) {
    case Shape::rectangle:
      setCorners(p, p.origin, a, b);
      p.near = distanceTo(p, a, b);
      return p.along_n < 0;
    case Shape::disc:
      setCorners(p, p.origin - a * p.u - a * p.v, 2 * a, 2 * a);
      p.near = std::max(0.0F, p.origin.norm() - a);
      return p.along_n < 0;
    case Shape::cylinder:
      setBall(p, p.origin + (b / 2) * p.n, std::sqrt(a * a + b * b / 4));
      return true;
    case Shape::sphere:
      setBall(p, p.origin, a);
      return true;
    case Shape::terrain:
      p.corner_count = -1;
      return true;
  }
  return false;
}

}  // namespace

Vec3f Mover::at(double seconds) const {
  const double angle = 2 * kPi * (double(rate) * seconds + double(phase));
  return centre + Vec3f{{reach_x * static_cast<float>(std::cos(angle)),
                         reach_y * static_cast<float>(std::sin(angle)), 0}};
}

View::View(const Scene& all, const SE3d& T_world_camera, double seconds)
    : scene(&all), position(T_world_camera.translation().cast<float>()) {
  const Mat<double, 3, 3> rotation = T_world_camera.rotation().matrix();
  for (std::size_t i = 0; i < 3; ++i) world_rows[i] = rotation.row(i).cast<float>();
  const SE3d T_camera_world = T_world_camera.inverse();
  primitives.reserve(all.primitives.size());
  for (const Primitive& primitive : all.primitives) add(primitive, T_camera_world, seconds);
  std::stable_sort(primitives.begin(), primitives.end(),
                   [](const SeenPrimitive& a, const SeenPrimitive& b) { return a.near < b.near; });
}

void View::add(const Primitive& primitive, const SE3d& T_camera_world, double seconds) {
  SeenPrimitive p;
  p.from = &primitive;
  Vec3f origin = primitive.origin;
  if (primitive.mover >= 0) {
    origin += scene->movers[static_cast<std::size_t>(primitive.mover)].at(seconds);
  }
  p.origin = (T_camera_world * origin.cast<double>()).cast<float>();
  p.u = (T_camera_world.rotation() * primitive.u.cast<double>()).cast<float>();
  p.v = (T_camera_world.rotation() * primitive.v.cast<double>()).cast<float>();
  p.n = (T_camera_world.rotation() * primitive.n.cast<double>()).cast<float>();
  p.along_u = p.origin.dot(p.u);
  p.along_v = p.origin.dot(p.v);
  p.along_n = p.origin.dot(p.n);
  if (setBounds(p)) primitives.push_back(p);
}

bool View::mayBeInside(const SeenPrimitive& p, const TileBounds& bounds) {
  if (bounds.is_wide || p.corner_count < 0) return true;
  for (const Vec3f& normal : bounds.normals) {
    if (p.corner_count == 0) {
      if (normal.dot(p.middle) < -p.reach) return false;
    } else if (std::all_of(p.corners.begin(), p.corners.end(),
                           [&](const Vec3f& corner) { return normal.dot(corner) < 0; })) {
      return false;
    }
  }
  return true;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
