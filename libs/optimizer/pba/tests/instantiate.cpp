// Uses every header of GSLAM::optimizer_pba; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/optimizer_pba.h>

#include <string>

std::string instantiatePba(const gslam::PoseProblem& problem);

std::string instantiatePba(const gslam::PoseProblem& problem) {
  gslam::OptimizerOptions options;
  options.backend = gslam::pbaBackend().name;
  return options.backend + std::to_string(optimizePose(problem, gslam::SE3d(), options).inliers);
}
