#include <gslam/optimizer/files/bundler.h>
#include <gslam/optimizer/files/colmap.h>
#include <gtest/gtest.h>

#include <string>

#include "file_tools.h"
#include "test_data.h"

namespace {

using file_tools::expectArgumentError;
using file_tools::expectParseError;
using gslam::Bundle;
using gslam::Camera;
using gslam::parseColmap;
using gslam::readColmap;
using gslam::writeColmap;

struct Texts {
  std::string cameras =
      "# comment\n7 SIMPLE_RADIAL 640 480 500 320 240 -0.125\n3 OPENCV 100 80 90 91 50 40 0.1 0.2 "
      "0.3 0.4\n";
  std::string images =
      "# comment\n\n12 1 0 0 0 0.5 0.25 1 7 a name.jpg\n10.5 20.5 1000 3 4 -1 5.5 6.5 2000\n"
      "5 0 1 0 0 0 0 2 3 b.jpg\n\n"
      "2 0.6 0 0.8 0 0 0 2 3 c.jpg\n0.5 0.5 1000\n";
  std::string points = "2000 1 2 20 255 0 128 0.5 12 2\n1000 3 4 25 1 2 3 0.25 12 0 2 0\n";
};

Bundle parse(const Texts& texts) {
  return parseColmap(texts.cameras, texts.images, texts.points, "model");
}

// Reading text in which something was replaced.
auto with(std::string Texts::*file, const std::string& from, const std::string& to) {
  Texts texts;
  std::string& text = texts.*file;
  text.replace(text.find(from), from.size(), to);
  return [texts] { parse(texts); };
}

TEST(file_colmap, poses_cameras_and_pixels_are_ours) {
  const Bundle bundle = parse(Texts());
  EXPECT_EQ(bundle.image_names, (std::vector<std::string>{"a name.jpg", "b.jpg", "c.jpg"}));
  EXPECT_EQ(bundle.cameras[0],
            Camera::fromParameters("radtan", 640, 480, {500, 500, 319.5, 239.5, -0.125, 0, 0, 0}));
  EXPECT_EQ(bundle.cameras[1],
            Camera::fromParameters("radtan", 100, 80, {90, 91, 49.5, 39.5, 0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(bundle.camera_freedom[0].parameters, 0x11u);
  EXPECT_TRUE(bundle.camera_freedom[0].keeps_aspect);
  EXPECT_EQ(bundle.camera_freedom[1].parameters, 0xf3u);
  EXPECT_FALSE(bundle.camera_freedom[1].keeps_aspect);
  EXPECT_EQ(bundle.T_world_body[0].translation(), (gslam::Vec3d{-0.5, -0.25, -1}));
  EXPECT_EQ(bundle.pose_ids.indexOf(2), 2u);
  EXPECT_EQ(bundle.point_ids.idOf(0), 2000);
  EXPECT_EQ(bundle.camera_ids.idOf(1), 3);
  EXPECT_EQ(bundle.observation_pose, (std::vector<std::uint32_t>{0, 0, 2}));
  EXPECT_EQ(bundle.observation_point, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_EQ(bundle.observation_camera, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(bundle.pixels[0], (gslam::Vec2d{5, 6}));
  EXPECT_EQ(bundle.pixels[2], (gslam::Vec2d{0, 0}));
  EXPECT_FLOAT_EQ(bundle.colors[0][2], 128.f / 255);
}

TEST(file_colmap, what_is_written_comes_back) {
  const file_tools::NewFolder folder;
  Bundle bundle = parse(Texts());
  const std::string path = folder / "a/b";
  writeColmap(bundle, path);
  Bundle again = readColmap(path);
  // The image that sees nothing is gone: two cameras might be its own.
  EXPECT_EQ(again.image_names, (std::vector<std::string>{"a name.jpg", "c.jpg"}));
  EXPECT_EQ(again.pose_ids.idOf(1), 2);
  EXPECT_EQ(again.cameras, bundle.cameras);
  EXPECT_EQ(again.points, bundle.points);
  EXPECT_EQ(again.colors, bundle.colors);
  EXPECT_EQ(again.pixels, bundle.pixels);
  EXPECT_EQ(again.observation_point, bundle.observation_point);
  EXPECT_TRUE(again.T_world_body[1].isApprox(bundle.T_world_body[2], 1e-15));
  EXPECT_NEAR(file_tools::radialCost(again), file_tools::radialCost(bundle),
              1e-12 * file_tools::radialCost(bundle));
}

TEST(file_colmap, every_camera_model_comes_back) {
  const file_tools::NewFolder folder;
  Texts texts;
  const char* const cameras[] = {
      "SIMPLE_PINHOLE 9 8 5 4 3",
      "PINHOLE 9 8 5 6 4 3",
      "SIMPLE_RADIAL 9 8 5 4 3 0.1",
      "RADIAL 9 8 5 4 3 0.1 0.2",
      "OPENCV 9 8 5 6 4 3 0.1 0.2 0.3 0.4",
      "FULL_OPENCV 9 8 5 6 4 3 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8",
      "SIMPLE_RADIAL_FISHEYE 9 8 5 4 3 0.1",
      "RADIAL_FISHEYE 9 8 5 4 3 0.1 0.2",
      "OPENCV_FISHEYE 9 8 5 6 4 3 0.1 0.2 0.3 0.4",
      "FOV 9 8 5 6 4 3 0.9",
  };
  for (const char* const camera : cameras) {
    texts.cameras = "3 SIMPLE_PINHOLE 9 8 5 4 3\n7 " + std::string(camera) + "\n";
    const Bundle bundle = parse(texts);
    writeColmap(bundle, folder / "model");
    const std::string written = file_tools::contentOf(folder / "model/cameras.txt");
    EXPECT_NE(written.find("7 " + std::string(camera) + "\n"), std::string::npos) << written;
    const Bundle again = readColmap(folder / "model");
    EXPECT_EQ(again.cameras, bundle.cameras) << camera;
    EXPECT_EQ(again.camera_freedom[1].parameters, bundle.camera_freedom[1].parameters) << camera;
  }
}

TEST(file_colmap, five_coefficients_become_full_opencv) {
  const file_tools::NewFolder folder;
  Bundle bundle = parse(Texts());
  bundle.cameras[0] = Camera::fromParameters("radtan", 9, 8, {5, 6, 4, 3, 0.1, 0.2, 0, 0, 0.3});
  writeColmap(bundle, folder / "model");
  const Bundle again = readColmap(folder / "model");
  EXPECT_EQ(again.cameras[0],
            Camera::fromParameters("radtan", 9, 8, {5, 6, 4, 3, 0.1, 0.2, 0, 0, 0.3, 0, 0, 0}));
  bundle.cameras[0] = Camera::fromParameters("double_sphere", 9, 8, {5, 6, 4, 3, 0.1, 0.5});
  expectArgumentError([&] { writeColmap(bundle, folder / "model"); }, "is double_sphere");
}

TEST(file_colmap, bundler_becomes_colmap_with_the_same_cost) {
  NEEDS_TEST_DATA();
  const file_tools::NewFolder folder;
  const Bundle bundle = gslam::readBundler(test_data::folder() +
                                           "bundle_adjustment/bundler_balbianello/balbianello.out");
  writeColmap(bundle, folder / "model");
  const Bundle again = readColmap(folder / "model");
  const double cost = file_tools::radialCost(bundle);
  EXPECT_NEAR(file_tools::radialCost(again), cost, 1e-12 * cost);
  EXPECT_EQ(again.colors, bundle.colors);
}

TEST(file_colmap, bad_text_is_refused_with_its_place) {
  expectParseError(with(&Texts::cameras, "OPENCV", "OPENCVX"), 3, "'OPENCVX' is a camera model");
  expectParseError(with(&Texts::cameras, "3 OPENCV", "7 OPENCV"), 3, "that is there already");
  expectParseError(with(&Texts::cameras, " -0.125", ""), 2, "the line ends, expected");
  expectParseError(with(&Texts::cameras, " -0.125", " 1 2"), 2, "'2' is too much");
  expectParseError(with(&Texts::cameras, "640", "0"), 2, "width is 0");
  expectParseError(with(&Texts::cameras, "500", "-1"), 2, "fx is -1");
  expectParseError(with(&Texts::images, "7 a name", "8 a name"), 3,
                   "camera's id that is not there");
  expectParseError(with(&Texts::images, "1 0 0 0", "0 0 0 0"), 3, "norm 0");
  expectParseError(with(&Texts::images, " c.jpg", ""), 7, "the name of an image");
  expectParseError(with(&Texts::images, "4 -1", "4"), 4, "expected a whole number");
  expectParseError(with(&Texts::images, "0.5 0.5 1000", ""), 2,
                   "a feature's number, expected below 0");
  expectParseError(with(&Texts::images, "0.5 0.5 1000", "0.5 0.5 7"), 2, "of point 7");
  expectParseError(with(&Texts::points, "12 0 2 0", "12 0"), 8, "which does not know of it");
  expectParseError(with(&Texts::points, "12 0 2 0", "12 0 12 0"), 2, "had already");
  expectParseError(with(&Texts::points, "1000 3", "2000 3"), 2, "there already");
  expectParseError(with(&Texts::points, "12 2", "13 2"), 1, "image's id that is not there");
  expectParseError(with(&Texts::points, "255", "-1"), 1, "part of a colour");
  const Texts texts;
  file_tools::expectNoCrashForBeginnings(texts.images, [&](const std::string& images) {
    parseColmap(texts.cameras, images, texts.points, "model");
  });
  file_tools::expectNoCrashForBeginnings(texts.points, [&](const std::string& points) {
    parseColmap(texts.cameras, texts.images, points, "model");
  });
  EXPECT_THROW(readColmap("/nowhere"), gslam::FileError);
}

}  // namespace
