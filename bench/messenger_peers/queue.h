// Measurements for all that have threads: what a message costs until it is handled elsewhere.
#ifndef GSLAM_BENCH_MESSENGER_PEERS_QUEUE_H
#define GSLAM_BENCH_MESSENGER_PEERS_QUEUE_H

#include <benchmark/benchmark.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>

#include "allocations.h"

using QueuedMessage = std::shared_ptr<const int>;

/// How many messages were handled, by all subscribers.
class Handled {
 public:
  void add(const QueuedMessage& message) {
    benchmark::DoNotOptimize(*message);
    count_.fetch_add(1, std::memory_order_release);
  }
  void waitFor(std::int64_t count) const {
    while (count_.load(std::memory_order_acquire) < count) std::this_thread::yield();
  }

 private:
  std::atomic<std::int64_t> count_{0};
};

/// A burst of 1000 messages until all subscribers have handled all of them; time per message.
/// @tparam Queue  has `Queue(std::size_t subscribers, std::size_t capacity, Handled&)` (0: without
///                bound), `push(const QueuedMessage&)`, and a destructor that ends its threads
template <class Queue>
void queuedBurst(benchmark::State& state) {
  const int size = 1000;
  const std::int64_t subscribers = state.range(0);
  Handled handled;
  Queue queue(static_cast<std::size_t>(subscribers), 0, handled);
  const QueuedMessage message = std::make_shared<const int>(1);
  std::int64_t expected = 0;
  const auto send = [&] {
    for (int i = 0; i < size; ++i) queue.push(message);
    handled.waitFor(expected += size * subscribers);
  };
  for (int i = 0; i < 10; ++i) send();  // queues find their size
  {
    const gslam_bench::CountAllocations count(state);
    for (auto _ : state) send();
  }
  state.SetItemsProcessed(state.iterations() * size);
}

/// One message at a time, as soon as the one before was handled.
template <class Queue>
void oneByOne(benchmark::State& state) {
  Handled handled;
  Queue queue(1, 0, handled);
  const QueuedMessage message = std::make_shared<const int>(1);
  std::int64_t expected = 0;
  for (auto _ : state) {
    queue.push(message);
    handled.waitFor(++expected);
  }
}

/// One message at a time, to a thread that had time to fall asleep.
template <class Queue>
void wakeUp(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  Handled handled;
  Queue queue(1, 0, handled);
  const QueuedMessage message = std::make_shared<const int>(1);
  std::int64_t expected = 0;
  for (auto _ : state) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    const Clock::time_point begin = Clock::now();
    queue.push(message);
    handled.waitFor(++expected);
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - begin).count());
  }
}

/// As many publishers as the benchmark has threads, and one subscriber that holds them back where
/// 4096 messages wait; time per message of all.
template <class Queue>
void manyPublishers(benchmark::State& state) {
  static Handled* handled = nullptr;
  static Queue* queue = nullptr;
  if (state.thread_index() == 0) {
    handled = new Handled;
    queue = new Queue(1, 4096, *handled);
  }
  const QueuedMessage message = std::make_shared<const int>(1);
  for (auto _ : state) queue->push(message);  // the loop begins when all threads are there
  if (state.thread_index() == 0) {
    delete queue;
    delete handled;
  }
  state.SetItemsProcessed(state.iterations());
}

#define BURST_PEER(Queue, name) \
  BENCHMARK_TEMPLATE(queuedBurst, Queue)->Name("queued_burst/" name)->Arg(1)->Arg(16)->UseRealTime()
#define ONE_BY_ONE_PEER(Queue, name)                                            \
  BENCHMARK_TEMPLATE(oneByOne, Queue)->Name("one_by_one/" name)->UseRealTime(); \
  BENCHMARK_TEMPLATE(wakeUp, Queue)->Name("wake_up/" name)->Iterations(1000)->UseManualTime()
#define PUBLISHERS_PEER(Queue, name)        \
  BENCHMARK_TEMPLATE(manyPublishers, Queue) \
      ->Name("publishers/" name)            \
      ->ThreadRange(1, 4)                   \
      ->UseRealTime()

#endif  // GSLAM_BENCH_MESSENGER_PEERS_QUEUE_H
