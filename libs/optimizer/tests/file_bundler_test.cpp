#include <gslam/optimizer/files/bundler.h>
#include <gtest/gtest.h>

#include <string>

#include "file_tools.h"
#include "test_data.h"

namespace {

using file_tools::expectParseError;
using gslam::Bundle;
using gslam::parseBundler;
using gslam::readBundler;
using gslam::writeBundler;

// The second of three cameras was not registered.
const char* const kBundler =
    "# Bundle file v0.3\n3 2\n"
    "500 -0.1 0.01\n1 0 0\n0 1 0\n0 0 1\n0.5 0.25 -1\n"
    "0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n"
    "600 0 0\n0 -1 0\n1 0 0\n0 0 1\n0 0 -2\n"
    "1 2 -20\n255 128 0\n2 0 17 10 20 2 4 -30.5 40\n"
    "3 4 -25\n0 1 2\n1 2 9 1.5 -2.5\n";

TEST(file_bundler, indices_are_those_of_the_list) {
  const Bundle bundle = parseBundler(kBundler, "text");
  ASSERT_EQ(bundle.T_world_body.size(), 3u);
  ASSERT_EQ(bundle.pixels.size(), 3u);
  EXPECT_EQ(bundle.pose_fixed, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(bundle.observation_pose, (std::vector<std::uint32_t>{0, 2, 2}));
  EXPECT_EQ(bundle.observation_key, (std::vector<std::uint32_t>{17, 4, 9}));
  EXPECT_EQ(bundle.pixels[1][1], -40);
  EXPECT_FLOAT_EQ(bundle.colors[0][1], 128.f / 255);
  // Half a turn about x from a camera that looks along -z.
  const gslam::Vec3d seen = bundle.T_world_body[0].inverse() * bundle.points[0];
  EXPECT_EQ(seen, (gslam::Vec3d{1.5, -2.25, 21}));
}

TEST(file_bundler, what_is_written_comes_back) {
  const file_tools::NewFolder folder;
  const Bundle bundle = parseBundler(kBundler, "text");
  writeBundler(bundle, folder / "out");
  EXPECT_EQ(file_tools::contentOf(folder / "out").substr(0, 23), "# Bundle file v0.3\n3 2\n");
  const Bundle again = readBundler(folder / "out");
  EXPECT_EQ(again.pose_fixed, bundle.pose_fixed);
  EXPECT_EQ(again.observation_pose, bundle.observation_pose);
  EXPECT_EQ(again.observation_key, bundle.observation_key);
  EXPECT_EQ(again.pixels, bundle.pixels);
  EXPECT_EQ(again.points, bundle.points);
  EXPECT_EQ(again.colors, bundle.colors);
  EXPECT_EQ(again.cameras, bundle.cameras);
}

TEST(file_bundler, balbianello_is_reprojected_well_and_comes_back) {
  NEEDS_TEST_DATA();
  const file_tools::NewFolder folder;
  const Bundle bundle =
      readBundler(test_data::folder() + "bundle_adjustment/bundler_balbianello/balbianello.out");
  EXPECT_EQ(bundle.T_world_body.size(), 5u);
  EXPECT_EQ(bundle.points.size(), 544u);
  const double cost = file_tools::radialCost(bundle);
  EXPECT_LT(2 * cost / static_cast<double>(bundle.pixels.size()), 1);  // squared pixels
  writeBundler(bundle, folder / "out");
  const Bundle again = readBundler(folder / "out");
  EXPECT_NEAR(file_tools::radialCost(again), cost, 1e-12 * cost);
  EXPECT_EQ(again.points, bundle.points);
  EXPECT_EQ(again.pixels, bundle.pixels);
  EXPECT_EQ(again.colors, bundle.colors);
  EXPECT_EQ(again.observation_key, bundle.observation_key);
}

TEST(file_bundler, bad_text_is_refused_with_its_place) {
  const std::string text = kBundler;
  const auto parse = [](const std::string& t) { return [t] { parseBundler(t, "text"); }; };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return parse(changed);
  };
  expectParseError(parse(""), 1, "expected the line '# Bundle file v0.3'");
  expectParseError(with("v0.3", "v0.4"), 1, "expected the line");
  expectParseError(with("\n3 2\n", "\n4000000000 1\n"), 2, "too short");
  expectParseError(with("1 0 0", "1 0 1"), 3, "camera that cannot be");
  expectParseError(with("500", "-500"), 3, "fx is -500");
  expectParseError(with("255 128", "256 128"), 19,
                   "'256' is a part of a colour, expected below 256");
  expectParseError(with("2 0 17", "2 3 17"), 20, "'3' is a camera's number");
  expectParseError(with("2 0 17", "2 1 17"), 20, "was not registered");
  expectParseError(with("2 0 17", "4000000000 0 17"), 20, "length of a list");
  expectParseError(parse(text + "x"), 24, "too much");
  file_tools::expectNoCrashForBeginnings(text, [](const std::string& t) { parseBundler(t, "t"); });
}

}  // namespace
