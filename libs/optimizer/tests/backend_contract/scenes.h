// Small problems with a known solution, for the tests of the facade and of every back end.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_SCENES_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_SCENES_H

#include <gslam/geometry/random.h>
#include <gslam/optimizer.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace backend_contract {

using gslam::Camera;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;

/// Each element up to `reach` either way.
template <std::size_t N>
gslam::Vec<double, N> randomVector(std::mt19937& generator, double reach) {
  gslam::Vec<double, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = gslam::randomUniform(generator, -reach, reach);
  return result;
}

/// A tangent with each element up to `reach` either way.
template <class Group>
typename Group::Tangent smallTangent(std::mt19937& generator, double reach) {
  return randomVector<Group::kFreedom>(generator, reach);
}

/// Cameras on an arc around a cloud of points, each of which sees nearly all of it.
struct BundleScene {
  std::vector<SE3d> true_poses, poses;
  std::vector<Vec3d> true_points, points;
  std::vector<Camera> true_cameras, cameras;
  std::vector<SE3d> true_extrinsics, extrinsics;  ///< none: the body
  std::vector<std::uint8_t> pose_fixed, point_fixed, extrinsic_free;
  std::vector<std::uint32_t> anchors;
  std::vector<gslam::CameraFreedom> freedom;
  std::vector<std::uint32_t> of_pose, of_point, of_camera;
  std::vector<Vec2d> pixels;
  std::vector<Vec3d> information;
  std::vector<double> right_u, baseline;
  std::vector<gslam::PositionPrior> position_priors;
  std::vector<gslam::AbsolutePosePrior> pose_priors;
  std::vector<gslam::RelativePosePrior> relative_priors;
  std::vector<gslam::WindowPrior> window_priors;

  gslam::BundleProblem problem() {
    gslam::BundleProblem views;
    views.T_world_body = poses;
    views.pose_fixed = pose_fixed;
    views.points = points;
    views.point_fixed = point_fixed;
    views.point_anchor = anchors;
    views.cameras = cameras;
    views.camera_freedom = freedom;
    views.T_body_camera = extrinsics;
    views.T_body_camera_free = extrinsic_free;
    views.observation_pose = of_pose;
    views.observation_point = of_point;
    views.observation_camera = of_camera;
    views.pixels = pixels;
    views.information = information;
    views.right_u = right_u;
    views.baseline = baseline;
    views.position_priors = position_priors;
    views.pose_priors = pose_priors;
    views.relative_priors = relative_priors;
    views.window_priors = window_priors;
    return views;
  }
};

inline Camera pinhole() {
  return Camera::fromParameters("pinhole", 640, 480, {500, 505, 319.5, 239.5});
}

/// What a camera at `position` that looks at the origin has as its pose.
inline SE3d lookingAtOrigin(const Vec3d& position) {
  const Vec3d z = (-position).normalized();
  const Vec3d x = Vec3d{0, 1, 0}.cross(z).normalized();
  const Vec3d y = z.cross(x);
  gslam::Mat3d rotation;
  for (std::size_t r = 0; r < 3; ++r) {
    rotation(r, 0) = x[r];
    rotation(r, 1) = y[r];
    rotation(r, 2) = z[r];
  }
  return SE3d(SO3d::fromMatrix(rotation), position);
}

/// Adds what all cameras of all poses see of all points.
inline void observeAll(BundleScene& scene) {
  for (std::uint32_t pose = 0; pose < scene.true_poses.size(); ++pose) {
    for (std::uint32_t camera = 0; camera < scene.true_cameras.size(); ++camera) {
      const SE3d T_body_camera =
          scene.true_extrinsics.empty() ? SE3d() : scene.true_extrinsics[camera];
      const SE3d T_camera_world = (scene.true_poses[pose] * T_body_camera).inverse();
      for (std::uint32_t point = 0; point < scene.true_points.size(); ++point) {
        const Vec3d seen = T_camera_world * scene.true_points[point];
        Vec2d pixel;
        if (!scene.true_cameras[camera].project(seen, pixel)) continue;
        scene.of_pose.push_back(pose);
        scene.of_point.push_back(point);
        scene.of_camera.push_back(camera);
        scene.pixels.push_back(pixel);
      }
    }
  }
}

