// One thread writes a map, others look at it: what they see is whole, and stays.
#include <gmock/gmock.h>
#include <gslam/core/map_check.h>
#include <gslam/core/shared_map.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "random_map.h"

namespace {

using gslam::KeyframeId;
using gslam::Map;
using gslam::MapPoint;
using gslam::PointId;
using gslam::SE3d;
using gslam::SharedMap;
using gslam_test::RandomMap;
using testing::IsEmpty;

constexpr std::size_t kPoints = 1000;

// Moves every point to a place that says in which round that was, and who sees them, too.
void writeRound(Map& map, int round) {
  for (const PointId id : {PointId(0), PointId(300), PointId(999)}) {
    const KeyframeId keyframe = KeyframeId(0);
    if (round % 2 == 0) {
      map.observe(id, keyframe, std::uint32_t(id) % 7);
    } else {
      map.forget(keyframe, std::uint32_t(id) % 7);
    }
  }
  for (std::size_t i = 0; i < kPoints; ++i) {
    map.setPosition(PointId(std::uint32_t(i)), {double(round), double(round), 0});
  }
  map.setPose(KeyframeId(0), SE3d(gslam::SO3d(), {double(round), 0, 0}));
  map.remove(map.add(MapPoint()));
}

void expectOneRound(const Map& map) {
  const double round = map.at(KeyframeId(0)).T_world_body.translation()[0];
  ASSERT_EQ(map.points().size(), kPoints);
  for (const auto& item : map.points()) ASSERT_EQ(item.value.position[1], round);
  ASSERT_EQ(map.observationCount(), std::int64_t(round) % 2 == 0 ? 3u : 0u);
}

Map firstRound() {
  Map map;
  map.add(RandomMap(1).keyframe(7, true));
  for (std::size_t i = 0; i < kPoints; ++i) map.add(MapPoint());
  writeRound(map, 0);
  return map;
}

TEST(SharedMap, ReadersSeeWholeRoundsWhileTheWriterGoesOn) {
  SharedMap shared{firstRound()};
  std::atomic<bool> is_over(false);
  std::vector<std::thread> readers;
  for (int r = 0; r < 3; ++r) {
    readers.emplace_back([&shared, &is_over] {
      std::vector<std::shared_ptr<const Map>> kept;
      while (!is_over.load()) {
        kept.push_back(shared.latest());
        expectOneRound(*kept.back());
        expectOneRound(*kept.front());
        if (kept.size() > 5) kept.clear();
      }
    });
  }
  for (int round = 1; round < 200; ++round) {
    writeRound(shared.edit(), round);
    shared.publish();
  }
  is_over.store(true);
  for (std::thread& reader : readers) reader.join();
  expectOneRound(*shared.latest());
  EXPECT_EQ(shared.latest()->at(PointId(5)).position[0], 199);
}

TEST(SharedMap, ReadersMayChangeCopies) {
  SharedMap shared{firstRound()};
  std::atomic<bool> is_over(false);
  std::vector<std::thread> readers;
  for (int r = 0; r < 3; ++r) {
    readers.emplace_back([&shared, &is_over, r] {
      while (!is_over.load()) {
        Map mine = *shared.latest();
        writeRound(mine, 1000 + r);
        expectOneRound(mine);
        const Map again = mine;
        writeRound(mine, 2000 + r);
        expectOneRound(again);
      }
    });
  }
  for (int round = 1; round < 100; ++round) {
    writeRound(shared.edit(), round);
    expectOneRound(*shared.publish());
  }
  is_over.store(true);
  for (std::thread& reader : readers) reader.join();
  expectOneRound(shared.working());
}

TEST(SharedMap, ShowsNothingBeforeItIsPublished) {
  SharedMap shared;
  ASSERT_NE(shared.latest(), nullptr);
  shared.edit().add(MapPoint());
  EXPECT_TRUE(shared.latest()->points().empty());
  const std::shared_ptr<const Map> shown = shared.publish();
  EXPECT_EQ(shown, shared.latest());
  EXPECT_EQ(shown->points().size(), 1u);
}

TEST(SharedMap, SnapshotsOutliveIt) {
  std::shared_ptr<const Map> kept;
  {
    SharedMap shared{RandomMap(2).map(10, 100)};
    kept = shared.latest();
    shared.edit() = Map();
    shared.publish();
  }
  EXPECT_GT(kept->observationCount(), 0u);
  EXPECT_THAT(gslam::validate(*kept), IsEmpty());
}

// The map goes before the loop begins.
TEST(SharedMap, LoopsMayBeOverWhatIsShownOnlyForThem) {
  SharedMap shared(firstRound());
  std::size_t count = 0;
  for (const auto& item : std::make_shared<const Map>(firstRound())->points()) {
    EXPECT_EQ(item.value.position[1], 0);
    ++count;
  }
  EXPECT_EQ(count, kPoints);
  for (const auto& item : firstRound().keyframes()) {
    EXPECT_EQ(item.value.content->features.size(), 7u);
  }
  const auto latest = [&shared] { return shared.latest(); };
  for (const auto& item : latest()->points()) {
    if (std::uint32_t(item.id) == 0) {
      writeRound(shared.edit(), 1);
      shared.publish();  // what was shown before is gone but for the loop
    }
    ASSERT_EQ(item.value.position[1], 0);
  }
  auto place = firstRound().points().begin();  // as are range and map here
  EXPECT_EQ((*++place).id, PointId(1));
}

}  // namespace
