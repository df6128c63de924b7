// Relative motions of both trajectories and their difference.
#ifndef GSLAM_EVALUATION_SRC_MOTION_H
#define GSLAM_EVALUATION_SRC_MOTION_H

#include <gslam/evaluation/ape.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/geometry/se3.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace evaluation {

constexpr double kDegrees = 57.295779513082320876798154814105;

// From i to j as seen from i, with scaled translation.
inline SE3d motion(const std::vector<SE3d>& poses, std::size_t i, std::size_t j, double scale) {
  const SE3d way = poses[i].inverse() * poses[j];
  return SE3d(way.rotation(), scale * way.translation());
}

// What is left between the two motions: (Q_i^-1 Q_j)^-1 (P_i^-1 P_j).
inline SE3d motionError(const PosePairs& pairs, std::size_t i, std::size_t j, double scale) {
  return motion(pairs.reference, i, j, 1).inverse() * motion(pairs.estimate, i, j, scale);
}

// Adds the three numbers that are said of an error.
inline void addError(const SE3d& error, PoseErrors& errors) {
  const double distance = error.translation().norm();
  const double angle = error.rotation().angle();
  const double turn = std::sin(0.5 * angle);  // |R - I| = 2 sqrt(2) sin(angle / 2)
  errors.translation.push_back(distance);
  errors.rotation.push_back(angle);
  errors.full.push_back(std::sqrt(distance * distance + 8 * turn * turn));
}

// Length of the reference's way up to each pair, metres.
std::vector<double> lengthsOf(const PosePairs& pairs);

}  // namespace evaluation
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SRC_MOTION_H
