#include <gslam/optimizer/files/bal.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "file_tools.h"
#include "test_data.h"

namespace {

using file_tools::contentOf;
using file_tools::expectArgumentError;
using file_tools::expectParseError;
using gslam::Bundle;
using gslam::Camera;
using gslam::parseBal;
using gslam::readBal;
using gslam::writeBal;

// Two cameras, two points, three observations.
const char* const kBal =
    "2 2 3\n0 0 10 20\n1 0 -3.5 1e1\n1 1 +4 -0.25\n"
    "0.1 0.2 -0.3\n1 2 -3\n500 -1e-3 1e-7\n"
    "-2 1 1.5\n0 0.5 -4\n600 0.01 0\n"
    "1 2 -20\n3 4 -25\n";

std::string dataFile(const char* name) {
  return test_data::folder() + "bundle_adjustment/" + name;
}

// The cost by the definition of the format, of the numbers as they stand in the file.
double costOfText(const std::string& text) {
  const char* place = text.c_str();
  const auto next = [&place] {
    char* end = nullptr;
    const double value = std::strtod(place, &end);
    place = end;
    return value;
  };
  const auto cameras = static_cast<std::size_t>(next()), points = static_cast<std::size_t>(next());
  const auto observations = static_cast<std::size_t>(next());
  std::vector<double> seen(4 * observations), camera(9 * cameras), point(3 * points);
  for (double& value : seen) value = next();
  for (double& value : camera) value = next();
  for (double& value : point) value = next();
  double sum = 0;
  for (std::size_t i = 0; i < observations; ++i) {
    const double* const c = &camera[9 * static_cast<std::size_t>(seen[4 * i])];
    const double* const X = &point[3 * static_cast<std::size_t>(seen[4 * i + 1])];
    // Rodrigues' formula
    const double angle = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    const double k[] = {c[0] / angle, c[1] / angle, c[2] / angle};
    const double along = k[0] * X[0] + k[1] * X[1] + k[2] * X[2];
    const double across[] = {k[1] * X[2] - k[2] * X[1], k[2] * X[0] - k[0] * X[2],
                             k[0] * X[1] - k[1] * X[0]};
    double P[3];
    for (int j = 0; j < 3; ++j) {
      P[j] = X[j] * std::cos(angle) + across[j] * std::sin(angle) +
             k[j] * along * (1 - std::cos(angle)) + c[3 + j];
    }
    const double p[] = {-P[0] / P[2], -P[1] / P[2]};
    const double s = p[0] * p[0] + p[1] * p[1];
    const double g = c[6] * (1 + c[7] * s + c[8] * s * s);
    sum += std::pow(g * p[0] - seen[4 * i + 2], 2) + std::pow(g * p[1] - seen[4 * i + 3], 2);
  }
  return sum / 2;
}

TEST(file_bal, cameras_look_forward_and_pixels_go_down) {
  const Bundle bundle = parseBal(kBal, "text");
  ASSERT_EQ(bundle.T_world_body.size(), 2u);
  ASSERT_EQ(bundle.points.size(), 2u);
  ASSERT_EQ(bundle.pixels.size(), 3u);
  EXPECT_EQ(bundle.pixels[0][1], -20);
  EXPECT_EQ(bundle.pixels[2][0], 4);
  EXPECT_EQ(bundle.pixels[2][1], 0.25);
  EXPECT_EQ(bundle.cameras[1],
            Camera::fromParameters("radtan", 1, 1, {600, 600, 0, 0, 0.01, 0, 0, 0}));
  EXPECT_TRUE(bundle.camera_freedom[0].keeps_aspect);
  EXPECT_EQ(bundle.camera_freedom[0].parameters, 0x31u);
  for (std::size_t i = 0; i < bundle.pixels.size(); ++i) {
    EXPECT_EQ(bundle.observation_camera[i], bundle.observation_pose[i]);
  }
  const double cost = costOfText(kBal);
  EXPECT_NEAR(file_tools::radialCost(bundle), cost, 1e-12 * cost);
}

TEST(file_bal, what_is_written_has_the_same_cost) {
  const file_tools::NewFolder folder;
  const Bundle bundle = parseBal(kBal, "text");
  writeBal(bundle, folder / "out.txt");
  const Bundle again = readBal(folder / "out.txt");
  const double cost = file_tools::radialCost(bundle);
  EXPECT_NEAR(file_tools::radialCost(again), cost, 1e-14 * cost);
  EXPECT_EQ(again.points, bundle.points);
  EXPECT_EQ(again.pixels, bundle.pixels);
  EXPECT_EQ(again.cameras, bundle.cameras);
}

TEST(file_bal, rotations_near_half_a_turn_come_back) {
  const file_tools::NewFolder folder;
  for (const char* const rotation : {"3.1415926535 0 0", "0 -3.14159265358979 1e-9", "0 0 0",
                                     "1e-12 0 1e-300", "2.2 2.2 -0.5", "6 1 0"}) {
    std::string text = "1 1 1\n0 0 1 2\n";
    text += std::string(rotation) + "\n1 2 3\n500 0 0\n4 5 6\n";
    const Bundle bundle = parseBal(text, "text");
    writeBal(bundle, folder / "out.txt");
    const Bundle again = readBal(folder / "out.txt");
    EXPECT_TRUE(again.T_world_body[0].isApprox(bundle.T_world_body[0], 1e-14)) << rotation;
  }
}

TEST(file_bal, ladybug_has_the_published_cost_and_keeps_it) {
  NEEDS_TEST_DATA();
  const file_tools::NewFolder folder;
  const Bundle bundle = readBal(dataFile("problem-49-7776-pre.txt"));
  EXPECT_EQ(bundle.T_world_body.size(), 49u);
  EXPECT_EQ(bundle.points.size(), 7776u);
  EXPECT_EQ(bundle.pixels.size(), 31843u);
  const double cost = file_tools::radialCost(bundle);
  EXPECT_NEAR(cost, 8.509125e5, 0.5);
  EXPECT_NEAR(costOfText(contentOf(dataFile("problem-49-7776-pre.txt"))), cost, 1e-11 * cost);
  writeBal(bundle, folder / "out.txt");
  const Bundle again = readBal(folder / "out.txt");
  EXPECT_NEAR(file_tools::radialCost(again), cost, 1e-14 * cost);
  EXPECT_NEAR(costOfText(contentOf(folder / "out.txt")), cost, 1e-11 * cost);
  EXPECT_EQ(again.points, bundle.points);
  EXPECT_EQ(again.pixels, bundle.pixels);
}

TEST(file_bal, tiny_files_are_read) {
  NEEDS_TEST_DATA();
  for (const char* const name :
       {"dubrovnik-1-1-pre.txt", "dubrovnik-3-7-18-pre.txt", "dubrovnik-3-7-pre.txt"}) {
    const std::string path = dataFile("gtsam/") + name;
    const Bundle bundle = readBal(path);
    const double cost = costOfText(contentOf(path));
    EXPECT_NEAR(file_tools::radialCost(bundle), cost, 1e-10 * cost) << name;
  }
}

TEST(file_bal, bad_text_is_refused_with_its_place) {
  const auto parse = [](const std::string& text) { return [text] { parseBal(text, "text"); }; };
  expectParseError(parse(""), 1, "the file ends, expected the number of cameras");
  expectParseError(parse("4000000000 4000000000 1\n"), 1, "too short for 4000000000 cameras");
  expectParseError(parse("99999999999 1 1\n"), 1, "expected below 4294967295");
  expectParseError(parse("-1 1 1\n"), 1, "'-1' is the number of cameras");
  std::string text = kBal;
  expectParseError(parse(text + "7\n"), 13, "'7' is too much");
  expectParseError(parse(text.substr(0, text.size() - 4)), 12, "the file ends, expected");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return parse(changed);
  };
  expectParseError(with("1 1 +4", "2 1 +4"), 4, "'2' is a camera's number, expected below 2");
  expectParseError(with("1 1 +4", "1 2 +4"), 4, "'2' is a point's number, expected below 2");
  expectParseError(with("-3.5", "nan"), 3,
                   "'nan' is x of an observation, expected a finite number");
  expectParseError(with("-3.5", "1e999"), 3, "'1e999'");
  expectParseError(with("-3.5", "0x10"), 3, "'0x10'");
  expectParseError(with("-3.5", "3,5"), 3, "'3,5'");
  expectParseError(with("500", "-500"), 5, "fx is -500");
  expectParseError(with("500", "0"), 5, "fx is 0");
  expectParseError(with("1 2 -3\n", "1e308 1.7e308 1e308\n"), 5, "is too far away");
  file_tools::expectNoCrashForBeginnings(text, [](const std::string& t) { parseBal(t, "text"); });
}

