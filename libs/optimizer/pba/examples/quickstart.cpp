#include <gslam/geometry/random.h>
#include <gslam/optimizer.h>
#include <gslam/optimizer_pba.h>

#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

int main() {
  // Eight poses along a wall of 200 points, all of it a little wrong; yours come from a map.
  std::mt19937 generator(7);
  const auto off = [&](double reach) { return gslam::randomUniform(generator, -reach, reach); };
  std::vector<gslam::Camera> cameras = {
      gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5})};
  std::vector<gslam::SE3d> poses;
  std::vector<gslam::Vec3d> points;
  std::vector<std::uint32_t> of_pose, of_point;
  std::vector<gslam::Vec2d> pixels;
  for (int i = 0; i < 200; ++i) points.push_back({3.5 + off(5), off(2), 6 + off(1)});
  for (std::uint32_t pose = 0; pose < 8; ++pose) {
    poses.emplace_back(gslam::SO3d::exp({0, off(0.1), 0}), gslam::Vec3d{1.0 * pose, off(0.2), 0});
    for (std::uint32_t point = 0; point < points.size(); ++point) {
      gslam::Vec2d pixel;
      if (!cameras[0].project(poses[pose].inverse() * points[point], pixel)) continue;
      if (!cameras[0].isInImage(pixel)) continue;
      of_pose.push_back(pose);
      of_point.push_back(point);
      pixels.push_back(pixel + gslam::Vec2d{off(1), off(1)});
    }
  }
  for (std::size_t i = 2; i < 8; ++i) poses[i] *= gslam::SE3d::exp({off(0.1), off(0.1), off(0.1)});
  for (gslam::Vec3d& point : points) point += {off(0.2), off(0.2), off(0.2)};
  const std::vector<std::uint8_t> pose_fixed = {1, 1, 0, 0, 0, 0, 0, 0};

  gslam::BundleProblem problem;
  problem.T_world_body = poses;
  problem.pose_fixed = pose_fixed;
  problem.points = points;
  problem.cameras = cameras;
  problem.observation_pose = of_pose;
  problem.observation_point = of_point;
  problem.pixels = pixels;
  gslam::OptimizerOptions options;
  options.loss = {gslam::LossKind::Huber, 2};  // pixels
  const gslam::OptimizerSummary summary = optimizeBundle(problem, options);
  std::cout << fullReport(summary);
  return summary.is_usable && summary.final_cost < 0.5 * static_cast<double>(pixels.size()) ? 0 : 1;
}
