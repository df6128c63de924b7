#ifndef GSLAM_OPTIMIZER_SRC_FACTORS_BUNDLE_BLOCKS_H
#define GSLAM_OPTIMIZER_SRC_FACTORS_BUNDLE_BLOCKS_H

#include <gslam/base/error.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>
#include <gslam/optimizer/bundle_problem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "no_block.h"

// The variables of a bundle, as blocks of a stacked tangent: first poses, then extrinsics, then
// intrinsics. Points stand apart, three numbers each, since they are eliminated.

namespace gslam {
inline namespace v1 {
namespace detail {

// Which parameters of a camera are variables.
struct FreeIntrinsics {
  std::vector<std::uint32_t> parameters;  // ascending
  double aspect = 0;                      // fy / fx where fy follows fx, else 0
};

// Values of all that a residual depends on.
struct BundleValues {
  std::vector<SE3d> T_world_body;
  std::vector<SE3d> T_body_camera;  // one for each camera
  std::vector<Camera> cameras;
  std::vector<Vec3d> points;    // world
  std::vector<Vec4d> anchored;  // of each point: direction in the anchor, 1 / distance; or empty
};

struct BundleBlocks {
  std::vector<std::uint32_t> pose;       // block of each pose, or kNoBlock: fixed
  std::vector<std::uint32_t> extrinsic;  // block of each T_body_camera
  std::vector<std::uint32_t> intrinsic;  // block of each camera's free parameters
  std::vector<FreeIntrinsics> freedom;   // of each camera
  std::vector<std::size_t> offset;       // of each block in the tangent, and the end
  std::vector<std::uint8_t> point_free;  // of each point
  std::vector<std::uint32_t> anchor;     // pose of each free point, or kNoBlock; or empty

  std::size_t count() const { return offset.size() - 1; }
  std::size_t size(std::size_t block) const { return offset[block + 1] - offset[block]; }
  std::size_t tangentSize() const { return offset.back(); }
  std::uint32_t anchorOf(std::size_t point) const {
    return anchor.empty() ? kNoBlock : anchor[point];
  }
};

inline FreeIntrinsics freeIntrinsics(const Camera& camera, const CameraFreedom& freedom) {
  FreeIntrinsics result;
  const std::size_t count = camera.parameterCount();
  // Some models have no focal lengths: there is nothing to keep.
  const bool keeps_aspect = freedom.keeps_aspect && count > 1 && camera.parameterNames()[1] == "fy";
  for (std::uint32_t i = 0; i < count && i < 32; ++i) {
    const bool follows = keeps_aspect && i == 1;
    if ((freedom.parameters >> i & 1u) != 0 && !follows) result.parameters.push_back(i);
  }
  const bool has_focal_length = !result.parameters.empty() && result.parameters[0] == 0;
  if (keeps_aspect && has_focal_length) {
    const std::vector<double> values = camera.parameters();
    result.aspect = values[1] / values[0];
  }
  return result;
}

inline BundleBlocks bundleBlocks(const BundleProblem& problem) {
  BundleBlocks blocks;
  blocks.offset.push_back(0);
  const auto add = [&blocks](std::size_t size) {
    if (size == 0) return kNoBlock;
    blocks.offset.push_back(blocks.offset.back() + size);
    return static_cast<std::uint32_t>(blocks.offset.size() - 2);
  };
  for (std::size_t i = 0; i < problem.T_world_body.size(); ++i) {
    const bool is_fixed = !problem.pose_fixed.empty() && problem.pose_fixed[i] != 0;
    blocks.pose.push_back(add(is_fixed ? 0 : 6));
  }
  for (std::size_t c = 0; c < problem.cameras.size(); ++c) {
    const bool is_free = !problem.T_body_camera_free.empty() && problem.T_body_camera_free[c] != 0;
    blocks.extrinsic.push_back(add(is_free ? 6 : 0));
  }
  for (std::size_t c = 0; c < problem.cameras.size(); ++c) {
    blocks.freedom.push_back(problem.camera_freedom.empty()
                                 ? FreeIntrinsics()
                                 : freeIntrinsics(problem.cameras[c], problem.camera_freedom[c]));
    blocks.intrinsic.push_back(add(blocks.freedom[c].parameters.size()));
  }
  blocks.point_free.assign(problem.points.size(), 1);
  for (std::size_t i = 0; i < problem.point_fixed.size(); ++i) {
    if (problem.point_fixed[i] != 0) blocks.point_free[i] = 0;
  }
  if (problem.point_anchor.empty()) return blocks;
  blocks.anchor.assign(problem.point_anchor.begin(), problem.point_anchor.end());
  for (std::size_t i = 0; i < blocks.anchor.size(); ++i) {
    if (blocks.anchor[i] == BundleProblem::kNoAnchor) continue;
    // A point in its anchor has no direction: it stays x, y, z.
    const Vec3d arm = problem.points[i] - problem.T_world_body[blocks.anchor[i]].translation();
    if (blocks.point_free[i] == 0 || !(arm.norm() > 1e-9)) blocks.anchor[i] = kNoBlock;
  }
  return blocks;
}

inline BundleValues bundleValues(const BundleProblem& problem, const BundleBlocks& blocks) {
  BundleValues values;
  values.T_world_body.assign(problem.T_world_body.begin(), problem.T_world_body.end());
  values.T_body_camera.assign(problem.T_body_camera.begin(), problem.T_body_camera.end());
  values.T_body_camera.resize(problem.cameras.size());
  values.cameras.assign(problem.cameras.begin(), problem.cameras.end());
  values.points.assign(problem.points.begin(), problem.points.end());
  values.anchored.resize(blocks.anchor.size());
  for (std::size_t i = 0; i < blocks.anchor.size(); ++i) {
    if (blocks.anchor[i] == kNoBlock) continue;
    const Vec3d arm = values.T_world_body[blocks.anchor[i]].inverse() * values.points[i];
    const double distance = arm.norm();
    values.anchored[i] = {arm[0] / distance, arm[1] / distance, arm[2] / distance, 1 / distance};
  }
  return values;
}

// Two directions at right angles to a unit vector and to each other: columns.
inline Mat<double, 3, 2> planeAcross(const Vec3d& direction) {
  const double ax = std::fabs(direction[0]), ay = std::fabs(direction[1]);
  const double az = std::fabs(direction[2]);
  const Vec3d off =
      ax <= ay && ax <= az ? Vec3d{1, 0, 0} : (ay <= az ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1});
  Vec3d a = direction.cross(off);
  a /= a.norm();
  const Vec3d b = direction.cross(a);
  return {a[0], b[0], a[1], b[1], a[2], b[2]};
}

// An inverse distance ends here, before infinity, or where it starts if that is less. A baseline of
// 1 has a parallax of 1e-10 rad there, far below any pixel; and the derivative by the inverse
// distance, a difference of numbers 1e10 times as large, still is right to some 1e-6 of it.
constexpr double kLeastInverse = 1e-10;

inline double leastInverse(const Vec4d& anchored) {
  return std::min(anchored[3], kLeastInverse);
}

// Whether it is as far as it can be, also after rounding by way of x, y, z.
inline bool isFarthest(const Vec4d& anchored) {
  return anchored[3] <= 1.001 * kLeastInverse;
}

// Whether a point is that far, and the slope of the cost by its inverse distance keeps it there.
inline bool isHeldFar(const BundleBlocks& blocks, const BundleValues& values, std::size_t point,
                      double slope) {
  return blocks.anchorOf(point) != kNoBlock && isFarthest(values.anchored[point]) && slope > 0;
}

// The anchored point after a step (2 of the direction, 1 of the inverse distance).
inline Vec4d steppedAnchored(const Vec4d& point, const double* step) {
  const Vec3d direction = point.segment<3>(0);
  const Vec3d turn = planeAcross(direction) * Vec2d{step[0], step[1]};
  const double angle = turn.norm();
  const double ratio = angle > 1e-12 ? std::sin(angle) / angle : 1.0;
  Vec3d turned = std::cos(angle) * direction + ratio * turn;
  turned /= turned.norm();
  const double inverse = std::max(point[3] + step[2], leastInverse(point));
  return {turned[0], turned[1], turned[2], inverse};
}

inline Vec3d inAnchor(const Vec4d& anchored) {
  return anchored.segment<3>(0) / anchored[3];
}

// d x / d (direction, inverse distance), in coordinates of the anchor.
inline Mat3d anchoredJacobian(const Vec4d& anchored) {
  const Mat<double, 3, 2> across = planeAcross(anchored.segment<3>(0));
  const double distance = 1 / anchored[3];
  Mat3d j;
  for (std::size_t r = 0; r < 3; ++r) {
    j(r, 0) = across(r, 0) * distance;
    j(r, 1) = across(r, 1) * distance;
    j(r, 2) = -anchored[r] * distance * distance;
  }
  return j;
}

inline SE3d steppedPose(const SE3d& pose, const double* step) {
  return pose * SE3d::exp({step[0], step[1], step[2], step[3], step[4], step[5]});
}

inline Camera steppedCamera(const Camera& camera, const FreeIntrinsics& freedom,
                            const double* step) {
  std::vector<double> parameters = camera.parameters();
  for (std::size_t i = 0; i < freedom.parameters.size(); ++i) {
    parameters[freedom.parameters[i]] += step[i];
  }
  if (freedom.aspect != 0) parameters[1] = freedom.aspect * parameters[0];
  return Camera::fromParameters(camera.modelName(), camera.width(), camera.height(), parameters);
}

// `next` becomes `values` with the step: `step` of all blocks, three of `point_step` for each
// point. Both have the same sizes before. False where a value does not exist.
inline bool stepValues(const BundleBlocks& blocks, const BundleValues& values, const double* step,
                       const double* point_step, BundleValues& next) {
  try {
    for (std::size_t i = 0; i < blocks.pose.size(); ++i) {
      if (blocks.pose[i] == kNoBlock) continue;
      next.T_world_body[i] =
          steppedPose(values.T_world_body[i], step + blocks.offset[blocks.pose[i]]);
    }
    for (std::size_t c = 0; c < blocks.extrinsic.size(); ++c) {
      if (blocks.extrinsic[c] != kNoBlock) {
        next.T_body_camera[c] =
            steppedPose(values.T_body_camera[c], step + blocks.offset[blocks.extrinsic[c]]);
      }
      if (blocks.intrinsic[c] != kNoBlock) {
        next.cameras[c] = steppedCamera(values.cameras[c], blocks.freedom[c],
                                        step + blocks.offset[blocks.intrinsic[c]]);
      }
    }
  } catch (const ArgumentError&) {
    return false;  // a focal length below zero, an angle without bounds
  }
  for (std::size_t i = 0; i < values.points.size(); ++i) {
    if (blocks.point_free[i] == 0) continue;
    const double* const s = point_step + 3 * i;
    if (blocks.anchorOf(i) == kNoBlock) {
      next.points[i] = values.points[i] + Vec3d{s[0], s[1], s[2]};
    } else {
      next.anchored[i] = steppedAnchored(values.anchored[i], s);
      next.points[i] = next.T_world_body[blocks.anchor[i]] * inAnchor(next.anchored[i]);
    }
  }
  return true;
}

// What a block is, for people: "pose 3", "T_body_camera 0", "camera 1".
inline std::string blockName(const BundleBlocks& blocks, std::size_t block) {
  const auto find = [block](const std::vector<std::uint32_t>& list) {
    return static_cast<std::size_t>(std::find(list.begin(), list.end(), block) - list.begin());
  };
  const std::size_t pose = find(blocks.pose);
  if (pose < blocks.pose.size()) return "pose " + std::to_string(pose);
  const std::size_t extrinsic = find(blocks.extrinsic);
  if (extrinsic < blocks.extrinsic.size()) return "T_body_camera " + std::to_string(extrinsic);
  return "camera " + std::to_string(find(blocks.intrinsic));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FACTORS_BUNDLE_BLOCKS_H