TEST(file_bal, spaces_and_small_numbers_do_not_matter) {
  std::string text = kBal;
  text.replace(text.find("1e-7"), 4, "1e-400");  // below all doubles
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : text) windows += c == '\n' ? std::string("\r\n\t") : std::string(1, c);
  EXPECT_EQ(parseBal(windows, "text").points, parseBal(kBal, "text").points);
}

TEST(file_bal, files_that_are_no_text_are_refused) {
  const file_tools::NewFolder folder;
  EXPECT_THROW(readBal(folder / "none.txt"), gslam::FileError);
  EXPECT_THROW(readBal(folder / ""), gslam::FileError);
  std::ofstream(folder / "packed.txt") << "BZh91AY";
  try {
    readBal(folder / "packed.txt");
    ADD_FAILURE();
  } catch (const gslam::FileError& error) {
    EXPECT_NE(std::string(error.what()).find("decompress"), std::string::npos);
  }
}

TEST(file_bal, what_it_cannot_hold_is_refused) {
  const file_tools::NewFolder folder;
  const Bundle bundle = parseBal(kBal, "text");
  const auto refuses = [&](const auto& change, const std::string& words) {
    Bundle changed = bundle;
    change(changed);
    expectArgumentError([&] { writeBal(changed, folder / "out.txt"); }, words);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.txt"));
  };
  const auto camera = [](const char* model, const std::vector<double>& values) {
    return [=](Bundle& b) { b.cameras[1] = Camera::fromParameters(model, 9, 9, values); };
  };
  refuses(camera("radtan", {5, 5, 0, 0, 0, 0, 1e-3, 0}), "cameras[1] has p1 and p2 besides: BAL");
  refuses(camera("pinhole", {5, 6, 0, 0}), "two focal lengths");
  refuses(camera("kannala_brandt", {5, 5, 0, 0, 0, 0, 0, 0}), "is kannala_brandt");
  refuses([](Bundle& b) { b.cameras[1] = Camera(); }, "no camera");
  refuses([](Bundle& b) { b.information.assign(3, {2, 0, 2}); }, "cannot hold weights");
  refuses([](Bundle& b) { b.observation_camera[1] = 0; }, "cannot hold a rig");
  refuses([](Bundle& b) { b.observation_pose[1] = 7; }, "observation_pose[1] is 7");
  refuses([](Bundle& b) { b.observation_point.pop_back(); }, "has 2 elements, expected 3");
  refuses(
      [](Bundle& b) {
        b.T_body_camera.assign(2, gslam::SE3d({}, {1, 0, 0}));
      },
      "cannot hold a rig");
}

TEST(file_bal, shared_pinhole_cameras_keep_their_cost) {
  const file_tools::NewFolder folder;
  Bundle bundle = parseBal(kBal, "text");
  bundle.cameras = {Camera::fromParameters("radtan", 640, 480, {500, 500, 320, 240, 0, 0, 0, 0})};
  bundle.camera_freedom.clear();
  bundle.observation_camera.assign(3, 0);
  const double cost = file_tools::radialCost(bundle);
  writeBal(bundle, folder / "out.txt");
  EXPECT_NEAR(file_tools::radialCost(readBal(folder / "out.txt")), cost, 1e-12 * cost);
}

}  // namespace
