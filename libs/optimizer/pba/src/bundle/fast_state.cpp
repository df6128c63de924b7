#include "bundle/fast_state.h"

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>

#include "bundle/fast_views.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

void setCameraNumbers(const Camera& camera, double* numbers) {
  const std::vector<double> parameters = camera.parameters();
  const std::size_t count = std::min<std::size_t>(parameters.size(), 9);
  std::copy_n(parameters.begin(), count, numbers + kFocal);
  std::fill(numbers + kFocal + count, numbers + kPoseFree, 0.0);
  numbers[kAspect] = parameters[1] / parameters[0];
}

void setPoseNumbers(const SE3d& T_world_body, const SE3d& T_body_camera, bool has_rig,
                    double* numbers) {
  const SE3d T_camera_world = (T_world_body * T_body_camera).inverse();
  const Mat3d rotation = T_camera_world.rotation().matrix();
  std::copy_n(rotation.data(), 9, numbers + kRotation);
  std::copy_n(T_camera_world.translation().data(), 3, numbers + kTranslation);
  if (!has_rig) return;
  const SE3d T_camera_body = T_body_camera.inverse();
  const Mat3d rig_rotation = T_camera_body.rotation().matrix();
  std::copy_n(rig_rotation.data(), 9, numbers + kRigRotation);
  std::copy_n(T_camera_body.translation().data(), 3, numbers + kRigTranslation);
}

void setViews(const BundleProblem& problem, const FastStructure& structure, FastState& state) {
  for (std::size_t i = 0; i < structure.views.size(); ++i) {
    const FastView& view = structure.views[i];
    if (view.block == kNoBlock) continue;
    double* const numbers = state.views.data() + i * viewNumbers(structure);
    const SE3d T_body_camera =
        problem.T_body_camera.empty() ? SE3d() : problem.T_body_camera[view.camera];
    setPoseNumbers(state.poses[view.block], T_body_camera, structure.has_rig, numbers);
    if (!view.has_free_camera) continue;
    const std::array<double, 3>& intrinsics = state.intrinsics[view.block];
    numbers[kFocal] = intrinsics[0];
    numbers[kFocal + 1] = intrinsics[0] * numbers[kAspect];
    numbers[kDistortion] = intrinsics[1];
    numbers[kDistortion + 1] = intrinsics[2];
  }
}

}  // namespace

FastState makeFastState(const BundleProblem& problem, const FastStructure& structure,
                        unsigned threads) {
  FastState state;
  for (const FastBlock& block : structure.blocks) {
    state.poses.push_back(problem.T_world_body[block.pose]);
    std::array<double, 3> intrinsics = {1, 0, 0};
    if (block.camera != kNoBlock) {
      const std::vector<double> parameters = problem.cameras[block.camera].parameters();
      intrinsics = {parameters[0], parameters[4], parameters[5]};
    }
    state.intrinsics.push_back(intrinsics);
  }
  state.points.resize(3 * structure.points.size());
  parallelFor(
      0, structure.points.size(),
      [&](std::size_t i) {
        std::copy_n(problem.points[structure.points[i]].data(), 3, &state.points[3 * i]);
      },
      fastParallel(8192, threads));
  state.views.resize(structure.views.size() * viewNumbers(structure));
  for (std::size_t i = 0; i < structure.views.size(); ++i) {
    const FastView& view = structure.views[i];
    double* const numbers = state.views.data() + i * viewNumbers(structure);
    setCameraNumbers(problem.cameras[view.camera], numbers);
    const SE3d T_body_camera =
        problem.T_body_camera.empty() ? SE3d() : problem.T_body_camera[view.camera];
    setPoseNumbers(problem.T_world_body[view.pose], T_body_camera, structure.has_rig, numbers);
    const bool is_pose_free = view.block != kNoBlock && structure.blocks[view.block].is_pose_free;
    numbers[kPoseFree] = is_pose_free ? 1.0 : 0.0;
    numbers[kCameraFree] = view.has_free_camera ? 1.0 : 0.0;
  }
  return state;
}

FastState stateWithoutPoints(const FastState& state) {
  FastState other;
  other.poses = state.poses;
  other.intrinsics = state.intrinsics;
  other.points.resize(state.points.size());
  other.views = state.views;
  return other;
}

bool moveBlocks(const BundleProblem& problem, const FastStructure& structure,
                const FastState& state, const std::vector<double>& step, FastState& moved) {
  for (std::size_t i = 0; i < structure.blocks.size(); ++i) {
    const FastBlock& block = structure.blocks[i];
    const double* const d = step.data() + i * structure.freedom;
    for (std::size_t c = 0; c < structure.freedom; ++c) {
      if (!(std::fabs(d[c]) < 1e100)) return false;
    }
    if (block.is_pose_free) {
      const SE3d::Tangent tangent = {d[0], d[1], d[2], d[3], d[4], d[5]};
      moved.poses[i] = (state.poses[i] * SE3d::exp(tangent)).normalized();
    }
    if (block.camera == kNoBlock) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      moved.intrinsics[i][c] = state.intrinsics[i][c] + d[6 + c];
    }
    if (!(moved.intrinsics[i][0] > 0)) return false;
  }
  setViews(problem, structure, moved);
  return true;
}

void writeFastState(const FastStructure& structure, const FastState& state,
                    const BundleProblem& problem) {
  const Span<SE3d> poses = problem.T_world_body;
  const Span<Vec3d> points = problem.points;
  const Span<Camera> cameras = problem.cameras;
  for (std::size_t i = 0; i < structure.blocks.size(); ++i) {
    const FastBlock& block = structure.blocks[i];
    if (block.is_pose_free) poses[block.pose] = state.poses[i];
    if (block.camera == kNoBlock) continue;
    Camera& camera = cameras[block.camera];
    std::vector<double> parameters = camera.parameters();
    const double aspect = parameters[1] / parameters[0];
    parameters[0] = state.intrinsics[i][0];
    parameters[1] = state.intrinsics[i][0] * aspect;
    parameters[4] = state.intrinsics[i][1];
    parameters[5] = state.intrinsics[i][2];
    camera =
        Camera::fromParameters(camera.modelName(), camera.width(), camera.height(), parameters);
  }
  for (std::size_t i = 0; i < structure.points.size(); ++i) {
    const std::size_t point = structure.points[i];
    if (!problem.point_fixed.empty() && problem.point_fixed[point] != 0) continue;
    points[point] = {state.points[3 * i], state.points[3 * i + 1], state.points[3 * i + 2]};
  }
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
