#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "factors/reprojection.h"

namespace gslam {
namespace {

using detail::projectEverywhere;
using detail::ReprojectionJacobians;
using detail::ReprojectionObservation;
using detail::reprojectionResidual;

// A camera of each model, radtan of each size.
std::vector<Camera> camerasOfAllModels() {
  const std::vector<double> radtan = {400,  410,  320,  240,  -0.2, 0.03, 1e-3,  -2e-3, 5e-3,
                                      0.01, 2e-3, 1e-3, 2e-3, 1e-3, 3e-3, -1e-3, 0.03,  -0.02};
  std::map<std::string, std::vector<double>> values = {
      {"pinhole", {400, 410, 320, 240}},
      {"kannala_brandt", {200, 210, 320, 240, 0.01, -0.02, 3e-3, -1e-3}},
      {"ocam", {320, 240, 1.01, 0.01, -0.02, -250, 0.02, 8e-4, -1e-7, 1e-10}},
      {"fov", {200, 210, 320, 240, 0.9}},
      {"double_sphere", {200, 210, 320, 240, -0.2, 0.6}},
      {"eucm", {200, 210, 320, 240, 0.6, 1.1}},
      {"ucm", {200, 210, 320, 240, 0.6}},
      {"mei", {400, 410, 320, 240, 0.9, -0.1, 0.02, 1e-3, -1e-3}},
      {"equirectangular", {}},
      {"orthographic", {200, 210, 320, 240}},
  };
  std::vector<Camera> cameras;
  for (const std::size_t n : {4u, 5u, 8u, 12u, 14u}) {
    cameras.push_back(Camera::fromParameters(
        "radtan", 640, 480,
        std::vector<double>(radtan.begin(), radtan.begin() + static_cast<std::ptrdiff_t>(4 + n))));
  }
  for (const std::string& name : Camera::modelNames()) {
    if (values.count(name) != 0) {
      cameras.push_back(Camera::fromParameters(name, 640, 480, values[name]));
    } else if (name != "radtan") {
      ADD_FAILURE() << "no camera to test the model " << name << " with";
    }
  }
  return cameras;
}

struct Arguments {
  SE3d T_world_body;
  SE3d T_body_camera;
  Camera camera;
  Vec3d point;
  ReprojectionObservation observation;
};

Vec3d residualOf(const Arguments& a) {
  Vec3d residual{};
  EXPECT_TRUE(reprojectionResidual(a.T_world_body, a.T_body_camera, a.camera, a.point,
                                   a.observation, residual));
  return residual;
}

// Of five points, so that steps may be large: error of order h^4.
template <class Move>
Vec3d numericDerivative(const Arguments& a, double h, const Move& move) {
  return (8.0 * (residualOf(move(a, h)) - residualOf(move(a, -h))) -
          (residualOf(move(a, 2 * h)) - residualOf(move(a, -2 * h)))) /
         (12 * h);
}

void expectNear(const Vec3d& expected, const Vec3d& actual, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(expected[i], actual[i], 1e-5 * (1 + std::fabs(expected[i])))
        << what << " row " << i;
  }
}

Camera withParameter(const Camera& camera, std::size_t i, double change) {
  std::vector<double> values = camera.parameters();
  values[i] += change;
  return Camera::fromParameters(camera.modelName(), camera.width(), camera.height(), values);
}

void expectDerivatives(const Arguments& a) {
  ReprojectionJacobians j;
  Vec3d residual{};
  ASSERT_TRUE(reprojectionResidual(a.T_world_body, a.T_body_camera, a.camera, a.point,
                                   a.observation, residual, &j));
  const std::string name = a.camera.modelName() + std::to_string(a.camera.parameterCount());
  for (std::size_t i = 0; i < 6; ++i) {
    const auto tangent = [i](double h) {
      SE3d::Tangent t{};
      t[i] = h;
      return SE3d::exp(t);
    };
    const Vec3d by_pose = numericDerivative(a, 1e-4, [&](Arguments b, double h) {
      b.T_world_body *= tangent(h);
      return b;
    });
    expectNear(by_pose, j.by_pose.col(i), name + " pose");
    const Vec3d by_extrinsic = numericDerivative(a, 1e-4, [&](Arguments b, double h) {
      b.T_body_camera *= tangent(h);
      return b;
    });
    expectNear(by_extrinsic, j.by_extrinsic.col(i), name + " extrinsic");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d by_point = numericDerivative(a, 1e-4, [i](Arguments b, double h) {
      b.point[i] += h;
      return b;
    });
    expectNear(by_point, j.by_point.col(i), name + " point");
  }
  const std::size_t count = a.camera.parameterCount();
  for (std::size_t i = 0; i < count; ++i) {
    const double value = std::fabs(a.camera.parameters()[i]);
    const Vec3d by_parameter =
        numericDerivative(a, value > 0 ? 1e-3 * value : 1e-6, [i](Arguments b, double h) {
          b.camera = withParameter(b.camera, i, h);
          return b;
        });
    const Vec3d column = {j.by_camera[i], j.by_camera[count + i], j.by_camera[2 * count + i]};
    expectNear(by_parameter, column, name + " " + a.camera.parameterNames()[i]);
  }
}

Arguments drawArguments(const Camera& camera, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto tangent = [&] {
    SE3d::Tangent t;
    for (std::size_t i = 0; i < 6; ++i) t[i] = unit(random);
    return t;
  };
  Arguments a;
  a.T_world_body = SE3d::exp(tangent());
  a.T_body_camera = SE3d::exp(0.3 * tangent());
  a.camera = camera;
  const Vec3d in_camera = {unit(random), unit(random), 3 + unit(random)};
  a.point = a.T_world_body * (a.T_body_camera * in_camera);
  a.observation.pixel = {300 + 100 * unit(random), 200 + 100 * unit(random)};
  a.observation.right_u = 250;
  a.observation.baseline = 0.2;
  return a;
}

TEST(reprojection_factor, has_the_derivatives_of_every_camera_model) {
  std::mt19937 random(1);
  for (const Camera& camera : camerasOfAllModels()) {
    for (int i = 0; i < 6; ++i) {
      Arguments a = drawArguments(camera, random);
      a.observation.has_right = i % 2 != 0;
      expectDerivatives(a);
    }
  }
}

TEST(reprojection_factor, is_predicted_less_observed) {
  const Camera camera = Camera::fromParameters("pinhole", 640, 480, {400, 500, 320, 240});
  ReprojectionObservation observation;
  observation.pixel = {300, 200};
  observation.right_u = 290;
  observation.baseline = 0.1;
  Vec3d residual{};
  ASSERT_TRUE(
      reprojectionResidual(SE3d(), SE3d(), camera, {0.2, 0.4, 2}, observation, residual, nullptr));
  EXPECT_EQ(residual, (Vec3d{360 - 300, 340 - 200, 0}));
  observation.has_right = true;
  ASSERT_TRUE(
      reprojectionResidual(SE3d(), SE3d(), camera, {0.2, 0.4, 2}, observation, residual, nullptr));
  EXPECT_NEAR(residual[2], 360 - 400 * 0.1 / 2 - 290, 1e-12);
}

TEST(reprojection_factor, agrees_with_the_camera_where_it_sees) {
  std::mt19937 random(2);
  for (const Camera& camera : camerasOfAllModels()) {
    for (int i = 0; i < 50; ++i) {
      const Arguments a = drawArguments(camera, random);
      const Vec3d point = a.T_body_camera.inverse() * (a.T_world_body.inverse() * a.point);
      Vec2d expected{}, actual{};
      if (!camera.project(point, expected)) continue;
      ASSERT_TRUE(projectEverywhere(camera, point, actual));
      EXPECT_LT((expected - actual).norm(), 1e-9) << camera;
    }
  }
}

TEST(reprojection_factor, goes_on_by_formula_behind_the_camera_and_beyond_the_fold) {
  std::mt19937 random(3);
  for (const Camera& camera : camerasOfAllModels()) {
    const bool is_formula = camera.modelName() == "pinhole" || camera.modelName() == "radtan";
    if (!is_formula) continue;
    for (const Vec3d& in_camera : {Vec3d{0.3, -0.2, -2}, Vec3d{3, 2, 1}, Vec3d{-2, 1, -1}}) {
      Arguments a = drawArguments(camera, random);
      a.point = a.T_world_body * (a.T_body_camera * in_camera);
      a.observation.has_right = true;
      expectDerivatives(a);
    }
    Vec2d pixel{};
    EXPECT_FALSE(projectEverywhere(camera, {1, 1, 0}, pixel));
    EXPECT_FALSE(projectEverywhere(camera, {1, 1, std::nan("")}, pixel));
  }
}

TEST(reprojection_factor, refuses_what_other_models_do_not_see) {
  const Camera camera = Camera::fromParameters("orthographic", 640, 480, {200, 200, 320, 240});
  Vec3d residual{};
  EXPECT_FALSE(reprojectionResidual(SE3d(), SE3d(), camera, {0.1, 0.1, -1}, {}, residual));
  EXPECT_FALSE(reprojectionResidual(SE3d(), SE3d(), Camera(), {0.1, 0.1, 1}, {}, residual));
}

}  // namespace
}  // namespace gslam
