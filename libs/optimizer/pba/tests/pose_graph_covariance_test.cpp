#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "factors/loss.h"
#include "factors/pose_edge.h"
#include "pose_graph_instances.h"
#include "solvers.h"

namespace gslam {
namespace {

using detail::pba::solvePoseGraphCovariance;
using pose_graph_test::Graph;
using pose_graph_test::walk;
using Matrix = Eigen::MatrixXd;

// J^T J of all edges, weighted by the loss, with J from differences of the residuals.
template <class Group>
Matrix denseEquations(const PoseGraphProblem<Group>& p, const RobustLoss& loss) {
  constexpr std::size_t n = Group::kFreedom;
  const Eigen::Index size = static_cast<Eigen::Index>(n * p.T_world_body.size());
  Matrix h = Matrix::Zero(size, size);
  for (std::size_t e = 0; e < p.from.size(); ++e) {
    const auto weight = detail::edgeWeight<Group>(p.residual, p.information[e]);
    const auto residual = [&](const Group& from, const Group& to) {
      detail::EdgeValue<Group> value{};
      detail::edgeValue(p.residual, from, to, p.T_from_to[e], weight, false, value);
      return value;
    };
    const Group from = p.T_world_body[p.from[e]], to = p.T_world_body[p.to[e]];
    const auto here = residual(from, to);
    double s = 0;
    for (std::size_t r = 0; r < here.rows; ++r) s += here.residual[r] * here.residual[r];
    Matrix j = Matrix::Zero(static_cast<Eigen::Index>(here.rows), size);
    for (std::size_t k = 0; k < 2 * n; ++k) {
      typename Group::Tangent step{};
      constexpr double h_step = 1e-6;
      step[k % n] = h_step;
      const Group plus = Group::exp(step), minus = Group::exp(-step);
      const auto above = k < n ? residual(from * plus, to) : residual(from, to * plus);
      const auto below = k < n ? residual(from * minus, to) : residual(from, to * minus);
      const std::size_t pose = k < n ? p.from[e] : p.to[e];
      for (std::size_t r = 0; r < here.rows; ++r) {
        j(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(pose * n + k % n)) =
            (above.residual[r] - below.residual[r]) / (2 * h_step);
      }
    }
    h += detail::lossAt(loss, s).first * j.transpose() * j;
  }
  return h;
}

template <class Group>
class PoseGraphCovariances : public ::testing::Test {};
using CovarianceGroups = ::testing::Types<SE2d, SE3d, SIM3d>;
TYPED_TEST_SUITE(PoseGraphCovariances, CovarianceGroups, );

TYPED_TEST(PoseGraphCovariances, are_blocks_of_the_inverse_of_the_normal_equations) {
  constexpr Eigen::Index n = TypeParam::kFreedom;
  for (const PoseGraphResidual kind :
       {PoseGraphResidual::Logarithm, PoseGraphResidual::Quaternion, PoseGraphResidual::Chordal}) {
    if (n == 7 && kind == PoseGraphResidual::Chordal) continue;
    Graph<TypeParam> graph = walk<TypeParam>(8, 6, 0.1, 31);
    graph.is_robust.clear();
    OptimizerOptions options;
    options.loss = {LossKind::Cauchy, 1};
    const auto problem = graph.problem(kind);
    const std::vector<std::uint32_t> chosen = {5, 0, 7, 5};
    const auto result = solvePoseGraphCovariance(problem, chosen, options);
    ASSERT_TRUE(result.is_valid) << result.message;
    ASSERT_EQ(result.poses.size(), chosen.size());
    const Matrix h = denseEquations(problem, options.loss);
    const Matrix inverse = h.bottomRightCorner(h.rows() - n, h.cols() - n).inverse();
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      for (Eigen::Index r = 0; r < n; ++r) {
        for (Eigen::Index c = 0; c < n; ++c) {
          const Eigen::Index at = static_cast<Eigen::Index>(chosen[i]) * n - n;
          const double expected = chosen[i] == 0 ? 0 : inverse(at + r, at + c);
          EXPECT_NEAR(result.poses[i](static_cast<std::size_t>(r), static_cast<std::size_t>(c)),
                      expected, 1e-6 * inverse.cwiseAbs().maxCoeff());
        }
      }
    }
  }
}

TYPED_TEST(PoseGraphCovariances, of_one_measured_pose_is_the_inverse_of_its_information) {
  Graph<TypeParam> graph;
  graph.T_world_body.resize(2);
  graph.add(0, 1, TypeParam(), 4.0 * TypeParam::Jacobian::identity());
  const std::vector<std::uint32_t> chosen = {1};
  const auto result = solvePoseGraphCovariance(graph.problem(), chosen, OptimizerOptions());
  ASSERT_TRUE(result.is_valid);
  for (std::size_t i = 0; i < TypeParam::kFreedom; ++i) {
    EXPECT_NEAR(result.poses[0](i, i), 0.25, 1e-15);
  }
}

TYPED_TEST(PoseGraphCovariances, are_refused_where_something_is_free) {
  Graph<TypeParam> graph = walk<TypeParam>(8, 4, 0.01, 32);
  auto nothing = TypeParam::Jacobian::identity();
  nothing(0, 0) = 0;
  graph.addPrior(0, graph.T_world_body[0], nothing);  // no anchor, since there is a prior
  const std::vector<std::uint32_t> chosen = {1};
  const auto result = solvePoseGraphCovariance(graph.problem(), chosen, OptimizerOptions());
  EXPECT_FALSE(result.is_valid);
  EXPECT_FALSE(result.message.empty());
  EXPECT_TRUE(result.poses.empty());
}

}  // namespace
}  // namespace gslam
