#include <gslam/optimizer/files/g2o.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "file_tools.h"
#include "test_data.h"

namespace {

using file_tools::expectArgumentError;
using file_tools::expectParseError;
using gslam::AnyPoseGraph;
using gslam::parseG2o;
using gslam::PoseGraph;
using gslam::readG2o;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::writeG2o;

const char* const kG2oPlane =
    "# poses\nVERTEX_SE2 7 1 2 0.5\nVERTEX_SE2 -3 4 5 -0.25\nFIX 7\n\n"
    "EDGE_SE2 -3 7 0.1 0.2 3.0 4 1 0.5 5 0.25 6\n";
const char* const kG2oSpace =
    "VERTEX_SE3:QUAT 0 1 2 3 0 0 0 1\nVERTEX_SE3:QUAT 1 4 5 6 0 0.6 0 0.8\n"
    "EDGE_SE3:QUAT 0 1 3 3 3 0 0.6 0 0.8 10 1 1 1 1 1 10 1 1 1 1 10 1 1 1 400 4 4 400 4 100\n";
const char* const kG2oScaled =
    "VERTEX_SIM3:QUAT 0 1 2 3 0 0 0 1 2\nVERTEX_SIM3:QUAT 1 4 5 6 0 0.6 0 0.8 0.5\n"
    "EDGE_SIM3:QUAT 0 1 3 3 3 0 0.6 0 0.8 0.25 10 0 0 1 0 0 1 10 0 0 1 0 1 10 0 0 1 1 400 0 0 8 "
    "400 "
    "0 8 100 8 50\n";

template <class Group>
void expectSameGraph(const PoseGraph<Group>& a, const PoseGraph<Group>& b, double tolerance) {
  ASSERT_EQ(a.T_world_body.size(), b.T_world_body.size());
  ASSERT_EQ(a.T_from_to.size(), b.T_from_to.size());
  EXPECT_EQ(a.from, b.from);
  EXPECT_EQ(a.to, b.to);
  EXPECT_EQ(a.pose_fixed, b.pose_fixed);
  EXPECT_EQ(a.information, b.information);
  for (std::size_t i = 0; i < a.T_world_body.size(); ++i) {
    EXPECT_EQ(a.ids.idOf(std::uint32_t(i)), b.ids.idOf(std::uint32_t(i)));
    EXPECT_TRUE(a.T_world_body[i].isApprox(b.T_world_body[i], tolerance)) << i;
  }
  for (std::size_t i = 0; i < a.T_from_to.size(); ++i) {
    EXPECT_TRUE(a.T_from_to[i].isApprox(b.T_from_to[i], tolerance)) << i;
  }
}

template <class Group>
PoseGraph<Group> writtenAndRead(const PoseGraph<Group>& graph) {
  const file_tools::NewFolder folder;
  writeG2o(graph, folder / "out.g2o");
  return std::get<PoseGraph<Group>>(readG2o(folder / "out.g2o"));
}

TEST(file_g2o, graphs_in_the_plane) {
  const auto graph = std::get<PoseGraph<SE2d>>(parseG2o(kG2oPlane, "text"));
  EXPECT_EQ(graph.ids.idOf(1), -3);
  EXPECT_EQ(graph.from[0], 1u);
  EXPECT_EQ(graph.to[0], 0u);
  EXPECT_EQ(graph.pose_fixed, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(graph.information[0], (gslam::Mat3d{4, 1, 0.5, 1, 5, 0.25, 0.5, 0.25, 6}));
  EXPECT_NEAR(graph.T_from_to[0].rotation().angle(), 3, 1e-15);
  expectSameGraph(writtenAndRead(graph), graph, 1e-15);
}

TEST(file_g2o, information_of_half_rotation_vectors_becomes_that_of_whole_ones) {
  const auto graph = std::get<PoseGraph<SE3d>>(parseG2o(kG2oSpace, "text"));
  const SE3d::Jacobian& m = graph.information[0];
  EXPECT_EQ(m(0, 0), 10);
  EXPECT_EQ(m(0, 1), 1);
  EXPECT_EQ(m(1, 4), 0.5);
  EXPECT_EQ(m(4, 1), 0.5);
  EXPECT_EQ(m(3, 4), 1);
  EXPECT_EQ(m(3, 3), 100);
  EXPECT_EQ(m(5, 5), 25);
  EXPECT_TRUE(graph.pose_fixed.empty());
  // What g2o and we make of a small error is the same.
  const double angle = 1e-4;
  const gslam::Vec<double, 6> error = {0, 0, 0, 0, angle, 0};
  const double q = SE3d::exp(error).rotation().y();
  EXPECT_NEAR(m(4, 4) * angle * angle, 400 * q * q, 1e-13);
  expectSameGraph(writtenAndRead(graph), graph, 0);
}

TEST(file_g2o, graphs_with_scales) {
  const auto graph = std::get<PoseGraph<SIM3d>>(parseG2o(kG2oScaled, "text"));
  EXPECT_EQ(graph.T_world_body[0].scale(), 2);
  EXPECT_EQ(graph.T_from_to[0].scale(), 0.25);
  EXPECT_EQ(graph.information[0](6, 6), 50);
  EXPECT_EQ(graph.information[0](5, 6), 4);
  EXPECT_EQ(graph.information[0](0, 3), 0.5);
  EXPECT_EQ(graph.information[0](0, 6), 1);
  expectSameGraph(writtenAndRead(graph), graph, 0);
}

TEST(file_g2o, edges_alone_make_poses) {
  const std::string text = "EDGE_SE2 9 4 1 0 0.5 1 0 0 1 0 1\nEDGE_SE2 4 5 1 0 0 1 0 0 1 0 1\n";
  const auto graph = std::get<PoseGraph<SE2d>>(parseG2o(text, "text"));
  ASSERT_EQ(graph.T_world_body.size(), 3u);
  EXPECT_EQ(graph.ids.idOf(0), 4);
  EXPECT_EQ(graph.ids.idOf(2), 9);
  for (std::size_t i = 0; i < 2; ++i) {
    const SE2d between =
        graph.T_world_body[graph.from[i]].inverse() * graph.T_world_body[graph.to[i]];
    EXPECT_TRUE(between.isApprox(graph.T_from_to[i], 1e-9));
  }
}

TEST(file_g2o, real_graphs_come_back) {
  NEEDS_TEST_DATA();
  const std::string folder = test_data::folder() + "pose_graphs/";
  const auto plane = std::get<PoseGraph<SE2d>>(readG2o(folder + "M3500.g2o"));
  EXPECT_EQ(plane.T_world_body.size(), 3500u);
  EXPECT_EQ(plane.from.size(), 5453u);
  expectSameGraph(writtenAndRead(plane), plane, 1e-15);
  for (const char* const name : {"sphere2500.g2o", "parking-garage.g2o", "tinyGrid3D.g2o"}) {
    const auto space = std::get<PoseGraph<SE3d>>(readG2o(folder + name));
    expectSameGraph(writtenAndRead(space), space, 0);
  }
  const auto sphere = std::get<PoseGraph<SE3d>>(readG2o(folder + "sphere2500.g2o"));
  EXPECT_EQ(sphere.T_world_body.size(), 2500u);
  EXPECT_EQ(sphere.from.size(), 4949u);
  EXPECT_NEAR(sphere.information[0](3, 3), 100, 0.01);
  EXPECT_NEAR(sphere.information[0](5, 5), 25, 0.3);
}

TEST(file_g2o, bad_text_is_refused_with_its_place) {
  const auto parse = [](const std::string& t) { return [t] { parseG2o(t, "text"); }; };
  const auto with = [&](const char* text, const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return parse(changed);
  };
  expectParseError(parse(""), 1, "the file ends, expected VERTEX_SE2");
  expectParseError(parse("# nothing\n"), 2, "the file ends");
  expectParseError(parse("FIX\n"), 0, "neither a vertex nor an edge");
  expectParseError(parse("VERTEX_XY 0 1 2\n"), 1, "'VERTEX_XY' is not supported here, expected");
  expectParseError(with(kG2oPlane, "EDGE_SE2", "EDGE_SE2_XY"), 6, "'EDGE_SE2_XY'");
  expectParseError(parse(std::string(kG2oPlane) + kG2oSpace), 7, "all of one kind");
  expectParseError(with(kG2oPlane, "SE2 -3", "SE2 7"), 3, "'7' is a vertex that is there already");
  expectParseError(with(kG2oPlane, "FIX 7", "FIX 8"), 4, "vertex 8 is not in the file");
  expectParseError(with(kG2oPlane, "-3 7 0.1", "-3 6 0.1"), 6, "vertex 6 is not in the file");
  expectParseError(with(kG2oPlane, "-3 7 0.1", "7 7 0.1"), 6, "joined to itself");
  expectParseError(with(kG2oPlane, "0.25 6", "0.25"), 6, "the line ends");
  expectParseError(with(kG2oPlane, "0.25 6", "0.25 6 7"), 6, "'7' is too much");
  expectParseError(with(kG2oPlane, "0.25 6", "0.25 -6"), 6, "not positive semi-definite");
  expectParseError(with(kG2oPlane, "0.1 0.2", "inf 0.2"), 6, "'inf'");
  expectParseError(with(kG2oSpace, "0 0.6 0 0.8\nEDGE", "0 6 0 8\nEDGE"), 2,
                   "quaternion of norm 10");
  expectParseError(with(kG2oScaled, "0.8 0.25", "0.8 0"), 3, "is a scale, expected one above 0");
  for (const char* const text : {kG2oPlane, kG2oSpace, kG2oScaled}) {
    file_tools::expectNoCrashForBeginnings(text, [](const std::string& t) { parseG2o(t, "text"); });
  }
}

TEST(file_g2o, what_it_cannot_hold_is_refused) {
  const file_tools::NewFolder folder;
  auto graph = std::get<PoseGraph<SE3d>>(parseG2o(kG2oSpace, "text"));
  graph.prior_pose = {0};
  expectArgumentError([&] { writeG2o(graph, folder / "out"); }, "cannot hold priors");
  graph.prior_pose.clear();
  graph.to[0] = 2;
  expectArgumentError([&] { writeG2o(graph, folder / "out"); }, "edge 0");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
