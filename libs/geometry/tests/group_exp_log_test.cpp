// exp, log and Jacobians of all groups against matrix functions in long double, at every angle and
// scale.
#include "group_reference.h"

namespace {

using reference::convert;
using reference::GroupFacts;
using reference::Real;

template <class G>
class GroupExpLog : public testing::Test {
 public:
  static constexpr Real epsilon() { return std::numeric_limits<typename G::Scalar>::epsilon(); }
  // What the classes state, in epsilons: 4e-15 for rotations and rigid transforms, 1e-13 for
  // similarities and for all Jacobians.
  static constexpr Real bound() { return (GroupFacts<G>::has_scale ? 450 : 18) * epsilon(); }
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
TYPED_TEST_SUITE(GroupExpLog, reference::SpaceGroups, );

TYPED_TEST(GroupExpLog, ExpIsTheMatrixExponential) {
  using G = TypeParam;
  using T = typename G::Scalar;
  using Facts = GroupFacts<G>;
  for (const auto& a : reference::scan<G>(reference::anglesAndBeyond<T>(), 6)) {
    const auto e = reference::expMinusIdentityOf(Facts::hat(convert<Real>(a)));
    const auto expected = reference::Square<Facts::size>::identity() + e;
    this->note("exp", reference::errorOf(G::exp(a).matrix(), expected), a, this->bound());
  }
}

// The translation on its own, which for large scales is the smaller part.
TYPED_TEST(GroupExpLog, TranslationOfExpKeepsItsDigits) {
  using G = TypeParam;
  using T = typename G::Scalar;
  using Facts = GroupFacts<G>;
  if (!Facts::has_translation) return;
  for (const auto& a : reference::scan<G>(reference::angles<T>(), 4)) {
    const auto e = reference::expMinusIdentityOf(Facts::hat(convert<Real>(a)));
    const gslam::Vec<Real, 3> expected = e.col(Facts::size - 1).template segment<3>(0);
    const auto actual = G::exp(a).matrix().col(Facts::size - 1).template segment<3>(0);
    this->note("exp", reference::relativeError(actual, expected), a, this->bound());
  }
}

TYPED_TEST(GroupExpLog, LogUndoesExp) {
  using G = TypeParam;
  using T = typename G::Scalar;
  using Facts = GroupFacts<G>;
  constexpr std::size_t n = G::kFreedom;
  for (const auto& a : reference::scan<G>(reference::angles<T>(), 6)) {
    const auto expected = convert<Real>(a);
    const auto log = G::exp(a).log();
    Real error = reference::relativeError(log, expected);
    if (error >
        this->bound()) {  // half a turn has two logarithms: exp tells whether it is the other
      const auto back = reference::expMinusIdentityOf(Facts::hat(convert<Real>(log)));
      const auto there = reference::expMinusIdentityOf(Facts::hat(expected));
      const Real angle = expected.template segment<3>(Facts::has_translation ? 3 : 0).norm();
      ASSERT_GT(angle, reference::kPi * (1 - 8 * this->epsilon())) << a << "\n" << log;
      error = reference::errorOf(back, there);
    }
    this->note("log", error, a, this->bound());
    ASSERT_LE(log.template segment<3>(n >= 6 ? 3 : 0).norm(),
              static_cast<T>(reference::kPi * (1 + this->bound())));
  }
}

TYPED_TEST(GroupExpLog, LeftJacobianIsTheIntegralOfAd) {
  using G = TypeParam;
  using T = typename G::Scalar;
  for (const auto& a : reference::scan<G>(reference::thinned(reference::anglesAndBeyond<T>()), 2)) {
    const auto expected = reference::integralOfExp(reference::adOf<G>(convert<Real>(a)));
    this->note("left", reference::errorOf(G::leftJacobian(a), expected), a, this->jacobianBound());
    this->note("right", reference::errorOf(G::rightJacobian(-a), expected), a,
               this->jacobianBound());
  }
}

// Normwise relative error of an inverse: |J X - I| and |X J - I| in the reference's arithmetic.
TYPED_TEST(GroupExpLog, InverseJacobiansInvert) {
  using G = TypeParam;
  using T = typename G::Scalar;
  constexpr std::size_t n = G::kFreedom;
  for (const auto& a : reference::scan<G>(reference::thinned(reference::angles<T>()), 2)) {
    const auto j = reference::integralOfExp(reference::adOf<G>(convert<Real>(a)));
    const auto x = convert<Real>(G::leftJacobianInverse(a));
    const auto rest = j * x - reference::Square<n>::identity();
    const Real scale = reference::frobenius(j) * reference::frobenius(x);
    this->note("inverse", reference::frobenius(rest) / scale, a, this->jacobianBound());
    const auto right = convert<Real>(G::rightJacobianInverse(-a)) - x;
    ASSERT_EQ(reference::frobenius(right), 0);
  }
}

TYPED_TEST(GroupExpLog, AdjointIsTheExponentialOfAd) {
  using G = TypeParam;
  using T = typename G::Scalar;
  constexpr std::size_t n = G::kFreedom;
  for (const auto& a : reference::scan<G>(reference::thinned(reference::angles<T>()), 2)) {
    const auto ad = reference::adOf<G>(convert<Real>(a));
    ASSERT_EQ(reference::frobenius(convert<Real>(G::ad(a)) - ad), 0) << a;
    const auto expected = reference::Square<n>::identity() + reference::expMinusIdentityOf(ad);
    this->note("Ad", reference::errorOf(G::exp(a).adjoint(), expected), a, this->bound());
  }
}

}  // namespace
