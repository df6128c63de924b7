// Geodesy against an iteration in long double, against published points, and against derivatives.
#include <gslam/core/geodesy.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using gslam::degreesOfRadians;
using gslam::EnuFrame;
using gslam::Geodetic;
using gslam::geodeticOfDegrees;
using gslam::radiansOfDegrees;
using gslam::toEcef;
using gslam::toGeodetic;
using gslam::Vec3d;

using Real = long double;
const Real kA = 6378137;
const Real kF = 1 / Real(298.257223563L);
const Real kE2 = kF * (2 - kF);
const Real kPi = 3.14159265358979323846264338327950288L;

struct Ecef {
  Real x, y, z;
};

Ecef referenceEcef(Real latitude, Real longitude, Real altitude) {
  const Real n = kA / std::sqrt(1 - kE2 * std::sin(latitude) * std::sin(latitude));
  return {(n + altitude) * std::cos(latitude) * std::cos(longitude),
          (n + altitude) * std::cos(latitude) * std::sin(longitude),
          ((1 - kE2) * n + altitude) * std::sin(latitude)};
}

Real distance(const Ecef& a, const Vec3d& b) {
  return std::sqrt((a.x - b[0]) * (a.x - b[0]) + (a.y - b[1]) * (a.y - b[1]) +
                   (a.z - b[2]) * (a.z - b[2]));
}

// The point itself, as far as the answer says: an error of the answer in metres.
Real error(const Vec3d& ecef) {
  const Geodetic g = toGeodetic(ecef);
  return distance(referenceEcef(g.latitude, g.longitude, g.altitude), ecef);
}

// The least distance to the ellipse, by golden section over the quadrant's parametric latitude.
Real leastDistance(Real axis_distance, Real z) {
  const auto at = [&](Real beta) {
    const Real b = kA * std::sqrt(1 - kE2);
    return std::hypot(axis_distance - kA * std::cos(beta), std::fabs(z) - b * std::sin(beta));
  };
  Real low = 0, high = kPi / 2;
  const Real golden = (std::sqrt(Real(5)) - 1) / 2;
  for (int i = 0; i < 120; ++i) {
    const Real left = high - golden * (high - low), right = low + golden * (high - low);
    (at(left) < at(right) ? high : low) = at(left) < at(right) ? right : left;
  }
  return at((low + high) / 2);
}

TEST(Geodesy, TheAxesOfTheEllipsoid) {
  EXPECT_EQ(toEcef(Geodetic{0, 0, 0}), (Vec3d{6378137, 0, 0}));
  const Vec3d pole = toEcef(geodeticOfDegrees(90, 0, 0));
  EXPECT_NEAR(pole[2], 6356752.314245, 5e-7);  // WGS 84's semi-minor axis, NIMA TR8350.2
  EXPECT_NEAR(pole[0], 0, 1e-9);
  const Vec3d east = toEcef(geodeticOfDegrees(0, 90, 100));
  EXPECT_NEAR(east[1], 6378237, 1e-9);
  EXPECT_NEAR(east[0], 0, 1e-9);
}

// GeographicLib's manual of CartConvert prints these.
TEST(Geodesy, PublishedPoints) {
  const Vec3d p = toEcef(geodeticOfDegrees(33.3, 44.4, 6000));
  EXPECT_NEAR(p[0], 3816209.60, 0.005);
  EXPECT_NEAR(p[1], 3737108.55, 0.005);
  EXPECT_NEAR(p[2], 3485109.57, 0.005);
  const EnuFrame frame(geodeticOfDegrees(33, 44, 20));
  const Vec3d enu = frame.fromGeodetic(geodeticOfDegrees(33.3, 44.4, 6000));
  EXPECT_NEAR(enu[0], 37288.97, 0.005);
  EXPECT_NEAR(enu[1], 33374.29, 0.005);
  EXPECT_NEAR(enu[2], 5783.65, 0.005);
  const Geodetic deep = toGeodetic({{30000, 30000, 0}});  // inside the evolute
  EXPECT_NEAR(degreesOfRadians(deep.latitude), 6.483, 0.0005);
  EXPECT_NEAR(degreesOfRadians(deep.longitude), 45, 1e-12);
  EXPECT_NEAR(deep.altitude, -6335709.73, 0.005);
}

TEST(Geodesy, ToEcefIsWithinThreeNanometresNearTheSurface) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> latitude(-1.5707, 1.5707), longitude(-3.1415, 3.1415);
  std::uniform_real_distribution<double> altitude(-11000, 20000);
  Real worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Geodetic g = {latitude(random), longitude(random), altitude(random)};
    worst =
        std::fmax(worst, distance(referenceEcef(g.latitude, g.longitude, g.altitude), toEcef(g)));
  }
  RecordProperty("worst_nm", std::to_string(double(worst * 1e9L)));
  EXPECT_LE(worst, 3e-9L);
}

