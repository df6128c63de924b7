// exp and log against the matrix exponential in long double, at every angle.
#include "reference.h"

namespace {

using gslam::SO3;
using gslam::Vec;
using reference::Real;
using reference::relativeError;

template <class T>
class So3ExpLog : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(So3ExpLog, Scalars, );

// The rotation vector of norm 0 to pi with the same rotation.
reference::Vector wrapped(const reference::Vector& v) {
  const Real angle = v.norm();
  const Real turn = 2 * reference::kPi;
  return v * ((angle - turn * std::round(angle / turn)) / angle);
}

// Beside half a turn, log may land on either side of it.
template <class T>
Real errorOfLog(const Vec<T, 3>& actual, const reference::Vector& expected) {
  const Real angle = expected.norm();
  Real error = relativeError(actual, expected);
  if (angle > reference::kPi - 4 * static_cast<Real>(std::numeric_limits<T>::epsilon())) {
    const Real other_side = relativeError(actual, expected * (1 - 2 * reference::kPi / angle));
    if (other_side < error) error = other_side;
  }
  return error;
}

TYPED_TEST(So3ExpLog, ExpIsTheMatrixExponential) {
  using T = TypeParam;
  Real worst = 0;
  for (const T angle : reference::anglesAndBeyond<T>()) {
    for (const Vec<T, 3>& axis : reference::axes<T>()) {
      const Vec<T, 3> v = angle * axis;
      const reference::Matrix e = reference::expMinusIdentity(reference::convert<Real>(v));
      const reference::Matrix expected = reference::add(reference::Matrix::identity(), e);
      const Real error = relativeError(SO3<T>::exp(v).matrix(), expected);
      ASSERT_LE(error, reference::bound<T>()) << "v = " << v;
      if (error > worst) worst = error;
    }
  }
  this->RecordProperty("worst_in_epsilons",
                       std::to_string(worst / std::numeric_limits<T>::epsilon()));
}

// Where the rotation is nearly the identity, only its difference from it says anything.
TYPED_TEST(So3ExpLog, ExpOfSmallAnglesKeepsItsDigits) {
  using T = TypeParam;
  for (const T angle : reference::angles<T>()) {
    if (angle > T(1)) continue;
    for (const Vec<T, 3>& axis : reference::axes<T>()) {
      const Vec<T, 3> v = angle * axis;
      const reference::Matrix e = reference::expMinusIdentity(reference::convert<Real>(v));
      const reference::Vector expected = {(e(2, 1) - e(1, 2)) / 2, (e(0, 2) - e(2, 0)) / 2,
                                          (e(1, 0) - e(0, 1)) / 2};
      const Vec<T, 3> actual = SO3<T>::vee(SO3<T>::exp(v).matrix());
      ASSERT_LE(relativeError(actual, expected), reference::bound<T>()) << "v = " << v;
    }
  }
}

TYPED_TEST(So3ExpLog, LogUndoesExp) {
  using T = TypeParam;
  for (const T angle : reference::angles<T>()) {
    for (const Vec<T, 3>& axis : reference::axes<T>()) {
      const Vec<T, 3> v = angle * axis;
      const Vec<T, 3> log = SO3<T>::exp(v).log();
      ASSERT_LE(errorOfLog(log, reference::convert<Real>(v)), reference::bound<T>()) << "v = " << v;
      ASSERT_LE(log.norm(), static_cast<T>(reference::kPi) * (1 + reference::bound<T>()));
    }
  }
}

TYPED_TEST(So3ExpLog, LogOfExpBeyondPiIsTheShortWay) {
  using T = TypeParam;
  for (const T angle : reference::anglesAndBeyond<T>()) {
    for (const Vec<T, 3>& axis : reference::axes<T>()) {
      const Vec<T, 3> v = angle * axis;
      const reference::Vector expected = wrapped(reference::convert<Real>(v));
      // Next to whole turns the result is tiny, and exp's error of epsilon^2 in the angle, far
      // below an ulp of the quaternion, shows; as does the reference's own.
      const Real epsilon = static_cast<Real>(std::numeric_limits<T>::epsilon());
      const Real from_exp = static_cast<Real>(angle) *
                            (4 * epsilon * epsilon + 4 * std::numeric_limits<Real>::epsilon()) /
                            expected.norm();
      ASSERT_LE(errorOfLog(SO3<T>::exp(v).log(), expected), reference::bound<T>() + from_exp)
          << "v = " << v;
    }
  }
}

// log on its own, for quaternions that long double arithmetic has made, with both signs.
TYPED_TEST(So3ExpLog, LogOfARoundedQuaternion) {
  using T = TypeParam;
  for (const T angle : reference::angles<T>()) {
    for (const Vec<T, 3>& axis : reference::axes<T>()) {
      const reference::Vector v = reference::convert<Real>(angle * axis);
      const reference::Vector u = v * (std::sin(v.norm() / 2) / v.norm());
      const T x = static_cast<T>(u[0]), y = static_cast<T>(u[1]), z = static_cast<T>(u[2]);
      const T w = static_cast<T>(std::cos(v.norm() / 2));
      ASSERT_LE(errorOfLog(SO3<T>::fromQuaternion(x, y, z, w).log(), v), reference::bound<T>())
          << v;
      ASSERT_LE(errorOfLog(SO3<T>::fromQuaternion(-x, -y, -z, -w).log(), v), reference::bound<T>())
          << v;
    }
  }
}

TYPED_TEST(So3ExpLog, ExpUndoesLog) {
  using T = TypeParam;
  reference::Random<T> random;
  for (int i = 0; i < 10000; ++i) {
    const SO3<T> r = (random.rotation() * random.rotation()).normalized();
    ASSERT_TRUE(SO3<T>::exp(r.log()).isApprox(r, 8 * std::numeric_limits<T>::epsilon())) << r;
  }
}

TYPED_TEST(So3ExpLog, SpecialPlaces) {
  using T = TypeParam;
  const T pi = static_cast<T>(reference::kPi);
  EXPECT_EQ(SO3<T>::exp({0, 0, 0}).quaternion(), SO3<T>::identity().quaternion());
  EXPECT_EQ(SO3<T>().log(), (Vec<T, 3>{0, 0, 0}));
  EXPECT_EQ(SO3<T>::fromQuaternion(0, 0, 0, -1).log(), (Vec<T, 3>{0, 0, 0}));
  const T ulp = 4 * std::numeric_limits<T>::epsilon();  // of numbers from 2 to 4, twice
  EXPECT_LE((SO3<T>::fromQuaternion(0, 1, 0, 0).log() - Vec<T, 3>{0, pi, 0}).norm(), ulp);
  EXPECT_LE((SO3<T>::fromQuaternion(0, -1, 0, 0).log() - Vec<T, 3>{0, -pi, 0}).norm(), ulp);
  const T least = std::numeric_limits<T>::denorm_min();
  EXPECT_EQ(SO3<T>::exp({0, 2 * least, 0}).log(), (Vec<T, 3>{0, 2 * least, 0}));
}

// 2, 3, 6 and 7 are the sides and the diagonal of a box: the angle 7 s is known without rounding.
TYPED_TEST(So3ExpLog, HugeAnglesAreReducedRight) {
  using T = TypeParam;
  const T limit = T(0.01) / std::numeric_limits<T>::epsilon() / 7;
  for (const T rough : reference::geometricSteps(T(0.7123456789), limit, T(1.1))) {
    int exponent = 0;  // s is rough without its last two bits, so that 3 s is a T
    const T digits = std::ldexp(T(1), std::numeric_limits<T>::digits - 2);
    const T s = std::ldexp(std::trunc(std::frexp(rough, &exponent) * digits) / digits, exponent);
    const Real half = Real(3.5) * static_cast<Real>(s);
    const Vec<Real, 4> expected = {2 * std::sin(half) / 7, -3 * std::sin(half) / 7,
                                   6 * std::sin(half) / 7, std::cos(half)};
    const SO3<T> r = SO3<T>::exp({2 * s, -3 * s, 6 * s});
    ASSERT_LE(relativeError(r.quaternion(), expected), reference::bound<T>()) << s;
  }
}

TYPED_TEST(So3ExpLog, EveryFiniteVectorGivesAUnitQuaternion) {
  using T = TypeParam;
  const T largest = std::numeric_limits<T>::max();
  for (const Vec<T, 3>& v : {Vec<T, 3>{largest, -largest, largest}, Vec<T, 3>{0, largest, 0},
                             Vec<T, 3>{largest, 1, std::numeric_limits<T>::min()}}) {
    EXPECT_NEAR(SO3<T>::exp(v).quaternion().norm(), T(1), 4 * std::numeric_limits<T>::epsilon());
  }
}

TYPED_TEST(So3ExpLog, ExpOfWhatIsNotFinite) {
  using T = TypeParam;
  const T infinity = std::numeric_limits<T>::infinity();
  const T nan = std::numeric_limits<T>::quiet_NaN();
  EXPECT_THROW((void)SO3<T>::exp({nan, 0, 0}), gslam::ArgumentError);
  EXPECT_THROW((void)SO3<T>::exp({0, 0, nan}), gslam::ArgumentError);
  EXPECT_THROW((void)SO3<T>::exp({0, -infinity, 0}), gslam::ArgumentError);
  EXPECT_THROW((void)SO3<T>::exp({infinity, nan, 1}), gslam::ArgumentError);
}

}  // namespace
