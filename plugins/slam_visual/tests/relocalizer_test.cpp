#include "tracking/relocalizer.h"

#include <gtest/gtest.h>

#include <string>

#include "made_scene.h"

namespace {

using gslam::KeyframeId;
using gslam::SE3d;
using made::Journey;
using made::kStep;
using made::Room;
using visual::Match;
using visual::SensorKind;

// A map without drift of a part of the room.
struct MappedRoom {
  explicit MappedRoom(SensorKind kind, int keyframes = 25, std::size_t points = 3000)
      : room(made::makeRoom(1, points)), journey(kind, {}, 5) {
    journey.visitCircle(room, 0, kStep, keyframes);
    for (int i = 0; i < keyframes; ++i) {
      const KeyframeId id = KeyframeId(i);
      places.add(id, journey.world.scene().of(id).view);
    }
  }
  bool locate(const made::Seen& seen) {
    return relocalizer.locate(*seen.view, journey.world.scene(), nullptr, matches, found);
  }

  Room room;
  Journey journey;
  visual::Options options;
  visual::PlaceIndex places{options.loop, 1};
  visual::Relocalizer relocalizer{options, places};
  std::vector<Match> matches;
  SE3d found;
};

SE3d kidnapped() {
  return made::cameraOnCircle(10.4 * kStep, 1.3) * SE3d(gslam::SO3d::exp({0.05, 0.1, 0.2}), {});
}

class RelocalizerTest : public testing::TestWithParam<SensorKind> {};

TEST_P(RelocalizerTest, FindsAViewFromElsewhereInTheMap) {
  MappedRoom mapped(GetParam());
  const made::Seen seen = mapped.journey.lookFrom(mapped.room, kidnapped(), 1);
  ASSERT_TRUE(mapped.locate(seen));
  const SE3d T_world_body = kidnapped() * mapped.journey.world.eye().T_body_camera.inverse();
  EXPECT_TRUE(mapped.found.isApprox(T_world_body, 0.015)) << mapped.found << '\n' << T_world_body;
  EXPECT_GT(mapped.matches.size(), seen.points.size() / 2);
  // Each match sees the point that it was made from, but for a few.
  std::size_t wrong = 0;
  for (const Match& match : mapped.matches) {
    const gslam::Vec3d truth = mapped.room.points[seen.points[match.feature]];
    const gslam::Vec3d point = mapped.journey.world.map().at(match.point).position;
    if ((truth - point).norm() > 0.1) ++wrong;
  }
  EXPECT_LT(wrong, mapped.matches.size() / 50);
}

TEST_P(RelocalizerTest, FindsItAmongFewKeyframesWithoutAVocabulary) {
  MappedRoom mapped(GetParam(), 11);
  EXPECT_FALSE(mapped.places.hasVocabulary());
  ASSERT_TRUE(mapped.locate(mapped.journey.lookFrom(mapped.room, kidnapped(), 1)));
}

TEST_P(RelocalizerTest, RefusesAnotherPlace) {
  MappedRoom mapped(GetParam());
  const Room other = made::makeRoom(2);
  EXPECT_FALSE(mapped.locate(mapped.journey.lookFrom(other, kidnapped(), 1)));
  EXPECT_TRUE(mapped.matches.empty());
  // The same room where the map does not reach.
  EXPECT_FALSE(
      mapped.locate(mapped.journey.lookFrom(mapped.room, made::cameraOnCircle(42 * kStep), 1)));
  EXPECT_FALSE(mapped.locate(mapped.journey.lookFrom(Room(), kidnapped(), 1)));
}

TEST_P(RelocalizerTest, RefusesTheSameThingsInAnotherOrder) {
  MappedRoom mapped(GetParam());
  Room mixed = mapped.room;
  made::Random random(3);
  for (std::size_t i = mixed.points.size() - 1; i > 0; --i) {
    std::swap(mixed.points[i], mixed.points[random.below(i + 1)]);
  }
  EXPECT_FALSE(mapped.locate(mapped.journey.lookFrom(mixed, kidnapped(), 1)));
}

// A poster that hangs elsewhere, too: all of it fits, but it is the middle of the image only.
TEST_P(RelocalizerTest, RefusesOneThingInAnotherPlace) {
  MappedRoom mapped(GetParam(), 25, 8000);
  Room elsewhere = mapped.room;
  const gslam::Camera& camera = mapped.journey.world.eye().camera;
  made::Random random(4);
  std::size_t on_poster = 0;
  for (std::size_t i = 0; i < elsewhere.points.size(); ++i) {
    gslam::Vec2d pixel;
    const gslam::Vec3d p = kidnapped().inverse() * elsewhere.points[i];
    if (p[2] > 0 && camera.project(p, pixel) && std::abs(pixel[0] - 320) < 98 &&
        std::abs(pixel[1] - 240) < 72) {
      ++on_poster;
    } else {
      elsewhere.drawDescriptor(i, random);
    }
  }
  ASSERT_GT(on_poster, 70U);  // enough of them to be sure, if they were everywhere
  EXPECT_FALSE(mapped.locate(mapped.journey.lookFrom(elsewhere, kidnapped(), 1)));
}

TEST_P(RelocalizerTest, SaysTheSameOfTheSame) {
  MappedRoom one(GetParam()), other(GetParam());
  ASSERT_TRUE(one.locate(one.journey.lookFrom(one.room, kidnapped(), 1)));
  ASSERT_TRUE(other.locate(other.journey.lookFrom(other.room, kidnapped(), 1)));
  EXPECT_EQ(one.found.matrix(), other.found.matrix());
  ASSERT_EQ(one.matches.size(), other.matches.size());
  for (std::size_t i = 0; i < one.matches.size(); ++i) {
    EXPECT_EQ(one.matches[i].feature, other.matches[i].feature);
    EXPECT_EQ(one.matches[i].point, other.matches[i].point);
  }
}

// The index knows keyframes that the scene, a copy of before, does not.
TEST_P(RelocalizerTest, IgnoresKeyframesThatAreNotThere) {
  MappedRoom mapped(GetParam());
  const made::Seen seen = mapped.journey.lookFrom(mapped.room, kidnapped(), 1);
  for (std::uint32_t i = 100; i < 105; ++i) mapped.places.add(KeyframeId(i), seen.view);
  EXPECT_TRUE(mapped.locate(seen));
}

INSTANTIATE_TEST_SUITE_P(Sensors, RelocalizerTest,
                         testing::Values(SensorKind::mono, SensorKind::rgbd), [](const auto& test) {
                           return test.param == SensorKind::mono ? std::string("mono")
                                                                 : std::string("rgbd");
                         });

}  // namespace
