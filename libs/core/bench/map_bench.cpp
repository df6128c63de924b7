// A map of 1e6 points and 1e7 observations: snapshots, edits, queries, files, memory.
#include <benchmark/benchmark.h>
#include <gslam/core/covisibility.h>
#include <gslam/core/map.h>
#include <gslam/core/map_file.h>
#include <gslam/core/point_index.h>
#include <gslam/core/shared_map.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

using gslam::Keyframe;
using gslam::KeyframeContent;
using gslam::KeyframeId;
using gslam::Map;
using gslam::MapPoint;
using gslam::PointId;
using gslam::SharedMap;

constexpr std::uint32_t kPoints = 1000000;
constexpr std::uint32_t kSeers = 10;  // keyframes that see a point

double bytesInUse() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 info = mallinfo2();
  return double(info.uordblks) + double(info.hblkhd);
#else
  return 0;
#endif
}

Keyframe keyframeOf(std::uint32_t features, bool has_content) {
  const auto content = std::make_shared<KeyframeContent>();
  content->features.resize(features);
  if (has_content) {
    content->descriptors = gslam::Image(32, int(features), gslam::PixelType::u8);
  }
  Keyframe keyframe;
  keyframe.content = content;
  return keyframe;
}

// A camera that goes on and on: a point is seen by neighbours in time, as in a real map.
Map makeMap(std::uint32_t keyframes, std::uint32_t points, bool has_content) {
  const std::uint32_t features = points / keyframes * kSeers;
  Map map;
  Keyframe shared = keyframeOf(features, false);
  for (std::uint32_t i = 0; i < keyframes; ++i) {
    map.add(has_content ? keyframeOf(features, true) : shared);
  }
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(-100, 100);
  std::vector<std::uint32_t> used(keyframes);
  for (std::uint32_t i = 0; i < points; ++i) {
    MapPoint point;
    point.position = {place(generator), place(generator), place(generator)};
    const PointId id = map.add(point);
    const std::uint32_t first = std::uint32_t(std::uint64_t(i) * keyframes / points);
    for (std::uint32_t k = 0; k < kSeers; ++k) {
      const std::uint32_t seer = (first + k) % keyframes;
      if (used[seer] < features) map.observe(id, KeyframeId(seer), used[seer]++);
    }
  }
  return map;
}

const Map& largeMap() {
  static const Map map = makeMap(10000, kPoints, false);
  return map;
}

void snapshot(benchmark::State& state) {
  SharedMap shared(largeMap());
  for (auto _ : state) benchmark::DoNotOptimize(shared.publish());
}

// A local bundle adjustment: 20 keyframes and 5000 points move, then all is shown or nothing is.
// A thread looks at the map all the time, or nobody.
void adjust(benchmark::State& state) {
  const bool is_shown = state.range(0) != 0, is_watched = state.range(1) != 0;
  SharedMap shared(largeMap());
  std::atomic<bool> is_over(false);
  std::thread reader([&] {
    while (is_watched && !is_over.load()) {
      const std::shared_ptr<const Map> map = shared.latest();
      double sum = 0;
      for (std::uint32_t i = 0; i < 1000; ++i) sum += map->at(PointId(i * 997)).position[0];
      benchmark::DoNotOptimize(sum);
    }
  });
  std::uint32_t from = 0;
  for (auto _ : state) {
    from = (from + 7919) % (kPoints - 5000);
    for (std::uint32_t i = 0; i < 5000; ++i)
      shared.edit().setPosition(PointId(from + i), {1, 2, 3});
    for (std::uint32_t i = 0; i < 20; ++i) {
      shared.edit().setPose(KeyframeId(from / 200 + i), gslam::SE3d());
    }
    if (is_shown) shared.publish();
  }
  is_over.store(true);
  reader.join();
}

// The same with points from all over the map: each is in a chunk of its own.
void adjustEverywhere(benchmark::State& state) {
  SharedMap shared(largeMap());
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < 5000; ++i) {
      shared.edit().setPosition(PointId(i * 199), {1, 2, 3});
    }
    if (state.range(0) != 0) shared.publish();
  }
}

// A new keyframe with 1000 features that see 800 known points, and 200 new ones.
void addKeyframe(benchmark::State& state) {
  SharedMap shared(largeMap());
  const Keyframe keyframe = keyframeOf(1000, false);
  std::uint32_t from = 0;
  for (auto _ : state) {
    from = (from + 7919) % (kPoints - 5000);
    Map& map = shared.edit();
    const KeyframeId id = map.add(keyframe);
    for (std::uint32_t i = 0; i < 800; ++i) map.observe(PointId(from + i * 5), id, i);
    for (std::uint32_t i = 800; i < 1000; ++i) map.observe(map.add(MapPoint()), id, i);
    if (state.range(0) != 0) shared.publish();
  }
}

