// Cost functions of bundles, with all kinds of blocks.
#include <cmath>

#include "bundle_model.h"
#include "derivatives.h"
#include "scenes.h"

namespace {

using gslam::BundleProblem;
using gslam::Camera;
using gslam::CameraFreedom;
using gslam::Mat;
using gslam::SE3d;
using gslam::SO3d;
using gslam::Vec2d;
using gslam::Vec3d;
using scenes::Bundle;

// What a scene may have besides poses, points and pixels.
struct Kind {
  const char* name;
  Camera camera;
  std::uint32_t mask = 0;  // of free parameters
  bool keeps_aspect = false;
  bool is_shared = false;  // one camera for all poses
  bool is_rig = false;     // cameras beside the body
  bool has_free_extrinsics = false;
  bool is_stereo = false;
  bool is_anchored = false;
};

// Where GoogleTest prints it.
void PrintTo(const Kind& kind, std::ostream* to) {
  *to << kind.name;
}

Camera radtan5() {
  return Camera::fromParameters("radtan", 640, 480,
                                {400, 410, 320, 240, -0.1, 0.02, 0.001, -0.002, 0.01});
}

Camera radtan14() {
  return Camera::fromParameters("radtan", 640, 480,
                                {400, 410, 320, 240, -0.1, 0.02, 0.001, -0.002, 0.01, 0.02, 0.01,
                                 0.002, 0.001, 0.002, -0.001, 0.001, 0.02, -0.01});
}

Camera fisheye() {
  return Camera::fromParameters("kannala_brandt", 640, 480,
                                {400, 410, 320, 240, 0.01, -0.002, 0.001, 0.0005});
}

class bundle_derivatives : public testing::TestWithParam<Kind> {};

TEST_P(bundle_derivatives, are_right) {
  const Kind& kind = GetParam();
  const std::size_t count = kind.is_shared ? 1 : 3;
  std::vector<SE3d> extrinsics;
  for (std::size_t c = 0; c < count && kind.is_rig; ++c) {
    extrinsics.emplace_back(SO3d::exp({0.02, 0.05, -0.03}), Vec3d{0.2, -0.1, 0.1 * double(c)});
  }
  Bundle scene = Bundle::make(3, 6, std::vector<Camera>(count, kind.camera), extrinsics, 1);
  ASSERT_GE(scene.pixels.size(), 12u);
  scene.disturb(0.02, 0.02, 0.05, 0);
  const std::vector<CameraFreedom> freedom(count, CameraFreedom{kind.mask, kind.keeps_aspect});
  const std::vector<std::uint8_t> extrinsic_free(count, 1);
  std::vector<Vec3d> information;
  for (std::size_t o = 0; o < scene.pixels.size(); ++o) {
    information.push_back({2 + double(o % 3), 0.5 - double(o % 2), 1.5});
    if (kind.is_stereo) scene.right_u.push_back(o % 3 == 0 ? std::nan("") : 300);
  }
  scene.baseline.assign(kind.is_stereo ? count : 0, 0.2);
  const std::vector<std::uint32_t> anchors = {0, 1, 2, BundleProblem::kNoAnchor, 0, 1};
  BundleProblem problem = scene.problem();
  problem.camera_freedom = freedom;
  problem.information = information;
  if (kind.has_free_extrinsics) problem.T_body_camera_free = extrinsic_free;
  if (kind.is_anchored) problem.point_anchor = anchors;
  gslam::detail::by_ceres::BundleModel model(problem, {});
  derivatives::expectRight(model.problem());
}

INSTANTIATE_TEST_SUITE_P(
    all, bundle_derivatives,
    testing::Values(Kind{"plain", scenes::pinhole(), 0}, Kind{"plain lens", scenes::radtan(), 0xff},
                    Kind{"plain lens of 5", radtan5(), 0x1ff},
                    Kind{"plain aspect", radtan5(), 0x1f1, true},
                    Kind{"plain shared", scenes::radtan(), 0xff, false, true},
                    Kind{"plain shared aspect", scenes::pinhole(), 0xd, true, true},
                    Kind{"plain rig", scenes::radtan(), 0x33, false, false, true},
                    Kind{"any lens", radtan14(), 0x3ffff}, Kind{"fisheye", fisheye(), 0xff},
                    Kind{"fisheye shared aspect", fisheye(), 0xf1, true, true},
                    Kind{"free rig", fisheye(), 0x3, false, true, true, true},
                    Kind{"free rig of lenses", scenes::radtan(), 0xff, false, false, true, true},
                    Kind{"stereo", scenes::radtan(), 0xff, false, false, false, false, true},
                    Kind{"stereo rig", scenes::pinhole(), 0, false, true, true, true, true},
                    Kind{"anchored", scenes::pinhole(), 0, false, false, false, false, false, true},
                    Kind{"anchored lens", scenes::radtan(), 0xff, false, false, false, false, false,
                         true},
                    Kind{"anchored rig", fisheye(), 0xff, true, true, true, true, true, true}));

TEST(bundle_derivatives_of_priors, are_right) {
  // Each camera belongs to a pose: priors see blocks of poses with lenses in them.
  for (const std::uint32_t mask : {0u, 0x33u}) {
    Bundle scene = Bundle::make(3, 6, std::vector<Camera>(3, scenes::radtan()), {}, 1);
    scene.disturb(0.02, 0.02, 0.05, 0);
    const std::vector<CameraFreedom> freedom(3, CameraFreedom{mask, false});
    std::mt19937_64 generator(3);
    const auto root = [&generator](std::size_t n) {
      std::vector<double> values(n * n);
      for (double& value : values) value = scenes::noise(generator, 10);
      return values;
    };
    Mat<double, 6, 6> m;
    const std::vector<double> numbers = root(6);
    std::copy(numbers.begin(), numbers.end(), m.data());
    const Mat<double, 6, 6> information = m.transpose() * m;
    const gslam::PositionPrior position = {2, {1, 2, 3}, information.block<3, 3>(1, 1)};
    const gslam::AbsolutePosePrior pose = {1, scenes::smallMotion(generator, 1, 1), information};
    const gslam::RelativePosePrior relative = {2, 0, scenes::smallMotion(generator, 1, 1),
                                               information};
    gslam::WindowPrior window;
    window.poses = {2, 0};
    window.T_linear = {scenes::smallMotion(generator, 1, 1), scenes::smallMotion(generator, 1, 1)};
    const std::vector<double> wide = root(12);
    window.information.assign(144, 0);
    for (std::size_t i = 0; i < 144; ++i) {
      for (std::size_t k = 0; k < 12; ++k) {
        window.information[i] += wide[12 * k + i / 12] * wide[12 * k + i % 12];
      }
    }
    window.gradient.assign(12, 3);
    BundleProblem problem = scene.problem();
    problem.camera_freedom = freedom;
    problem.position_priors = {&position, 1};
    problem.pose_priors = {&pose, 1};
    problem.relative_priors = {&relative, 1};
    problem.window_priors = {&window, 1};
    gslam::detail::by_ceres::BundleModel model(problem, {});
    derivatives::expectRight(model.problem());
  }
}

}  // namespace
