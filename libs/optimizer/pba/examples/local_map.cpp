// A window of key frames that moves: what leaves it stays as a prior.
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
  gslam::Bundle bundle;
  bundle.cameras = {gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5})};
  for (int i = 0; i < 300; ++i) bundle.points.push_back({3 + off(6), off(3), 7 + off(1)});
  for (std::uint32_t pose = 0; pose < 6; ++pose) {
    bundle.T_world_body.emplace_back(gslam::SO3d(), gslam::Vec3d{1.0 * pose, 0, 0});
    for (std::uint32_t point = 0; point < bundle.points.size(); ++point) {
      const gslam::Vec3d seen = bundle.T_world_body[pose].inverse() * bundle.points[point];
      gslam::Vec2d pixel;
      if (!bundle.cameras[0].project(seen, pixel)) continue;
      if (!bundle.cameras[0].isInImage(pixel)) continue;
      bundle.observation_pose.push_back(pose);
      bundle.observation_point.push_back(point);
      bundle.observation_camera.push_back(0);
      bundle.pixels.push_back(pixel + gslam::Vec2d{off(0.5), off(0.5)});
    }
  }
  bundle.pose_fixed = {1, 1, 0, 0, 0, 0};
  const gslam::OptimizerSummary summary = optimizeBundle(bundle.problem());
  std::cout << briefReport(summary) << "\n";

  // Poses 4 and 5 go on; all else becomes what is known of them.
  const std::vector<std::uint32_t> keep = {4, 5};
  const gslam::WindowPrior prior = marginalize(bundle.problem(), keep);
  std::cout << "a prior on " << prior.poses.size() << " poses, " << prior.information.size()
            << " numbers\n";
  return summary.is_usable && prior.poses.size() == 2 ? 0 : 1;
}
