#include <gslam/geometry.h>

#include <iostream>

int main() {
  const double pi = 3.14159265358979323846;
  const gslam::SO3d R_world_body = gslam::SO3d::exp({0, 0, pi / 2});  // a quarter turn about z
  const gslam::Vec3d forward_body = {1, 0, 0};
  const gslam::Vec3d forward_world = R_world_body * forward_body;
  std::cout << "forward, in the world: " << forward_world << "\n";  // y, up to rounding

  const gslam::SO3d R_moved = R_world_body * gslam::SO3d::exp({1e-9, 0, 0});  // on the right
  std::cout << "step of the body, in radians: " << (R_world_body.inverse() * R_moved).log() << "\n"
            << "quaternion x y z w: " << R_moved << "\n";
  const bool is_right = forward_world.dot({0, 1, 0}) > 1 - 1e-15;
  return is_right && R_moved.isApprox(R_world_body, 1e-8) ? 0 : 1;
}
