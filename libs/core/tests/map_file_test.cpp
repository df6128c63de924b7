// Maps as files: all comes back, on paper as in code, and what is damaged is refused.
#include <gmock/gmock.h>
#include <gslam/core/detail/map_layout.h>
#include <gslam/core/map_check.h>
#include <gslam/core/map_file.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "random_map.h"

namespace {

using gslam::CameraImage;
using gslam::Image;
using gslam::Keyframe;
using gslam::KeyframeId;
using gslam::loadMap;
using gslam::Map;
using gslam::mapFromBytes;
using gslam::MapPoint;
using gslam::mapToBytes;
using gslam::PointId;
using gslam::saveMap;
using gslam::SE3d;
using gslam::SensorRig;
using gslam_test::RandomMap;
using testing::HasSubstr;
using testing::IsEmpty;

using Bytes = std::vector<std::uint8_t>;

std::string pathOf(const std::string& name) {
  return testing::TempDir() + "gslam_map_file_test_" + name;
}

// ---- everything is equal

bool same(const SE3d& a, const SE3d& b) {
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

void expectSame(const SensorRig& a, const SensorRig& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].name, b.cameras[i].name);
    EXPECT_EQ(a.cameras[i].kind, b.cameras[i].kind);
    EXPECT_EQ(a.cameras[i].camera, b.cameras[i].camera);
    EXPECT_EQ(a.cameras[i].rate, b.cameras[i].rate);
    EXPECT_EQ(a.cameras[i].depth_scale, b.cameras[i].depth_scale);
    EXPECT_TRUE(same(a.cameras[i].T_body_camera, b.cameras[i].T_body_camera));
  }
  EXPECT_EQ(a.has_imu, b.has_imu);
  EXPECT_TRUE(same(a.imu.T_body_imu, b.imu.T_body_imu));
  EXPECT_EQ(a.imu.rate, b.imu.rate);
  EXPECT_EQ(a.has_gnss, b.has_gnss);
  EXPECT_EQ(a.gnss_antenna, b.gnss_antenna);
}

void expectSame(const CameraImage& a, const CameraImage& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.exposure, b.exposure);
  EXPECT_EQ(a.depth_scale, b.depth_scale);
  EXPECT_TRUE(same(a.T_body_camera, b.T_body_camera));
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.image, b.image);
}

void expectSame(const Keyframe& a, const Keyframe& b) {
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_TRUE(same(a.T_world_body, b.T_world_body));
  EXPECT_EQ(a.content->descriptors, b.content->descriptors);
  ASSERT_EQ(a.content->features.size(), b.content->features.size());
  for (std::size_t i = 0; i < a.content->features.size(); ++i) {
    const auto &f = a.content->features[i], &g = b.content->features[i];
    EXPECT_EQ(f.pixel, g.pixel);
    EXPECT_EQ(f.size, g.size);
    EXPECT_EQ(f.angle, g.angle);
    EXPECT_EQ(f.response, g.response);
    EXPECT_EQ(f.octave, g.octave);
    EXPECT_EQ(f.camera, g.camera);
  }
  ASSERT_EQ(a.content->images.size(), b.content->images.size());
  for (std::size_t i = 0; i < a.content->images.size(); ++i) {
    expectSame(a.content->images[i], b.content->images[i]);
  }
}

void expectSamePoints(const Map& a, const Map& b) {
  ASSERT_EQ(a.points().size(), b.points().size());
  for (const auto& item : a.points()) {
    const MapPoint& point = b.at(item.id);
    EXPECT_EQ(item.value.position, point.position);
    EXPECT_EQ(item.value.normal, point.normal);
    EXPECT_EQ(item.value.color, point.color);
    EXPECT_EQ(item.value.label, point.label);
    EXPECT_EQ(item.value.kind, point.kind);
    const auto seen = a.observations(item.id), by = b.observations(item.id);
    ASSERT_EQ(seen.size(), by.size());
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], by[i]);
    ASSERT_EQ(a.shape(item.id) != nullptr, b.shape(item.id) != nullptr);
    if (a.shape(item.id) != nullptr) {
      EXPECT_EQ(a.shape(item.id)->size, b.shape(item.id)->size);
      EXPECT_EQ(a.shape(item.id)->R_world_shape.quaternion(),
                b.shape(item.id)->R_world_shape.quaternion());
    }
    ASSERT_EQ(a.descriptor(item.id) != nullptr, b.descriptor(item.id) != nullptr);
    if (a.descriptor(item.id) != nullptr) {
      EXPECT_EQ(*a.descriptor(item.id), *b.descriptor(item.id));
    }
  }
}

