#include "scene/eye.h"

#include <limits>

namespace visual {

using gslam::Vec2d;
using gslam::Vec3d;

bool Eye::pointOf(const Vec2d& pixel, double depth, Vec3d& point) const {
  Vec3d bearing;
  if (!camera.unproject(pixel, bearing) || !(bearing[2] > 0.05)) return false;
  point = (depth / bearing[2]) * bearing;
  return true;
}

double Eye::rightOf(const Vec2d& pixel, double depth) const {
  Vec3d point;
  Vec2d right;
  if (!pointOf(pixel, depth, point)) return std::numeric_limits<double>::quiet_NaN();
  if (!camera.project({point[0] - baseline, point[1], point[2]}, right)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return right[0];
}

}  // namespace visual
