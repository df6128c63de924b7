// Distances against their definitions.
#include <gslam/geometry/distance.h>

#include "any_group.h"

namespace {

using gslam::SO2d;
using gslam::SO3d;

TEST(Distance, Angles) {
  std::mt19937 generator(1);
  for (const double angle : reference::angles<double>()) {
    const SO3d a = gslam::randomOf<SO3d>(generator);
    const SO3d b = a * SO3d::exp(angle * gslam::randomDirection<double>(generator));
    ASSERT_NEAR(gslam::angleBetween(a, b), angle, 4e-15);
    ASSERT_NEAR(gslam::angleBetween(b, a), angle, 4e-15);
    ASSERT_NEAR(gslam::geodesicDistance(a, b), angle, 4e-15);
    const SO2d c = gslam::randomOf<SO2d>(generator), d = c * SO2d::fromAngle(-angle);
    ASSERT_NEAR(gslam::angleBetween(c, d), angle, 4e-15);
    ASSERT_NEAR(gslam::geodesicDistance(c, d), angle, 4e-15);
  }
}

TEST(Distance, ChordsAreNormsOfMatrices) {
  std::mt19937 generator(1);
  for (int i = 0; i < 500; ++i) {
    const SO3d a = gslam::randomOf<SO3d>(generator), b = gslam::randomOf<SO3d>(generator);
    const auto difference = reference::convert<reference::Real>(a.matrix() - b.matrix());
    ASSERT_NEAR(gslam::chordalDistance(a, b), static_cast<double>(reference::frobenius(difference)),
                4e-15);
    const SO2d c = gslam::randomOf<SO2d>(generator), d = gslam::randomOf<SO2d>(generator);
    const auto planar = reference::convert<reference::Real>(c.matrix() - d.matrix());
    ASSERT_NEAR(gslam::chordalDistance(c, d), static_cast<double>(reference::frobenius(planar)),
                4e-15);
  }
}

template <class G>
class GeodesicDistance : public reference::AnyGroup<G> {};
TYPED_TEST_SUITE(GeodesicDistance, reference::AllGroups, );

TYPED_TEST(GeodesicDistance, LengthOfTheTangent) {
  using G = TypeParam;
  for (int i = 0; i < 200; ++i) {
    const G a = this->element(), g = this->element();
    const auto way = this->tangent(3);
    const G b = a * G::exp(way);
    ASSERT_NEAR(gslam::geodesicDistance(a, b), way.norm(), 64 * this->epsilon());
    ASSERT_NEAR(gslam::geodesicDistance(g * a, g * b), way.norm(), 128 * this->epsilon());
  }
}

}  // namespace
