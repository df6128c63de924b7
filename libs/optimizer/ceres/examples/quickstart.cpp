#include <gslam/optimizer.h>
#include <gslam/optimizer_ceres.h>

#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
  // Two cameras, one metre apart, see a grid of points.
  std::vector<gslam::SE3d> poses = {gslam::SE3d(), gslam::SE3d(gslam::SO3d(), {1, 0, 0})};
  std::vector<gslam::Camera> cameras = {
      gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5})};
  std::vector<gslam::Vec3d> points;
  std::vector<std::uint32_t> seen_by, seen_point;
  std::vector<gslam::Vec2d> pixels;
  for (std::uint32_t j = 0; j < 25; ++j) {
    points.push_back({j % 5 * 0.5 - 0.5, j / 5 * 0.5 - 1.0, 4 + j % 3 * 0.5});
    for (std::uint32_t p = 0; p < 2; ++p) {
      gslam::Vec2d pixel;
      if (!cameras[0].project(poses[p].inverse() * points[j], pixel)) continue;
      seen_by.push_back(p);
      seen_point.push_back(j);
      pixels.push_back(pixel);
    }
  }

  // What is known of the second camera is not quite right. The first one, and how far away they
  // are from each other, are known.
  poses[1] *= gslam::SE3d::exp({0.05, 0.02, -0.03, 0.01, -0.02, 0.01});
  const std::vector<std::uint8_t> pose_fixed = {1, 0};
  const gslam::PositionPrior at = {1, {1, 0, 0}, 1e6 * gslam::Mat3d::identity()};

  gslam::BundleProblem problem;
  problem.T_world_body = poses;
  problem.pose_fixed = pose_fixed;
  problem.points = points;
  problem.cameras = cameras;
  problem.observation_pose = seen_by;
  problem.observation_point = seen_point;
  problem.pixels = pixels;
  problem.position_priors = {&at, 1};

  gslam::OptimizerOptions options;
  options.backend = "ceres";
  options.loss = {gslam::LossKind::Huber, 2};
  const gslam::OptimizerSummary summary = gslam::optimizeBundle(problem, options);
  std::printf("%s\n", gslam::nameOf(summary.status));
  std::printf("cost %.1f, then %.1f\n", summary.initial_cost, summary.final_cost);
  const gslam::Vec3d position = poses[1].translation();
  std::printf("second camera at %.3f %.3f %.3f\n", position[0], position[1], position[2]);
}
