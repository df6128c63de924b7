// One measurement for all: deliver a message to n subscribers that count it, in the same thread.
#ifndef GSLAM_BENCH_MESSENGER_PEERS_PUBLISH_H
#define GSLAM_BENCH_MESSENGER_PEERS_PUBLISH_H

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "allocations.h"

template <class T>
using Message = std::shared_ptr<const T>;
using Megabyte = std::array<char, 1 << 20>;

/// @tparam Bus  has `subscribe(std::size_t& received)` and `publish(const Message<T>&)`
template <template <class> class Bus, class T>
void publish(benchmark::State& state) {
  Bus<T> bus;
  std::size_t received = 0;
  for (std::int64_t i = 0; i < state.range(0); ++i) bus.subscribe(received);
  const Message<T> message = std::make_shared<const T>();
  std::size_t expected = 0;
  {
    const gslam_bench::CountAllocations count(state);
    for (auto _ : state) bus.publish(message);
  }
  expected = static_cast<std::size_t>(state.iterations() * state.range(0));
  if (received != expected) state.SkipWithError("messages were lost");
}

#define PEER(Bus, name)                                                              \
  BENCHMARK_TEMPLATE(publish, Bus, int)->Name("publish_int/" name)->Arg(1)->Arg(16); \
  BENCHMARK_TEMPLATE(publish, Bus, Megabyte)->Name("publish_megabyte/" name)->Arg(1)->Arg(16)

#endif  // GSLAM_BENCH_MESSENGER_PEERS_PUBLISH_H
