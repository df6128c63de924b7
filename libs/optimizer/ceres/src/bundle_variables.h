#ifndef GSLAM_OPTIMIZER_CERES_SRC_BUNDLE_VARIABLES_H
#define GSLAM_OPTIMIZER_CERES_SRC_BUNDLE_VARIABLES_H

#include <ceres/problem.h>
#include <factors/bundle_blocks.h>
#include <gslam/optimizer/bundle_problem.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "manifolds.h"
#include "plain_lens.h"

// The variables of a bundle as Ceres' parameter blocks.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {

// Numbers that Ceres varies.
struct Block {
  double* data = nullptr;  // null: not a variable
  int ambient = 0;
  int tangent = 0;
};

// Poses, extrinsics and points x, y, z are blocks where they stand in the problem. Blocks of their
// own have free intrinsics, anchored points, and poses together with the intrinsics that only they
// see: one block of 9 instead of 6 and 3 is what Ceres has fast code for.
class BundleVariables {
 public:
  explicit BundleVariables(const BundleProblem& problem);
  // The problem has pointers to this.
  BundleVariables(const BundleVariables&) = delete;
  BundleVariables& operator=(const BundleVariables&) = delete;

  const BundleProblem& problem() const { return problem_; }
  bool isPoseFree(std::size_t i) const { return what_.pose[i] != kNoBlock; }
  bool isPointFree(std::size_t i) const { return what_.point_free[i] != 0; }
  // The pose that a free point is anchored to; kNoBlock: x, y, z are its numbers.
  std::uint32_t anchorOf(std::size_t i) const { return what_.anchorOf(i); }
  bool isAnchored(std::size_t i) const { return anchorOf(i) != kNoBlock; }
  std::size_t cameraOf(std::size_t observation) const {
    return problem_.observation_camera.empty() ? 0 : problem_.observation_camera[observation];
  }

  // Null data where they are no variables. The camera's is null also where the pose has it.
  const Block& pose(std::size_t i) const { return poses_[i]; }
  Block point(std::size_t i) const;
  const Block& extrinsic(std::size_t camera) const { return extrinsics_[camera]; }
  const Block& camera(std::size_t i) const { return cameras_[i]; }
  bool isFused(std::size_t pose) const { return poses_[pose].ambient > ambientSize<SE3d>(); }
  // The pose whose block the camera is in; kNoBlock: none.
  std::size_t fusedPose(std::size_t camera) const { return fused_pose_[camera]; }

  // The parameters that blocks have, as a lens where that is enough; else as a camera, which is
  // made only where wantCamera() was called, and has no model where it refuses them.
  const PlainLens& lens(std::size_t camera) const { return lenses_[camera]; }
  const Camera& cameraNow(std::size_t i) const { return camera_now_[i]; }
  void wantCamera(std::size_t i) { is_camera_wanted_[i] = 1; }
  const FreeIntrinsics& columns(std::size_t camera) const { return what_.freedom[camera]; }

  // Makes poses, cameras and extrinsics known to Ceres.
  void addTo(ceres::Problem& problem);
  // Makes a point known that is seen.
  void addPoint(std::size_t i, ceres::Problem& problem);
  // Degrees of freedom of poses, cameras and extrinsics, and of points.
  std::size_t reducedFreedom() const;
  std::size_t pointFreedom() const;

  // The derivative of an anchored point by its tangent, with the anchor where it is.
  Mat3d pointJacobian(std::size_t point) const;

  // Makes the cameras that the blocks now hold, once for all residuals.
  void prepareCameras();
  // Whether an anchored point is as far as it can be, and whether it is no variable beyond that in
  // the derivatives of residuals.
  bool isFarthest(std::size_t point) const { return detail::isFarthest(anchored_[point]); }
  bool isHeld(std::size_t point) const { return is_held_[point] != 0; }
  void setHeld(std::size_t point, bool is_held) { is_held_[point] = is_held ? 1 : 0; }
  // The arrays of the problem get the values of the blocks, or those from the start.
  void writeBack();
  void restore();

 private:
  void setLenses();
  std::vector<double> parametersNow(std::size_t camera) const;
  void findFused();
  void setBlocks();
  double* cameraNumbers(std::size_t camera) const;

  BundleProblem problem_;
  BundleBlocks what_;   // what is free
  BundleValues start_;  // and where it was
  std::vector<Block> poses_, extrinsics_, cameras_;
  std::vector<std::uint32_t> fused_pose_, fused_camera_;
  std::vector<Camera> camera_now_;
  std::vector<std::uint8_t> is_camera_wanted_;
  std::vector<PlainLens> lenses_;
  std::vector<double> own_;      // of fused poses and cameras
  std::vector<Vec4d> anchored_;  // of each point, where one is anchored
  std::vector<std::uint8_t> is_held_;
  GroupManifold<SE3d> pose_manifold_;
  AnchoredManifold anchored_manifold_;
  std::vector<std::unique_ptr<GroupManifold<SE3d>>> fused_manifolds_;  // by the number of columns
};

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_SRC_BUNDLE_VARIABLES_H
