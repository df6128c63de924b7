#include "bundle_variables.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cstring>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace by_ceres {
namespace {

constexpr std::uint32_t kSeveral = kNoBlock - 1;

// The same camera with other parameters; none where the model refuses them.
struct WithParameters {
  using Result = Camera;
  const Camera& camera;
  const std::vector<double>& values;

  template <class Model>
  Camera operator()(const Model& /*model*/) const {
    typename Model::Parameters parameters;
    for (std::size_t i = 0; i < values.size(); ++i) parameters[i] = values[i];
    try {
      return Camera(camera.width(), camera.height(), Model(parameters));
    } catch (const ArgumentError&) {
      return Camera();
    }
  }
  static Camera none() { return Camera(); }
};

double* numbersOf(SE3d& pose) {
  return const_cast<double*>(pose.data());  // the object itself is not const
}

}  // namespace

BundleVariables::BundleVariables(const BundleProblem& problem)
    : problem_(problem),
      what_(bundleBlocks(problem)),
      start_(bundleValues(problem, what_)),
      camera_now_(start_.cameras),
      is_camera_wanted_(problem.cameras.size(), 0),
      anchored_(start_.anchored),
      is_held_(anchored_.size(), 0) {
  findFused();
  setBlocks();
  setLenses();
}

// A pose and a camera that see nothing but with each other.
void BundleVariables::findFused() {
  std::vector<std::uint32_t> pose_of(problem_.cameras.size(), kNoBlock);
  std::vector<std::uint32_t> camera_of(problem_.T_world_body.size(), kNoBlock);
  const auto meet = [](std::uint32_t& known, std::size_t met) {
    if (known == kNoBlock) known = static_cast<std::uint32_t>(met);
    if (known != met) known = kSeveral;
  };
  for (std::size_t o = 0; o < problem_.pixels.size(); ++o) {
    meet(pose_of[cameraOf(o)], problem_.observation_pose[o]);
    meet(camera_of[problem_.observation_pose[o]], cameraOf(o));
  }
  fused_pose_.assign(problem_.cameras.size(), kNoBlock);
  fused_camera_.assign(problem_.T_world_body.size(), kNoBlock);
  for (std::size_t c = 0; c < pose_of.size(); ++c) {
    const std::uint32_t p = pose_of[c];
    if (p == kNoBlock || p == kSeveral || what_.freedom[c].parameters.empty()) continue;
    if (camera_of[p] != c || !isPoseFree(p)) continue;
    fused_pose_[c] = p;
    fused_camera_[p] = static_cast<std::uint32_t>(c);
  }
}

void BundleVariables::setBlocks() {
  constexpr int n = ambientSize<SE3d>(), d = freedomOf<SE3d>();
  poses_.resize(problem_.T_world_body.size());
  extrinsics_.resize(problem_.cameras.size());
  cameras_.resize(problem_.cameras.size());
  std::size_t size = 0;
  for (std::size_t c = 0; c < what_.freedom.size(); ++c) {
    size += what_.freedom[c].parameters.size() + (fused_pose_[c] == kNoBlock ? 0 : std::size_t(n));
  }
  own_.resize(size);
  double* next = own_.data();
  for (std::size_t p = 0; p < poses_.size(); ++p) {
    if (isPoseFree(p)) poses_[p] = {numbersOf(problem_.T_world_body[p]), n, d};
  }
  for (std::size_t c = 0; c < what_.freedom.size(); ++c) {
    const int k = static_cast<int>(what_.freedom[c].parameters.size());
    if (fused_pose_[c] != kNoBlock) {
      store(problem_.T_world_body[fused_pose_[c]], next);
      poses_[fused_pose_[c]] = {next, n + k, d + k};
      next += n;
    } else if (k > 0) {
      cameras_[c] = {next, k, k};
    }
    const std::vector<double> values = problem_.cameras[c].parameters();
    for (const std::uint32_t i : what_.freedom[c].parameters) *next++ = values[i];
    const bool is_free =
        !problem_.T_body_camera_free.empty() && problem_.T_body_camera_free[c] != 0;
    if (is_free) extrinsics_[c] = {numbersOf(problem_.T_body_camera[c]), n, d};
  }
}

void BundleVariables::setLenses() {
  lenses_.resize(problem_.cameras.size());
  for (std::size_t c = 0; c < lenses_.size(); ++c) {
    PlainLens& lens = lenses_[c];
    lens.is_plain = PlainLens::hasForm(problem_.cameras[c]);
    if (!lens.is_plain) continue;
    lens.setNumbers(problem_.cameras[c].parameters());
    if (!problem_.T_body_camera.empty()) lens.setExtrinsic(problem_.T_body_camera[c]);
    lens.aspect = what_.freedom[c].aspect;
    for (const std::uint32_t i : what_.freedom[c].parameters) {
      lens.columns[lens.column_count++] = static_cast<std::uint8_t>(i);
    }
  }
}