void expectSame(const Map& a, const Map& b) {
  EXPECT_EQ(a.nextKeyframeId(), b.nextKeyframeId());
  EXPECT_EQ(a.nextPointId(), b.nextPointId());
  EXPECT_EQ(a.nextEdgeId(), b.nextEdgeId());
  expectSame(a.rig(), b.rig());
  ASSERT_EQ(a.keyframes().size(), b.keyframes().size());
  for (const auto& item : a.keyframes()) {
    ASSERT_NE(b.find(item.id), nullptr);
    expectSame(item.value, b.at(item.id));
  }
  expectSamePoints(a, b);
  ASSERT_EQ(a.edges().size(), b.edges().size());
  for (const auto& item : a.edges()) {
    const gslam::PoseEdge& edge = b.at(item.id);
    EXPECT_EQ(item.value.from, edge.from);
    EXPECT_EQ(item.value.to, edge.to);
    EXPECT_EQ(item.value.kind, edge.kind);
    EXPECT_EQ(item.value.scale, edge.scale);
    EXPECT_TRUE(same(item.value.T_from_to, edge.T_from_to));
    EXPECT_EQ(std::memcmp(&item.value.information, &edge.information, 288), 0);
  }
  EXPECT_THAT(gslam::validate(b), IsEmpty());
}

TEST(MapFile, GivesEverythingBack) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Map map = RandomMap(seed).map(20, 700);
    const std::string path = pathOf("round_trip");
    saveMap(path, map);
    const Map loaded = loadMap(path);
    expectSame(map, loaded);
    EXPECT_EQ(mapToBytes(loaded), mapToBytes(map));
    std::remove(path.c_str());
  }
}

TEST(MapFile, GivesBackWhatFillsManySections) {
  RandomMap random(3);
  Map map;
  const KeyframeId a = map.add(random.keyframe(30000, false));
  const KeyframeId b = map.add(random.keyframe(30000, true));
  map.setImages(a, {CameraImage()});
  for (std::uint32_t i = 0; i < 30000; ++i) {
    const PointId id = map.add(random.point());
    map.observe(id, a, i);
    map.observe(id, b, 29999 - i);
    map.setShape(id, random.shape());
    map.setDescriptor(id, map.at(a).content->descriptors.view(0, int(i), 4, 1));
  }
  for (int i = 0; i < 3000; ++i) map.add(random.edge(a, b));
  expectSame(map, mapFromBytes(mapToBytes(map)));
}

TEST(MapFile, GivesBackAnEmptyMap) {
  expectSame(Map(), mapFromBytes(mapToBytes(Map())));
}

TEST(MapFile, KeepsTheGapsOfViewsOut) {
  Map map;
  gslam::KeyframeContent content;
  content.images.resize(1);
  const Image large = RandomMap(1).image(10, 10, gslam::PixelType::u16, 2);
  content.images[0].image = large.view(3, 2, 4, 5);
  Keyframe keyframe;
  keyframe.content = std::make_shared<const gslam::KeyframeContent>(content);
  const KeyframeId id = map.add(keyframe);
  const Map loaded = mapFromBytes(mapToBytes(map));
  const Image& image = loaded.at(id).content->images[0].image;
  EXPECT_TRUE(image.isDense());
  EXPECT_EQ(image, large.view(3, 2, 4, 5));
}

// ---- a reader made from the text in map_file.h, with nothing of the library's

struct PaperReader {
  explicit PaperReader(const Bytes& all) : bytes(all) {}
  const Bytes& bytes;
  std::size_t place = 0;

