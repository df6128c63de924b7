#include "factors/pose_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gslam {
namespace {

using detail::EdgeValue;
using detail::EdgeWeight;

const PoseGraphResidual kResiduals[] = {PoseGraphResidual::Logarithm, PoseGraphResidual::Quaternion,
                                        PoseGraphResidual::Chordal};

template <class Group>
class PoseEdge : public ::testing::Test {
 public:
  static constexpr std::size_t n = Group::kFreedom;

  typename Group::Tangent tangent(double size) {
    typename Group::Tangent t;
    for (std::size_t i = 0; i < n; ++i) t[i] = size * normal_(random_);
    return t;
  }
  Group pose(double size = 1) { return Group::exp(tangent(size)); }
  typename Group::Jacobian information(std::size_t rank = n) {
    typename Group::Jacobian a{};
    for (std::size_t r = 0; r < rank; ++r) {
      const auto row = tangent(1);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) a(i, j) += row[i] * row[j];
      }
    }
    return a;
  }
  static bool has(PoseGraphResidual kind) { return n != 7 || kind != PoseGraphResidual::Chordal; }

 private:
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

using Groups = ::testing::Types<SE2d, SE3d, SIM3d>;
TYPED_TEST_SUITE(PoseEdge, Groups, );

// The error of a symmetric difference of four points is of the fourth order.
template <class Group, class Residual>
void expectDerivative(const Residual& residual, const Group& pose, const double* derivative) {
  constexpr std::size_t n = Group::kFreedom;
  constexpr double h = 1e-3;
  for (std::size_t k = 0; k < n; ++k) {
    EdgeValue<Group> at[4];
    const double steps[] = {-2 * h, -h, h, 2 * h};
    for (std::size_t i = 0; i < 4; ++i) {
      typename Group::Tangent step{};
      step[k] = steps[i];
      at[i] = residual(pose * Group::exp(step));
    }
    for (std::size_t r = 0; r < at[0].rows; ++r) {
      const double numeric =
          (8 * (at[2].residual[r] - at[1].residual[r]) - (at[3].residual[r] - at[0].residual[r])) /
          (12 * h);
      EXPECT_NEAR(derivative[r * n + k], numeric, 1e-8 * (1 + std::fabs(numeric)))
          << "row " << r << " column " << k;
    }
  }
}

TYPED_TEST(PoseEdge, derivatives_are_those_of_the_residuals) {
  using Group = TypeParam;
  for (const PoseGraphResidual kind : kResiduals) {
    if (!this->has(kind)) continue;
    for (int trial = 0; trial < 20; ++trial) {
      const Group from = this->pose(), between = this->pose(0.8);
      const Group to = from * between * this->pose(trial < 10 ? 0.3 : 1e-9);
      const auto weight = detail::edgeWeight<Group>(kind, this->information());
      EdgeValue<Group> value;
      detail::edgeValue(kind, from, to, between, weight, true, value);
      const auto byFrom = [&](const Group& pose) {
        EdgeValue<Group> v;
        detail::edgeValue(kind, pose, to, between, weight, false, v);
        return v;
      };
      const auto byTo = [&](const Group& pose) {
        EdgeValue<Group> v;
        detail::edgeValue(kind, from, pose, between, weight, false, v);
        return v;
      };
      expectDerivative<Group>(byFrom, from, value.by_from);
      expectDerivative<Group>(byTo, to, value.by_to);
    }
  }
}

TYPED_TEST(PoseEdge, the_residual_is_zero_where_the_measurement_is_exact) {
  using Group = TypeParam;
  for (const PoseGraphResidual kind : kResiduals) {
    if (!this->has(kind)) continue;
    const Group from = this->pose(), between = this->pose();
    const auto weight = detail::edgeWeight<Group>(kind, this->information());
    EdgeValue<Group> value;
    detail::edgeValue(kind, from, from * between, between, weight, false, value);
    for (std::size_t r = 0; r < value.rows; ++r) EXPECT_NEAR(value.residual[r], 0, 1e-13);
  }
}