/// The first two poses are fixed; the start of all else is off by `off` metres and radians.
inline BundleScene bundleScene(std::size_t poses, std::size_t points, double off,
                               const Camera& camera = pinhole(), unsigned seed = 1) {
  std::mt19937 generator(seed);
  BundleScene scene;
  scene.true_cameras = scene.cameras = {camera};
  for (std::size_t i = 0; i < poses; ++i) {
    const double angle = 0.25 * static_cast<double>(i);
    scene.true_poses.push_back(
        lookingAtOrigin({6 * std::sin(angle), 0.3 * std::cos(3 * angle), -6 * std::cos(angle)}));
  }
  for (std::size_t i = 0; i < points; ++i) {
    scene.true_points.push_back(randomVector<3>(generator, 1.5));
  }
  observeAll(scene);
  scene.poses = scene.true_poses;
  scene.points = scene.true_points;
  scene.pose_fixed.assign(poses, 0);
  for (std::size_t i = 0; i < poses && i < 2; ++i) scene.pose_fixed[i] = 1;
  for (std::size_t i = 2; i < poses; ++i) {
    scene.poses[i] = scene.poses[i] * SE3d::exp(smallTangent<SE3d>(generator, off));
  }
  for (Vec3d& point : scene.points) point += randomVector<3>(generator, off);
  return scene;
}

/// Moves each pixel by up to `reach`, and every `gross`-th by 40 pixels; 0: none.
inline void addNoise(BundleScene& scene, double reach, std::size_t gross = 0, unsigned seed = 2) {
  std::mt19937 generator(seed);
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    scene.pixels[i] += randomVector<2>(generator, reach);
    if (gross != 0 && i % gross == 3 % gross) scene.pixels[i] += Vec2d{30, -27};
  }
}

/// Poses on a helix (in the plane a circle), edges to the next and, every fourth, to the tenth.
template <class Group>
struct GraphScene {
  std::vector<Group> truth;
  gslam::PoseGraph<Group> graph;
};

template <class Group>
GraphScene<Group> graphScene(std::size_t count, double off, unsigned seed = 3) {
  std::mt19937 generator(seed);
  GraphScene<Group> scene;
  typename Group::Tangent step{};
  step[0] = 1;
  step[Group::kFreedom == 3 ? 2 : 5] = 0.3;
  if (Group::kFreedom > 3) step[2] = 0.1;
  if (Group::kFreedom == 7) step[6] = 0.02;
  Group pose;
  for (std::size_t i = 0; i < count; ++i) {
    scene.truth.push_back(pose);
    pose = pose * Group::exp(step);
  }
  const auto connect = [&](std::size_t from, std::size_t to) {
    scene.graph.from.push_back(static_cast<std::uint32_t>(from));
    scene.graph.to.push_back(static_cast<std::uint32_t>(to));
    scene.graph.T_from_to.push_back(scene.truth[from].inverse() * scene.truth[to]);
    scene.graph.is_robust.push_back(to != from + 1);
    auto information = Group::Jacobian::identity();
    for (std::size_t k = 0; k < Group::kFreedom; ++k) {
      information(k, k) = 10 + static_cast<double>((from + 3 * k) % 7);
    }
    information(0, 1) = information(1, 0) = 2;
    scene.graph.information.push_back(information);
  };
  for (std::size_t i = 0; i + 1 < count; ++i) connect(i, i + 1);
  for (std::size_t i = 0; i + 10 < count; i += 4) connect(i, i + 10);
  scene.graph.T_world_body = scene.truth;
  scene.graph.pose_fixed.assign(count, 0);
  scene.graph.pose_fixed[0] = 1;
  for (std::size_t i = 1; i < count; ++i) {
    Group& start = scene.graph.T_world_body[i];
    start = start * Group::exp(smallTangent<Group>(generator, off));
  }
  return scene;
}

/// What is named in the message of the ArgumentError that a call throws; empty: it threw none.
template <class Call>
std::string complaintOf(const Call& call) {
  try {
    call();
  } catch (const gslam::ArgumentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace backend_contract

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_SCENES_H
