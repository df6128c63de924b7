// Frames a second on one thread, 640 x 480, as the defaults make them. Time is that of the CPU.
#include <benchmark/benchmark.h>
#include <gslam/datasets.h>

#include <cstdint>
#include <string>

namespace {

void renderFrames(benchmark::State& state, const std::string& name) {
  const auto dataset = gslam::openSynthetic(gslam::syntheticOptions(name));
  std::size_t i = 0;
  for (auto _ : state) {
    dataset->seek(i);
    benchmark::DoNotOptimize(dataset->next());
    i = (i + 7) % 600;
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()));
}

void openWorld(benchmark::State& state, const std::string& name) {
  const gslam::SyntheticOptions options = gslam::syntheticOptions(name);
  for (auto _ : state) benchmark::DoNotOptimize(gslam::openSynthetic(options));
}

const bool kRegistered = [] {
  for (const std::string world : {"room", "corridor", "street", "aerial"}) {
    const std::string name = "synthetic://" + world + "?threads=1";
    for (const std::string sensors : {"rgbd", "mono", "stereo"}) {
      benchmark::RegisterBenchmark(
          (sensors + "/gslam/" + world).c_str(),
          [=](benchmark::State& state) { renderFrames(state, name + "&sensors=" + sensors); })
          ->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark(("open/gslam/" + world).c_str(), [=](benchmark::State& state) {
      openWorld(state, name);
    })->Unit(benchmark::kMillisecond);
  }
  benchmark::RegisterBenchmark("colour/gslam/room", [](benchmark::State& state) {
    renderFrames(state, "synthetic://room?threads=1&colour=1");
  })->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