Block BundleVariables::point(std::size_t i) const {
  if (!isPointFree(i)) return Block();
  if (isAnchored(i)) return {const_cast<double*>(anchored_[i].data()), 4, 3};
  return {problem_.points[i].data(), 3, 3};
}

double* BundleVariables::cameraNumbers(std::size_t camera) const {
  const std::uint32_t p = fused_pose_[camera];
  return p == kNoBlock ? cameras_[camera].data : poses_[p].data + ambientSize<SE3d>();
}

void BundleVariables::addTo(ceres::Problem& problem) {
  for (const Block& block : poses_) {
    if (block.data == nullptr) continue;
    const auto more = static_cast<std::size_t>(block.ambient - ambientSize<SE3d>());
    ceres::Manifold* manifold = &pose_manifold_;
    if (more > 0) {
      if (fused_manifolds_.size() <= more) fused_manifolds_.resize(more + 1);
      std::unique_ptr<GroupManifold<SE3d>>& fused = fused_manifolds_[more];
      if (fused == nullptr) fused = std::make_unique<GroupManifold<SE3d>>(static_cast<int>(more));
      manifold = fused.get();
    }
    problem.AddParameterBlock(block.data, block.ambient, manifold);
  }
  for (const Block& block : cameras_) {
    if (block.data != nullptr) problem.AddParameterBlock(block.data, block.ambient);
  }
  for (const Block& block : extrinsics_) {
    if (block.data == nullptr) continue;
    problem.AddParameterBlock(block.data, block.ambient, &pose_manifold_);
  }
}

void BundleVariables::addPoint(std::size_t i, ceres::Problem& problem) {
  ceres::Manifold* const manifold = isAnchored(i) ? &anchored_manifold_ : nullptr;
  const Block block = point(i);
  problem.AddParameterBlock(block.data, block.ambient, manifold);
}

std::size_t BundleVariables::reducedFreedom() const {
  std::size_t sum = 0;
  for (const std::vector<Block>* blocks : {&poses_, &cameras_, &extrinsics_}) {
    for (const Block& block : *blocks) sum += static_cast<std::size_t>(block.tangent);
  }
  return sum;
}

std::size_t BundleVariables::pointFreedom() const {
  std::size_t sum = 0;
  for (std::size_t j = 0; j < problem_.points.size(); ++j) sum += isPointFree(j) ? 3 : 0;
  return sum;
}

Mat3d BundleVariables::pointJacobian(std::size_t point) const {
  return problem_.T_world_body[anchorOf(point)].rotation().matrix() *
         anchoredJacobian(anchored_[point]);
}

std::vector<double> BundleVariables::parametersNow(std::size_t camera) const {
  const FreeIntrinsics& columns = what_.freedom[camera];
  std::vector<double> values = problem_.cameras[camera].parameters();
  const double* const free = cameraNumbers(camera);
  for (std::size_t i = 0; i < columns.parameters.size(); ++i) {
    values[columns.parameters[i]] = free[i];
  }
  if (columns.aspect != 0) values[1] = columns.aspect * values[0];
  return values;
}

void BundleVariables::prepareCameras() {
  for (std::size_t c = 0; c < what_.freedom.size(); ++c) {
    if (what_.freedom[c].parameters.empty()) continue;
    const std::vector<double> values = parametersNow(c);
    if (lenses_[c].is_plain) lenses_[c].setNumbers(values);
    if (is_camera_wanted_[c] != 0) {
      camera_now_[c] = problem_.cameras[c].visit(WithParameters{problem_.cameras[c], values});
    }
  }
}

void BundleVariables::writeBack() {
  for (std::size_t c = 0; c < what_.freedom.size(); ++c) {
    if (what_.freedom[c].parameters.empty()) continue;
    const Camera& camera = problem_.cameras[c];
    const Camera moved = camera.visit(WithParameters{camera, parametersNow(c)});
    if (moved.isValid()) problem_.cameras[c] = moved;
  }
  for (std::size_t p = 0; p < poses_.size(); ++p) {
    if (isFused(p)) problem_.T_world_body[p] = loaded<SE3d>(poses_[p].data);
  }
  for (std::size_t j = 0; j < problem_.points.size() && !anchored_.empty(); ++j) {
    if (!isAnchored(j)) continue;
    const SE3d& pose = problem_.T_world_body[anchorOf(j)];
    const SE3d& then = start_.T_world_body[anchorOf(j)];
    const bool has_moved = std::memcmp(&pose, &then, sizeof(SE3d)) != 0;
    if (!has_moved && anchored_[j] == start_.anchored[j]) continue;
    problem_.points[j] = pose * inAnchor(anchored_[j]);
  }
}

void BundleVariables::restore() {
  std::copy(start_.T_world_body.begin(), start_.T_world_body.end(), problem_.T_world_body.begin());
  std::copy(start_.points.begin(), start_.points.end(), problem_.points.begin());
  std::copy_n(start_.T_body_camera.begin(), problem_.T_body_camera.size(),
              problem_.T_body_camera.begin());
}

}  // namespace by_ceres
}  // namespace detail
}  // namespace v1
}  // namespace gslam
