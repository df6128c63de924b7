// PLY: what is written is read back; what others write is read, or refused.
#include <gmock/gmock.h>
#include <gslam/core/ply.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "random_map.h"

namespace {

using gslam::Color;
using gslam::Keyframe;
using gslam::loadPly;
using gslam::Map;
using gslam::MapPoint;
using gslam::PlyOptions;
using gslam::savePly;
using gslam::Vec3d;
using gslam::Vec3f;
using gslam_test::RandomMap;
using testing::HasSubstr;

std::string path() {
  return testing::TempDir() + "gslam_ply_test.ply";
}

std::string saved(const Map& map, const PlyOptions& options) {
  savePly(path(), map, options);
  std::ifstream file(path(), std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::remove(path().c_str());
  return text;
}

std::vector<MapPoint> parse(const std::string& text) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  return gslam::parsePly(gslam::Span<const std::uint8_t>(bytes, text.size()), "x.ply");
}

std::string plyProblem(const std::string& text) {
  try {
    parse(text);
  } catch (const gslam::ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(Ply, GivesPointsBack) {
  const Map map = RandomMap(1).map(5, 200);
  for (const bool is_binary : {true, false}) {
    PlyOptions options;
    options.is_binary = is_binary;
    savePly(path(), map, options);
    const std::vector<MapPoint> points = loadPly(path());
    std::remove(path().c_str());
    ASSERT_EQ(points.size(), map.points().size());
    std::size_t i = 0;
    for (const auto& item : map.points()) {
      EXPECT_EQ(points[i].position, item.value.position);
      EXPECT_EQ(points[i].normal, item.value.normal);
      EXPECT_EQ(points[i].color, item.value.color);
      ++i;
    }
  }
}

// Two points, one with a colour; one keyframe.
TEST(Ply, IsWrittenAsTextThatPeopleCanRead) {
  Map map;
  MapPoint point;
  point.position = {1, 2.5, -300000.125};
  map.add(point);
  point.color = Color{10, 20, 30, 255};
  point.position = {0, 0, 1e300};
  map.add(point);
  Keyframe keyframe;
  keyframe.stamp = 1500000000;
  map.add(keyframe);
  PlyOptions options;
  options.is_binary = false;
  EXPECT_EQ(saved(map, options),
            "ply\n"
            "format ascii 1.0\n"
            "comment GSLAM map\n"
            "element vertex 2\n"
            "property double x\n"
            "property double y\n"
            "property double z\n"
            "property uchar red\n"
            "property uchar green\n"
            "property uchar blue\n"
            "element keyframe 1\n"
            "property double time\n"
            "property double x\n"
            "property double y\n"
            "property double z\n"
            "property double qx\n"
            "property double qy\n"
            "property double qz\n"
            "property double qw\n"
            "end_header\n"
            "1 2.5 -300000.125 255 255 255\n"
            "0 0 1e300 10 20 30\n"
            "1.5 0 0 0 0 0 0 1\n");
}

TEST(Ply, BinaryHasTheSizeThatItsHeaderSays) {
  Map map;
  MapPoint point;
  point.normal = {0, 0, 1};
  point.position = {7, 8, 9};
  map.add(point);
  PlyOptions options;
  options.has_keyframes = false;
  const std::string text = saved(map, options);
  const std::string end = "end_header\n";
  const std::size_t body = text.find(end) + end.size();
  ASSERT_EQ(text.size() - body, 3u * 8 + 3 * 4);
  const unsigned char seven[] = {0, 0, 0, 0, 0, 0, 0x1C, 0x40};
  EXPECT_EQ(std::memcmp(text.data() + body, seven, 8), 0);
}

TEST(Ply, FrustaLookWhereCamerasLook) {
  Map map;
  gslam::SensorRig rig;
  rig.cameras.resize(1);
  rig.cameras[0].camera =
      gslam::Camera::fromParameters("pinhole", 640, 480, {320, 320, 319.5, 239.5});
  rig.cameras[0].T_body_camera = gslam::SE3d(gslam::SO3d(), {0, 0, 1});
  map.setRig(rig);
  map.add(MapPoint());
  map.add(Keyframe());
  PlyOptions options;
  options.is_binary = false;
  options.frustum_depth = 2;
  const std::string text = saved(map, options);
  EXPECT_THAT(text, HasSubstr("element vertex 6\n"));
  EXPECT_THAT(text, HasSubstr("element edge 8\n"));
  EXPECT_EQ(parse(text).size(), 1u);  // the corners are no points
  options.is_binary = true;
  EXPECT_EQ(parse(saved(map, options)).size(), 1u);
  std::string all = text;
  all.replace(all.find("frustum"), 7, "unknown");
  const std::vector<MapPoint> points = parse(all);
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points[1].position, (Vec3d{0, 0, 1}));
  EXPECT_LT((points[2].position - Vec3d{-2, -1.5, 3}).norm(), 1e-12);
  EXPECT_LT((points[4].position - Vec3d{2, 1.5, 3}).norm(), 1e-12);
}

TEST(Ply, NumbersThatAreNoneComeBack) {
  Map map;
  MapPoint point;
  point.position = {NAN, INFINITY, -INFINITY};
  map.add(point);
  for (const bool is_binary : {true, false}) {
    PlyOptions options;
    options.is_binary = is_binary;
    const Vec3d p = parse(saved(map, options)).at(0).position;
    EXPECT_TRUE(std::isnan(p[0]));
    EXPECT_EQ(p[1], INFINITY);
    EXPECT_EQ(p[2], -INFINITY);
  }
}

const char kHeader[] =
    "ply\r\n"
    "format ascii 1.0\r\n"
    "comment made by hand\r\n"
    "obj_info x\r\n"
    "element face 2\r\n"
    "property list uchar int vertex_indices\r\n"
    "element vertex 2\r\n"
    "property float z\r\n"
    "property list uchar float weights\r\n"
    "property float32 y\r\n"
    "property float64 x\r\n"
    "property uint8 diffuse_red\r\n"
    "property float green\r\n"
    "property ushort blue\r\n"
    "property float confidence\r\n"
    "end_header\r\n";

TEST(Ply, ReadsWhatOthersWrite) {
  const std::vector<MapPoint> points = parse(std::string(kHeader) +
                                             "3 0 1 2\r\n"
                                             "0\r\n"
                                             "+3 2 1 1 .5 1. 255 0.5 65535 9\r\n"
                                             "\t6e0 0 -05 4 0 -1 25957 1\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position, (Vec3d{1, 0.5, 3}));
  EXPECT_EQ(points[0].color, (Color{255, 128, 255, 255}));
  EXPECT_EQ(points[0].normal, Vec3f{});
  EXPECT_EQ(points[1].position, (Vec3d{4, -5, 6}));
  EXPECT_EQ(points[1].color, (Color{0, 0, 101, 255}));
}

TEST(Ply, ReadsBothOrdersOfBytes) {
  const std::string header =
      "element face 1\nproperty list int int vertex_indices\n"
      "element vertex 1\nproperty float x\nproperty short y\nproperty double z\nend_header\n";
  const std::string little("\2\0\0\0\1\0\0\0\2\0\0\0\0\0\x80\x3F\xFE\xFF\0\0\0\0\0\0\x08\x40", 26);
  const std::string big("\0\0\0\2\0\0\0\1\0\0\0\2\x3F\x80\0\0\xFF\xFE\x40\x08\0\0\0\0\0\0", 26);
  const Vec3d expected = {1, -2, 3};
  EXPECT_EQ(parse("ply\nformat binary_little_endian 1.0\n" + header + little).at(0).position,
            expected);
  EXPECT_EQ(parse("ply\nformat binary_big_endian 1.0\n" + header + big).at(0).position, expected);
}

TEST(Ply, SaysWhatIsWrong) {
  const std::string begin = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_THAT(plyProblem(""), HasSubstr("x.ply: ends in its header"));
  EXPECT_THAT(plyProblem("plyx\n"), HasSubstr("x.ply:1: is no PLY file"));
  EXPECT_THAT(plyProblem("ply\nformat text 1.0\n"), HasSubstr("x.ply:2: has a format"));
  EXPECT_THAT(plyProblem(begin + "end_header\n"), HasSubstr("has no vertices"));
  EXPECT_THAT(plyProblem("ply\nend_header\n"), HasSubstr("does not say its format"));
  EXPECT_THAT(plyProblem(begin + "property float x\n"), HasSubstr("before its first element"));
  EXPECT_THAT(plyProblem(begin + "element vertex -1\n"), HasSubstr("count"));
  EXPECT_THAT(plyProblem(begin + "element vertex 1\nproperty real x\n"), HasSubstr("x.ply:4"));
  EXPECT_THAT(plyProblem(begin + "element vertex 1\nproperty float x\nend_header\n1\n"),
              HasSubstr("without x, y and z"));
  EXPECT_THAT(plyProblem(begin + "element vertex 1\n" + xyz + "1 2\n     "),
              HasSubstr("too early"));
  EXPECT_THAT(plyProblem(begin + "element vertex 1\n" + xyz + "1 2\n3x\n"),
              HasSubstr("x.ply:9: found '3x', expected a number"));
  EXPECT_THAT(plyProblem(begin + "element dust 5\nelement vertex 1\n" + xyz + "1 2 3\n"),
              HasSubstr("'dust' without properties"));
}

TEST(Ply, BelievesNoCount) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string begin = std::string("ply\nformat ") + format + " 1.0\n";
    EXPECT_THAT(plyProblem(begin + "element vertex 9000000000000000000\n" + xyz + "1 2 3\n"),
                HasSubstr("a count of 9000000000000000000 with 6 bytes left"));
    EXPECT_NE(plyProblem(begin + "element face 1\nproperty list uint int i\nelement vertex 1\n" +
                         xyz + "\xFF\xFF\xFF\xFF 1 2 3 4 5 6\n"),
              "");
  }
}

TEST(Ply, RefusesEveryPrefix) {
  const Map map = RandomMap(1).map(0, 3);
  for (const bool is_binary : {true, false}) {
    PlyOptions options;
    options.is_binary = is_binary;
    options.has_keyframes = false;
    const std::string whole = saved(map, options);
    const std::size_t least = whole.size() - (is_binary ? 0 : 5);  // the last number may be shorter
    for (std::size_t size = 0; size < least; ++size) {
      EXPECT_NE(plyProblem(whole.substr(0, size)), "") << size;
    }
  }
}

TEST(Ply, RefusesWhatIsNoFile) {
  EXPECT_THROW(loadPly(path()), gslam::FileError);
  EXPECT_THROW(loadPly(testing::TempDir()), gslam::Error);
  EXPECT_THROW(savePly(testing::TempDir() + "missing/x.ply", Map()), gslam::FileError);
}

}  // namespace
