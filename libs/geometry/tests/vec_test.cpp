#include <gslam/geometry/vec.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <type_traits>

namespace {

using gslam::Vec;

template <class T>
class VecTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(VecTest, Scalars, );

// What crosses plugin borders must be the same for everybody.
template <class T, std::size_t N>
constexpr bool isPlainVec() {
  return std::is_trivially_copyable<Vec<T, N>>::value &&
         std::is_standard_layout<Vec<T, N>>::value && std::is_trivial<Vec<T, N>>::value &&
         sizeof(Vec<T, N>) == N * sizeof(T) && alignof(Vec<T, N>) == alignof(T);
}
static_assert(isPlainVec<float, 2>() && isPlainVec<float, 3>(), "");
static_assert(isPlainVec<double, 3>() && isPlainVec<double, 4>(), "");

TYPED_TEST(VecTest, Arithmetic) {
  using T = TypeParam;
  const Vec<T, 3> a = {1, 2, 3};
  const Vec<T, 3> b = {4, -5, 6};
  EXPECT_EQ(a + b, (Vec<T, 3>{5, -3, 9}));
  EXPECT_EQ(a - b, (Vec<T, 3>{-3, 7, -3}));
  EXPECT_EQ(-a, (Vec<T, 3>{-1, -2, -3}));
  EXPECT_EQ(2 * a, (Vec<T, 3>{2, 4, 6}));
  EXPECT_EQ(a * 2, 2 * a);
  EXPECT_EQ(b / 2, (Vec<T, 3>{2, T(-2.5), 3}));
  EXPECT_EQ(a.dot(b), T(12));
  EXPECT_EQ(a.cross(b), (Vec<T, 3>{27, 6, -13}));
  EXPECT_EQ(a.cross(b), -b.cross(a));
  EXPECT_EQ((Vec<T, 3>{1, 0, 0}).cross({0, 1, 0}), (Vec<T, 3>{0, 0, 1}));
}

TYPED_TEST(VecTest, ElementsAndComparison) {
  using T = TypeParam;
  Vec<T, 4> v{};
  EXPECT_EQ(v, (Vec<T, 4>{0, 0, 0, 0}));
  v[2] = 7;
  EXPECT_EQ(v.data()[2], T(7));
  EXPECT_EQ(v.size(), 4u);
  EXPECT_NE(v, (Vec<T, 4>{}));
  v[0] = std::numeric_limits<T>::quiet_NaN();
  EXPECT_FALSE(v == v);
  EXPECT_TRUE(v != v);
}

TYPED_TEST(VecTest, Norms) {
  using T = TypeParam;
  const Vec<T, 3> v = {2, -3, 6};
  EXPECT_EQ(v.squaredNorm(), T(49));
  EXPECT_EQ(v.norm(), T(7));
  EXPECT_EQ((Vec<T, 2>{0, -4}).normalized(), (Vec<T, 2>{0, -1}));
  EXPECT_EQ((Vec<T, 3>{}).norm(), T(0));
}

// The squares of these are zero, denormal or infinite.
TYPED_TEST(VecTest, NormsOfEverySize) {
  using T = TypeParam;
  using Limits = std::numeric_limits<T>;
  const T epsilon = Limits::epsilon();
  T size = Limits::min() * 8;
  while (size < Limits::max() / 100) {
    const Vec<T, 3> v = {2 * size, -3 * size, 6 * size};
    ASSERT_NEAR(v.norm() / size, T(7), 20 * epsilon) << size;
    ASSERT_NEAR(v.normalized().norm(), T(1), 2 * epsilon) << size;
    ASSERT_NEAR(v.normalized()[2], T(6) / T(7), 2 * epsilon) << size;
    size *= T(7.7);
  }
  const Vec<T, 2> least = {Limits::denorm_min(), Limits::denorm_min()};
  EXPECT_NEAR(least.normalized()[1], std::sqrt(T(0.5)), epsilon);
  const Vec<T, 2> most = {Limits::max(), Limits::max()};
  EXPECT_NEAR(most.normalized()[1], std::sqrt(T(0.5)), epsilon);
}

TYPED_TEST(VecTest, WhatHasNoDirection) {
  using T = TypeParam;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const T infinity = std::numeric_limits<T>::infinity();
  EXPECT_THROW((Vec<T, 3>{}).normalized(), gslam::ArgumentError);
  EXPECT_THROW((Vec<T, 3>{0, nan, 1}).normalized(), gslam::ArgumentError);
  EXPECT_THROW((Vec<T, 3>{nan, 0, 0}).normalized(), gslam::ArgumentError);
  EXPECT_THROW((Vec<T, 3>{1, 0, -infinity}).normalized(), gslam::ArgumentError);
  EXPECT_TRUE(std::isnan((Vec<T, 3>{0, nan, 0}).norm()));
  EXPECT_EQ((Vec<T, 3>{1, 0, -infinity}).norm(), infinity);
}

TYPED_TEST(VecTest, Prints) {
  std::ostringstream out;
  out << Vec<TypeParam, 3>{1, -2.5, 0};
  EXPECT_EQ(out.str(), "1 -2.5 0");
}

}  // namespace
