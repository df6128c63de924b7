// Angles of all twelve sequences: there and back, at and near gimbal lock, and what they mean.
#include <gslam/geometry/euler.h>

#include "reference.h"

namespace {

using gslam::EulerSequence;
using gslam::SO3;
using gslam::SO3d;
using gslam::Vec;
using reference::Real;

constexpr int kSequences = 12;
const char* const kNames[kSequences] = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx",
                                        "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"};

template <class T>
class Euler : public testing::Test {
 public:
  static constexpr T epsilon() { return std::numeric_limits<T>::epsilon(); }
  static SO3<T> about(char axis, T angle) {
    Vec<T, 3> v{};
    v[static_cast<std::size_t>(axis - 'x')] = angle;
    return SO3<T>::exp(v);
  }
  // The range that the header states.
  static bool isInRange(const Vec<T, 3>& angles, bool proper) {
    const T pi = static_cast<T>(reference::kPi) * (1 + epsilon());
    const bool middle = proper ? angles[1] >= 0 && angles[1] <= pi : std::fabs(angles[1]) <= pi / 2;
    return std::fabs(angles[0]) <= pi && middle && std::fabs(angles[2]) <= pi;
  }
  // The rotation comes back, whatever the angles.
  static void roundTrip(const SO3<T>& r) {
    for (int i = 0; i < kSequences; ++i) {
      const auto sequence = static_cast<EulerSequence>(i);
      const Vec<T, 3> intrinsic = gslam::intrinsicEulerOf(r, sequence);
      const Vec<T, 3> extrinsic = gslam::extrinsicEulerOf(r, sequence);
      ASSERT_TRUE(isInRange(intrinsic, i >= 6)) << kNames[i] << " " << intrinsic;
      ASSERT_TRUE(isInRange(extrinsic, i >= 6)) << kNames[i] << " " << extrinsic;
      const SO3<T> back = gslam::fromIntrinsicEuler(sequence, intrinsic);
      ASSERT_LE((back.inverse() * r).angle(), 16 * epsilon()) << kNames[i] << " " << intrinsic;
      const SO3<T> too = gslam::fromExtrinsicEuler(sequence, extrinsic);
      ASSERT_LE((too.inverse() * r).angle(), 16 * epsilon()) << kNames[i] << " " << extrinsic;
    }
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Euler, Scalars, );

// The names of the enumerators are the definition; products in that order are the other.
TYPED_TEST(Euler, SequencesAreWhatTheirNamesSay) {
  using T = TypeParam;
  const Vec<T, 3> a = {T(0.3), T(-0.7), T(2)};
  for (int i = 0; i < kSequences; ++i) {
    const auto first = this->about(kNames[i][0], a[0]);
    const auto second = this->about(kNames[i][1], a[1]);
    const auto third = this->about(kNames[i][2], a[2]);
    const auto sequence = static_cast<EulerSequence>(i);
    ASSERT_TRUE(gslam::fromIntrinsicEuler(sequence, a)
                    .isApprox(first * second * third, 8 * this->epsilon()))
        << kNames[i];
    ASSERT_TRUE(gslam::fromExtrinsicEuler(sequence, a)
                    .isApprox(third * second * first, 8 * this->epsilon()))
        << kNames[i];
  }
  EXPECT_EQ(static_cast<int>(EulerSequence::zyz), kSequences - 1);
  EXPECT_EQ(static_cast<int>(EulerSequence::xyx), 6);
}

TYPED_TEST(Euler, AnglesComeBack) {
  using T = TypeParam;
  reference::Random<T> random;
  for (int n = 0; n < 500; ++n) {
    for (int i = 0; i < kSequences; ++i) {
      const auto sequence = static_cast<EulerSequence>(i);
      const T middle = i >= 6 ? random.uniform(T(0.1), T(3.04)) : random.uniform(T(-1.4), T(1.4));
      const Vec<T, 3> a = {random.uniform(T(-3.1), T(3.1)), middle,
                           random.uniform(T(-3.1), T(3.1))};
      const auto r = gslam::fromIntrinsicEuler(sequence, a);
      const auto e = gslam::fromExtrinsicEuler(sequence, a);
      ASSERT_LE((gslam::intrinsicEulerOf(r, sequence) - a).norm(), 100 * this->epsilon());
      ASSERT_LE((gslam::extrinsicEulerOf(e, sequence) - a).norm(), 100 * this->epsilon());
    }
  }
}

TYPED_TEST(Euler, EveryRotationComesBack) {
  reference::Random<TypeParam> random;
  for (int n = 0; n < 2000; ++n) this->roundTrip(random.rotation() * random.rotation());
}

// All multiples of an eighth turn, exactly and with the smallest steps aside: every gimbal lock.
TYPED_TEST(Euler, GimbalLock) {
  using T = TypeParam;
  const T eighth = static_cast<T>(reference::kPi / 4);
  reference::Random<T> random;
  const auto steps = reference::geometricSteps(this->epsilon() / 4, T(0.1), T(5));
  for (int i = 0; i < 8 * 8 * 8; ++i) {
    const int turns[3] = {i % 8, i / 8 % 8, i / 64};
    const SO3<T> r = this->about('x', eighth * static_cast<T>(turns[0])) *
                     this->about('y', eighth * static_cast<T>(turns[1])) *
                     this->about('z', eighth * static_cast<T>(turns[2]));
    this->roundTrip(r);
    for (const T step : steps) this->roundTrip(r * SO3<T>::exp(step * random.direction()));
  }
}

TYPED_TEST(Euler, AtGimbalLockTheThirdAngleIsZero) {
  using T = TypeParam;
  const T quarter = static_cast<T>(reference::kPi / 2);
  const auto up = gslam::fromRollPitchYaw(T(0.3), -quarter, T(0.5));
  const Vec<T, 3> angles = gslam::rollPitchYawOf(up);
  EXPECT_EQ(angles[0], 0);
  EXPECT_NEAR(angles[1], -quarter, this->epsilon());
  EXPECT_NEAR(angles[2], T(0.8), 8 * this->epsilon());
  const auto intrinsic = gslam::intrinsicEulerOf(this->about('z', T(0.7)), EulerSequence::zxz);
  EXPECT_NEAR(intrinsic[0], T(0.7), 4 * this->epsilon());
  EXPECT_EQ(intrinsic[1], 0);
  EXPECT_EQ(intrinsic[2], 0);
}

TYPED_TEST(Euler, SmallAnglesKeepTheirDigits) {
  using T = TypeParam;
  for (int i = 0; i < 6; ++i) {
    const auto sequence = static_cast<EulerSequence>(i);
    for (const T size : {T(1e-3), T(1e-9), T(1e-20), T(1e-30)}) {
      const Vec<T, 3> a = size * Vec<T, 3>{T(0.3), T(-0.5), T(0.7)};
      const Vec<T, 3> back =
          gslam::intrinsicEulerOf(gslam::fromIntrinsicEuler(sequence, a), sequence);
      ASSERT_LE(reference::relativeError(back, a), 8 * this->epsilon()) << kNames[i] << size;
    }
  }
}

// REP 103: x forward, y left, z up. Yaw turns left, pitch lowers the nose, roll lowers the right.
TYPED_TEST(Euler, RollPitchYaw) {
  using T = TypeParam;
  const T a = T(0.1);
  EXPECT_GT((gslam::fromRollPitchYaw(T(0), T(0), a) * Vec<T, 3>{1, 0, 0})[1], 0);
  EXPECT_LT((gslam::fromRollPitchYaw(T(0), a, T(0)) * Vec<T, 3>{1, 0, 0})[2], 0);
  EXPECT_GT((gslam::fromRollPitchYaw(a, T(0), T(0)) * Vec<T, 3>{0, 1, 0})[2], 0);
  const auto r = gslam::fromRollPitchYaw(T(0.1), T(0.2), T(0.3));
  EXPECT_TRUE(r.isApprox(gslam::fromIntrinsicEuler<T>(EulerSequence::zyx, {T(0.3), T(0.2), T(0.1)}),
                         4 * this->epsilon()));
  // From the heading on: yaw first, in the world.
  EXPECT_TRUE(
      r.isApprox(this->about('z', T(0.3)) * this->about('y', T(0.2)) * this->about('x', T(0.1)),
                 8 * this->epsilon()));
}

TYPED_TEST(Euler, AxisAndAngle) {
  using T = TypeParam;
  for (const T angle : reference::angles<T>()) {
    for (const Vec<T, 3>& axis : reference::axes<T>()) {
      const SO3<T> r = gslam::fromAxisAngle(T(3) * axis, angle);
      ASSERT_TRUE(r.isApprox(SO3<T>::exp(angle * axis), 8 * this->epsilon()));
      const gslam::AxisAngle<T> back = gslam::axisAngleOf(r);
      ASSERT_LE(std::fabs(back.angle - angle), 4 * this->epsilon() * angle);
      if (angle < static_cast<T>(reference::kPi) * (1 - 4 * this->epsilon())) {
        ASSERT_LE((back.axis - axis).norm(), 4 * this->epsilon()) << angle;
      }
    }
  }
  EXPECT_EQ(gslam::axisAngleOf(SO3<T>()).axis, (Vec<T, 3>{1, 0, 0}));
  EXPECT_EQ(gslam::axisAngleOf(SO3<T>()).angle, 0);
}

TEST(EulerInput, WhatIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)gslam::fromRollPitchYaw(0.0, nan, 0.0), gslam::ArgumentError);
  EXPECT_THROW((void)gslam::fromAxisAngle(gslam::Vec3d{0, 0, 0}, 1.0), gslam::ArgumentError);
  EXPECT_THROW((void)gslam::fromAxisAngle(gslam::Vec3d{0, 0, 1}, nan), gslam::ArgumentError);
  const auto wrong = static_cast<EulerSequence>(12);
  EXPECT_THROW((void)gslam::extrinsicEulerOf(SO3d(), wrong), gslam::ArgumentError);
  EXPECT_THROW((void)gslam::fromIntrinsicEuler(wrong, gslam::Vec3d{}), gslam::ArgumentError);
}

}  // namespace
