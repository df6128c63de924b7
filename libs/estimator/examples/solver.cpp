#include <gslam/estimator/solvers/p3p.h>

#include <array>
#include <iostream>

int main() {
  const gslam::SE3d T_camera_world(gslam::SO3d::exp({0.3, -0.2, 0.1}), {0.1, 0.2, 5});
  const std::array<gslam::Vec3d, 3> points = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}};
  std::array<gslam::Vec3d, 3> bearings;
  for (std::size_t i = 0; i < 3; ++i) bearings[i] = (T_camera_world * points[i]).normalized();

  std::array<gslam::SE3d, 4> poses;  // no memory is allocated
  const std::size_t count = gslam::p3p(bearings, points, poses);
  bool is_found = false;
  for (std::size_t i = 0; i < count; ++i) {
    std::cout << "T_camera_world: " << poses[i] << "\n";
    is_found = is_found || poses[i].isApprox(T_camera_world, 1e-9);
  }
  return is_found ? 0 : 1;
}
