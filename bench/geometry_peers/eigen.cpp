#include <Eigen/Geometry>

#include "rotations.h"

namespace {

// Eigen has no exp and log of rotations; these are what its users write.
struct EigenQuaternion {
  using Rotation = Eigen::Quaterniond;
  using Vector = Eigen::Vector3d;

  static Vector vector(double x, double y, double z) { return Vector(x, y, z); }
  static Rotation exp(const Vector& v) {
    const double angle = v.norm();
    return Rotation(Eigen::AngleAxisd(angle, v / angle));
  }
  static Vector log(const Rotation& r) {
    const Eigen::AngleAxisd angle_axis(r);
    return angle_axis.angle() * angle_axis.axis();
  }
  static Rotation inverse(const Rotation& r) { return r.conjugate(); }
  static Rotation mult(const Rotation& a, const Rotation& b) { return a * b; }
  static Vector act(const Rotation& r, const Vector& v) { return r * v; }
};

PEER(EigenQuaternion, "eigen");

}  // namespace
