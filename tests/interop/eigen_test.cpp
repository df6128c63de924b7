// Eigen's types and ours are the same things: elements, actions, products.
#include <gslam/geometry/eigen.h>
#include <gslam/geometry/nearest_rotation.h>
#include <gslam/geometry/random.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>

namespace {

using gslam::fromEigen;
using gslam::Mat;
using gslam::randomOf;
using gslam::toEigen;
using gslam::Vec3d;
using gslam::viewAsEigen;

template <class T>
class EigenTest : public testing::Test {
 public:
  static constexpr T epsilon() { return std::numeric_limits<T>::epsilon(); }
  std::mt19937 generator{1};
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(EigenTest, Scalars, );

TYPED_TEST(EigenTest, VectorsAndMatrices) {
  using T = TypeParam;
  const gslam::Vec<T, 3> v = {1, 2, 3};
  const Mat<T, 2, 3> m = {11, 12, 13, 21, 22, 23};
  const Eigen::Matrix<T, 2, 3> e = toEigen(m);
  EXPECT_EQ(e(0, 2), T(13));
  EXPECT_EQ(e(1, 0), T(21));
  EXPECT_EQ(fromEigen(e), m);
  EXPECT_EQ(fromEigen(toEigen(v)), v);
  const gslam::Vec<T, 2> product = fromEigen(e * toEigen(v));  // expressions, too
  EXPECT_EQ(product, m * v);
  EXPECT_EQ(fromEigen(e.transpose()), m.transpose());
  EXPECT_EQ((toEigen(Mat<T, 1, 3>{1, 2, 3})(0, 2)), T(3));
  EXPECT_EQ((toEigen(Mat<T, 3, 1>{1, 2, 3})(2, 0)), T(3));
  EXPECT_EQ(fromEigen(toEigen(Mat<T, 1, 3>{1, 2, 3})), (Mat<T, 1, 3>{1, 2, 3}));
}

TYPED_TEST(EigenTest, ViewsAreTheElements) {
  using T = TypeParam;
  gslam::Vec<T, 3> v = {1, 2, 3};
  viewAsEigen(v).y() = 7;
  EXPECT_EQ(v[1], T(7));
  Mat<T, 2, 3> m = {};
  viewAsEigen(m)(0, 2) = 13;
  viewAsEigen(m).row(1).setConstant(5);
  EXPECT_EQ(m, (Mat<T, 2, 3>{0, 0, 13, 5, 5, 5}));
  const auto r = randomOf<gslam::SO3<T>>(this->generator);
  EXPECT_EQ(viewAsEigen(r).coeffs().data(), r.data());
  EXPECT_EQ(viewAsEigen(r).w(), r.w());
}

TYPED_TEST(EigenTest, RotationsAndPoses) {
  using T = TypeParam;
  const T tolerance = 16 * this->epsilon();
  for (int i = 0; i < 200; ++i) {
    const auto a = randomOf<gslam::SE3<T>>(this->generator);
    const auto b = randomOf<gslam::SE3<T>>(this->generator);
    const auto s = randomOf<gslam::SIM3<T>>(this->generator);
    const auto p = randomOf<gslam::SE2<T>>(this->generator);
    const auto v = gslam::randomDirection<T>(this->generator);
    const gslam::Vec<T, 2> v2 = v.template segment<2>(0);
    ASSERT_EQ(fromEigen(toEigen(a.rotation())).quaternion(), a.rotation().quaternion());
    ASSERT_TRUE(fromEigen(toEigen(a)).isApprox(a, tolerance));
    ASSERT_TRUE(fromEigen(toEigen(s)).isApprox(s, tolerance));
    ASSERT_TRUE(fromEigen(toEigen(p)).isApprox(p, tolerance));
    ASSERT_TRUE(fromEigen(toEigen(p.rotation())).isApprox(p.rotation(), tolerance));
    // What is done there is what is done here.
    ASSERT_LE((fromEigen(toEigen(a.rotation()) * toEigen(v)) - a.rotation() * v).norm(), tolerance);
    ASSERT_LE((fromEigen(toEigen(a) * toEigen(v)) - a * v).norm(), tolerance);
    ASSERT_LE((fromEigen(toEigen(s) * toEigen(v)) - s * v).norm(), tolerance);
    ASSERT_LE((fromEigen(toEigen(p) * toEigen(v2)) - p * v2).norm(), tolerance);
    ASSERT_TRUE(fromEigen(toEigen(a) * toEigen(b)).isApprox(a * b, tolerance));
    ASSERT_TRUE(fromEigen(toEigen(a.rotation()) * toEigen(b.rotation()))
                    .isApprox(a.rotation() * b.rotation(), tolerance));
    const Eigen::AngleAxis<T> turn(toEigen(a.rotation()));
    ASSERT_LE(std::fabs(turn.angle() - a.rotation().angle()), 4 * tolerance);
  }
}

TYPED_TEST(EigenTest, WhatIsNoPoseIsRefused) {
  using T = TypeParam;
  Eigen::Transform<T, 3, Eigen::Affine> sheared = Eigen::Transform<T, 3, Eigen::Affine>::Identity();
  sheared(0, 1) = T(0.5);
  EXPECT_THROW((void)fromEigen(sheared), gslam::ArgumentError);
  EXPECT_THROW((void)fromEigen(Eigen::Quaternion<T>(0, 0, 0, 0)), gslam::ArgumentError);
}

// The nearest rotation from the singular values: U diag(1, 1, det) V^T.
TYPED_TEST(EigenTest, NearestRotationIsThatOfTheSvd) {
  using T = TypeParam;
  for (int i = 0; i < 1000; ++i) {
    Mat<T, 3, 3> m;
    for (T& value : m.values) value = gslam::randomUniform<T>(this->generator, -1, 1);
    const Eigen::JacobiSVD<Eigen::Matrix<T, 3, 3>> svd(toEigen(m),
                                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
    const T det = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    const Eigen::Matrix<T, 3, 1> signs(1, 1, det > 0 ? T(1) : T(-1));
    const Mat<T, 3, 3> expected =
        fromEigen((svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()).eval());
    const auto& s = svd.singularValues();
    const T gap = s[1] + signs[2] * s[2];
    if (gap < T(0.01)) continue;  // there the answer shakes
    const auto nearest = gslam::nearestRotation(m);
    const auto difference = toEigen(nearest.rotation.matrix() - expected);
    ASSERT_LE(difference.norm(), 32 * this->epsilon() * s[0] / gap);
  }
}

// A view of a temporary does not compile.
template <class X, class = decltype(viewAsEigen(std::declval<X>()))>
std::true_type canView(int);
template <class X>
std::false_type canView(long);
static_assert(decltype(canView<Vec3d&>(0))::value, "");
static_assert(decltype(canView<const Vec3d&>(0))::value, "");
static_assert(!decltype(canView<Vec3d>(0))::value, "");
static_assert(!decltype(canView<gslam::SO3d>(0))::value, "");
static_assert(!decltype(canView<gslam::Mat3d>(0))::value, "");

}  // namespace
