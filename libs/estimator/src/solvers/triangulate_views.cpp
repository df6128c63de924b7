#include <gslam/estimator/solvers/triangulate_views.h>

#include <cmath>
#include <limits>

#include "math/check_size.h"

namespace gslam {
inline namespace v1 {
namespace {

constexpr int kMostSteps = 10;

// A ray in the local frame: its z is about the mean of the rays, its origin the first camera.
struct Ray {
  Vec3d centre;
  Vec3d direction;
};

class LocalFrame {
 public:
  // False where there is no mean direction.
  bool compute(Span<const SE3d> T_camera_world, Span<const Vec3d> bearings) {
    Vec3d mean{};
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      mean += T_camera_world[i].rotation().inverse() * bearings[i];
    }
    const double length = mean.norm();
    if (!(length > 1e-8 && length <= std::numeric_limits<double>::max())) {
      // Rays from all sides: any frame is as good.
      if (!(length >= 0 && length <= 1e-8)) return false;
      mean = {{0, 0, 1}};
    } else {
      mean *= 1 / length;
    }
    // The shortest way from z to the mean, or back from the other side.
    if (mean[2] < 0) mean *= -1;
    const double scale = 1 / std::sqrt(2 + 2 * mean[2]);
    local_world_ =
        SO3d::fromQuaternion(scale * mean[1], -scale * mean[0], 0, scale * (1 + mean[2]));
    origin_ = centreOf(T_camera_world[0]);
    return true;
  }
  Ray ray(const SE3d& T_camera_world, const Vec3d& bearing) const noexcept {
    return {local_world_ * (centreOf(T_camera_world) - origin_),
            local_world_ * (T_camera_world.rotation().inverse() * bearing)};
  }
  Vec3d toWorld(const Vec3d& p) const noexcept { return local_world_.inverse() * p + origin_; }

 private:
  static Vec3d centreOf(const SE3d& T) noexcept { return T.inverse().translation(); }

  SO3d local_world_;
  Vec3d origin_{};
};

// Sums of w (I - u u^T), for u near z: z z is small and must not be made by a difference.
struct Projectors {
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, zz = 0;
  double weights = 0;
  Vec3d right{};

  void add(const Vec3d& u, double w) noexcept {
    const double x2 = u[0] * u[0], y2 = u[1] * u[1], z2 = u[2] * u[2];
    xx += w * (y2 + z2);
    xy -= w * (u[0] * u[1]);
    yy += w * (x2 + z2);
    xz -= w * (u[0] * u[2]);
    yz -= w * (u[1] * u[2]);
    zz += w * (x2 + y2);
    weights += w;
  }
  bool solve(Vec3d& solution) const noexcept {
    const double determinant = xx * yy - xy * xy;
    const double inverse = 1 / determinant;
    // Column z in terms of the others.
    const double kx = inverse * (yy * xz - xy * yz);
    const double ky = inverse * (xx * yz - xy * xz);
    const double rest = zz - (kx * xz + ky * yz);
    if (!(determinant > 1e-20 * weights * weights && rest > 1e-20 * weights)) return false;
    const double z = (right[2] - (kx * right[0] + ky * right[1])) / rest;
    const double rx = right[0] - xz * z;
    const double ry = right[1] - yz * z;
    solution = {{inverse * (yy * rx - xy * ry), inverse * (xx * ry - xy * rx), z}};
    return solution.squaredNorm() <= std::numeric_limits<double>::max();
  }
};

// The equations of a step of Gauss and Newton at `point`, and the sum of squared chords there.
struct Step {
  Step(const LocalFrame& frame, Span<const SE3d> T_camera_world, Span<const Vec3d> bearings,
       const Vec3d& point) noexcept {
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      const Ray ray = frame.ray(T_camera_world[i], bearings[i]);
      const Vec3d to_point = point - ray.centre;
      const double inverse = 1 / std::sqrt(to_point.squaredNorm());
      const Vec3d u = inverse * to_point;
      const Vec3d chord = ray.direction - u;
      cost += chord.squaredNorm();
      in_front = in_front && u.dot(ray.direction) > 0;
      equations.add(u, inverse * inverse);
      equations.right += inverse * (chord - u.dot(chord) * u);
    }
  }

  Projectors equations;
  double cost = 0;
  bool in_front = true;
};

}  // namespace

std::size_t triangulateViews(Span<const SE3d> T_camera_world, Span<const Vec3d> bearings,
                             Vec3d& point_world) {
  detail::checkSizes("T_camera_world", T_camera_world.size(), "bearings", bearings.size(), 2);
  LocalFrame frame;
  if (!frame.compute(T_camera_world, bearings)) return 0;
  Projectors linear;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const Ray ray = frame.ray(T_camera_world[i], bearings[i]);
    linear.add(ray.direction, 1);
    linear.right += ray.centre - ray.direction.dot(ray.centre) * ray.direction;
  }
  Vec3d point;
  if (!linear.solve(point)) return 0;

  Step now(frame, T_camera_world, bearings, point);
  for (int i = 0; i < kMostSteps; ++i) {
    Vec3d delta;
    if (!now.equations.solve(delta)) break;
    const Vec3d next = point + delta;
    const Step then(frame, T_camera_world, bearings, next);
    if (!(then.cost < now.cost)) break;
    now = then;
    point = next;
    if (!(delta.squaredNorm() > 1e-24 * point.squaredNorm())) break;
  }
  const Vec3d world = frame.toWorld(point);
  if (!now.in_front || !(world.squaredNorm() <= std::numeric_limits<double>::max())) return 0;
  point_world = world;
  return 1;
}

}  // namespace v1
}  // namespace gslam
