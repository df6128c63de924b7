// How large the image of some observations is: what chance() is measured by.
#ifndef GSLAM_ESTIMATOR_ROBUST_SUPPORT_H
#define GSLAM_ESTIMATOR_ROBUST_SUPPORT_H

#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// The box around points of a plane.
class Box {
 public:
  void add(double x, double y) {
    low_x_ = std::min(low_x_, x), high_x_ = std::max(high_x_, x);
    low_y_ = std::min(low_y_, y), high_y_ = std::max(high_y_, y);
  }
  double area() const { return width() * height(); }
  double diagonal() const { return std::hypot(width(), height()); }

 private:
  double width() const { return std::max(high_x_ - low_x_, 0.0); }
  double height() const { return std::max(high_y_ - low_y_, 0.0); }
  double low_x_ = 1e300, low_y_ = 1e300, high_x_ = -1e300, high_y_ = -1e300;
};

// The cone around bearings: its axis is their mean.
struct Cone {
  double half_angle = 0;   // radians
  double solid_angle = 0;  // steradians

  template <class BearingOf>
  Cone(std::size_t count, const BearingOf& bearing_of) {
    Vec3d sum{};
    for (std::size_t i = 0; i < count; ++i) sum += bearing_of(i);
    const double norm = sum.norm();
    double least = count == 0 ? 1 : -1;
    if (norm > 1e-6 * static_cast<double>(count)) {
      least = 1;
      for (std::size_t i = 0; i < count; ++i) {
        least = std::min(least, sum.dot(bearing_of(i)) / norm);
      }
    }
    half_angle = std::acos(std::max(least, -1.0));
    solid_angle = 2 * 3.14159265358979323846 * (1 - std::max(least, -1.0));
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_SUPPORT_H