TYPED_TEST(PoseEdge, residuals_of_small_errors_agree_with_the_information) {
  using Group = TypeParam;
  const Group from = this->pose(), between = this->pose();
  const auto d = this->tangent(1e-5);
  const auto information = this->information();
  const double expected = d.dot(information * d);
  for (const PoseGraphResidual kind :
       {PoseGraphResidual::Logarithm, PoseGraphResidual::Quaternion}) {
    const auto weight = detail::edgeWeight<Group>(kind, information);
    EdgeValue<Group> value;
    detail::edgeValue(kind, from, from * between * Group::exp(d), between, weight, false, value);
    double s = 0;
    for (std::size_t r = 0; r < value.rows; ++r) s += value.residual[r] * value.residual[r];
    EXPECT_NEAR(s, expected, 1e-3 * expected);
  }
}

TYPED_TEST(PoseEdge, the_root_squared_is_the_information_also_where_it_is_singular) {
  for (std::size_t rank = 0; rank <= TypeParam::kFreedom; ++rank) {
    const auto information = this->information(rank);
    const auto root = detail::edgeWeight<TypeParam>(PoseGraphResidual::Logarithm, information).root;
    const auto squared = root.transpose() * root;
    for (std::size_t i = 0; i < TypeParam::kFreedom * TypeParam::kFreedom; ++i) {
      EXPECT_NEAR(squared.values[i], information.values[i], 1e-11);
    }
  }
}

TEST(pose_edge, chordal_weights_are_those_of_se_sync) {
  SE3d::Jacobian m = SE3d::Jacobian::identity();
  for (std::size_t i = 0; i < 6; ++i) m(i, i) = static_cast<double>(i + 1);
  m(0, 1) = m(1, 0) = 0.5;
  const auto weight = detail::edgeWeight<SE3d>(PoseGraphResidual::Chordal, m);
  EXPECT_NEAR(weight.kappa_root * weight.kappa_root, 6 / (1. / 4 + 1. / 5 + 1. / 6), 1e-13);
  EXPECT_NEAR(weight.tau_root * weight.tau_root, 3 / (3 / 1.75 + 1. / 3), 1e-14);
  const SE2d::Jacobian plane = {{1, 0.5, 0, 0.5, 2, 0, 0, 0, 7}};
  const auto flat = detail::edgeWeight<SE2d>(PoseGraphResidual::Chordal, plane);
  EXPECT_NEAR(flat.kappa_root * flat.kappa_root, 7, 1e-14);
  EXPECT_NEAR(flat.tau_root * flat.tau_root, 2 / (3 / 1.75), 1e-14);
}

TEST(pose_edge, chordal_weights_of_nearly_singular_information_keep_their_digits) {
  for (const double least : {1e-3, 1e-5, 1e-7}) {
    const Mat3d turn = SO3d::exp({{0.5, -0.3, 0.8}}).matrix();
    const Mat3d part = turn * Mat3d{{1, 0, 0, 0, least, 0, 0, 0, least}} * turn.transpose();
    SE3d::Jacobian m{};
    m.setBlock(0, 0, part);
    m.setBlock(3, 3, part);
    const auto weight = detail::edgeWeight<SE3d>(PoseGraphResidual::Chordal, m);
    const double trace = 1 + 2 / least;
    EXPECT_NEAR(weight.kappa_root * weight.kappa_root * trace, 6, 1e-14 / least);
    EXPECT_NEAR(weight.tau_root * weight.tau_root * trace, 3, 1e-14 / least);
  }
}

TEST(pose_edge, a_chordal_weight_of_singular_information_is_zero) {
  const auto weight = detail::edgeWeight<SE3d>(PoseGraphResidual::Chordal, SE3d::Jacobian{});
  EXPECT_EQ(weight.kappa_root, 0);
  EXPECT_EQ(weight.tau_root, 0);
}

}  // namespace
}  // namespace gslam
