// The pose of a camera from points that are known, as tracking has it for every frame.
#include <gslam/geometry/random.h>
#include <gslam/optimizer.h>
#include <gslam/optimizer_pba.h>

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

int main() {
  std::mt19937 generator(7);
  const auto off = [&](double reach) { return gslam::randomUniform(generator, -reach, reach); };
  const gslam::Camera camera =
      gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
  const gslam::SE3d T_world_camera(gslam::SO3d::exp({0.1, 0.2, 0}), {1, 2, 3});
  std::vector<gslam::Vec3d> points;
  std::vector<gslam::Vec2d> pixels;
  while (points.size() < 100) {
    const gslam::Vec3d seen = {off(2), off(2), 6 + off(2)};
    gslam::Vec2d pixel;
    if (!camera.project(seen, pixel)) continue;
    points.push_back(T_world_camera * seen);
    pixels.push_back(points.size() % 10 == 0 ? gslam::Vec2d{off(300), off(300)}  // a wrong match
                                             : pixel + gslam::Vec2d{off(1), off(1)});
  }

  std::vector<std::uint8_t> inliers(points.size());
  gslam::PoseProblem problem;
  problem.points = points;
  problem.pixels = pixels;
  problem.cameras = gslam::Span<const gslam::Camera>(&camera, 1);
  problem.inliers = inliers;
  gslam::OptimizerOptions options;
  options.loss = {gslam::LossKind::Cauchy, 2};
  const gslam::SE3d start = T_world_camera * gslam::SE3d::exp({0.1, -0.1, 0.1, 0.02, 0.01, -0.02});
  const gslam::OptimizedPose pose = optimizePose(problem, start, options);
  std::cout << nameOf(pose.status) << ": " << pose.T_world_body << ", " << pose.inliers << " of "
            << points.size() << " fit\n";
  return pose.is_usable && pose.inliers >= 85 && pose.T_world_body.isApprox(T_world_camera, 0.05)
             ? 0
             : 1;
}
