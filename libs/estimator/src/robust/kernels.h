// The loops over matches that scoring and refinement consist of, in the best variant of SIMD.
#ifndef GSLAM_ESTIMATOR_ROBUST_KERNELS_H
#define GSLAM_ESTIMATOR_ROBUST_KERNELS_H

#include <gslam/base/simd.h>

#include <cstddef>

namespace gslam {
inline namespace v1 {
namespace detail {

// How points of two views are given.
enum class EpipolarKind {
  Plane,   // x1 y1 x2 y2, on the planes z = 1
  Sphere,  // b1 b2, unit bearings, whose noise is the same in all directions
  Frames,  // b1 b2, the columns of d b1 / d pixel, of d b2 / d pixel
};

// Numbers of a match.
constexpr std::size_t kEpipolarColumns[] = {4, 6, 18};
constexpr std::size_t kPlaneColumns = 5;   // X Y Z u v
constexpr std::size_t kFrameColumns = 15;  // X Y Z, A (2 x 3), b, o

constexpr std::size_t kBlock = 32;  // matches that are refined on together
constexpr std::size_t kBlockLanes = 4;

// Squared residuals of matches [first, first + count) of columns of floats. The matrix has nine
// elements for two views, twelve for poses; results are multiplied by the factor.
using SquaredFunction = void (*)(const float* matrix, float factor, const float* const* columns,
                                 std::size_t first, std::size_t count, float* squared);
SquaredFunction sampsonFunction(EpipolarKind kind);
SquaredFunction reprojectPlaneFunction();
SquaredFunction reprojectFramesFunction();

// A block of matches; those that are not there have the weight 0 and numbers of some match.
struct EpipolarBlock {
  double columns[18][kBlock];
  double weights[kBlock];
};
struct PoseBlock {
  double columns[kFrameColumns][kBlock];
  double weights[kBlock];
};

// Sums over matches; upper triangles.
struct EpipolarSums {
  double hessian[81] = {};
  double gradient[9] = {};
  double cost = 0;
};
struct PoseSums {
  double hessian[36] = {};
  double gradient[6] = {};
  double cost = 0;
};

// Normal equations of Sampson's error by the nine elements of the matrix.
using SampsonBlockFunction = void (*)(const double* matrix, const EpipolarBlock&, EpipolarSums&);
SampsonBlockFunction sampsonBlockFunction(EpipolarKind kind);

// Normal equations of a reprojection by the right tangent of the pose T_world_camera; the matrix is
// that of its inverse.
using ReprojectBlockFunction = void (*)(const double* matrix, const PoseBlock&, PoseSums&);
ReprojectBlockFunction reprojectBlockFunction();

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_KERNELS_H
