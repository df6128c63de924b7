#include <gslam/estimator.h>
#include <gslam/geometry.h>
#include <gslam/geometry/random.h>

#include <iostream>
#include <random>
#include <vector>

int main() {
  // Two views of 300 points, a third of the matches wrong; yours come from a feature matcher.
  const gslam::Camera camera =
      gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5});
  const gslam::SE3d T_second_first(gslam::SO3d::exp({0, 0.1, 0}), {-1, 0, 0.2});
  std::vector<gslam::Vec2d> first, second;
  std::mt19937 generator(7);
  while (first.size() < 300) {
    const gslam::Vec3d bearing = {gslam::randomUniform(generator, -0.5, 0.5),
                                  gslam::randomUniform(generator, -0.4, 0.4), 1};
    const gslam::Vec3d point = bearing * gslam::randomUniform(generator, 4.0, 12.0);
    gslam::Vec2d in_first, in_second;
    if (!camera.project(point, in_first) || !camera.project(T_second_first * point, in_second)) {
      continue;
    }
    if (first.size() % 3 == 0) in_second = {639 - in_second[0], in_first[1]};
    first.push_back(in_first);
    second.push_back(in_second);
  }

  gslam::EstimateOptions options;
  options.threshold = 1;  // pixel, for cameras of every model
  const gslam::RelativePoseEstimate estimate =
      gslam::estimateRelativePose(first, second, camera, camera, options);
  if (!estimate.ok()) {
    std::cout << nameOf(estimate.status) << ": " << estimate.message << "\n";
    return 1;
  }
  std::cout << estimate.inlier_count << " of " << first.size() << " matches fit, "
            << estimate.iterations << " samples\n"
            << "direction of motion: " << estimate.model.translation() << "\n";
  return estimate.inlier_count >= 200 ? 0 : 1;
}
