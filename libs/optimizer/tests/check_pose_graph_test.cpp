#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "backend_contract/scenes.h"

namespace {

using gslam::PoseGraph;
using gslam::PoseGraphResidual;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using testing::ElementsAre;
using testing::IsEmpty;

template <class Group>
using Change = std::function<void(PoseGraph<Group>&)>;

// Of a graph without findings, after a change: "error field problem".
template <class Group>
std::vector<std::string> findingsAfter(const Change<Group>& change,
                                       PoseGraphResidual residual = PoseGraphResidual::Logarithm) {
  PoseGraph<Group> graph = backend_contract::graphScene<Group>(20, 0).graph;
  change(graph);
  std::vector<std::string> texts;
  for (const gslam::ProblemFinding& finding : checkPoseGraph(graph.problem(residual))) {
    texts.push_back((finding.is_error ? "error " : "warning ") + finding.field + " " +
                    finding.problem);
  }
  return texts;
}

template <class Group>
class CheckPoseGraph : public testing::Test {};
using Groups = testing::Types<SE2d, SE3d, SIM3d>;
TYPED_TEST_SUITE(CheckPoseGraph, Groups, );

TYPED_TEST(CheckPoseGraph, finds_nothing_in_a_good_graph) {
  EXPECT_THAT(findingsAfter<TypeParam>([](PoseGraph<TypeParam>&) {}), IsEmpty());
  EXPECT_THAT(findingsAfter<TypeParam>([](PoseGraph<TypeParam>&) {}, PoseGraphResidual::Quaternion),
              IsEmpty());
  EXPECT_TRUE(checkPoseGraph(gslam::PoseGraphProblem<TypeParam>()).empty());
  // Without an anchor the first pose is one.
  EXPECT_THAT(findingsAfter<TypeParam>([](PoseGraph<TypeParam>& g) { g.pose_fixed.clear(); }),
              IsEmpty());
}

TYPED_TEST(CheckPoseGraph, finds_errors) {
  using Graph = PoseGraph<TypeParam>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(findingsAfter<TypeParam>([](Graph& g) { g.to.pop_back(); }),
              ElementsAre("error to has 21 elements, expected 22 as of from"));
  EXPECT_THAT(findingsAfter<TypeParam>([](Graph& g) { g.prior_pose = {1}; }),
              ElementsAre("error prior_T_world_body has 0 elements, expected 1 as of prior_pose",
                          "error prior_information has 0 elements, expected 1 as of prior_pose"));
  EXPECT_THAT(findingsAfter<TypeParam>([](Graph& g) { g.from[4] = g.from[6] = 20; }),
              ElementsAre("error from[4] is 20, expected below 20 (and 1 other of this kind)"));
  EXPECT_THAT(findingsAfter<TypeParam>([](Graph& g) { g.to[3] = g.from[3]; }),
              ElementsAre("error to[3] is the pose that the edge comes from"));
  EXPECT_THAT(findingsAfter<TypeParam>([&](Graph& g) { g.information[3](1, 0) = nan; }),
              ElementsAre("error information[3] holds a number that is not finite"));
  EXPECT_THAT(findingsAfter<TypeParam>([](Graph& g) { g.information[3](1, 0) = 2.1; }),
              ElementsAre("error information[3] is not symmetric"));
  EXPECT_THAT(findingsAfter<TypeParam>(
                  [](Graph& g) { g.information[3](1, 0) = g.information[3](0, 1) = 1000; }),
              ElementsAre("error information[3] is not positive semi-definite"));
  EXPECT_THAT(findingsAfter<TypeParam>([&](Graph& g) {
                typename TypeParam::Tangent tangent{};
                tangent[0] = nan;
                g.T_from_to[2] = TypeParam::exp(tangent);
              }),
              ElementsAre("error T_from_to[2] is not finite"));
}

TYPED_TEST(CheckPoseGraph, finds_singular_information) {
  using Graph = PoseGraph<TypeParam>;
  const auto without_rotation = [](Graph& g) {
    auto& information = g.information[5];
    for (std::size_t k = TypeParam::kFreedom == 3 ? 2 : 3; k < TypeParam::kFreedom; ++k) {
      information(k, k) = 0;
    }
  };
  EXPECT_THAT(findingsAfter<TypeParam>(without_rotation),
              ElementsAre("warning information[5] is singular: some direction of the residual "
                          "costs nothing"));
  const bool is_similarity = TypeParam::kFreedom == 7;
  EXPECT_EQ(findingsAfter<TypeParam>(without_rotation, PoseGraphResidual::Chordal).front(),
            is_similarity
                ? "error residual is Chordal, which is not for SIM3: expected Logarithm or "
                  "Quaternion"
                : "error information[5] is singular, expected one with an inverse for Chordal");
  if (is_similarity) return;
  EXPECT_THAT(findingsAfter<TypeParam>([](Graph&) {}, PoseGraphResidual::Chordal), IsEmpty());
}

TYPED_TEST(CheckPoseGraph, takes_information_of_every_size) {
  for (const double size : {1e-30, 1e-6, 1e12, 1e200}) {
    EXPECT_THAT(findingsAfter<TypeParam>([&](PoseGraph<TypeParam>& g) {
                  for (auto& information : g.information) information = size * information;
                }),
                IsEmpty());
  }
  // Metres and radians may differ by much.
  EXPECT_THAT(findingsAfter<TypeParam>([&](PoseGraph<TypeParam>& g) {
                for (auto& information : g.information) information(2, 2) = 1e15;
              }),
              IsEmpty());
}

TYPED_TEST(CheckPoseGraph, warns_of_parts_and_poses_that_nothing_holds) {
  using Graph = PoseGraph<TypeParam>;
  const auto add_part = [](Graph& g) {
    for (std::size_t i = 0; i < 3; ++i) {
      g.T_world_body.push_back(g.T_world_body[i]);
      g.pose_fixed.push_back(0);
    }
    g.from.push_back(21);
    g.to.push_back(22);
    g.T_from_to.push_back(g.T_from_to[0]);
    g.information.push_back(g.information[0]);
    g.is_robust.push_back(0);
  };
  EXPECT_THAT(findingsAfter<TypeParam>(add_part),
              ElementsAre("warning T_world_body[20] has no edges: it stays",
                          "warning T_world_body[21] begins a part that no edge connects to an "
                          "anchor: it stays near the start"));
  EXPECT_THAT(findingsAfter<TypeParam>([&](Graph& g) {
                add_part(g);
                g.pose_fixed[22] = 1;
                g.prior_pose = {20};
                g.prior_T_world_body = {g.T_world_body[20]};
                g.prior_information = {g.information[0]};
              }),
              IsEmpty());
}

}  // namespace
