// Camera against the models it holds.
#include <cstring>
#include <map>
#include <string>

#include "camera_cases.h"

namespace {

using gslam::Camera;
using gslam::Vec2d;
using gslam::Vec3d;

template <class Case>
class CameraValue : public testing::Test {};
TYPED_TEST_SUITE(CameraValue, camera_cases::All, );

// The same bits as the model itself, one by one and many at once. (A SIMD path of an older
// implementation subtracted z where it had to divide.)
TYPED_TEST(CameraValue, DoesWhatTheModelDoes) {
  const auto model = camera_cases::make<typename TypeParam::Double>(TypeParam::values());
  const Camera camera(TypeParam::kWidth, TypeParam::kHeight, model);
  EXPECT_EQ(camera.modelName(), model.name());
  EXPECT_EQ(camera.parameters(), TypeParam::values());
  const std::vector<Vec2d> pixels = camera_cases::pixels<TypeParam>();
  std::vector<Vec3d> bearings(pixels.size());
  std::vector<std::uint8_t> is_valid(pixels.size(), 7);
  const std::size_t count = camera.unprojectMany(pixels, bearings, is_valid);
  std::size_t expected_count = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    Vec3d one, expected;
    const bool is_seen = model.unproject(pixels[i], expected);
    ASSERT_EQ(is_valid[i], is_seen ? 1 : 0);
    ASSERT_EQ(camera.unproject(pixels[i], one), is_seen);
    expected_count += is_seen ? 1 : 0;
    if (!is_seen) continue;
    ASSERT_EQ(one, expected);
    ASSERT_EQ(bearings[i], expected);
    bearings[i] *= 1.5;
  }
  EXPECT_EQ(count, expected_count);
  bearings.push_back({0, 0, 0});
  std::vector<Vec2d> back(bearings.size());
  is_valid.resize(bearings.size());
  (void)camera.projectMany(bearings, back, is_valid);
  EXPECT_EQ(is_valid.back(), 0);
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    Vec2d one, expected;
    const bool is_seen = model.project(bearings[i], expected);
    ASSERT_EQ(is_valid[i], is_seen ? 1 : 0);
    ASSERT_EQ(camera.project(bearings[i], one), is_seen);
    if (!is_seen) continue;
    ASSERT_EQ(one, expected);
    ASSERT_EQ(back[i], expected);
  }
}

TYPED_TEST(CameraValue, GivesTheModelsJacobians) {
  using Model = typename TypeParam::Double;
  const Model model = camera_cases::make<Model>(TypeParam::values());
  const Camera camera(TypeParam::kWidth, TypeParam::kHeight, model);
  const Vec3d point = {0.11, -0.07, 1.3};
  Vec2d pixel;
  Vec3d bearing;
  gslam::Mat<double, 2, 3> a, b;
  gslam::Mat<double, 3, 2> c, d;
  typename Model::ParameterJacobian by_parameters;
  typename Model::BearingParameterJacobian bearing_by_parameters;
  std::vector<double> flat(3 * camera.parameterCount());
  ASSERT_TRUE(model.project(point, pixel, &a, &by_parameters));
  ASSERT_TRUE(camera.project(point, pixel, &b, flat.data()));
  EXPECT_EQ(a, b);
  EXPECT_EQ(std::memcmp(flat.data(), by_parameters.values, sizeof(by_parameters)), 0);
  ASSERT_TRUE(model.unproject(pixel, bearing, &c, &bearing_by_parameters));
  ASSERT_TRUE(camera.unproject(pixel, bearing, &d, flat.data()));
  EXPECT_EQ(c, d);
  EXPECT_EQ(std::memcmp(flat.data(), bearing_by_parameters.values, sizeof(bearing_by_parameters)),
            0);
}

TYPED_TEST(CameraValue, IsMadeFromItsNamesAndValues) {
  const auto model = camera_cases::make<typename TypeParam::Double>(TypeParam::values());
  const Camera camera(TypeParam::kWidth, TypeParam::kHeight, model);
  const Camera made = Camera::fromParameters(camera.modelName(), camera.width(), camera.height(),
                                             camera.parameters());
  EXPECT_EQ(made, camera);
  std::map<std::string, double> named;
  for (const std::string& name : camera.parameterNames()) named[name] = camera.parameter(name);
  EXPECT_EQ(Camera::fromNamedParameters(camera.modelName(), camera.width(), camera.height(), named),
            camera);
}

}  // namespace
