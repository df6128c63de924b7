// The pose of a camera by hand with Ceres, analytic derivatives and a Huber loss.
#include <ceres/ceres.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "ceres_manifold.h"
#include "measure.h"

namespace {

class KnownPoint : public ceres::SizedCostFunction<2, 7> {
 public:
  KnownPoint(const gslam::Vec3d& point, const gslam::Vec2d& pixel, const double* intrinsics)
      : point_(point), pixel_(pixel), intrinsics_(intrinsics) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const gslam::Vec3d p = poseOf<gslam::SE3d>(parameters[0]).inverse() * point_;
    const double* const k = intrinsics_;
    residuals[0] = k[0] * p[0] / p[2] + k[2] - pixel_[0];
    residuals[1] = k[1] * p[1] / p[2] + k[3] - pixel_[1];
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const gslam::Mat<double, 2, 3> by_p = {{k[0] / p[2], 0, -k[0] * p[0] / (p[2] * p[2]), 0,
                                            k[1] / p[2], -k[1] * p[1] / (p[2] * p[2])}};
    const gslam::Mat<double, 2, 3> by_rotation = by_p * gslam::SO3d::hat(p);
    for (std::size_t r = 0; r < 2; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        jacobians[0][7 * r + c] = -by_p(r, c);
        jacobians[0][7 * r + 3 + c] = by_rotation(r, c);
      }
      jacobians[0][7 * r + 6] = 0;
    }
    return true;
  }

 private:
  gslam::Vec3d point_;
  gslam::Vec2d pixel_;
  const double* intrinsics_;
};

gslam::SE3d solvePose(const PoseScene& scene) {
  double pose[7];
  setNumbers(scene.start, pose);
  const std::vector<double> intrinsics = scene.cameras[0].parameters();
  ceres::Problem problem;
  auto* const loss = new ceres::HuberLoss(2);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    problem.AddResidualBlock(new KnownPoint(scene.points[i], scene.pixels[i], intrinsics.data()),
                             loss, pose);
  }
  problem.SetManifold(pose, new TangentManifold<gslam::SE3d>());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  // A covariance, as the others give it.
  ceres::Covariance covariance((ceres::Covariance::Options()));
  const std::vector<std::pair<const double*, const double*>> blocks = {{pose, pose}};
  double block[36];
  if (covariance.Compute(blocks, &problem)) {
    covariance.GetCovarianceBlockInTangentSpace(pose, pose, block);
  }
  return poseOf<gslam::SE3d>(pose);
}

const bool kRows = addPoseRows("ceres", solvePose);

}  // namespace
