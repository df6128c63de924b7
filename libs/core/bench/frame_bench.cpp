// What a frame costs on its way: the pixels are never copied, so 1 MB costs what 1 byte does.
#include <allocations.h>
#include <benchmark/benchmark.h>
#include <gslam/core/frame.h>
#include <gslam/messenger/messenger.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace {

using gslam::Frame;

// `size` x `size` grey pixels.
std::shared_ptr<const Frame> frameOf(const gslam::Image& image) {
  const std::shared_ptr<Frame> frame = std::make_shared<Frame>();
  frame->images.emplace_back();
  frame->images[0].image = image;
  return frame;
}

// A new frame around pixels that are there, sent to four subscribers.
void publish(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const gslam::Image image(size, size, gslam::PixelType::u8);
  const gslam::Messenger messenger;
  std::uintptr_t seen = 0;
  std::vector<gslam::Subscriber> subscribers;
  for (int i = 0; i < 4; ++i) {
    subscribers.push_back(messenger.subscribe<Frame>("/sensor/frame", [&](const Frame& frame) {
      seen += reinterpret_cast<std::uintptr_t>(frame.images[0].image.bytes());
    }));
  }
  const gslam::Publisher<Frame> publisher = messenger.advertise<Frame>("/sensor/frame");
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) publisher.publish(frameOf(image));
  if (seen != state.iterations() * 4 * reinterpret_cast<std::uintptr_t>(image.bytes())) {
    state.SkipWithError("pixels were copied");
  }
}
BENCHMARK(publish)->Name("publish_frame/gslam")->Arg(1)->Arg(1024);

// What a copy of the pixels would cost.
void clone(benchmark::State& state) {
  const gslam::Image image(1024, 1024, gslam::PixelType::u8);
  for (auto _ : state) benchmark::DoNotOptimize(image.clone());
}
BENCHMARK(clone)->Name("clone_image/gslam/1024");

}  // namespace
