#include <gslam/optimizer.h>

#include <cstdint>
#include <iostream>
#include <vector>

int main() {
  // Yours come from a map, or from a file: gslam/optimizer/files.h.
  const gslam::Camera pinhole =
      gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
  std::vector<gslam::Camera> cameras = {pinhole};
  std::vector<gslam::SE3d> poses = {{gslam::SO3d(), {0, 0, 0}}, {gslam::SO3d(), {1, 0, 0}}};
  std::vector<gslam::Vec3d> points = {{0, 0, 5}, {1, -0.5, 6}, {0, 0, 8}};
  const std::vector<std::uint32_t> of_pose = {0, 0, 1, 1, 1}, of_point = {0, 1, 0, 1, 2};
  const std::vector<gslam::Vec2d> pixels = {
      {319, 240}, {403, 198}, {219.5, 239.5}, {319, 197.5}, {257, 240}};

  gslam::BundleProblem problem;  // views: nothing is copied, and results are written in place
  problem.T_world_body = poses;
  problem.points = points;
  problem.cameras = cameras;
  problem.observation_pose = of_pose;
  problem.observation_point = of_point;
  problem.pixels = pixels;

  for (const gslam::ProblemFinding& finding : checkBundle(problem)) {
    std::cout << (finding.is_error ? "error: " : "warning: ") << finding.field << " "
              << finding.problem << "\n";
  }
  std::cout << "cost: " << bundleCost(problem, {gslam::LossKind::Huber, 1}) << "\n";

  if (gslam::optimizerBackends().empty()) {  // #include <gslam/optimizer_pba.h>, and link it
    std::cout << "There is no back end, which optimizeBundle(problem) needs.\n";
  } else {
    std::cout << fullReport(optimizeBundle(problem));
  }
}
