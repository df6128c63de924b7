// Random elements of whatever group a test is about, and all groups as a list of types.
#ifndef GSLAM_GEOMETRY_TESTS_ANY_GROUP_H
#define GSLAM_GEOMETRY_TESTS_ANY_GROUP_H

#include <gslam/geometry/random.h>

#include <random>

#include "planar_reference.h"

namespace reference {

template <class G>
class AnyGroup : public testing::Test {
 public:
  using Scalar = typename G::Scalar;
  using Tangent = typename G::Tangent;
  static constexpr Scalar epsilon() { return std::numeric_limits<Scalar>::epsilon(); }

  // Of length 0 to `size`.
  Tangent tangent(Scalar size) {
    const Tangent v = gslam::randomNormal<Scalar, G::kFreedom>(generator);
    return (gslam::randomUniform<Scalar>(generator, 0, size) / v.norm()) * v;
  }
  G element() { return gslam::randomOf<G>(generator); }
  static Scalar distance(const G& a, const G& b) { return (a.inverse() * b).log().norm(); }

  std::mt19937 generator{1};
};

using AllGroups = testing::Types<gslam::SO2d, gslam::SO3d, gslam::SO3f, gslam::SE2d, gslam::SE3d,
                                 gslam::SE3f, gslam::SIM3d>;

}  // namespace reference

#endif  // GSLAM_GEOMETRY_TESTS_ANY_GROUP_H