  std::uint64_t u(int size) {
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i) value |= std::uint64_t(bytes.at(place++)) << (8 * i);
    return value;
  }
  double f64() {
    const std::uint64_t bits = u(8);
    double value;
    std::memcpy(&value, &bits, 8);
    return value;
  }
  float f32() {
    const std::uint32_t bits = std::uint32_t(u(4));
    float value;
    std::memcpy(&value, &bits, 4);
    return value;
  }
  std::string text(std::size_t size) {
    place += size;
    return std::string(bytes.begin() + std::ptrdiff_t(place - size),
                       bytes.begin() + std::ptrdiff_t(place));
  }
  std::string text() { return text(u(4)); }
  std::vector<double> pose() {
    std::vector<double> numbers;
    for (int i = 0; i < 7; ++i) numbers.push_back(f64());
    return numbers;
  }
  std::string camera() {
    const std::string model = text();
    if (model.empty()) return model;
    place += 8;
    place += 8 * u(4);
    return model;
  }
  Bytes image() {
    const std::uint64_t width = u(4), height = u(4), channels = u(2), type = u(1);
    const std::uint64_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 2, 4, 8, 8};
    place += 1;
    const std::string pixels = text(width * height * channels * sizes[type]);
    return Bytes(pixels.begin(), pixels.end());
  }
};

struct Paper {
  std::map<std::uint64_t, std::vector<double>> poses, positions;
  std::map<std::uint64_t, std::vector<float>> features;
  std::map<std::uint64_t, Bytes> descriptors, images;
  std::vector<std::vector<std::uint64_t>> observations, edges;
  std::vector<std::string> cameras;

  explicit Paper(const Bytes& bytes) {
    PaperReader in(bytes);
    EXPECT_EQ(in.text(8), "GSLAMMAP");
    EXPECT_EQ(in.u(4), 1u);
    EXPECT_EQ(in.u(4), 0u);
    for (std::string tag; tag != "END ";) {
      tag = in.text(4);
      EXPECT_EQ(in.u(4), 0u);
      const std::uint64_t length = in.u(8);
      const std::size_t end = in.place + length;
      read(tag, in);
      if (tag == "HEAD" || tag == "SHAP") in.place = end;
      EXPECT_EQ(in.place, end) << tag;
      in.u(8);
    }
    EXPECT_EQ(in.place, bytes.size());
  }

  void read(const std::string& tag, PaperReader& in) {
    if (tag == "RIG ") return readRig(in);
    if (tag == "HEAD" || tag == "SHAP") return;
    if (tag == "DESC") return readDescriptors(in);
    if (tag == "END ") in.place += 8;
    if (tag == "END ") return;
    for (std::uint64_t n = in.u(4); n != 0; --n) {
      if (tag == "KEYF") readKeyframe(in);
      if (tag == "PNTS") readPoint(in);
      if (tag == "EDGE") readEdge(in);
      if (tag != "OBSV") continue;
      const std::uint64_t point = in.u(4);
      for (std::uint64_t m = in.u(4); m != 0; --m) {
        const std::uint64_t keyframe = in.u(4);
        observations.push_back({point, keyframe, in.u(4)});
      }
    }
  }
  void readRig(PaperReader& in) {
    for (std::uint64_t n = in.u(4); n != 0; --n) {
      const std::string name = in.text();
      in.place += 17;
      in.pose();
      cameras.push_back(name + " " + in.camera());
    }
    in.place += 1 + 56 + 40 + 1 + 24;
  }
  void readKeyframe(PaperReader& in) {
    const std::uint64_t id = in.u(4);
    in.place += 16;
    poses[id] = in.pose();
    for (std::uint64_t m = in.u(4); m != 0; --m) {
      for (int i = 0; i < 5; ++i) features[id].push_back(in.f32());
      features[id].push_back(float(std::int16_t(in.u(2))));
      features[id].push_back(float(in.u(2)));
    }
    in.image();
    for (std::uint64_t k = in.u(4); k != 0; --k) {
      in.text();
      in.place += 17;
      in.pose();
      in.camera();
      images[id] = in.image();
    }
  }
  void readPoint(PaperReader& in) {
    const std::uint64_t id = in.u(4);
    for (int i = 0; i < 3; ++i) positions[id].push_back(in.f64());
    in.place += 12 + 4 + 4 + 4;
  }
  void readDescriptors(PaperReader& in) {
    std::vector<std::uint64_t> ids(in.u(4));
    for (std::uint64_t& id : ids) id = in.u(4);
    const Bytes rows = in.image();
    const std::ptrdiff_t size = std::ptrdiff_t(rows.size() / ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto row = rows.begin() + size * std::ptrdiff_t(i);
      descriptors[ids[i]] = Bytes(row, row + size);
    }
  }
  void readEdge(PaperReader& in) {
    const std::uint64_t id = in.u(4), from = in.u(4);
    edges.push_back({id, from, in.u(4)});
    in.place += 4 + 56 + 8 + 288;
  }
};

