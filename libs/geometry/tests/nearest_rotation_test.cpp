// The nearest rotation against what polar decompositions in long double and exhaustive search find.
#include <gslam/geometry/nearest_rotation.h>
#include <gslam/geometry/random.h>

#include <random>

#include "reference.h"

namespace {

using gslam::Mat;
using gslam::Mat3d;
using gslam::nearestRotation;
using gslam::SO3;
using gslam::SO3d;
using gslam::Vec;
using reference::Real;

template <class T>
class Nearest : public testing::Test {
 public:
  static constexpr T epsilon() { return std::numeric_limits<T>::epsilon(); }
  std::mt19937 generator{1};

  Mat<T, 3, 3> noise(T size) {
    Mat<T, 3, 3> m;
    for (T& value : m.values) value = gslam::randomUniform<T>(generator, -size, size);
    return m;
  }
  // U diag(s) V^T, made in long double, so that U V^T is known exactly.
  static Mat<T, 3, 3> composed(const SO3<T>& u, const Vec<Real, 3>& s, const SO3<T>& v) {
    reference::Matrix scaled = reference::convert<Real>(u.normalized().matrix());
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) scaled(r, c) *= s[c];
    }
    return reference::convert<T>(scaled * reference::convert<Real>(v.matrix()).transpose());
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Nearest, Scalars, );

// X <- (X + X^-T) / 2 (Higham 1986), for matrices with a positive determinant.
reference::Matrix polarOf(reference::Matrix x) {
  for (int i = 0; i < 60; ++i) {
    const auto a = x.row(0), b = x.row(1), c = x.row(2);
    const Real det = a.dot(b.cross(c));
    const auto p = b.cross(c), q = c.cross(a), r = a.cross(b);
    const reference::Matrix inverse_transposed = {p[0], p[1], p[2], q[0], q[1],
                                                  q[2], r[0], r[1], r[2]};
    x = Real(0.5) * (x + (1 / det) * inverse_transposed);
  }
  return x;
}

TYPED_TEST(Nearest, NoisyMatrices) {
  using T = TypeParam;
  for (int i = 0; i < 1000; ++i) {
    const SO3<T> r = gslam::randomOf<SO3<T>>(this->generator);
    const Mat<T, 3, 3> m = r.matrix() + this->noise(T(0.3));
    const auto expected = polarOf(reference::convert<Real>(m));
    const auto nearest = nearestRotation(m);
    ASSERT_TRUE(nearest.is_unique);
    const auto actual = nearest.rotation.matrix();
    ASSERT_LE(reference::relativeError(actual, expected), 16 * this->epsilon());
    const Real distance = reference::norm(reference::convert<Real>(m) - expected);
    ASSERT_LE(std::fabs(nearest.distance - distance), 16 * this->epsilon());  // as the matrix
  }
}

TYPED_TEST(Nearest, RotationsAreTheirOwn) {
  using T = TypeParam;
  for (const T angle : reference::angles<T>()) {
    const SO3<T> r = SO3<T>::exp(angle * gslam::randomDirection<T>(this->generator));
    const auto nearest = nearestRotation(r.matrix());
    ASSERT_TRUE(nearest.rotation.isApprox(r, 16 * this->epsilon())) << angle;
    ASSERT_LE(nearest.distance, 16 * this->epsilon());
    ASSERT_TRUE(nearest.is_unique);
  }
}

// Whatever the singular values, and of a reflection, too: U diag(1, 1, d) V^T.
TYPED_TEST(Nearest, KnownSingularValues) {
  using T = TypeParam;
  const Vec<Real, 3> all[] = {
      {3, 2, 1},      {1, 1, 1},        {1, 1e-2L, 1e-3L}, {1, 1, 0},
      {1, 1, 1e-30L}, {1, 0.5L, -0.4L}, {5, 4, -1},        {1e-3L, 1e-3L, -1e-6L}};
  for (const auto& s : all) {
    for (int i = 0; i < 100; ++i) {
      const SO3<T> u = gslam::randomOf<SO3<T>>(this->generator);
      const SO3<T> v = gslam::randomOf<SO3<T>>(this->generator);
      const auto nearest = nearestRotation(this->composed(u, s, v));
      const T allowed = 16 * this->epsilon() * static_cast<T>(s[0] / (s[1] + s[2]));
      ASSERT_TRUE(nearest.rotation.isApprox(u * v.inverse(), allowed)) << s;
      ASSERT_TRUE(nearest.is_unique) << s;
    }
  }
}

TYPED_TEST(Nearest, NotUnique) {
  using T = TypeParam;
  const Vec<Real, 3> all[] = {{1, 0, 0}, {1, 1, -1}, {3, 2, -2}};
  for (const auto& s : all) {
    const SO3<T> u = gslam::randomOf<SO3<T>>(this->generator);
    const auto m = this->composed(u, s, SO3<T>());
    const auto nearest = nearestRotation(m);
    EXPECT_FALSE(nearest.is_unique) << s;
    // All the same none is nearer: u is one of them.
    const Real distance = reference::norm(reference::convert<Real>(m - u.matrix()));
    EXPECT_LE(std::fabs(nearest.distance - distance), 16 * this->epsilon());
  }
  const auto zero = nearestRotation(Mat<T, 3, 3>{});
  EXPECT_FALSE(zero.is_unique);
  EXPECT_EQ(zero.rotation.angle(), 0);
  EXPECT_NEAR(zero.distance, std::sqrt(T(3)), 2 * this->epsilon());
}

TYPED_TEST(Nearest, MatricesOfEverySize) {
  using T = TypeParam;
  const SO3<T> r = SO3<T>::exp({1, 2, T(-0.5)});
  const T scales[] = {std::numeric_limits<T>::min() * 16, T(1e-20), T(1e20),
                      std::numeric_limits<T>::max() / 4};
  for (const T scale : scales) {
    const auto nearest = nearestRotation(scale * r.matrix());
    EXPECT_TRUE(nearest.rotation.isApprox(r, 8 * this->epsilon())) << scale;
    EXPECT_TRUE(nearest.is_unique);
  }
  EXPECT_THROW((void)nearestRotation(Mat<T, 3, 3>{0, std::numeric_limits<T>::infinity()}),
               gslam::ArgumentError);
}

// No rotation of many, and none of those next to it, is nearer.
TEST(NearestRotation, NoOtherIsNearer) {
  std::mt19937 generator(3);
  for (int i = 0; i < 30; ++i) {
    Mat3d m;
    for (double& value : m.values) value = gslam::randomUniform(generator, -1.0, 1.0);
    const auto nearest = nearestRotation(m);
    const auto distance = [&m](const SO3d& r) {
      return reference::norm(reference::convert<Real>(r.matrix() - m));
    };
    for (int j = 0; j < 300; ++j) {
      ASSERT_GE(distance(gslam::randomOf<SO3d>(generator)), nearest.distance - 1e-14L);
      const auto step = 1e-3 * gslam::randomDirection<double>(generator);
      ASSERT_GE(distance(nearest.rotation * SO3d::exp(step)), nearest.distance - 1e-14L);
    }
  }
}

}  // namespace
