// exp, log and Jacobians of SO2 and SE2 against matrix functions in long double, at every angle.
#include "planar_reference.h"

namespace {

using reference::convert;
using reference::GroupFacts;
using reference::Real;

template <class G>
class PlanarExpLog : public testing::Test {
 public:
  static constexpr Real epsilon() { return std::numeric_limits<typename G::Scalar>::epsilon(); }
  static constexpr Real bound() { return 18 * epsilon(); }
  static constexpr Real jacobianBound() { return 450 * epsilon(); }

  void note(const char* what, Real error, const typename G::Tangent& a, Real allowed) {
    ASSERT_LE(error, allowed) << what << " at " << a;
    if (error > worst_) worst_ = error;
  }
  void TearDown() override {
    this->RecordProperty("worst_in_epsilons", std::to_string(worst_ / epsilon()));
  }

 private:
  Real worst_ = 0;
};
TYPED_TEST_SUITE(PlanarExpLog, reference::PlanarGroups, );

TYPED_TEST(PlanarExpLog, ExpIsTheMatrixExponential) {
  using G = TypeParam;
  using T = typename G::Scalar;
  using Facts = GroupFacts<G>;
  for (const auto& a : reference::planarScan<G>(reference::anglesAndBeyond<T>())) {
    const auto e = reference::expMinusIdentityOf(Facts::hat(convert<Real>(a)));
    const auto expected = reference::Square<Facts::size>::identity() + e;
    this->note("exp", reference::errorOf(G::exp(a).matrix(), expected), a, this->bound());
  }
}

// Also around whole turns, where it is nearly 0, and the reference itself has fewer digits.
TYPED_TEST(PlanarExpLog, TranslationOfExpKeepsItsDigits) {
  using G = TypeParam;
  using T = typename G::Scalar;
  using Facts = GroupFacts<G>;
  if (!Facts::has_translation) return;
  for (const auto& a : reference::planarScan<G>(reference::anglesAndBeyond<T>())) {
    const auto e = reference::expMinusIdentityOf(Facts::hat(convert<Real>(a)));
    const gslam::Vec<Real, 2> expected = e.col(Facts::size - 1).template segment<2>(0);
    const auto actual = G::exp(a).matrix().col(Facts::size - 1).template segment<2>(0);
    const Real rounding = 32 * std::numeric_limits<Real>::epsilon() / expected.norm();
    this->note("exp", reference::relativeError(actual, expected), a, this->bound() + rounding);
  }
}

// The smallest angles keep their digits.
TYPED_TEST(PlanarExpLog, SineOfExpKeepsItsDigits) {
  using G = TypeParam;
  using T = typename G::Scalar;
  for (const auto& a : reference::planarScan<G>(reference::angles<T>())) {
    const Real angle = convert<Real>(a)[G::kFreedom - 1];
    if (angle == 0 || std::fabs(angle) > 3) continue;
    const Real actual = G::exp(a).matrix()(1, 0);
    this->note("sine", std::fabs(actual / std::sin(angle) - 1), a, this->bound());
  }
}

TYPED_TEST(PlanarExpLog, LogUndoesExp) {
  using G = TypeParam;
  using T = typename G::Scalar;
  using Facts = GroupFacts<G>;
  constexpr std::size_t last = G::kFreedom - 1;
  for (const auto& a : reference::planarScan<G>(reference::angles<T>())) {
    const auto expected = convert<Real>(a);
    const auto log = G::exp(a).log();
    Real error = reference::relativeError(log, expected);
    if (error > this->bound()) {  // half a turn has two logarithms
      const auto back = reference::expMinusIdentityOf(Facts::hat(convert<Real>(log)));
      const auto there = reference::expMinusIdentityOf(Facts::hat(expected));
      ASSERT_GT(std::fabs(expected[last]), reference::kPi * (1 - 8 * this->epsilon())) << a;
      error = reference::errorOf(back, there);
    }
    this->note("log", error, a, this->bound());
    ASSERT_LE(std::fabs(log[last]), static_cast<T>(reference::kPi));
    // The angle on its own, however small beside the translation.
    const Real angle_error = std::fabs(static_cast<Real>(log[last]) - expected[last]);
    if (std::fabs(expected[last]) < 3) {
      ASSERT_LE(angle_error, this->bound() * std::fabs(expected[last])) << a;
    }
  }
}

TYPED_TEST(PlanarExpLog, LeftJacobianIsTheIntegralOfAd) {
  using G = TypeParam;
  using T = typename G::Scalar;
  for (const auto& a : reference::planarScan<G>(reference::anglesAndBeyond<T>())) {
    const auto expected = reference::integralOfExp(reference::planarAdOf<G>(convert<Real>(a)));
    this->note("left", reference::errorOf(G::leftJacobian(a), expected), a, this->jacobianBound());
    this->note("right", reference::errorOf(G::rightJacobian(-a), expected), a,
               this->jacobianBound());
  }
}

TYPED_TEST(PlanarExpLog, InverseJacobiansInvert) {
  using G = TypeParam;
  using T = typename G::Scalar;
  constexpr std::size_t n = G::kFreedom;
  for (const auto& a : reference::planarScan<G>(reference::angles<T>())) {
    const auto j = reference::integralOfExp(reference::planarAdOf<G>(convert<Real>(a)));
    const auto x = convert<Real>(G::leftJacobianInverse(a));
    const auto rest = j * x - reference::Square<n>::identity();
    const Real scale = reference::frobenius(j) * reference::frobenius(x);
    this->note("inverse", reference::frobenius(rest) / scale, a, this->jacobianBound());
    const auto right = convert<Real>(G::rightJacobianInverse(-a)) - x;
    ASSERT_EQ(reference::frobenius(right), 0);
  }
}

TYPED_TEST(PlanarExpLog, AdjointIsTheExponentialOfAd) {
  using G = TypeParam;
  using T = typename G::Scalar;
  constexpr std::size_t n = G::kFreedom;
  for (const auto& a : reference::planarScan<G>(reference::angles<T>())) {
    const auto ad = reference::planarAdOf<G>(convert<Real>(a));
    ASSERT_EQ(reference::frobenius(convert<Real>(G::ad(a)) - ad), 0) << a;
    const auto expected = reference::Square<n>::identity() + reference::expMinusIdentityOf(ad);
    this->note("Ad", reference::errorOf(G::exp(a).adjoint(), expected), a, this->bound());
  }
}

}  // namespace
