// Synchronous delivery by a publisher handle, from one thread to n subscribers.
#include <benchmark/benchmark.h>
#include <gslam/messenger.h>

#include <array>
#include <memory>
#include <vector>

#include "allocations.h"

namespace {

template <class T>
void publish(benchmark::State& state, const std::shared_ptr<const T>& message) {
  const gslam::Messenger messenger;
  std::vector<gslam::Subscriber> subscribers;
  std::size_t received = 0;
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    subscribers.push_back(
        messenger.subscribe<T>("/t", [&received](const std::shared_ptr<const T>&) { ++received; }));
  }
  const gslam::Publisher<T> publisher = messenger.advertise<T>("/t");
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) publisher.publish(message);
  benchmark::DoNotOptimize(received);
}

void publishInt(benchmark::State& state) {
  publish(state, std::make_shared<const int>(1));
}
BENCHMARK(publishInt)->Name("publish_shared_int/gslam")->Arg(1)->Arg(16);

void publishMegabyte(benchmark::State& state) {
  using Megabyte = std::array<char, 1 << 20>;
  publish(state, std::make_shared<const Megabyte>());
}
BENCHMARK(publishMegabyte)->Name("publish_shared_megabyte/gslam")->Arg(1)->Arg(16);

}  // namespace