std::vector<double> numbersOf(const SE3d& pose) {
  const auto& t = pose.translation();
  const auto& q = pose.rotation().quaternion();
  return {t[0], t[1], t[2], q[0], q[1], q[2], q[3]};
}

TEST(MapFile, IsWhatItsDescriptionSays) {
  const Map map = RandomMap(8).map(10, 100);
  const Paper paper(mapToBytes(map));
  EXPECT_EQ(paper.cameras, (std::vector<std::string>{"left radtan", "right pinhole"}));
  ASSERT_EQ(paper.poses.size(), map.keyframes().size());
  for (const auto& item : map.keyframes()) {
    const std::uint32_t id = std::uint32_t(item.id);
    EXPECT_EQ(paper.poses.at(id), numbersOf(item.value.T_world_body));
    std::vector<float> numbers;
    for (const auto& f : item.value.content->features) {
      numbers.insert(numbers.end(), {f.pixel[0], f.pixel[1], f.size, f.angle, f.response,
                                     float(f.octave), float(f.camera)});
    }
    EXPECT_EQ(paper.features.count(id) == 0 ? std::vector<float>() : paper.features.at(id),
              numbers);
    if (item.value.content->images.empty()) continue;
    const Image& last = item.value.content->images.back().image;
    EXPECT_EQ(paper.images.at(id), Bytes(last.bytes(), last.bytes() + last.byteCount()));
  }
  ASSERT_EQ(paper.positions.size(), map.points().size());
  std::vector<std::vector<std::uint64_t>> observations;
  for (const auto& item : map.points()) {
    const std::uint32_t id = std::uint32_t(item.id);
    const auto& p = item.value.position;
    EXPECT_EQ(paper.positions.at(id), (std::vector<double>{p[0], p[1], p[2]}));
    for (const auto& by : map.observations(item.id)) {
      observations.push_back({id, std::uint32_t(by.keyframe), by.feature});
    }
    const Image* const row = map.descriptor(item.id);
    if (row == nullptr) continue;
    EXPECT_EQ(paper.descriptors.at(id), Bytes(row->bytes(), row->bytes() + row->rowBytes()));
  }
  EXPECT_EQ(paper.observations, observations);
  EXPECT_EQ(paper.edges.size(), map.edges().size());
}

TEST(MapFile, WritesZerosForWhatIsReserved) {
  Map map = RandomMap(2).map(4, 5);
  const Bytes bytes = mapToBytes(map);
  MapPoint point = (*map.points().begin()).value;
  point.reserved[1] = 7;
  map.set((*map.points().begin()).id, point);
  gslam::PoseEdge edge = (*map.edges().begin()).value;
  edge.reserved[6] = 7;
  map.set((*map.edges().begin()).id, edge);
  EXPECT_EQ(mapToBytes(map), bytes);
}

// A long product of rotations has a norm that is no longer 1 to the last bits.
TEST(MapFile, GivesPosesBackToTheBit) {
  RandomMap random(3);
  Map map;
  map.setRig(random.rig());
  for (int i = 0; i < 20; ++i) {
    Keyframe keyframe;
    keyframe.T_world_body = SE3d();
    for (int k = 0; k < 2000; ++k) keyframe.T_world_body *= random.pose();
    map.add(keyframe);
    gslam::Shape shape;
    shape.R_world_shape = keyframe.T_world_body.rotation();
    map.setShape(map.add(MapPoint()), shape);
  }
  const Map again = mapFromBytes(mapToBytes(map));
  bool have_drifted = false;
  for (const auto& item : map.keyframes()) {
    EXPECT_TRUE(same(again.at(item.id).T_world_body, item.value.T_world_body));
    const double norm = item.value.T_world_body.rotation().quaternion().squaredNorm();
    have_drifted = have_drifted || std::fabs(norm - 1) > 1e-15;
  }
  EXPECT_TRUE(have_drifted);
  expectSame(again, map);
  EXPECT_EQ(mapToBytes(again), mapToBytes(map));
}

