// What holds in every group, tested once for all: axioms, the meaning of Ad and of the Jacobians,
// conversions, printing, layout.
#include <sstream>
#include <type_traits>

#include "group_reference.h"

namespace {

using gslam::SE3;
using gslam::SIM3;
using gslam::Vec;
using reference::convert;
using reference::GroupFacts;
using reference::Real;

template <class G>
class Group : public testing::Test {
 public:
  using Scalar = typename G::Scalar;
  static Scalar epsilon() { return std::numeric_limits<Scalar>::epsilon(); }

  typename G::Tangent tangent(Scalar angle = 3) {
    const auto r = convert<Real>(random.uniform(Scalar(0.1), Scalar(2)) * random.direction());
    const auto v = convert<Real>(random.uniform(Scalar(0), angle) * random.direction());
    return convert<Scalar>(
        GroupFacts<G>::tangent(r, v, static_cast<Real>(random.uniform(Scalar(-1), Scalar(1)))));
  }
  G element() { return G::exp(tangent()); }
  Vec<Scalar, 3> point() { return random.uniform(Scalar(0.1), Scalar(3)) * random.direction(); }

  reference::Random<Scalar> random;
};
TYPED_TEST_SUITE(Group, reference::SpaceGroups, );

constexpr int kRounds = 500;

// (p, 1) for a matrix that is homogeneous, p for one that is not.
template <std::size_t N, class T>
Vec<Real, N> homogeneous(const Vec<T, 3>& p) {
  Vec<Real, N> h;
  for (std::size_t i = 0; i < N; ++i) h[i] = i < 3 ? static_cast<Real>(p[i < 3 ? i : 0]) : 1;
  return h;
}

TYPED_TEST(Group, LayoutIsPlain) {
  using G = TypeParam;
  EXPECT_TRUE(std::is_trivially_copyable<G>::value);
  EXPECT_TRUE(std::is_standard_layout<G>::value);
  EXPECT_EQ(alignof(G), alignof(typename G::Scalar));
  const std::size_t numbers =
      4 + (GroupFacts<G>::has_translation ? 3 : 0) + GroupFacts<G>::has_scale;
  EXPECT_EQ(sizeof(G), numbers * sizeof(typename G::Scalar));
}

TYPED_TEST(Group, MatricesMultiplyAsElementsDo) {
  using G = TypeParam;
  constexpr std::size_t n = GroupFacts<G>::size;
  for (int i = 0; i < kRounds; ++i) {
    const G a = this->element(), b = this->element();
    const auto ma = convert<Real>(a.matrix()), mb = convert<Real>(b.matrix());
    ASSERT_LE(reference::errorOf((a * b).matrix(), ma * mb), 40 * this->epsilon());
    const auto one = convert<Real>(a.inverse().matrix()) * ma;
    ASSERT_LE(reference::frobenius(one - reference::Square<n>::identity()), 200 * this->epsilon());
    const auto p = this->point();
    const Vec<Real, 3> moved = (ma * homogeneous<n>(p)).template segment<3>(0);
    ASSERT_LE((convert<Real>(a * p) - moved).norm(), 40 * this->epsilon() * (1 + moved.norm()));
    G accumulated = a;
    accumulated *= b;
    ASSERT_EQ(accumulated.matrix(), (a * b).matrix());
  }
}

TYPED_TEST(Group, IdentityAndInverse) {
  using G = TypeParam;
  EXPECT_EQ(G().matrix(), G::Matrix::identity());
  EXPECT_EQ(G::identity().log(), typename G::Tangent{});
  EXPECT_EQ(G::exp(typename G::Tangent{}).matrix(), G::Matrix::identity());
  for (int i = 0; i < kRounds; ++i) {
    const G a = this->element();
    ASSERT_TRUE((a * a.inverse()).isApprox(G(), 60 * this->epsilon()));
    ASSERT_TRUE(a.inverse().inverse().isApprox(a, 60 * this->epsilon()));
    ASSERT_TRUE((G() * a).isApprox(a, 4 * this->epsilon()));
    ASSERT_FALSE((a * G::exp(this->tangent())).isApprox(a, 1e-3F));
  }
}

TYPED_TEST(Group, HatAndVee) {
  using G = TypeParam;
  for (int i = 0; i < kRounds; ++i) {
    const auto a = this->tangent();
    ASSERT_EQ(reference::frobenius(convert<Real>(G::hat(a)) - GroupFacts<G>::hat(convert<Real>(a))),
              0);
    ASSERT_LE((G::vee(G::hat(a)) - a).norm(), this->epsilon());
  }
}

// A exp(d) A^-1 = exp(Ad d).
TYPED_TEST(Group, AdjointMovesPerturbationsToTheLeft) {
  using G = TypeParam;
  for (int i = 0; i < kRounds; ++i) {
    const G a = this->element();
    const auto d = this->tangent(1) * typename G::Scalar(0.1);
    ASSERT_TRUE((a * G::exp(d)).isApprox(G::exp(a.adjoint() * d) * a, 300 * this->epsilon()));
    ASSERT_LE((G::ad(d) * d).norm(), 4 * this->epsilon());
  }
}

// Jacobians against differences of the third order; what is left is rounding and the step squared.
TYPED_TEST(Group, JacobiansAreTheDerivatives) {
  using G = TypeParam;
  using T = typename G::Scalar;
  using Tangent = typename G::Tangent;
  const T step = std::cbrt(this->epsilon());
  for (int round = 0; round < 100; ++round) {
    const Tangent a = this->tangent(2.5F);
    const auto p = this->point();
    const G e = G::exp(a);
    const auto left = G::leftJacobian(a), right = G::rightJacobian(a);
    const auto acting = e.actionJacobian(p);
    for (std::size_t j = 0; j < G::kFreedom; ++j) {
      Tangent d{};
      d[j] = step;
      const G plus = G::exp(a + d), minus = G::exp(a - d);
      const Tangent to_left =
          ((plus * e.inverse()).log() - (minus * e.inverse()).log()) / (2 * step);
      const Tangent to_right =
          ((e.inverse() * plus).log() - (e.inverse() * minus).log()) / (2 * step);
      const auto moved = (e * G::exp(d) * p - e * G::exp(-d) * p) / (2 * step);
      ASSERT_LE((left.col(j) - to_left).norm(), 300 * step * step) << a;
      ASSERT_LE((right.col(j) - to_right).norm(), 300 * step * step) << a;
      ASSERT_LE((acting.col(j) - moved).norm(), 300 * step * step) << a;
    }
  }
}

TYPED_TEST(Group, MatricesGiveBackTheirElement) {
  using G = TypeParam;
  for (int i = 0; i < kRounds; ++i) {
    const G a = this->element();
    ASSERT_TRUE(G::fromMatrix(a.matrix()).isApprox(a, 20 * this->epsilon()));
  }
}

TYPED_TEST(Group, CastKeepsWhatFits) {
  using G = TypeParam;
  for (int i = 0; i < kRounds; ++i) {
    const G a = this->element();
    const G through_double = a.template cast<double>().template cast<typename G::Scalar>();
    ASSERT_TRUE(through_double.isApprox(a, 4 * this->epsilon()));
    ASSERT_TRUE(a.template cast<float>().template cast<typename G::Scalar>().isApprox(
        a, 20 * std::numeric_limits<float>::epsilon()));
  }
}

TYPED_TEST(Group, NormalizedMendsTheQuaternionAlone) {
  using G = TypeParam;
  using T = typename G::Scalar;
  G product;
  for (int i = 0; i < 3000; ++i) product *= G::exp(this->tangent() * T(0.001));
  const G mended = product.normalized();
  const T* const q = mended.data();
  EXPECT_NEAR((Vec<T, 4>{q[0], q[1], q[2], q[3]}.norm()), T(1), 2 * this->epsilon());
  EXPECT_TRUE(mended.isApprox(product, 4 * this->epsilon()));
}

// Translation, quaternion, scale, as in a TUM trajectory; in memory the quaternion stands first.
TYPED_TEST(Group, PrintsItsNumbersInOrder) {
  using G = TypeParam;
  const G a = this->element();
  std::vector<std::size_t> order = {0, 1, 2, 3};
  if (GroupFacts<G>::has_translation) order = {4, 5, 6, 0, 1, 2, 3};
  if (GroupFacts<G>::has_scale) order.push_back(7);
  std::ostringstream printed, expected;
  printed << a;
  for (const std::size_t i : order) expected << (i == order[0] ? "" : " ") << a.data()[i];
  EXPECT_EQ(printed.str(), expected.str());
}

// A plane through three points becomes the plane through the moved points.
template <class G>
class PlaneMover : public Group<G> {};
using PlaneMovers = testing::Types<SE3<float>, SE3<double>, SIM3<float>, SIM3<double>>;
TYPED_TEST_SUITE(PlaneMover, PlaneMovers, );

TYPED_TEST(PlaneMover, PlanesGoWithTheirPoints) {
  using T = typename TypeParam::Scalar;
  for (int i = 0; i < kRounds; ++i) {
    const Vec<T, 3> p = this->point(), u = this->point(), v = this->point();
    const Vec<T, 3> n = u.cross(v).normalized();
    const TypeParam a = this->element();
    const Vec<T, 4> plane = a.transformPlane({n[0], n[1], n[2], -n.dot(p)});
    const Vec<T, 3> normal = plane.template segment<3>(0);
    ASSERT_NEAR(normal.norm(), T(1), 8 * this->epsilon());
    for (const Vec<T, 3>& q : {p, p + u, p - v}) {
      ASSERT_NEAR(normal.dot(a * q) + plane[3], T(0), 100 * this->epsilon());
    }
  }
}

TEST(Sim3, VectorsAreDifferencesOfPoints) {
  const gslam::SIM3d a(gslam::SO3d::exp({1, -2, 0.5}), {3, 4, 5}, 2.5);
  const gslam::Vec3d p = {1, 2, 3}, q = {-3, 0.5, 2};
  EXPECT_LE((a.transformVector(p - q) - (a * p - a * q)).norm(), 1e-14);
  EXPECT_EQ(a.rigid().translation(), a.translation());
}

}  // namespace
