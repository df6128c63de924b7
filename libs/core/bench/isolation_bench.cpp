// What it costs to run a SLAM system in a process of its own: a frame of 1 MB, lock-step, to one
// that does nothing. Peer: the same system in this process.
#include <allocations.h>
#include <benchmark/benchmark.h>
#include <gslam/core/isolated_slam.h>
#include <gslam/core/plugins.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace {

std::shared_ptr<const gslam::Frame> frameOf(std::int64_t bytes) {
  const auto frame = std::make_shared<gslam::Frame>();
  if (bytes > 0) {
    frame->images.resize(1);
    frame->images[0].image = gslam::Image(1024, int(bytes / 1024), gslam::PixelType::u8);
    for (int y = 0; y < frame->images[0].image.height(); ++y) {
      frame->images[0].image.bytes(y)[0] = 1;  // pages that were never written cost nothing to read
    }
  }
  return frame;
}

std::string toy() {
  return std::string(GSLAM_TEST_PLUGIN_TOY) + ":toy";
}

void feed(benchmark::State& state, std::unique_ptr<gslam::Slam> slam) {
  gslam::SlamSetup setup;
  setup.parameters = gslam::Svar::object({{"idle", true}});
  std::int64_t poses = 0;
  const gslam::Subscriber subscriber = setup.messenger.subscribe<gslam::TrackedPose>(
      "pose", [&](const gslam::TrackedPose&) { ++poses; });
  slam->configure(setup);
  const std::shared_ptr<const gslam::Frame> frame = frameOf(state.range(0));
  slam->feed(frame);
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) slam->feed(frame);
  if (poses != state.iterations() + 1) state.SkipWithError("poses were lost");
  state.SetBytesProcessed(state.iterations() * state.range(0));
}

void feedIsolated(benchmark::State& state) {
  gslam::IsolationOptions options;
  options.slam = toy();
  options.worker = GSLAM_TEST_WORKER;
  feed(state, std::unique_ptr<gslam::Slam>(new gslam::IsolatedSlam(options)));
}
BENCHMARK(feedIsolated)
    ->Name("feed_frame/gslam")
    ->Arg(0)
    ->Arg(1 << 20)
    ->Arg(8 << 20)
    ->UseRealTime();

void feedHere(benchmark::State& state) {
  gslam::Plugins plugins;
  feed(state, plugins.slam(toy()).make());
}
BENCHMARK(feedHere)
    ->Name("feed_frame/in_process")
    ->Arg(0)
    ->Arg(1 << 20)
    ->Arg(8 << 20)
    ->UseRealTime();

// From nothing to a system that was made.
void start(benchmark::State& state) {
  gslam::IsolationOptions options;
  options.slam = toy();
  options.worker = GSLAM_TEST_WORKER;
  for (auto _ : state) gslam::IsolatedSlam slam(options);
}
BENCHMARK(start)->Name("start_and_end/gslam")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
