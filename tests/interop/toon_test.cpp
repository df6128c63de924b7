// TooN's groups and ours are the same: elements, products, actions, exp and log.
#include <gslam/geometry/random.h>
#include <gslam/geometry/toon.h>
#include <gtest/gtest.h>

#include <random>

namespace {

using gslam::fromTooN;
using gslam::Mat;
using gslam::randomOf;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::SO3d;
using gslam::toTooN;
using gslam::Vec3d;

TEST(Toon, VectorsAndMatrices) {
  const Mat<double, 2, 3> m = {11, 12, 13, 21, 22, 23};
  const TooN::Matrix<2, 3> t = toTooN(m);
  EXPECT_EQ(t(0, 2), 13);
  EXPECT_EQ(t(1, 0), 21);
  EXPECT_EQ(fromTooN(t), m);
  EXPECT_EQ(fromTooN(toTooN(Vec3d{1, 2, 3})), (Vec3d{1, 2, 3}));
  EXPECT_EQ(toTooN(gslam::Vec2f{1, 2})[1], 2);
}

template <class G>
void expectTheSameGroup(double tolerance) {
  std::mt19937 generator(1);
  for (int i = 0; i < 200; ++i) {
    const G a = randomOf<G>(generator), b = randomOf<G>(generator);
    const Vec3d p = gslam::randomDirection<double>(generator);
    ASSERT_TRUE(fromTooN(toTooN(a)).isApprox(a, tolerance));
    ASSERT_TRUE(fromTooN(toTooN(a) * toTooN(b)).isApprox(a * b, tolerance));
    ASSERT_LE((fromTooN(toTooN(a) * toTooN(p)) - a * p).norm(), tolerance);
    // The tangents have the same order; near half a turn TooN's log has fewer digits.
    ASSERT_TRUE(fromTooN(decltype(toTooN(a))::exp(toTooN(a.log()))).isApprox(a, tolerance));
    const auto log = fromTooN(toTooN(a).ln());
    if (a.log().norm() < 3) {
      ASSERT_LE((log - a.log()).norm(), 1e-9) << a;
    }
  }
}

TEST(Toon, Rotations) {
  expectTheSameGroup<SO3d>(1e-14);
}
TEST(Toon, Poses) {
  expectTheSameGroup<SE3d>(1e-13);
}
TEST(Toon, Similarities) {
  expectTheSameGroup<SIM3d>(1e-12);
}

}  // namespace
