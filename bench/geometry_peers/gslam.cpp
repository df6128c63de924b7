#include <gslam/geometry.h>

#include "rotations.h"

namespace {

struct Gslam {
  using Rotation = gslam::SO3d;
  using Vector = gslam::Vec3d;

  static Vector vector(double x, double y, double z) { return Vector{x, y, z}; }
  static Rotation exp(const Vector& v) { return Rotation::exp(v); }
  static Vector log(const Rotation& r) { return r.log(); }
  static Rotation inverse(const Rotation& r) { return r.inverse(); }
  static Rotation mult(const Rotation& a, const Rotation& b) { return a * b; }
  static Vector act(const Rotation& r, const Vector& v) { return r * v; }
};

PEER(Gslam, "gslam");

}  // namespace
