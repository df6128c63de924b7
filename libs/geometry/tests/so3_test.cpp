// What makes SO3 a group that acts on space, and what keeps its invariant.
#include <cstring>
#include <sstream>
#include <type_traits>

#include "reference.h"

namespace {

using gslam::Mat;
using gslam::SO3;
using gslam::Vec;
using reference::Real;

template <class T>
class So3Test : public testing::Test {
 public:
  static constexpr T epsilon() { return std::numeric_limits<T>::epsilon(); }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(So3Test, Scalars, );

static_assert(std::is_trivially_copyable<gslam::SO3d>::value, "");
static_assert(std::is_standard_layout<gslam::SO3d>::value, "");
static_assert(sizeof(gslam::SO3d) == 4 * sizeof(double), "");
static_assert(sizeof(gslam::SO3f) == 4 * sizeof(float), "");
static_assert(alignof(gslam::SO3d) == alignof(double), "no over-alignment");
static_assert(alignof(gslam::SO3f) == alignof(float), "no over-alignment");

TYPED_TEST(So3Test, StoredXyzw) {
  using T = TypeParam;
  const SO3<T> r = SO3<T>::fromQuaternion(T(0.5), T(-0.5), T(0.5), T(-0.5));
  EXPECT_EQ(r.x(), T(0.5));
  EXPECT_EQ(r.y(), T(-0.5));
  EXPECT_EQ(r.z(), T(0.5));
  EXPECT_EQ(r.w(), T(-0.5));
  EXPECT_EQ(r.quaternion(), (Vec<T, 4>{T(0.5), T(-0.5), T(0.5), T(-0.5)}));
  T bytes[4];
  std::memcpy(bytes, &r, sizeof bytes);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(bytes[i], r.data()[i]);
  std::ostringstream out;
  out << r;
  EXPECT_EQ(out.str(), "0.5 -0.5 0.5 -0.5");
}

// A quarter turn about z takes x to y: right-handed, active, Hamilton.
TYPED_TEST(So3Test, Handedness) {
  using T = TypeParam;
  const T quarter = static_cast<T>(reference::kPi / 2);
  const SO3<T> about_z = SO3<T>::exp({0, 0, quarter});
  const SO3<T> about_x = SO3<T>::exp({quarter, 0, 0});
  EXPECT_GT(about_z.z(), 0);
  EXPECT_LE((about_z * Vec<T, 3>{1, 0, 0} - Vec<T, 3>{0, 1, 0}).norm(), 2 * this->epsilon());
  EXPECT_NEAR(about_z.matrix()(1, 0), T(1), 2 * this->epsilon());
  EXPECT_NEAR(about_z.matrix()(0, 1), T(-1), 2 * this->epsilon());
  // First about x (y becomes z), then about z (z stays).
  EXPECT_LE((about_z * about_x * Vec<T, 3>{0, 1, 0} - Vec<T, 3>{0, 0, 1}).norm(),
            4 * this->epsilon());
}

TYPED_TEST(So3Test, GroupAxioms) {
  using T = TypeParam;
  reference::Random<T> random;
  const T tolerance = 8 * this->epsilon();
  for (int i = 0; i < 2000; ++i) {
    const SO3<T> a = random.rotation(), b = random.rotation(), c = random.rotation();
    ASSERT_TRUE(((a * b) * c).isApprox(a * (b * c), tolerance));
    ASSERT_TRUE((a * SO3<T>::identity()).isApprox(a, tolerance));
    ASSERT_TRUE((SO3<T>() * a).isApprox(a, tolerance));
    ASSERT_TRUE((a * a.inverse()).isApprox(SO3<T>(), tolerance));
    ASSERT_TRUE((a.inverse() * a).isApprox(SO3<T>(), tolerance));
    ASSERT_TRUE((a * b).inverse().isApprox(b.inverse() * a.inverse(), tolerance));
  }
}

TYPED_TEST(So3Test, ActsAsItsMatrix) {
  using T = TypeParam;
  reference::Random<T> random;
  for (int i = 0; i < 2000; ++i) {
    const SO3<T> a = random.rotation(), b = random.rotation();
    const T size = std::exp(random.uniform(T(-20), T(20)));
    const Vec<T, 3> v = size * random.direction();
    const T tolerance = 16 * this->epsilon() * size;
    ASSERT_LE((a * v - a.matrix() * v).norm(), tolerance);
    ASSERT_LE(((a * b) * v - a * (b * v)).norm(), tolerance);
    ASSERT_LE((a.inverse() * (a * v) - v).norm(), tolerance);
    ASSERT_LE(std::fabs((a * v).norm() - v.norm()), tolerance);
    const Vec<T, 3> u = random.direction();
    ASSERT_LE(((a * u).cross(a * v) - a * u.cross(v)).norm(), 2 * tolerance);
  }
}

TYPED_TEST(So3Test, MatrixIsARotation) {
  using T = TypeParam;
  reference::Random<T> random;
  for (int i = 0; i < 2000; ++i) {
    const SO3<T> a = random.rotation(), b = random.rotation();
    const auto matrix = reference::convert<Real>(a.matrix());
    const auto difference =
        reference::add(matrix * matrix.transpose(), reference::Matrix::identity(), -1);
    // An element is off by 4 times what the norm of the quaternion may be.
    ASSERT_LE(reference::norm(difference), 28 * this->epsilon());
    ASSERT_LE(
        reference::relativeError((a * b).matrix(), matrix * reference::convert<Real>(b.matrix())),
        16 * this->epsilon());
  }
}

// The norm of a product is the product of the norms and a rounding; normalized() mends it.
TYPED_TEST(So3Test, LongProductsDriftNoFasterThanStated) {
  using T = TypeParam;
  reference::Random<T> random;
  const int factors = 10000;
  SO3<T> product;
  for (int i = 0; i < factors; ++i) product *= random.rotation();
  const T drift = std::fabs(product.quaternion().norm() - 1);
  EXPECT_LE(drift, 4 * factors * this->epsilon());
  EXPECT_NEAR(product.normalized().quaternion().norm(), T(1), 2 * this->epsilon());
  EXPECT_TRUE(product.normalized().isApprox(product, 4 * this->epsilon()));
  // log is that of the rotation next to it: what is off is the norm, not the direction.
  EXPECT_LE((product.normalized().log() - product.log()).norm(), 4 * drift + 8 * this->epsilon());
}

TYPED_TEST(So3Test, EveryWayInGivesAUnitQuaternion) {
  using T = TypeParam;
  reference::Random<T> random;
  for (const T angle : reference::anglesAndBeyond<T>()) {
    const SO3<T> r = SO3<T>::exp(angle * random.direction());
    const Vec<T, 4> q = random.uniform(T(0.01), T(100)) * r.quaternion();
    const SO3<T> all[] = {r, r.inverse(), r * r, SO3<T>::fromMatrix(r.matrix()),
                          SO3<T>::fromQuaternion(q[0], q[1], q[2], q[3])};
    for (const SO3<T>& one : all) {
      const Real norm = reference::convert<Real>(one.quaternion()).norm();
      ASSERT_LE(std::fabs(norm - 1), 4 * this->epsilon()) << angle;
    }
  }
}

TYPED_TEST(So3Test, AngleAndIsApprox) {
  using T = TypeParam;
  const T pi = static_cast<T>(reference::kPi);
  for (const T angle : reference::angles<T>()) {
    const SO3<T> r = SO3<T>::exp({0, -angle, 0});
    ASSERT_LE(std::fabs(r.angle() - angle), 2 * this->epsilon() * angle);
    ASSERT_EQ(r.angle(), r.inverse().angle());
  }
  const SO3<T> a = SO3<T>::exp({T(0.1), T(0.2), T(-3)});
  const SO3<T> moved = a * SO3<T>::exp({0, T(0.01), 0});
  EXPECT_TRUE(a.isApprox(moved, T(0.0101)));
  EXPECT_FALSE(a.isApprox(moved, T(0.0099)));
  EXPECT_TRUE(a.isApprox(SO3<T>::fromQuaternion(-a.x(), -a.y(), -a.z(), -a.w()), this->epsilon()));
  EXPECT_FALSE(a.isApprox(a * SO3<T>::exp({pi, 0, 0}), T(3.14)));
  EXPECT_FALSE(a.isApprox(a, std::numeric_limits<T>::quiet_NaN()));
}

TYPED_TEST(So3Test, HatAndVee) {
  using T = TypeParam;
  const Vec<T, 3> a = {T(0.1), -2, 3};
  const Vec<T, 3> b = {4, T(5.5), -6};
  EXPECT_EQ(SO3<T>::hat(a) * b, a.cross(b));
  EXPECT_EQ(SO3<T>::hat(a).transpose(), SO3<T>::hat(-a));
  EXPECT_EQ(SO3<T>::vee(SO3<T>::hat(a)), a);
  EXPECT_EQ(SO3<T>::vee(Mat<T, 3, 3>::identity()), (Vec<T, 3>{}));
}

// R exp(delta) = exp(R delta) R: what a perturbation on the right means.
TYPED_TEST(So3Test, RightPerturbation) {
  using T = TypeParam;
  reference::Random<T> random;
  for (int i = 0; i < 500; ++i) {
    const SO3<T> r = random.rotation();
    const Vec<T, 3> delta = random.uniform(0, 3) * random.direction();
    ASSERT_TRUE(
        (r * SO3<T>::exp(delta)).isApprox(SO3<T>::exp(r * delta) * r, 16 * this->epsilon()));
  }
}

}  // namespace