TEST(Geodesy, ToGeodeticIsWithinThreeNanometresNearTheSurface) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> latitude(-1.5707, 1.5707), longitude(-3.1415, 3.1415);
  std::uniform_real_distribution<double> altitude(-11000, 20000);
  Real worst = 0;
  for (int i = 0; i < 100000; ++i) {
    worst = std::fmax(
        worst, error(toEcef(Geodetic{latitude(random), longitude(random), altitude(random)})));
  }
  RecordProperty("worst_nm", std::to_string(double(worst * 1e9L)));
  EXPECT_LE(worst, 3e-9L);
}

TEST(Geodesy, ToGeodeticFromTheDepthsToOrbitsAndBeyond) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> magnitude(std::log(1e5), std::log(1e12));
  Real worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3d direction = Vec3d{normal(random), normal(random), normal(random)};
    const double radius = std::exp(magnitude(random));
    const Vec3d p = direction * (radius / direction.norm());
    worst = std::fmax(worst, error(p) / std::fmax(radius, 6.4e6));
  }
  RecordProperty("worst", std::to_string(double(worst * 1e16L)) + "e-16");
  EXPECT_LE(worst, 5e-16L);
}

TEST(Geodesy, OfAllPointsTheNearestIsFound) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> deep(0, 60000), anywhere(0, 2e7);
  for (int i = 0; i < 3000; ++i) {
    const double r = i % 2 == 0 ? deep(random) : anywhere(random);
    const double z = i % 2 == 0 ? deep(random) - 30000 : anywhere(random) - 1e7;
    const Geodetic g = toGeodetic({{r, 0, z}});
    ASSERT_NEAR(double(std::fabs(Real(g.altitude)) - leastDistance(r, z)), 0, 1e-8)
        << r << " " << z;
    ASSERT_LE(error({{r, 0, z}}), 1e-7) << r << " " << z;
    ASSERT_TRUE(g.latitude == 0 || std::signbit(g.latitude) == std::signbit(z)) << r << " " << z;
  }
}

TEST(Geodesy, PolesAxisCentreAndDateLine) {
  const double b = 6356752.314245179;
  for (const double z : {b + 1000, b, b - 1000, 1e5, 42841.3, 42000.0, 1.0, 1e-9, 1e9}) {
    for (const double sign : {1.0, -1.0}) {
      const Geodetic g = toGeodetic({{0, 0, sign * z}});
      EXPECT_NEAR(g.latitude, sign * radiansOfDegrees(90), 1e-15) << z;
      EXPECT_EQ(g.longitude, 0);
      EXPECT_NEAR(g.altitude, z - b, 4e-16 * z + 2e-9) << z;
    }
  }
  const Geodetic centre = toGeodetic({{0, 0, 0}});
  EXPECT_NEAR(centre.latitude, radiansOfDegrees(90), 1e-15);
  EXPECT_NEAR(centre.altitude, -b, 1e-8);
  const Geodetic east = toGeodetic({{-6378137, 1e-3, 0}}),
                 west = toGeodetic({{-6378137, -1e-3, 0}});
  EXPECT_NEAR(east.longitude, radiansOfDegrees(180), 1e-9);
  EXPECT_NEAR(west.longitude, -radiansOfDegrees(180), 1e-9);
  EXPECT_NEAR(
      (toEcef(geodeticOfDegrees(10, 180, 5)) - toEcef(geodeticOfDegrees(10, -180, 5))).norm(), 0,
      2e-9);
  // Next to the pole, where a micrometre is many degrees of longitude.
  for (const double off : {1e-6, 1e-3, 1.0}) EXPECT_LE(error({{off, -off, 6356800}}), 3e-9L);
  // In the plane of the equator, out of the disc and in it.
  for (const double r : {1.0, 100.0, 42000.0, 42697.0, 42698.0, 43000.0, 1e6, 6378137.0, 1e8}) {
    EXPECT_LE(error({{r, 0, 0}}), 1e-7L) << r;
    EXPECT_GE(toGeodetic({{r, 0, 0}}).latitude, 0) << r;
  }
}

TEST(Geodesy, AltitudeIsMonotonicAlongANormal) {
  const Vec3d foot = toEcef(geodeticOfDegrees(47.3, 8.5, 0));
  const Vec3d up = EnuFrame(geodeticOfDegrees(47.3, 8.5, 0)).R_ecef_enu().col(2);
  for (const double h : {-6.2e6, -5e6, -1e6, -1e4, -1.0, 0.0, 1.0, 8848.0, 4e5, 2e7, 4e8, 1e12}) {
    const Geodetic g = toGeodetic(foot + up * h);
    ASSERT_NEAR(g.altitude, h, 4e-16 * std::fabs(h) + 1e-8);
    ASSERT_NEAR(degreesOfRadians(g.latitude), 47.3, 1e-6);
  }
}

