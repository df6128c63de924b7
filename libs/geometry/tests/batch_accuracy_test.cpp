// exp and log of batches against the matrix exponential in long double, in every variant: the
// bounds that SO3 and SE3 state hold for batches, too.
#include <gslam/geometry/batch.h>

#include "group_reference.h"

namespace {

using gslam::SE3;
using gslam::SO3;
using reference::convert;
using reference::GroupFacts;
using reference::Real;

template <class G>
class BatchAccuracy : public testing::Test {
 public:
  using Scalar = typename G::Scalar;
  using Tangent = typename G::Tangent;
  static constexpr Real bound() { return reference::bound<Scalar>(); }

  // Matrix exponentials minus the identity, once for all variants.
  void prepare(const std::vector<Scalar>& angles) {
    tangents = reference::scan<G>(angles, 4);
    for (const Tangent& a : tangents) {
      references.push_back(reference::expMinusIdentityOf(GroupFacts<G>::hat(convert<Real>(a))));
    }
  }
  void note(Real error, const Tangent& a) {
    ASSERT_LE(error, bound()) << simdName(gslam::activeSimd()) << " at " << a;
    worst_ = error > worst_ ? error : worst_;
  }
  void TearDown() override {
    const Real epsilon = std::numeric_limits<Scalar>::epsilon();
    this->RecordProperty("worst_in_epsilons", std::to_string(worst_ / epsilon));
  }

  std::vector<Tangent> tangents;
  std::vector<reference::Square<GroupFacts<G>::size>> references;

 private:
  Real worst_ = 0;
};
using RigidGroups = testing::Types<SO3<float>, SO3<double>, SE3<float>, SE3<double>>;
TYPED_TEST_SUITE(BatchAccuracy, RigidGroups, );

TYPED_TEST(BatchAccuracy, ExpIsTheMatrixExponential) {
  using G = TypeParam;
  using Facts = GroupFacts<G>;
  this->prepare(reference::anglesAndBeyond<typename G::Scalar>());
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    std::vector<G> results(this->tangents.size());
    gslam::expMany<G>(this->tangents, results);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto expected = reference::Square<Facts::size>::identity() + this->references[i];
      this->note(reference::errorOf(results[i].matrix(), expected), this->tangents[i]);
    }
  }
}

// The rotation and the translation apart, relative to themselves: nothing is lost at small angles.
TYPED_TEST(BatchAccuracy, LogUndoesExp) {
  using G = TypeParam;
  this->prepare(reference::angles<typename G::Scalar>());
  for (const gslam::Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd forced(variant);
    std::vector<G> there(this->tangents.size());
    std::vector<typename G::Tangent> back(this->tangents.size());
    gslam::expMany<G>(this->tangents, there);
    gslam::logMany<G>(there, back);
    for (std::size_t i = 0; i < back.size(); ++i) {
      const auto& a = this->tangents[i];
      Real error = reference::relativeError(back[i], convert<Real>(a));
      if (error > this->bound()) {  // half a turn has two logarithms
        const Real angle = convert<Real>(a.template segment<3>(G::kFreedom - 3)).norm();
        ASSERT_GT(angle, reference::kPi * (1 - this->bound())) << a << "\n" << back[i];
        const auto other =
            reference::expMinusIdentityOf(GroupFacts<G>::hat(convert<Real>(back[i])));
        error = reference::errorOf(other, this->references[i]);
      }
      this->note(error, a);
    }
  }
}

}  // namespace