std::string temporaryPath() {
  const char* const folder = std::getenv("TMPDIR");
  return std::string(folder == nullptr ? "/tmp" : folder) + "/gslam_map_bench.map";
}

std::int64_t sizeOf(const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return 0;
  std::fseek(file, 0, SEEK_END);
  const long size = std::ftell(file);
  std::fclose(file);
  return size;
}

// 0: observations and features; 1: with descriptors of 32 bytes.
void save(benchmark::State& state) {
  const Map map = makeMap(2000, 200000, state.range(0) != 0);
  for (auto _ : state) gslam::saveMap(temporaryPath(), map);
  state.SetBytesProcessed(state.iterations() * sizeOf(temporaryPath()));
  std::remove(temporaryPath().c_str());
}
void load(benchmark::State& state) {
  gslam::saveMap(temporaryPath(), makeMap(2000, 200000, state.range(0) != 0));
  for (auto _ : state) benchmark::DoNotOptimize(gslam::loadMap(temporaryPath()));
  state.SetBytesProcessed(state.iterations() * sizeOf(temporaryPath()));
  std::remove(temporaryPath().c_str());
}

void index(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(gslam::PointIndex(largeMap()));
}
void nearest(benchmark::State& state) {
  const gslam::PointIndex points(largeMap());
  double x = 0;
  for (auto _ : state) {
    x = x > 90 ? -90 : x + 0.01;
    benchmark::DoNotOptimize(points.nearest({x, 3, -5}, 10));
  }
}
void covisible(benchmark::State& state) {
  std::uint32_t id = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(gslam::covisibleKeyframes(largeMap(), KeyframeId(id), 15));
    id = (id + 97) % 10000;
  }
}

// Bytes a point, an observation and a keyframe, of a map that was built step by step.
void memory(benchmark::State& state) {
  const std::uint32_t keyframes = 100000;
  for (auto _ : state) {
    const double start = bytesInUse();
    Map map;
    for (std::uint32_t i = 0; i < kPoints; ++i) map.add(MapPoint());
    const double with_points = bytesInUse();
    for (std::uint32_t i = 0; i < keyframes; ++i) map.add(Keyframe());
    const double with_keyframes = bytesInUse();
    map = Map();
    const double before = bytesInUse();
    map = makeMap(keyframes, kPoints, false);
    const double all = bytesInUse() - before;
    const std::vector<std::uint8_t> bytes = gslam::mapToBytes(map);
    const double before_load = bytesInUse();
    const Map loaded = gslam::mapFromBytes(bytes);
    const double all_loaded = bytesInUse() - before_load;
    const double point = (with_points - start) / kPoints;
    const double keyframe = (with_keyframes - with_points) / keyframes;
    const double features = 24.0 * double(map.observationCount());  // shared until it is loaded
    const double rest = point * kPoints + keyframe * keyframes;
    const double observations = static_cast<double>(map.observationCount());
    state.counters["point_bytes"] = point;
    state.counters["keyframe_bytes"] = keyframe;
    state.counters["observation_bytes"] = (all - rest) / observations;
    state.counters["loaded_observation_bytes"] = (all_loaded - rest - features) / observations;
    state.counters["observations"] = static_cast<double>(map.observationCount());
  }
}

}  // namespace

BENCHMARK(snapshot)->Name("map_snapshot/gslam/1000000");
BENCHMARK(adjust)->Name("map_adjust/gslam")->Args({0, 0})->Args({1, 0})->Args({1, 1});
BENCHMARK(adjustEverywhere)->Name("map_adjust_everywhere/gslam")->Arg(0)->Arg(1);
BENCHMARK(addKeyframe)->Name("map_add_keyframe/gslam")->Arg(0)->Arg(1);
BENCHMARK(save)->Name("map_save/gslam")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(load)->Name("map_load/gslam")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(index)->Name("map_index/gslam/1000000")->Unit(benchmark::kMillisecond);
BENCHMARK(nearest)->Name("map_nearest/gslam/10");
BENCHMARK(covisible)->Name("map_covisible/gslam");
BENCHMARK(memory)->Name("map_memory/gslam")->Iterations(1)->Unit(benchmark::kMillisecond);