TEST(MapFile, RefusesToWriteRotationsThatAreNone) {
  Map map = RandomMap(2).map(4, 5);
  const double none[7] = {std::nan(""), 0, 0, 1, 0, 0, 0};  // as arithmetic may give it
  SE3d pose;
  static_assert(sizeof(pose) == sizeof(none), "");
  std::memcpy(static_cast<void*>(&pose), none, sizeof(pose));
  map.setPose(KeyframeId(0), pose);
  const std::string path = pathOf("kept");
  saveMap(path, Map());
  EXPECT_THROW(saveMap(path, map), gslam::ArgumentError);
  EXPECT_NO_THROW(loadMap(path));
  std::remove(path.c_str());
}

// ---- damage

Map smallMap() {
  RandomMap random(2);
  Map map;
  map.setRig(random.rig());
  const KeyframeId a = map.add(random.keyframe(2, true)), b = map.add(random.keyframe(1, false));
  const PointId point = map.add(random.point());
  map.setShape(point, random.shape());
  map.setDescriptor(point, random.image(4, 1, gslam::PixelType::u8, 1));
  map.observe(point, a, 1);
  map.observe(point, b, 0);
  map.add(random.edge(a, b));
  return map;
}

TEST(MapFile, RefusesEveryPrefix) {
  const Bytes whole = mapToBytes(smallMap());
  ASSERT_NO_THROW(mapFromBytes(whole));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    // In a block of its own, so that sanitizers see what reads behind its end.
    const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(size));
    EXPECT_THROW(mapFromBytes(part), gslam::ParseError) << size;
  }
}

TEST(MapFile, RefusesEveryFlippedBit) {
  Bytes bytes = mapToBytes(smallMap());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const std::uint8_t mask = std::uint8_t(1 << bit % 8);
    bytes[bit / 8] ^= mask;
    EXPECT_THROW(mapFromBytes(bytes), gslam::ParseError) << bit;
    bytes[bit / 8] ^= mask;
  }
}

// Makes the checksums right, as somebody would who means harm.
void sign(Bytes& bytes) {
  for (std::size_t begin = 16; bytes.size() - begin >= 24;) {
    const std::uint64_t length = gslam::detail::loadLittle<std::uint64_t>(&bytes[begin + 8]);
    if (length > bytes.size() - begin - 24) return;
    const std::size_t end = begin + 16 + std::size_t(length);
    gslam::detail::storeLittle(&bytes[end], gslam::detail::Xxh64::of(&bytes[begin], end - begin));
    begin = end + 8;
  }
}

