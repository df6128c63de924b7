#include "observation_cost.h"

#include <algorithm>
#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

// Rows of `columns` numbers, whitened, to rows of `stride` numbers.
void whiten(const WeightedObservation& w, const double* rows, std::size_t columns, double* to,
            std::size_t stride) {
  for (std::size_t i = 0; i < columns; ++i) {
    double u = rows[i], v = rows[columns + i];
    w.root.apply(u, v);
    to[i] = u;
    to[stride + i] = v;
    if (w.seen.has_right) to[2 * stride + i] = w.root.xx * rows[2 * columns + i];
  }
}

// The derivatives by the free parameters of a camera: columns of `raw`, rows of `count` numbers,
// moved together, rows of columns.size() numbers.
void gatherCamera(const FreeIntrinsics& columns, std::size_t count, double* raw) {
  const std::size_t k = columns.parameters.size();
  for (std::size_t r = 0; r < 3; ++r) {
    double* const row = raw + r * count;
    if (columns.aspect != 0) row[0] += columns.aspect * row[1];
    for (std::size_t i = 0; i < k; ++i) raw[r * k + i] = row[columns.parameters[i]];
  }
}

}  // namespace

WeightedObservation weightedObservation(const BundleProblem& problem, std::size_t index) {
  return {observationAt(problem, index), pixelRoot(problem, index)};
}

bool plainSquaredNorm(const BundleProblem& problem, std::size_t index, double& squared_norm) {
  const std::size_t c = cameraOf(problem, index);
  const WeightedObservation w = weightedObservation(problem, index);
  const SE3d T_body_camera = problem.T_body_camera.empty() ? SE3d() : problem.T_body_camera[c];
  Vec3d residual{}, white{};
  if (!reprojectionResidual(problem.T_world_body[problem.observation_pose[index]], T_body_camera,
                            problem.cameras[c], problem.points[problem.observation_point[index]],
                            w.seen, residual)) {
    return false;
  }
  whiten(w, residual.data(), 1, white.data(), 1);
  squared_norm = white.squaredNorm();
  return std::isfinite(squared_norm);
}

ObservationBlocks blocksOf(const BundleVariables& variables, std::size_t index) {
  const BundleProblem& problem = variables.problem();
  const std::size_t p = problem.observation_pose[index], j = problem.observation_point[index];
  const std::size_t c = variables.cameraOf(index);
  ObservationBlocks result;
  const auto add = [&result](const Block& block) -> std::int8_t {
    if (block.data == nullptr) return -1;
    result.blocks[result.count] = block;
    return static_cast<std::int8_t>(result.count++);
  };
  const bool is_anchored = variables.isAnchored(j);
  result.is_own_anchor = is_anchored && variables.anchorOf(j) == p;
  // A block with the intrinsics in it matters always.
  if (!result.is_own_anchor || variables.isFused(p)) result.pose = add(variables.pose(p));
  result.point = add(variables.point(j));
  result.camera = add(variables.camera(c));
  result.extrinsic = add(variables.extrinsic(c));
  if (is_anchored && !result.is_own_anchor) {
    result.anchor = add(variables.pose(variables.anchorOf(j)));
  }
  return result;
}

void ObservationCost::set(const BundleVariables& variables, std::size_t index,
                          const ObservationBlocks& blocks) {
  variables_ = &variables;
  index_ = static_cast<std::uint32_t>(index);
  pose_ = blocks.pose;
  point_ = blocks.point;
  camera_ = blocks.camera;
  extrinsic_ = blocks.extrinsic;
  anchor_ = blocks.anchor;
  is_own_anchor_ = blocks.is_own_anchor;
  const bool has_right = observationAt(variables.problem(), index).has_right;
  set_num_residuals(has_right ? 3 : 2);
  std::vector<std::int32_t>& sizes = *mutable_parameter_block_sizes();
  sizes.resize(static_cast<std::size_t>(blocks.count));
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = blocks.blocks[i].ambient;
}

struct ObservationCost::Point {
  Vec3d in_world{};
  // Of anchored points that are free.
  bool is_anchored = false;
  SE3d T_world_anchor;
  Vec3d in_anchor{};
  Vec4d numbers{};
};

SE3d ObservationCost::poseAt(int place, double const* const* parameters, std::size_t index) const {
  return place >= 0 ? loaded<SE3d>(parameters[place]) : variables_->problem().T_world_body[index];
}

