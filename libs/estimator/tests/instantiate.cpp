// Uses every header of GSLAM::estimator; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/estimator.h>
#include <gslam/estimator/solvers.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

std::string instantiateEstimates(const std::vector<gslam::Vec2d>& pixels,
                                 const std::vector<gslam::Vec3d>& points,
                                 const gslam::Camera& camera);

std::string instantiateEstimates(const std::vector<gslam::Vec2d>& pixels,
                                 const std::vector<gslam::Vec3d>& points,
                                 const gslam::Camera& camera) {
  gslam::EstimateOptions options;
  options.scoring = gslam::EstimateScoring::Magsac;
  options.threshold = 0.1;
  const gslam::RelativePoseEstimate relative =
      gslam::estimateRelativePose(pixels, pixels, camera, camera, options);
  const std::size_t inliers = gslam::estimateAbsolutePose(pixels, camera, points).inlier_count +
                              gslam::estimateEssential(points, points).inlier_count +
                              gslam::estimateFundamental(pixels, pixels).inlier_count +
                              gslam::estimateHomography(pixels, pixels).inlier_count +
                              gslam::estimateAffine2D(pixels, pixels).inlier_count +
                              gslam::estimateAffine3D(points, points, options).inlier_count +
                              gslam::estimateRigid3D(points, points, options).inlier_count +
                              gslam::estimateSimilarity3D(points, points, options).inlier_count +
                              gslam::estimateRigPose(points, points, points).inlier_count +
                              gslam::estimatePlane(points, options).inlier_count;
  return nameOf(relative.status) + relative.message + nameOf(relative.degeneracy) +
         std::to_string(inliers);
}

std::size_t instantiateSolvers(const std::vector<gslam::Vec3d>& bearings,
                               const std::vector<gslam::Vec3d>& points);

std::size_t instantiateSolvers(const std::vector<gslam::Vec3d>& bearings,
                               const std::vector<gslam::Vec3d>& points) {
  std::array<gslam::Mat3d, 10> essentials;
  std::array<gslam::SE3d, 4> poses;
  gslam::SE3d pose;
  return gslam::essential5pt(bearings, bearings, essentials) + gslam::p3p(bearings, points, poses) +
         gslam::sqpnp(bearings, points, poses) + gslam::epnp(bearings, points, pose) +
         gslam::rigid3D(points, points, pose);
}
