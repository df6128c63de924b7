// Planes in two views: which matches a homography that belongs to an epipolar geometry explains.
#ifndef GSLAM_ESTIMATOR_ROBUST_PLANE_PARALLAX_H
#define GSLAM_ESTIMATOR_ROBUST_PLANE_PARALLAX_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/epipolar_matches.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Of squares: a match is on a plane, or turned only, within twice the threshold, since its error
// has two components, not one.
constexpr double kPlaneTolerance = 4;

// The homographies of an epipolar geometry are base + epipole v^T, a plane v each: v x1 is the
// inverse depth of what lies in it. In the coordinates of the matches.
struct HomographyFamily {
  Mat3d base;     // the rotation, where cameras are known, else [e']x F
  Vec3d epipole;  // in the second view

  // Best v x1 for one match; false near the epipole, where every one will do.
  bool inverseDepth(const Vec3d& first, const Vec3d& second, double& depth) const;
  Mat3d homography(const Vec3d& plane) const;
};

struct PlaneFit {
  bool is_found = false;
  Mat3d homography{}, inverse{};
  Vec3d plane{};
  std::size_t on_plane = 0;  // of those that were tested
};

// The plane of three matches.
PlaneFit planeOf(const EpipolarMatches& matches, const HomographyFamily& family,
                 const std::uint32_t* three);

// The plane of most of some matches: three at a time, then all that agree.
// @param largest  squared error of a match on the plane
PlaneFit fitPlane(const EpipolarMatches& matches, const HomographyFamily& family,
                  const std::vector<std::uint32_t>& indices, double largest);

// How many of all matches are on it.
std::size_t countOnPlane(const EpipolarMatches& matches, const Mat3d& homography,
                         const Mat3d& inverse, double largest);

bool invert(const Mat3d& m, Mat3d& inverse);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_PLANE_PARALLAX_H