ObservationCost::Point ObservationCost::pointAt(double const* const* parameters,
                                                const SE3d& T_world_body) const {
  const BundleProblem& problem = variables_->problem();
  const std::size_t j = problem.observation_point[index_];
  Point point;
  if (point_ < 0) {
    point.in_world = problem.points[j];
    return point;
  }
  const double* const x = parameters[point_];
  point.in_world = {x[0], x[1], x[2]};
  if (!variables_->isAnchored(j)) return point;
  point.is_anchored = true;
  point.numbers = {x[0], x[1], x[2], x[3]};
  point.in_anchor = inAnchor(point.numbers);
  point.T_world_anchor =
      is_own_anchor_ ? T_world_body : poseAt(anchor_, parameters, variables_->anchorOf(j));
  point.in_world = point.T_world_anchor * point.in_anchor;
  return point;
}

void ObservationCost::setJacobians(const WeightedObservation& weighted, const Point& point,
                                   ReprojectionJacobians& raw, double** jacobians) const {
  const std::size_t c = variables_->cameraOf(index_);
  const auto rows = static_cast<std::size_t>(num_residuals());
  const auto begin = [&](int place) -> double* {
    if (place < 0 || jacobians[place] == nullptr) return nullptr;
    const auto size =
        static_cast<std::size_t>(parameter_block_sizes()[static_cast<std::size_t>(place)]);
    std::fill(jacobians[place], jacobians[place] + rows * size, 0.0);
    return jacobians[place];
  };
  const auto sizeOf = [&](int place) {
    return static_cast<std::size_t>(parameter_block_sizes()[static_cast<std::size_t>(place)]);
  };
  const bool is_fused = pose_ >= 0 && sizeOf(pose_) > 7;
  if (is_fused || camera_ >= 0) {
    gatherCamera(variables_->columns(c), variables_->cameraNow(c).parameterCount(), raw.by_camera);
  }
  const std::size_t k = variables_->columns(c).parameters.size();
  if (double* const to = begin(pose_)) {
    if (!is_own_anchor_) whiten(weighted, raw.by_pose.data(), 6, to, sizeOf(pose_));
    if (is_fused) whiten(weighted, raw.by_camera, k, to + 6, sizeOf(pose_));
  }
  if (double* const to = begin(camera_)) whiten(weighted, raw.by_camera, k, to, k);
  if (double* const to = begin(extrinsic_)) {
    whiten(weighted, raw.by_extrinsic.data(), 6, to, sizeOf(extrinsic_));
  }
  if (double* const to = begin(anchor_)) {
    const Mat<double, 3, 6> by_anchor =
        raw.by_point * point.T_world_anchor.actionJacobian(point.in_anchor);
    whiten(weighted, by_anchor.data(), 6, to, sizeOf(anchor_));
  }
  double* const to = begin(point_);
  if (to == nullptr) return;
  if (!point.is_anchored) {
    whiten(weighted, raw.by_point.data(), 3, to, 3);
    return;
  }
  Mat3d by_local =
      raw.by_point * point.T_world_anchor.rotation().matrix() * anchoredJacobian(point.numbers);
  if (variables_->isHeld(variables_->problem().observation_point[index_])) {
    for (std::size_t r = 0; r < 3; ++r) by_local(r, 2) = 0;
  }
  whiten(weighted, by_local.data(), 3, to, 4);
}

bool ObservationCost::Evaluate(double const* const* parameters, double* residuals,
                               double** jacobians) const {
  const BundleProblem& problem = variables_->problem();
  const std::size_t c = variables_->cameraOf(index_);
  const SE3d T_world_body = poseAt(pose_, parameters, problem.observation_pose[index_]);
  SE3d T_body_camera;
  if (extrinsic_ >= 0) {
    T_body_camera = loaded<SE3d>(parameters[extrinsic_]);
  } else if (!problem.T_body_camera.empty()) {
    T_body_camera = problem.T_body_camera[c];
  }
  const Point point = pointAt(parameters, T_world_body);
  const WeightedObservation weighted = weightedObservation(problem, index_);
  Vec3d residual{};
  ReprojectionJacobians raw;
  if (!reprojectionResidual(T_world_body, T_body_camera, variables_->cameraNow(c), point.in_world,
                            weighted.seen, residual, jacobians != nullptr ? &raw : nullptr)) {
    return false;
  }
  whiten(weighted, residual.data(), 1, residuals, 1);
  if (!areFinite(residuals, num_residuals())) return false;
  if (jacobians != nullptr) setJacobians(weighted, point, raw, jacobians);
  return true;
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
