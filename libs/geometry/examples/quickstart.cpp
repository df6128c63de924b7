#include <gslam/geometry.h>

#include <iostream>

int main() {
  const double pi = 3.14159265358979323846;
  const gslam::SO3d R_world_body = gslam::SO3d::exp({0, 0, pi / 2});  // a quarter turn about z
  gslam::SE3d T_world_body(R_world_body, {10, 0, 0});

  T_world_body *= gslam::SE3d::exp({1, 0, 0, 0, 0, 0});  // one metre forward, in the body's frame
  std::cout << "pose, as a TUM line: " << T_world_body << "\n";  // 10 1 0 0 0 0.707107 0.707107

  const gslam::Vec3d p_world = T_world_body * gslam::Vec3d{2, 0, 0};
  std::cout << "2 m ahead: " << p_world << "\n";  // 10 3 0, up to rounding

  const gslam::Vec<double, 6> delta = {0.1, 0, 0, 0, 0, 1e-9};
  const gslam::SE3d T_moved = T_world_body * gslam::SE3d::exp(delta);
  std::cout << "moved by " << (T_world_body.inverse() * T_moved).log() << "\n";  // delta again
  const gslam::Mat<double, 6, 6> J = gslam::SE3d::rightJacobian(delta);
  std::cout << "right Jacobian: " << J(0, 0) << ", ...\n";

  return T_moved.isApprox(T_world_body, 0.2) && (p_world - gslam::Vec3d{10, 3, 0}).norm() < 1e-14
             ? 0
             : 1;
}