TEST(Geodesy, WhatIsNoPlaceIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(toEcef(Geodetic{47.3, 0.1, 0}), gslam::ArgumentError);  // degrees
  EXPECT_THROW(toEcef(Geodetic{0.8, 8.5, 0}), gslam::ArgumentError);
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_THROW(toEcef(Geodetic{bad, 0, 0}), gslam::ArgumentError);
    EXPECT_THROW(toEcef(Geodetic{0, bad, 0}), gslam::ArgumentError);
    EXPECT_THROW(toEcef(Geodetic{0, 0, bad}), gslam::ArgumentError);
    EXPECT_THROW(toGeodetic({{bad, 0, 0}}), gslam::ArgumentError);
    EXPECT_THROW(toGeodetic({{0, 0, bad}}), gslam::ArgumentError);
    EXPECT_THROW(EnuFrame(Geodetic{bad, 0, 0}), gslam::ArgumentError);
  }
  EXPECT_THROW(toGeodetic({{1e60, 0, 0}}), gslam::ArgumentError);
  EXPECT_NO_THROW(toGeodetic({{1e50, 1e50, 1e50}}));
  EXPECT_TRUE(std::isfinite(toGeodetic({{1e-300, 0, 1e-300}}).altitude));
}

TEST(EnuFrame, AxesAreTheDerivativesOfThePlace) {
  for (const double latitude : {-89.9, -47.0, 0.0, 33.0, 89.9}) {
    for (const double longitude : {-179.99, -90.0, 0.0, 8.5, 180.0}) {
      const Geodetic g = geodeticOfDegrees(latitude, longitude, 400);
      const EnuFrame frame(g);
      const double step = 1e-6;
      const auto axis = [&](double dlat, double dlon, double dalt) {
        const Vec3d d = toEcef({g.latitude + dlat, g.longitude + dlon, g.altitude + dalt}) -
                        toEcef({g.latitude - dlat, g.longitude - dlon, g.altitude - dalt});
        return d / d.norm();
      };
      EXPECT_LE((axis(0, step, 0) - frame.R_ecef_enu().col(0)).norm(), 1e-6);
      EXPECT_LE((axis(step, 0, 0) - frame.R_ecef_enu().col(1)).norm(), 1e-9);
      EXPECT_LE((axis(0, 0, 10) - frame.R_ecef_enu().col(2)).norm(), 1e-9);
    }
  }
}

TEST(EnuFrame, RoundTripsAndTheRigidTransform) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> latitude(-90, 90), longitude(-180, 180), near(-5000, 5000);
  for (int i = 0; i < 2000; ++i) {
    const Geodetic origin = geodeticOfDegrees(latitude(random), longitude(random), near(random));
    const EnuFrame frame(origin);
    ASSERT_LE(frame.fromGeodetic(origin).norm(), 0);
    const Vec3d enu = {near(random), near(random), near(random)};
    ASSERT_LE((frame.fromEcef(frame.toEcef(enu)) - enu).norm(), 2e-9);
    ASSERT_LE((frame.fromGeodetic(frame.toGeodetic(enu)) - enu).norm(), 8e-9);
    ASSERT_LE((frame.T_ecef_enu() * enu - frame.toEcef(enu)).norm(), 5e-9);
    ASSERT_NEAR(frame.R_ecef_enu().col(0).dot(frame.R_ecef_enu().col(1)), 0, 1e-15);
  }
}

TEST(EnuFrame, UpIsUpAndNorthIsNorth) {
  const EnuFrame frame(geodeticOfDegrees(47, 8, 500));
  const Vec3d above = frame.fromGeodetic(geodeticOfDegrees(47, 8, 510));
  EXPECT_NEAR(above[2], 10, 2e-9);
  EXPECT_NEAR(above[0], 0, 2e-9);
  EXPECT_NEAR(above[1], 0, 2e-9);
  const Vec3d north = frame.fromGeodetic(geodeticOfDegrees(47.001, 8, 500));
  EXPECT_NEAR(north[1], 111.183, 0.02);  // a thousandth of a degree of the meridian
  EXPECT_NEAR(north[0], 0, 2e-9);
  EXPECT_LT(north[2], 0);  // the earth is round
}

TEST(Geodesy, DegreesAreExactWhereTheyCanBe) {
  EXPECT_EQ(radiansOfDegrees(180), 3.14159265358979323846);
  EXPECT_EQ(radiansOfDegrees(-90), -1.57079632679489661923);
  EXPECT_EQ(degreesOfRadians(radiansOfDegrees(90)), 90);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> degrees(-180, 180);
  for (int i = 0; i < 1000; ++i) {
    const double d = degrees(random);
    ASSERT_NEAR(degreesOfRadians(radiansOfDegrees(d)), d, 1e-13);
  }
}

}  // namespace
