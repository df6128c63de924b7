// Uses the header of GSLAM::optimizer_ceres; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/optimizer_ceres.h>

#include <string>

std::string instantiateCeresBackend(const gslam::BundleProblem& problem);

std::string instantiateCeresBackend(const gslam::BundleProblem& problem) {
  return gslam::ceresBackend().name + gslam::ceresBackend().bundle(problem, {}).message;
}
