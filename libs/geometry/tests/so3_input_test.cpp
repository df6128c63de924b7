// Quaternions and matrices from outside: what is taken, and what is refused with which words.
#include <gmock/gmock.h>

#include <string>

#include "reference.h"

namespace {

using gslam::Mat;
using gslam::SO3;
using gslam::Vec;
using testing::HasSubstr;

template <class T>
class So3Input : public testing::Test {
 public:
  static constexpr T epsilon() { return std::numeric_limits<T>::epsilon(); }

  static std::string refusal(const Vec<T, 4>& q) {
    try {
      (void)SO3<T>::fromQuaternion(q[0], q[1], q[2], q[3]);
    } catch (const gslam::ArgumentError& error) {
      return error.what();
    }
    return "taken";
  }
  static std::string refusal(const Mat<T, 3, 3>& m) {
    try {
      (void)SO3<T>::fromMatrix(m);
    } catch (const gslam::ArgumentError& error) {
      return error.what();
    }
    return "taken";
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(So3Input, Scalars, );

TYPED_TEST(So3Input, QuaternionsAreNormalised) {
  using T = TypeParam;
  const SO3<T> r = SO3<T>::fromQuaternion(2, -4, 10, 11);
  const Vec<T, 4> expected = Vec<T, 4>{2, -4, 10, 11} / std::sqrt(T(241));
  EXPECT_LE((r.quaternion() - expected).norm(), 2 * this->epsilon());
  const T huge = std::numeric_limits<T>::max() / 2;
  EXPECT_EQ(SO3<T>::fromQuaternion(huge, huge, -huge, huge).quaternion(),
            (Vec<T, 4>{T(0.5), T(0.5), T(-0.5), T(0.5)}));
}

TYPED_TEST(So3Input, UnitQuaternionsKeepTheirBits) {
  using T = TypeParam;
  reference::Random<T> random;
  for (int i = 0; i < 2000; ++i) {
    const Vec<T, 4> q = (random.rotation() * random.rotation()).normalized().quaternion();
    ASSERT_EQ(SO3<T>::fromQuaternion(q[0], q[1], q[2], q[3]).quaternion(), q);
  }
}

TYPED_TEST(So3Input, RefusedQuaternions) {
  using T = TypeParam;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const T infinity = std::numeric_limits<T>::infinity();
  EXPECT_THAT(this->refusal(Vec<T, 4>{0, 0, 0, 0}), HasSubstr("norm near zero"));
  EXPECT_THAT(this->refusal(Vec<T, 4>{0, 0, this->epsilon(), 0}), HasSubstr("norm near zero"));
  EXPECT_THAT(this->refusal(Vec<T, 4>{0, nan, 0, 1}), HasSubstr("not finite"));
  EXPECT_THAT(this->refusal(Vec<T, 4>{-infinity, 0, 0, 1}), HasSubstr("-inf 0 0 1"));
  EXPECT_EQ(this->refusal(Vec<T, 4>{0, 0, 2 * this->epsilon(), 0}), "taken");
}

// Every branch, and both sides of each border between them.
TYPED_TEST(So3Input, MatricesGiveBackTheirRotation) {
  using T = TypeParam;
  for (const T angle : reference::anglesAndBeyond<T>()) {
    for (const Vec<T, 3>& axis : reference::axes<T>()) {
      const SO3<T> r = SO3<T>::exp(angle * axis);
      ASSERT_TRUE(SO3<T>::fromMatrix(r.matrix()).isApprox(r, 8 * this->epsilon())) << r;
    }
  }
}

TYPED_TEST(So3Input, MatricesOfSmallAnglesKeepTheirDigits) {
  using T = TypeParam;
  for (const T angle : reference::angles<T>()) {
    if (angle > T(1)) continue;
    const Vec<T, 3> v = angle * Vec<T, 3>{2, 3, -6} / 7;
    const Vec<T, 3> log = SO3<T>::fromMatrix(SO3<T>::exp(v).matrix()).log();
    ASSERT_LE(reference::relativeError(log, v), reference::bound<T>()) << angle;
  }
}

TYPED_TEST(So3Input, MatricesWithSixDigitsAreTaken) {
  using T = TypeParam;
  reference::Random<T> random;
  for (int i = 0; i < 500; ++i) {
    const SO3<T> r = random.rotation();
    Mat<T, 3, 3> m = r.matrix();
    for (T& value : m.values) value = std::round(value * T(1e6)) / T(1e6);
    ASSERT_TRUE(SO3<T>::fromMatrix(m).isApprox(r, T(3e-6)));
  }
}

TYPED_TEST(So3Input, RefusedMatrices) {
  using T = TypeParam;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const Mat<T, 3, 3> reflection = {1, 0, 0, 0, 1, 0, 0, 0, -1};
  const Mat<T, 3, 3> inversion = {-1, 0, 0, 0, -1, 0, 0, 0, -1};
  const Mat<T, 3, 3> scaled = {2, 0, 0, 0, 2, 0, 0, 0, 2};
  const Mat<T, 3, 3> sheared = {1, 0, 0, T(0.6), T(0.8), 0, 0, 0, 1};
  EXPECT_THAT(this->refusal(reflection), HasSubstr("is a reflection, its determinant is -1"));
  EXPECT_THAT(this->refusal(inversion), HasSubstr("is a reflection"));
  EXPECT_THAT(this->refusal(scaled), HasSubstr("row 0 has the squared length 4, expected 1"));
  EXPECT_THAT(this->refusal(sheared),
              HasSubstr("rows 0 and 1 have the dot product 0.6, expected 0 within 1e-05"));
  EXPECT_THAT(this->refusal(Mat<T, 3, 3>{}), HasSubstr("row 0 has the squared length 0"));
  EXPECT_THAT(this->refusal(Mat<T, 3, 3>{1, 0, 0, 0, 1, nan, 0, 0, 1}),
              HasSubstr("nan in row 1, column 2"));
  EXPECT_THAT(this->refusal(Mat<T, 3, 3>{1, 0, 0, 0, T(1.00001), 0, 0, 0, 1}),
              HasSubstr("row 1 has the squared length 1.0000"));
}

TYPED_TEST(So3Input, ToleranceOfMatricesIsTheCallers) {
  using T = TypeParam;
  const Mat<T, 3, 3> nearly = {1, 0, 0, 0, T(1.0004), 0, 0, 0, 1};
  EXPECT_THROW((void)SO3<T>::fromMatrix(nearly), gslam::ArgumentError);
  EXPECT_TRUE(SO3<T>::fromMatrix(nearly, T(1e-3)).isApprox(SO3<T>(), T(1e-3)));
}

}  // namespace
