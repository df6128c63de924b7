// Messages that go to a thread pool, and many publishers. Threads of a subscription's own are
// measured beside their peers, in bench/messenger_peers.
#include <allocations.h>
#include <benchmark/benchmark.h>
#include <gslam/messenger.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace {

using gslam::inOwnThread;
using gslam::Messenger;
using gslam::SubscribeOptions;
using gslam::Subscriber;
using Message = std::shared_ptr<const int>;

// A burst of messages until all subscribers have handled all of them.
void burstToExecutor(benchmark::State& state) {
  const int size = 1000;
  const Messenger messenger;
  const auto pool = std::make_shared<gslam::ThreadPool>(2);
  const auto publisher = messenger.advertise<int>("n");
  std::atomic<std::int64_t> handled{0};
  std::vector<Subscriber> subscribers;
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    subscribers.push_back(messenger.subscribe<int>("n", gslam::onExecutor(pool), [&](const int& n) {
      benchmark::DoNotOptimize(n);
      handled.fetch_add(1, std::memory_order_release);
    }));
  }
  const Message message = std::make_shared<const int>(1);
  std::int64_t expected = 0;
  const auto send = [&] {
    for (int i = 0; i < size; ++i) publisher.publish(message);
    expected += size * state.range(0);
    while (handled.load(std::memory_order_acquire) < expected) std::this_thread::yield();
  };
  for (int i = 0; i < 10; ++i) send();  // queues find their size
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) send();
  state.SetItemsProcessed(state.iterations() * size);
}
BENCHMARK(burstToExecutor)->Name("queued_burst_executor/gslam")->Arg(1)->Arg(16)->UseRealTime();

// Several publishers of one topic, with one subscriber.
void manyPublishers(benchmark::State& state, const SubscribeOptions& options) {
  static Messenger* messenger = nullptr;
  static Subscriber* subscriber = nullptr;
  static std::atomic<std::int64_t> handled;
  if (state.thread_index() == 0) {
    messenger = new Messenger;
    subscriber = new Subscriber(messenger->subscribe<int>(
        "n", options, [](const int&) { handled.fetch_add(1, std::memory_order_relaxed); }));
  }
  const Message message = std::make_shared<const int>(1);
  gslam::Publisher<int> publisher;
  for (auto _ : state) {
    if (publisher.topic().empty()) publisher = messenger->advertise<int>("n");
    publisher.publish(message);
  }
  if (state.thread_index() == 0) {
    delete subscriber;
    delete messenger;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(manyPublishers, synchronous, SubscribeOptions())
    ->Name("publishers_synchronous/gslam")
    ->ThreadRange(1, 4)
    ->UseRealTime();
BENCHMARK_CAPTURE(manyPublishers, dropping, inOwnThread().keepLast(4096))
    ->Name("publishers_dropping/gslam")
    ->ThreadRange(1, 4)
    ->UseRealTime();

}  // namespace
