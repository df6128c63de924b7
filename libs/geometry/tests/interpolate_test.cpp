// What lies between two elements of a group.
#include <gslam/geometry/interpolate.h>

#include "any_group.h"

namespace {

using gslam::interpolate;
using gslam::interpolateSplit;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;

template <class G>
class Interpolate : public reference::AnyGroup<G> {};
TYPED_TEST_SUITE(Interpolate, reference::AllGroups, );

TYPED_TEST(Interpolate, MeetsBothEnds) {
  using G = TypeParam;
  for (int i = 0; i < 200; ++i) {
    const G a = this->element(), b = this->element();
    const auto at_0 = interpolate(a, b, 0).matrix();
    const auto at_1 = interpolate(a, b, 1).matrix();
    ASSERT_EQ(at_0, a.matrix());
    ASSERT_EQ(at_1, b.matrix());
  }
}

TYPED_TEST(Interpolate, ConstantVelocity) {
  using G = TypeParam;
  for (int i = 0; i < 200; ++i) {
    const G a = this->element();
    const auto way = this->tangent(3);
    const G b = a * G::exp(way);
    for (const float t : {-0.5f, 0.125f, 0.375f, 0.5f, 0.625f, 0.875f, 1.5f}) {
      ASSERT_LE(this->distance(interpolate(a, b, t), a * G::exp(way * t)), 64 * this->epsilon());
    }
  }
}

TYPED_TEST(Interpolate, NoFrameIsSpecial) {
  using G = TypeParam;
  for (int i = 0; i < 200; ++i) {
    const G a = this->element(), b = a * G::exp(this->tangent(3)), g = this->element();
    const auto t = gslam::randomUniform<typename G::Scalar>(this->generator, 0, 1);
    const G between = interpolate(a, b, t);
    const auto allowed = 128 * this->epsilon();
    ASSERT_LE(this->distance(interpolate(g * a, g * b, t), g * between), allowed);
    ASSERT_LE(this->distance(interpolate(a * g, b * g, t), between * g), 4 * allowed);
    ASSERT_LE(this->distance(interpolate(b, a, 1 - t), between), allowed);
  }
}

TEST(InterpolateRotations, TheShortWayRound) {
  std::mt19937 generator(1);
  for (int i = 0; i < 500; ++i) {
    const SO3d a = gslam::randomOf<SO3d>(generator), b = gslam::randomOf<SO3d>(generator);
    const SO3d other = SO3d::fromQuaternion(-b.x(), -b.y(), -b.z(), -b.w());  // the same rotation
    const double whole = (a.inverse() * b).angle();
    for (const double t : {0.1, 0.5, 0.9}) {
      ASSERT_NEAR((a.inverse() * interpolate(a, b, t)).angle(), t * whole, 1e-14);
      ASSERT_NEAR((a.inverse() * interpolate(a, other, t)).angle(), t * whole, 1e-14);
    }
  }
}

TEST(InterpolateRotations, HalfATurn) {
  const double quarter = std::acos(-1.0) / 2;
  const SO3d half = SO3d::fromQuaternion(0, 0, 1, 0);
  EXPECT_NEAR(interpolate(SO3d(), half, 0.5).angle(), quarter, 1e-15);
  EXPECT_NEAR((half.inverse() * interpolate(SO3d(), half, 0.5)).angle(), quarter, 1e-15);
}

// Along a circle and along its chord: the way of a vehicle that turns left by a quarter.
TEST(InterpolatePoses, ArcAndChord) {
  const double quarter = std::acos(-1.0) / 2, root = std::sqrt(0.5);
  const SE3d a, b(SO3d::exp({0, 0, quarter}), {1, 1, 0});
  const SE3d arc = interpolate(a, b, 0.5), chord = interpolateSplit(a, b, 0.5);
  EXPECT_LE((arc.translation() - gslam::Vec3d{root, 1 - root, 0}).norm(), 1e-15);
  EXPECT_LE((chord.translation() - gslam::Vec3d{0.5, 0.5, 0}).norm(), 1e-15);
  EXPECT_TRUE(arc.rotation().isApprox(SO3d::exp({0, 0, quarter / 2}), 1e-15));
  EXPECT_TRUE(chord.rotation().isApprox(SO3d::exp({0, 0, quarter / 2}), 1e-15));
  const SE2d p, q(gslam::SO2d::fromAngle(quarter), {1, 1});
  EXPECT_TRUE(interpolateSplit(p, q, 0.5).isApprox(
      SE2d(gslam::SO2d::fromAngle(quarter / 2), {0.5, 0.5}), 1e-15));
}

TEST(InterpolatePoses, SplitMeetsBothEnds) {
  std::mt19937 generator(1);
  for (int i = 0; i < 200; ++i) {
    const SIM3d a = gslam::randomOf<SIM3d>(generator), b = gslam::randomOf<SIM3d>(generator);
    ASSERT_EQ(interpolateSplit(a, b, 0).matrix(), a.matrix());
    ASSERT_EQ(interpolateSplit(a, b, 1).matrix(), b.matrix());
  }
  const SIM3d one, nine(SE3d(), 9.0);
  EXPECT_NEAR(interpolateSplit(one, nine, 0.5).scale(), 3, 1e-14);
  EXPECT_NEAR(interpolateSplit(one, nine, 1.5).scale(), 27, 1e-13);
}

TEST(InterpolatePoses, TimeMustBeFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)interpolate(SE3d(), SE3d(), nan), gslam::ArgumentError);
  EXPECT_THROW((void)interpolateSplit(SE3d(), SE3d(), nan), gslam::ArgumentError);
}

}  // namespace
