#ifndef GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_KERNEL_H
#define GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_KERNEL_H

#include <gslam/base/simd.h>
#include <gslam/optimizer/options.h>

#include <cstddef>

// Cost, gradient and normal equations of a block of observations of one camera.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

constexpr std::size_t kPoseBlock = 64;
constexpr std::size_t kPoseLanes = 8;  // of the widest variant

// 0..20: the upper triangle of J^T W J, row by row; 21..26: the gradient; then
enum : std::size_t { kPoseCost = 27, kPoseSeen, kPoseInliers, kPoseSums };

// A camera of a formula, and where it is.
struct PoseCamera {
  double p[12];  // world to camera, rows of 4
  double fx, fy, cx, cy;
  double k1, k2, p1, p2, k3;  // radtan
  double baseline;
};

struct PoseLoss {
  LossKind kind = LossKind::Squared;
  double a = 1, a2 = 1, inverse_a2 = 1;
  // 2 for the second derivative in the normal equations (which may then be indefinite), 0 for the
  // weights alone.
  double twice_second = 0;

  explicit PoseLoss(const RobustLoss& loss)
      : kind(loss.kind),
        a(loss.scale),
        a2(loss.scale * loss.scale),
        inverse_a2(1 / (loss.scale * loss.scale)) {}
};

// Below what a camera sees.
constexpr double kNoRight = -1e300;

struct PoseBlock {
  alignas(64) double x[kPoseBlock];
  double y[kPoseBlock], z[kPoseBlock];  // world
  double u[kPoseBlock], v[kPoseBlock];
  double weight[kPoseBlock];  // information; negative where it is left out of all sums
  double right[kPoseBlock];   // stereo only: u in the right image, or kNoRight
  double inlier[kPoseBlock];  // result: 1 or 0
};

// Added to; each is the sum of its two lanes. Tangents are those of the camera, on the right.
struct PoseSums {
  alignas(64) double lanes[kPoseSums][2];
};

enum class PoseFormula { Pinhole, Radtan, PinholeStereo };

// `count` is a multiple of kPoseLanes.
using PoseFunction = void (*)(const PoseCamera&, const PoseLoss&, std::size_t count, PoseBlock&,
                              PoseSums&);
const SimdKernel<PoseFunction>& poseKernel(PoseFormula formula);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_SMALL_POSE_KERNEL_H
