// Absolute poses of cameras, and of rigs of cameras, for the robust loop.
#ifndef GSLAM_ESTIMATOR_ROBUST_POSE_PROBLEM_H
#define GSLAM_ESTIMATOR_ROBUST_POSE_PROBLEM_H

#include <gslam/base/span.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/kernels.h"
#include "robust/problem.h"
#include "robust/random_order.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// A camera of a rig, to project with exactly.
struct PoseCamera {
  const Camera* camera;
  SE3d T_rig_camera;
  SE3d T_camera_rig;
};

// One observation, in the frame of the rig (of the camera, where there is only one).
struct PoseObservation {
  Vec3d origin{};             // where its ray starts
  Vec3d bearing{};            // of length 1
  Mat<double, 2, 3> frame{};  // of what is seen in the direction q, frame q / (bearing q) is the
                              // residual: pixels, or radians
  Vec2d pixel{};
  std::uint32_t camera = 0;  // in the list of cameras, where there is one
};

// A model is T_rig_world (quaternion, translation), where the world's origin is the mean of the
// points; its delta is the right tangent of the inverse, T_world_rig.
class PoseProblem : public Problem {
 public:
  // @param observations  in the caller's order, as points
  // @param cameras       to project with in the end; none: residuals are angles. Must stay
  PoseProblem(std::vector<PoseObservation> observations, Span<const Vec3d> points,
              std::vector<PoseCamera> cameras, const RandomOrder& order);

  std::size_t size() const override { return points_.size(); }
  std::size_t sampleSize() const override { return 3; }
  std::size_t maxSolutions() const override { return is_central_ ? 4 : 8; }
  std::size_t dof() const override { return 6; }
  std::size_t residualDimension() const override { return 2; }
  std::size_t solve(const std::uint32_t* sample, ModelNumbers* models) const override;
  void squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                        float* squared) const override;
  void exactSquaredResiduals(const ModelNumbers& model, double* squared) const override;
  void squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift, std::size_t count,
                               double* squared) const override;
  std::size_t placeOf(const ModelNumbers& model, std::size_t i, double* place) const override;
  void accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                  NormalEquations& sums) const override;
  ModelNumbers retract(const ModelNumbers& model, const double* delta) const override;
  double chance(double threshold) const override;
  Examination examine(const ModelNumbers& model, const std::uint8_t* inliers,
                      double threshold) const override;

  SE3d worldPoseOf(const ModelNumbers& model) const;  // T_world_rig
  // Why no sample has a solution: whether nearly all points are on one line, or at one place.
  Degeneracy degeneracyOfAllPoints() const;

 private:
  void setUpPlane();
  void setUpFrames();
  void setUpChance();
  double exactSquared(const SE3d& T_rig_world, std::size_t i) const {
    return exactSquared(T_rig_world, i, i);
  }
  // Of point i and observation j.
  double exactSquared(const SE3d& T_rig_world, std::size_t i, std::size_t j) const;
  std::size_t solveCentral(const std::uint32_t* sample, ModelNumbers* models) const;
  std::size_t solveRig(const std::uint32_t* sample, ModelNumbers* models) const;
  void examineLine(const ModelNumbers& model, const std::vector<std::uint32_t>& inliers,
                   double threshold, Examination& result) const;
  void examinePlane(const ModelNumbers& model, const std::vector<std::uint32_t>& inliers,
                    double threshold, Examination& result) const;

  std::vector<PoseObservation> observations_;  // in the loop's order, as the next
  std::vector<Vec3d> points_;                  // centred
  std::vector<PoseCamera> cameras_;
  std::vector<double> periods_;  // columns after which an image begins again, of each; 0: never
  Vec3d centre_{};
  bool is_central_ = false;  // all rays start at one place
  bool is_plane_ = false;    // a pinhole camera
  double focal_[2] = {1, 1};
  double length_ = 1;  // pixels of a unit of the plane
  double chance_per_square_ = 0;
  std::vector<float> columns_;
  std::vector<const float*> column_starts_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_POSE_PROBLEM_H
