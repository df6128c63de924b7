// Jacobians of every camera model against central differences of the same model in long double.
#include <algorithm>
#include <cmath>

#include "camera_cases.h"

namespace {

using camera_cases::make;
using camera_cases::pixels;
using gslam::Mat;
using gslam::Vec;
using gslam::Vec2d;
using gslam::Vec3d;
using Real = long double;

template <std::size_t N>
Vec<Real, N> widen(const Vec<double, N>& v) {
  Vec<Real, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = v[i];
  return result;
}

// Largest difference of two matrices, relative to the largest element of the column.
template <std::size_t R, std::size_t C>
double difference(const Mat<double, R, C>& actual, const Mat<Real, R, C>& expected) {
  double largest = 0;
  for (std::size_t c = 0; c < C; ++c) {
    Real scale = 1e-3L;
    for (std::size_t r = 0; r < R; ++r) scale = std::max(scale, std::fabs(expected(r, c)));
    for (std::size_t r = 0; r < R; ++r) {
      largest = std::max(largest, double(std::fabs(actual(r, c) - expected(r, c)) / scale));
    }
  }
  return largest;
}

// How far a number may be changed: as much as it is large, or as much as changes the result by 1.
template <std::size_t R, std::size_t C>
Vec<Real, C> scales(const Vec<Real, C>& at, const Mat<double, R, C>& jacobian) {
  Vec<Real, C> result;
  for (std::size_t c = 0; c < C; ++c) {
    Real steepest = 10;
    for (std::size_t r = 0; r < R; ++r) {
      steepest = std::max<Real>(steepest, std::fabs(jacobian(r, c)));
    }
    result[c] = std::max(std::fabs(at[c]), 1 / steepest);
  }
  return result;
}

// d f / d x from four values on each line; f(x, result) says whether there is one.
template <std::size_t R, std::size_t C, class Function>
bool differentiate(const Function& f, const Vec<Real, C>& at, const Vec<Real, C>& steps,
                   Mat<Real, R, C>& jacobian) {
  for (std::size_t c = 0; c < C; ++c) {
    const Real step = steps[c];
    const auto difference = [&](Real distance, Vec<Real, R>& result) {
      Vec<Real, C> low = at, high = at;
      low[c] -= distance;
      high[c] += distance;
      Vec<Real, R> below, above;
      if (!f(low, below) || !f(high, above)) return false;
      result = above - below;
      return true;
    };
    Vec<Real, R> near, far;
    if (!difference(step, near) || !difference(2 * step, far)) return false;
    for (std::size_t r = 0; r < R; ++r) jacobian(r, c) = (8 * near[r] - far[r]) / (12 * step);
  }
  return true;
}

template <class Case>
class CameraJacobian : public testing::Test {
 public:
  using Camera = typename Case::Double;
  using Long = typename Case::Long;
  static constexpr std::size_t kCount = Camera::parameterCount();

  CameraJacobian() : camera(make<Camera>(Case::values())), reference(make<Long>(Case::values())) {}

  void checkProject(const Vec3d& point) {
    Vec2d pixel, plain;
    Mat<double, 2, 3> by_point;
    Mat<double, 2, kCount> by_parameters;
    ASSERT_TRUE(camera.project(point, pixel, &by_point, &by_parameters));
    ASSERT_TRUE(camera.project(point, plain));
    EXPECT_EQ(pixel, plain);
    Mat<Real, 2, 3> expected;
    Mat<Real, 2, kCount> expected_by_parameters;
    const auto of_point = [&](const Vec<Real, 3>& p, Vec<Real, 2>& result) {
      return reference.project(p, result);
    };
    const auto of_parameters = [&](const Vec<Real, kCount>& parameters, Vec<Real, 2>& result) {
      return Long(parameters).project(widen(point), result);
    };
    const Vec<Real, 3> at = widen(point);
    if (!differentiate(of_point, at, 1e-4L * scales(at, by_point), expected)) return;  // at a limit
    EXPECT_LE(difference(by_point, expected), 1e-10) << point << "\n" << by_point;
    const auto parameters = reference.parameters();
    if (!differentiate(of_parameters, parameters, 1e-4L * scales(parameters, by_parameters),
                       expected_by_parameters)) {
      return;
    }
    EXPECT_LE(difference(by_parameters, expected_by_parameters), 1e-8)
        << point << "\n"
        << by_parameters << "\nexpected\n"
        << expected_by_parameters;
    ++checked;
  }

  void checkUnproject(const Vec2d& pixel) {
    Vec3d bearing, plain;
    Mat<double, 3, 2> by_pixel;
    Mat<double, 3, kCount> by_parameters;
    if (!camera.unproject(pixel, plain)) return;
    ASSERT_TRUE(camera.unproject(pixel, bearing, &by_pixel, &by_parameters)) << pixel;
    EXPECT_EQ(bearing, plain);
    Mat<Real, 3, 2> expected;
    Mat<Real, 3, kCount> expected_by_parameters;
    const auto of_pixel = [&](const Vec<Real, 2>& p, Vec<Real, 3>& result) {
      return reference.unproject(p, result);
    };
    const auto of_parameters = [&](const Vec<Real, kCount>& parameters, Vec<Real, 3>& result) {
      return Long(parameters).unproject(widen(pixel), result);
    };
    const Vec<Real, 2> at = widen(pixel);
    if (!differentiate(of_pixel, at, 1e-6L * scales(at, by_pixel), expected)) return;
    EXPECT_LE(difference(by_pixel, expected), 1e-8) << pixel << "\n" << by_pixel;
    const auto parameters = reference.parameters();
    if (!differentiate(of_parameters, parameters, 1e-6L * scales(parameters, by_parameters),
                       expected_by_parameters)) {
      return;
    }
    EXPECT_LE(difference(by_parameters, expected_by_parameters), 1e-8)
        << pixel << "\n"
        << by_parameters << "\nexpected\n"
        << expected_by_parameters;
    ++checked;
  }

  Camera camera;
  Long reference;
  int checked = 0;
};
TYPED_TEST_SUITE(CameraJacobian, camera_cases::All, );

TYPED_TEST(CameraJacobian, OfProject) {
  for (const Vec2d& pixel : pixels<TypeParam>(61)) {
    Vec3d bearing;
    if (this->camera.unproject(pixel, bearing)) this->checkProject(bearing * 2.5);
  }
  EXPECT_GE(this->checked, 30);
}

TYPED_TEST(CameraJacobian, OfProjectAtTheAxis) {
  this->checkProject({0, 0, 1.7});
  this->checkProject({1e-170, 0, 1.7});
  this->checkProject({1e-9, -1e-9, 1.7});
  this->checkProject({-3e-5, 2e-5, 1.7});
  EXPECT_EQ(this->checked, 4);
}

TYPED_TEST(CameraJacobian, OfUnproject) {
  for (const Vec2d& pixel : pixels<TypeParam>(61)) this->checkUnproject(pixel);
  EXPECT_GE(this->checked, 30);
}

}  // namespace
