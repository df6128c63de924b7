// What batches refuse, and what they hand on, in every variant.
#include <gslam/geometry/batch.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace {

using gslam::ArgumentError;
using gslam::Arrays;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::Vec3d;
using Vec6d = gslam::Vec<double, 6>;
using Vec7d = gslam::Vec<double, 7>;

template <class Function>
std::string messageOf(const Function& function) {
  try {
    function();
  } catch (const ArgumentError& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(BatchInput, DifferentSizesAreRefusedByName) {
  std::vector<Vec3d> points(3), more(4);
  std::vector<SO3d> rotations(3), few(2);
  EXPECT_EQ("in and out have 3 and 4 elements, expected the same number",
            messageOf([&] { transformPoints(SO3d(), points, more); }));
  EXPECT_EQ("transforms and in have 3 and 4 elements, expected the same number",
            messageOf([&] { gslam::transformPoints<SO3d>(rotations, more, more); }));
  EXPECT_EQ("transforms and out have 3 and 4 elements, expected the same number",
            messageOf([&] { gslam::transformPoints<SO3d>(rotations, points, more); }));
  EXPECT_EQ("a and b have 3 and 2 elements, expected the same number",
            messageOf([&] { gslam::composeMany<SO3d>(rotations, few, rotations); }));
  EXPECT_EQ("a and out have 3 and 2 elements, expected the same number",
            messageOf([&] { gslam::composeMany<SO3d>(rotations, rotations, few); }));
  EXPECT_EQ("in and out have 3 and 2 elements, expected the same number",
            messageOf([&] { gslam::inverseMany<SO3d>(rotations, few); }));
  EXPECT_EQ("tangents and out have 4 and 3 elements, expected the same number",
            messageOf([&] { gslam::expMany<SO3d>(more, rotations); }));
  EXPECT_EQ("in and tangents have 3 and 4 elements, expected the same number",
            messageOf([&] { gslam::logMany<SO3d>(rotations, more); }));
}

TEST(BatchInput, AMissingArrayIsRefused) {
  double x[2] = {}, y[2] = {};
  EXPECT_EQ("component 2 is null, expected 3 arrays", messageOf([&] {
              Arrays<double, 3>({x, y}, 2);
            }));
  EXPECT_EQ(0U, (Arrays<double, 3>({nullptr, nullptr, nullptr}, 0).size()));
}

TEST(BatchInput, NothingIsDoneWithNothing) {
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    gslam::transformPoints(SE3d(), gslam::Span<const Vec3d>(), gslam::Span<Vec3d>());
    const Arrays<double, 7> none({}, 0);
    gslam::composeMany<SE3d>(none, none, none);
    gslam::expMany<SE3d>(Arrays<double, 6>({}, 0), none);
  }
}

// In the middle and in the tail, for what every exp refuses.
TEST(BatchInput, ExpNamesTheFirstThatIsNotFinite) {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    for (const double value : bad) {
      const std::size_t places[] = {0, 3, 17, 36};
      for (const std::size_t at : places) {
        std::vector<Vec3d> v(37, Vec3d{0.1, 0.2, 0.3});
        v[at][1] = value;
        v[36][2] = value;
        std::vector<SO3d> r(37);
        const std::string number = std::to_string(at);
        EXPECT_EQ("element " + number +
                      " of tangents is refused: rotation vector has an element that is not finite",
                  messageOf([&] { gslam::expMany<SO3d>(v, r); }));
        for (std::size_t i = 0; i < at; ++i) {
          EXPECT_TRUE(r[i].isApprox(SO3d::exp(v[i]), 1e-15)) << i;
        }
        std::vector<Vec6d> a(37, Vec6d{1, 2, 3, 0.1, 0.2, 0.3});
        a[at][5] = value;
        std::vector<SE3d> t(37);
        EXPECT_EQ(0U, messageOf([&] {
                        gslam::expMany<SE3d>(a, t);
                      }).find("element " + number + " of tangents is refused"));
      }
    }
    std::vector<Vec7d> s(5, Vec7d{0, 0, 0, 0, 0, 0, 0});
    s[2][6] = 1e6;
    std::vector<SIM3d> similarities(5);
    EXPECT_EQ(0U, messageOf([&] {
                    gslam::expMany<SIM3d>(s, similarities);
                  }).find("element 2 of tangents is refused: scale"));
    s[2][6] = 0;
    s[4][4] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(0U, messageOf([&] {
                    gslam::expMany<SIM3d>(s, similarities);
                  }).find("element 4 of tangents is refused"));
  }
}

TEST(BatchInput, WhatIsNotFiniteStaysInItsElement) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    std::vector<Vec3d> points(19, Vec3d{1, 2, 3});
    points[7] = Vec3d{nan, 0, 0};
    points[18] = Vec3d{std::numeric_limits<double>::infinity(), 0, 0};
    gslam::transformPoints(SO3d::exp({0, 0, 1}), points, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(i != 7 && i != 18, std::isfinite(points[i].norm())) << i;
    }
    // A translation may be anything; exp has no word against it.
    std::vector<Vec6d> tangents(9, Vec6d{1, 2, 3, 0.1, 0.2, 0.3});
    tangents[4][0] = nan;
    std::vector<SE3d> poses(9);
    gslam::expMany<SE3d>(tangents, poses);
    EXPECT_TRUE(std::isnan(poses[4].translation()[0]));
    EXPECT_TRUE(poses[4].rotation().isApprox(poses[3].rotation(), 1e-15));
    EXPECT_EQ(poses[3].matrix(), poses[5].matrix());
  }
}

// Angles so large that their squares are not finite are right for SO3::exp, and not for SE3::exp.
TEST(BatchInput, HugeAnglesAreThoseOfTheClasses) {
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    std::vector<Vec3d> v(11, Vec3d{1, 2, 3});
    v[5] = Vec3d{1e200, 0, 0};
    std::vector<SO3d> r(11);
    gslam::expMany<SO3d>(v, r);
    EXPECT_EQ(SO3d::exp(v[5]).quaternion(), r[5].quaternion());
    std::vector<Vec6d> a(11, Vec6d{1, 2, 3, 1, 2, 3});
    a[6][3] = 1e200;
    std::vector<SE3d> t(11);
    EXPECT_EQ(0U, messageOf([&] {
                    gslam::expMany<SE3d>(a, t);
                  }).find("element 6 of tangents is refused"));
  }
}

}  // namespace