TEST(MapFile, TakesOnlyWholeMapsFromWhoeverMeansHarm) {
  const Bytes whole = mapToBytes(smallMap());
  std::size_t refused = 0;
  for (std::size_t i = 16; i < whole.size(); ++i) {
    for (const int value : {0x00, 0x01, 0x7F, 0x80, 0xFF}) {
      Bytes bytes = whole;
      bytes[i] = std::uint8_t(value);
      sign(bytes);
      try {
        const Map map = mapFromBytes(bytes);
        for (const std::string& problem : gslam::validate(map)) {
          EXPECT_THAT(problem, testing::AnyOf(HasSubstr("finite"), HasSubstr("symmetric"),
                                              HasSubstr("scale"), HasSubstr("diagonal"),
                                              HasSubstr("rig does not have")));
        }
        EXPECT_EQ(mapToBytes(mapFromBytes(mapToBytes(map))), mapToBytes(map));
      } catch (const gslam::ParseError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100u);
}

void addSection(Bytes& bytes, std::size_t place, const std::string& tag, const Bytes& payload) {
  Bytes section(tag.begin(), tag.end());
  section.resize(16);
  gslam::detail::storeLittle(&section[8], std::uint64_t(payload.size()));
  section.insert(section.end(), payload.begin(), payload.end());
  section.resize(section.size() + 8);
  bytes.insert(bytes.begin() + std::ptrdiff_t(place), section.begin(), section.end());
  bytes[bytes.size() - 16] = std::uint8_t(bytes[bytes.size() - 16] + 1);  // the count in END
  sign(bytes);
}

std::string mapProblem(const Bytes& bytes) {
  try {
    mapFromBytes(bytes, "x.map");
  } catch (const gslam::ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(MapFile, SkipsSectionsThatItDoesNotKnow) {
  const Bytes whole = mapToBytes(smallMap());
  Bytes bytes = whole;
  addSection(bytes, 16, "NEWS", {1, 2, 3});
  addSection(bytes, bytes.size() - 32, "more", {});
  EXPECT_EQ(mapToBytes(mapFromBytes(bytes)), whole);
}

TEST(MapFile, BelievesNoCount) {
  const Bytes huge = {0xFF, 0xFF, 0xFF, 0xFF};
  for (const char* const tag : {"RIG ", "KEYF", "PNTS", "SHAP", "DESC", "OBSV", "EDGE"}) {
    Bytes bytes = mapToBytes(Map());
    addSection(bytes, bytes.size() - 32, tag, huge);
    EXPECT_THAT(mapProblem(bytes), HasSubstr("x.map: byte ")) << tag;
    EXPECT_THAT(mapProblem(bytes), HasSubstr("a count of 4294967295 with 0 bytes left")) << tag;
  }
}

// The worst: each id in a page of its own, with little that is said of it.
TEST(MapFile, TakesNoMoreMemoryThanItSays) {
  using gslam::detail::MapLayout;
  const auto bytesOf = [](std::uint32_t points) {
    Map map;
    const KeyframeId seer = map.add(RandomMap(1).keyframe(points, false));
    for (std::uint32_t i = 0; i < points; ++i) {
      map.insert(PointId(i << 16), MapPoint());
      map.setDescriptor(PointId(i << 16), Image(1, 1, gslam::PixelType::u8));
      map.observe(PointId(i << 16), seer, i);
    }
    EXPECT_EQ(mapToBytes(mapFromBytes(mapToBytes(map))), mapToBytes(map));
    return mapToBytes(map).size();
  };
  const double bytes = double(bytesOf(300) - bytesOf(200)) / 100;  // of a point in a file
  constexpr double kCount = 64;                                    // of references, and of the heap
  const double tables[] = {
      sizeof(MapLayout::PointPage) + sizeof(MapLayout::PointNode) + sizeof(MapPoint) + 4 * kCount,
      sizeof(MapLayout::PointPage) + sizeof(MapLayout::PointNode) + sizeof(Image) + 4 * kCount,
      sizeof(MapLayout::ObservationPage) + sizeof(MapLayout::ObservationNode) +
          3 * sizeof(std::uint32_t) + sizeof(gslam::Observation) + 5 * kCount};
  EXPECT_LT(tables[0] / 52, 200);
  EXPECT_LT((tables[0] + tables[1]) / (52 + 5), 200);
  EXPECT_LT((tables[0] + tables[1] + tables[2]) / (52 + 5 + 16), 210);
  EXPECT_LT((tables[0] + tables[1] + tables[2]) / bytes, 200);
}

TEST(MapFile, SaysWhatIsWrong) {
  EXPECT_THAT(mapProblem(Bytes(100, 'x')), HasSubstr("x.map: byte 16: is no GSLAM map"));
  Bytes bytes = mapToBytes(Map());
  bytes[8] = 2;
  EXPECT_THAT(mapProblem(bytes), HasSubstr("has version 2 of the format, expected 1"));
  bytes = mapToBytes(Map());
  bytes.push_back(0);
  EXPECT_THAT(mapProblem(bytes), HasSubstr("behind its end"));
  bytes = mapToBytes(smallMap());
  bytes[200] ^= 1;
  EXPECT_THAT(mapProblem(bytes), HasSubstr("checksum"));
}

TEST(MapFile, RefusesAPointThatIsThereTwice) {
  Map map;
  map.add(MapPoint());
  Bytes bytes = mapToBytes(map);
  Bytes payload(4 + 52);
  payload[0] = 1;
  addSection(bytes, bytes.size() - 32, "PNTS", payload);
  EXPECT_THAT(mapProblem(bytes), HasSubstr("point 0 is in the map already"));
}

// ---- files

TEST(MapFile, RefusesWhatIsNoFile) {
  EXPECT_THROW(loadMap(pathOf("missing")), gslam::FileError);
  EXPECT_THROW(loadMap(testing::TempDir()), gslam::Error);
  const std::string path = pathOf("empty");
  std::ofstream{path};
  EXPECT_THROW(loadMap(path), gslam::ParseError);
  std::remove(path.c_str());
}

TEST(MapFile, LeavesNothingWhereItCannotBeWritten) {
  EXPECT_THROW(saveMap(pathOf("missing/x"), Map()), gslam::FileError);
  EXPECT_THROW(saveMap(testing::TempDir(), Map()), gslam::FileError);  // a folder is in the way
  EXPECT_FALSE(std::ifstream(testing::TempDir() + ".0.tmp"));
}

TEST(MapFile, ReplacesTheOldFileOnlyWhenTheNewIsWhole) {
  const std::string path = pathOf("replaced");
  const Map old = smallMap();
  saveMap(path, old);
  {
    gslam::detail::NewFile file(path);
    file.write("begun", 5);
    EXPECT_EQ(mapToBytes(loadMap(path)), mapToBytes(old));
  }  // given up, as by an exception
  EXPECT_EQ(mapToBytes(loadMap(path)), mapToBytes(old));
  EXPECT_FALSE(std::ifstream(path + ".0.tmp"));
  std::ofstream(path + ".0.tmp") << "of somebody else";
  saveMap(path, Map());
  EXPECT_TRUE(loadMap(path).points().empty());
  EXPECT_TRUE(std::ifstream(path + ".0.tmp"));
  std::remove((path + ".0.tmp").c_str());
  std::remove(path.c_str());
}

TEST(MapFile, KeepsLinksAndModes) {
  const std::string folder = pathOf("folder"), target = folder + "/target", link = folder + "/link";
  ASSERT_EQ(::mkdir(folder.c_str(), 0755), 0);
  ASSERT_EQ(::symlink("target", link.c_str()), 0);  // which is not there yet
  saveMap(link, smallMap());
  EXPECT_EQ(mapToBytes(loadMap(target)), mapToBytes(smallMap()));
  ASSERT_EQ(::chmod(target.c_str(), 0640), 0);
  saveMap(link, Map());
  struct stat facts;
  ASSERT_EQ(::lstat(link.c_str(), &facts), 0);
  EXPECT_TRUE(S_ISLNK(facts.st_mode));
  ASSERT_EQ(::lstat(target.c_str(), &facts), 0);
  EXPECT_TRUE(S_ISREG(facts.st_mode));
  EXPECT_EQ(facts.st_mode & 0777, 0640u);
  EXPECT_TRUE(loadMap(target).points().empty());
  const std::string circle = folder + "/circle";
  ASSERT_EQ(::symlink("circle", circle.c_str()), 0);
  std::remove(link.c_str());
  std::remove(target.c_str());
  std::remove(circle.c_str());
  EXPECT_EQ(::rmdir(folder.c_str()), 0);  // nothing else is in it
}

TEST(MapFile, WritesIntoPipesAndDevices) {
  saveMap("/dev/null", smallMap());
  struct stat facts;
  ASSERT_EQ(::stat("/dev/null", &facts), 0);
  EXPECT_TRUE(S_ISCHR(facts.st_mode));
  const std::string path = pathOf("pipe");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&path] { saveMap(path, smallMap()); });
  std::ifstream pipe(path, std::ios::binary);
  const Bytes bytes((std::istreambuf_iterator<char>(pipe)), std::istreambuf_iterator<char>());
  writer.join();
  EXPECT_EQ(bytes, mapToBytes(smallMap()));
  ASSERT_EQ(::stat(path.c_str(), &facts), 0);
  EXPECT_TRUE(S_ISFIFO(facts.st_mode));
  std::remove(path.c_str());
}

}  // namespace
