#ifndef GSLAM_OPTIMIZER_SRC_FACTORS_IS_BEFORE_H
#define GSLAM_OPTIMIZER_SRC_FACTORS_IS_BEFORE_H

#include <gslam/geometry/camera.h>

#include <cstddef>

// Which points the problems of one or two views use.

namespace gslam {
inline namespace v1 {
namespace detail {

struct IsBefore {
  using Result = bool;
  const Vec3d& point;

  template <class Model>
  bool operator()(const Model& model) const {
    Vec2d pixel{};
    return model.project(point, pixel);
  }
  template <std::size_t N>
  bool operator()(const RadtanCamera<double, N>& /*model*/) const {
    return point[2] > 0;
  }
  bool operator()(const PinholeCamera<double>& /*model*/) const { return point[2] > 0; }
  static bool none() { return false; }
};

// Whether a point lies before the plane of a pinhole or radtan camera, which are evaluated by their
// formulas, or is seen by a camera of another model.
inline bool isBefore(const Camera& camera, const Vec3d& point) {
  return camera.visit(IsBefore{point});
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FACTORS_IS_BEFORE_H
