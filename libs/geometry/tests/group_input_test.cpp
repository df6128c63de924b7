// What comes from outside into SE3 and SIM3: what is taken, and what is refused with which words.
#include <gmock/gmock.h>

#include <string>

#include "not_finite.h"
#include "reference.h"
#include "refusal.h"

namespace {

using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using testing::HasSubstr;

SE3d someTransform() {
  return SE3d(SO3d::exp({0.3, -1, 2}), {1, 2, 3});
}

TEST(GroupInput, Se3Matrices) {
  auto m = someTransform().matrix();
  EXPECT_TRUE(SE3d::fromMatrix(m.block<3, 4>(0, 0)).isApprox(someTransform(), 1e-15));
  m(3, 1) = 1e-3;
  EXPECT_THAT(refusal([&] { SE3d::fromMatrix(m); }),
              HasSubstr("has the last row (0 0.001 0 1), expected 0 0 0 1"));
  m = someTransform().matrix();
  m(1, 3) = kNan;
  EXPECT_THAT(refusal([&] { SE3d::fromMatrix(m); }), HasSubstr("nan in row 1, column 3"));
  m = someTransform().matrix();
  m(0, 0) += 0.1;
  EXPECT_THAT(refusal([&] { SE3d::fromMatrix(m); }), HasSubstr("is not orthonormal"));
  EXPECT_EQ(refusal([&] { SE3d::fromMatrix(m, 0.3); }), "taken");
  EXPECT_THAT(refusal([&] { SE3d::fromMatrix(gslam::Mat4d{}); }), HasSubstr("last row"));
}

TEST(GroupInput, Sim3Matrices) {
  const SIM3d s(someTransform(), 1e-3);
  EXPECT_TRUE(SIM3d::fromMatrix(s.matrix()).isApprox(s, 1e-14));
  auto m = s.matrix();
  for (std::size_t i = 0; i < 3; ++i) m(i, 0) *= -1;
  EXPECT_THAT(refusal([&] { SIM3d::fromMatrix(m); }), HasSubstr("has the determinant -1e-09"));
  for (std::size_t i = 0; i < 3; ++i) m(i, 0) *= -1.1;
  EXPECT_THAT(refusal([&] { SIM3d::fromMatrix(m); }), HasSubstr("is not orthonormal"));
  EXPECT_THAT(refusal([&] { SIM3d::fromMatrix(gslam::Mat4d{}); }), HasSubstr("determinant 0"));
}

TEST(GroupInput, ScalesAreFiniteAndPositive) {
  for (const double scale : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_THAT(refusal([&] {
                  SIM3d(SO3d(), {0, 0, 0}, scale);
                }),
                HasSubstr("expected a finite one above 0"));
    EXPECT_THAT(refusal([&] { SIM3d(SE3d(), scale); }), HasSubstr("scale is"));
  }
  EXPECT_THAT(refusal([&] { SIM3d(SE3d(), 1e300).cast<float>(); }), HasSubstr("scale is inf"));
}

TEST(GroupInput, TangentsThatAreNoAngles) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e200}) {
    EXPECT_THAT(refusal([&] { SE3d::exp({0, 0, 0, 0, bad, 0}); }), HasSubstr("rotation vector"));
    EXPECT_THAT(refusal([&] {
                  SIM3d::exp({0, 0, 0, 0, 0, bad, 0});
                }),
                HasSubstr("rotation vector"));
  }
}

TEST(GroupInput, LogarithmsOfScales) {
  for (const double s : {700.0, -700.0, 1e-9, -1e-9}) {
    const SIM3d e = SIM3d::exp({1, 2, 3, 0.1, 0.2, 0.3, s});
    EXPECT_LE(std::fabs(e.log()[6] - s), 1e-13 * std::fabs(s) + 1e-16);
    EXPECT_LE((e.log().segment<3>(0) - gslam::Vec3d{1, 2, 3}).norm(), 1e-13) << s;
  }
  EXPECT_THAT(refusal([] { SIM3d::exp({0, 0, 0, 0, 0, 0, 800}); }), HasSubstr("scale is inf"));
  EXPECT_THAT(refusal([] { SIM3d::exp({0, 0, 0, 0, 0, 0, -800}); }), HasSubstr("scale is 0"));
  EXPECT_THAT(refusal([] { SIM3d::exp({0, 0, 0, 0, 0, 0, kNan}); }), HasSubstr("scale is nan"));
}

// What peers got wrong at these very places: NaN at 0, 2e9 at an angle of 1e-10, 1e-6 near half a
// turn.
TEST(GroupInput, PlacesWhereOthersFail) {
  EXPECT_EQ(SE3d::exp({1, 2, 3, 0, 0, 0}).translation(), (gslam::Vec3d{1, 2, 3}));
  EXPECT_EQ(SIM3d::exp({1, 2, 3, 0, 0, 0, 0}).translation(), (gslam::Vec3d{1, 2, 3}));
  const SIM3d tiny = SIM3d::exp({1, 2, 3, 1e-10, 0, 0, 1e-12});
  EXPECT_LE((tiny.translation() - gslam::Vec3d{1, 2, 3}).norm(), 1e-9);
  const double pi = static_cast<double>(reference::kPi);
  for (const double gap : {1e-3, 1e-6, 1e-8, 1e-12, 1e-15}) {
    const gslam::Vec<double, 6> a = {1, 2, 3, 0, pi - gap, 0};
    EXPECT_LE((SE3d::exp(a).log() - a).norm(), 4e-15 * a.norm()) << gap;
  }
}

}  // namespace
