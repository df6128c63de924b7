#include <gslam/optimizer/files/g2o.h>
#include <gslam/optimizer/files/toro.h>
#include <gtest/gtest.h>

#include <string>

#include "file_tools.h"
#include "test_data.h"

namespace {

using file_tools::expectArgumentError;
using file_tools::expectParseError;
using gslam::parseToro;
using gslam::PoseGraph;
using gslam::readToro;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::writeToro;

const char* const kToroPlane =
    "VERTEX2 0 1 2 0.5\nVERTEX 1 4 5 -0.25\nEDGE2 0 1 0.1 0.2 3.0 4 1 5 6 0.5 0.25\n"
    "EDGE_ODOMETRY 1 0 1 0 0 1 0 1 1 0 0\n";
const char* const kToroSpace =
    "VERTEX3 3 1 2 3 0.1 0.2 0.3\nVERTEX3 4 1 2 3 0 0 0\n"
    "EDGE3 4 3 1 2 3 0.1 -0.2 0.3 10 1 0 0 0 0 10 0 0 0 0 10 0 0 0 100 2 0 100 0 25\n";

TEST(file_toro, graphs_in_the_plane) {
  const file_tools::NewFolder folder;
  const auto graph = std::get<PoseGraph<SE2d>>(parseToro(kToroPlane, "text"));
  EXPECT_EQ(graph.information[0], (gslam::Mat3d{4, 1, 0.5, 1, 5, 0.25, 0.5, 0.25, 6}));
  EXPECT_EQ(graph.from, (std::vector<std::uint32_t>{0, 1}));
  writeToro(graph, folder / "out.graph");
  const auto again = std::get<PoseGraph<SE2d>>(readToro(folder / "out.graph"));
  EXPECT_EQ(again.information, graph.information);
  EXPECT_EQ(again.to, graph.to);
  EXPECT_TRUE(again.T_from_to[0].isApprox(graph.T_from_to[0], 1e-15));
}

TEST(file_toro, yaw_is_the_last_of_three_turns) {
  const file_tools::NewFolder folder;
  const auto graph = std::get<PoseGraph<SE3d>>(parseToro(kToroSpace, "text"));
  const gslam::SO3d expected =
      gslam::SO3d::exp({0, 0, 0.3}) * gslam::SO3d::exp({0, 0.2, 0}) * gslam::SO3d::exp({0.1, 0, 0});
  EXPECT_TRUE(graph.T_world_body[0].rotation().isApprox(expected, 1e-15));
  EXPECT_EQ(graph.information[0](3, 4), 2);
  EXPECT_EQ(graph.information[0](5, 5), 25);
  writeToro(graph, folder / "out.graph");
  const auto again = std::get<PoseGraph<SE3d>>(readToro(folder / "out.graph"));
  EXPECT_EQ(again.information, graph.information);
  EXPECT_TRUE(again.T_from_to[0].isApprox(graph.T_from_to[0], 1e-15));
}

// The edges of the truth are exact: poses made of them explain all, and are a sphere.
TEST(file_toro, the_true_sphere_is_made_of_its_edges) {
  NEEDS_TEST_DATA();
  const auto graph = std::get<PoseGraph<SE3d>>(
      readToro(test_data::folder() + "pose_graphs/sphere2500_groundtruth.txt"));
  ASSERT_EQ(graph.T_world_body.size(), 2500u);
  for (std::size_t i = 0; i < graph.from.size(); ++i) {
    const SE3d between =
        graph.T_world_body[graph.from[i]].inverse() * graph.T_world_body[graph.to[i]];
    ASSERT_TRUE(between.isApprox(graph.T_from_to[i], 1e-2)) << i;  // the file has 6 digits
  }
}

TEST(file_toro, bad_text_is_refused_with_its_place) {
  const auto parse = [](const std::string& t) { return [t] { parseToro(t, "text"); }; };
  expectParseError(parse("VERTEX4 0 0 0 0\n"), 1, "'VERTEX4' is not supported here");
  expectParseError(parse(std::string(kToroPlane) + kToroSpace), 5, "all of one kind");
  // Row by row, as in g2o's files.
  expectParseError(parse("EDGE2 0 1 1 0 0 1 0 0 1 0 1\n"), 1, "not positive semi-definite");
  expectParseError(parse("VERTEX2 0 0 0 0\nFIX 0\n"), 2, "'FIX'");
  file_tools::expectNoCrashForBeginnings(kToroPlane,
                                         [](const std::string& t) { parseToro(t, "t"); });
  file_tools::expectNoCrashForBeginnings(kToroSpace,
                                         [](const std::string& t) { parseToro(t, "t"); });
  const file_tools::NewFolder folder;
  expectArgumentError([&] { writeToro(PoseGraph<SIM3d>(), folder / "out"); }, "has scales");
}

}  // namespace
