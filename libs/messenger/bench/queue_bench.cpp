// Queues and threads: what a message costs until it is handled, against a queue by hand.
#include <allocations.h>
#include <benchmark/benchmark.h>
#include <gslam/messenger.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace {

using gslam::inOwnThread;
using gslam::Messenger;
using gslam::onExecutor;
using gslam::SubscribeOptions;
using gslam::Subscriber;
using Message = std::shared_ptr<const int>;

constexpr int kBurst = 1000;

// The usual way: a deque behind a mutex, and a thread that waits for it.
class ByHand {
 public:
  explicit ByHand(std::atomic<std::int64_t>& handled)
      : handled_(handled), thread_([this] { work(); }) {}
  ~ByHand() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    ready_.notify_one();
    thread_.join();
  }
  void push(const Message& message) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.push_back(message);
    }
    ready_.notify_one();
  }

 private:
  void work() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      ready_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      {
        const Message message = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        benchmark::DoNotOptimize(*message);
        handled_.fetch_add(1, std::memory_order_release);
      }
      lock.lock();
    }
  }

  std::atomic<std::int64_t>& handled_;
  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Message> waiting_;
  bool stop_ = false;
  std::thread thread_;
};

void waitFor(const std::atomic<std::int64_t>& handled, std::int64_t count) {
  while (handled.load(std::memory_order_acquire) < count) std::this_thread::yield();
}

// A burst of messages until all subscribers have handled all of them.
template <class Send>
void burst(benchmark::State& state, std::atomic<std::int64_t>& handled, Send send) {
  const Message message = std::make_shared<const int>(1);
  for (int i = 0; i < kBurst; ++i) send(message);  // queues find their size
  std::int64_t expected = kBurst * state.range(0);
  waitFor(handled, expected);
  const gslam_bench::CountAllocations count(state);
  for (auto _ : state) {
    for (int i = 0; i < kBurst; ++i) send(message);
    waitFor(handled, expected += kBurst * state.range(0));
  }
  state.SetItemsProcessed(state.iterations() * kBurst);
}

void burstOf(benchmark::State& state, const SubscribeOptions& options) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  std::atomic<std::int64_t> handled{0};
  std::vector<Subscriber> subscribers;
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    subscribers.push_back(messenger.subscribe<int>("n", options, [&](const int& n) {
      benchmark::DoNotOptimize(n);
      handled.fetch_add(1, std::memory_order_release);
    }));
  }
  burst(state, handled, [&](const Message& message) { publisher.publish(message); });
}

void burstByHand(benchmark::State& state) {
  std::atomic<std::int64_t> handled{0};
  std::vector<std::unique_ptr<ByHand>> queues;
  for (std::int64_t i = 0; i < state.range(0); ++i) queues.emplace_back(new ByHand(handled));
  burst(state, handled, [&](const Message& message) {
    for (const auto& queue : queues) queue->push(message);
  });
}

BENCHMARK_CAPTURE(burstOf, own_thread, inOwnThread())
    ->Name("queued_burst/gslam")
    ->Arg(1)
    ->Arg(16)
    ->UseRealTime();
BENCHMARK_CAPTURE(burstOf, executor, onExecutor(std::make_shared<gslam::ThreadPool>(2)))
    ->Name("queued_burst/gslam_executor")
    ->Arg(1)
    ->Arg(16)
    ->UseRealTime();
BENCHMARK(burstByHand)->Name("queued_burst/mutex_deque")->Arg(1)->Arg(16)->UseRealTime();

// One message at a time: until a thread has handled it that has slept for a while.
template <class Send>
void wakeUp(benchmark::State& state, const std::atomic<std::int64_t>& handled, Send send) {
  using Clock = std::chrono::steady_clock;
  const Message message = std::make_shared<const int>(1);
  std::int64_t expected = 0;
  for (auto _ : state) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    const Clock::time_point begin = Clock::now();
    send(message);
    waitFor(handled, ++expected);
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - begin).count());
  }
}
void wakeUpOf(benchmark::State& state, const SubscribeOptions& options) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  std::atomic<std::int64_t> handled{0};
  const Subscriber subscriber = messenger.subscribe<int>(
      "n", options, [&](const int&) { handled.fetch_add(1, std::memory_order_release); });
  wakeUp(state, handled, [&](const Message& message) { publisher.publish(message); });
}
void wakeUpByHand(benchmark::State& state) {
  std::atomic<std::int64_t> handled{0};
  ByHand queue(handled);
  wakeUp(state, handled, [&](const Message& message) { queue.push(message); });
}
BENCHMARK_CAPTURE(wakeUpOf, own_thread, inOwnThread())->Name("wake_up/gslam")->UseManualTime();
BENCHMARK_CAPTURE(wakeUpOf, spinning, inOwnThread().spinFor(std::chrono::microseconds(1000)))
    ->Name("wake_up/gslam_spinning")
    ->UseManualTime();
BENCHMARK(wakeUpByHand)->Name("wake_up/mutex_deque")->UseManualTime();

// The same without a pause: each message as soon as the one before was handled.
template <class Send>
void pingPong(benchmark::State& state, const std::atomic<std::int64_t>& handled, Send send) {
  const Message message = std::make_shared<const int>(1);
  std::int64_t expected = 0;
  for (auto _ : state) {
    send(message);
    waitFor(handled, ++expected);
  }
}
void oneByOneOf(benchmark::State& state, const SubscribeOptions& options) {
  const Messenger messenger;
  const auto publisher = messenger.advertise<int>("n");
  std::atomic<std::int64_t> handled{0};
  const Subscriber subscriber = messenger.subscribe<int>(
      "n", options, [&](const int&) { handled.fetch_add(1, std::memory_order_release); });
  pingPong(state, handled, [&](const Message& message) { publisher.publish(message); });
}
void oneByOneByHand(benchmark::State& state) {
  std::atomic<std::int64_t> handled{0};
  ByHand queue(handled);
  pingPong(state, handled, [&](const Message& message) { queue.push(message); });
}
BENCHMARK_CAPTURE(oneByOneOf, own_thread, inOwnThread())->Name("one_by_one/gslam")->UseRealTime();
BENCHMARK(oneByOneByHand)->Name("one_by_one/mutex_deque")->UseRealTime();

// Several publishers of one topic.
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
    ->Name("publishers/gslam")
    ->ThreadRange(1, 4)
    ->UseRealTime();
BENCHMARK_CAPTURE(manyPublishers, queued, inOwnThread().blockPublisher(4096))
    ->Name("publishers_queued/gslam")
    ->ThreadRange(1, 4)
    ->UseRealTime();
BENCHMARK_CAPTURE(manyPublishers, dropping, inOwnThread().keepLast(4096))
    ->Name("publishers_dropping/gslam")
    ->ThreadRange(1, 4)
    ->UseRealTime();

// The same by hand: a deque with a bound, and a thread that takes from it.
class BoundedByHand {
 public:
  BoundedByHand() : thread_([this] { work(); }) {}
  ~BoundedByHand() {
    push(nullptr);
    thread_.join();
  }
  void push(const Message& message) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      not_full_.wait(lock, [this] { return waiting_.size() < 4096; });
      waiting_.push_back(message);
    }
    not_empty_.notify_one();
  }

 private:
  void work() {
    for (;;) {
      Message message;
      {
        std::unique_lock<std::mutex> lock(mutex_);
        not_empty_.wait(lock, [this] { return !waiting_.empty(); });
        message = std::move(waiting_.front());
        waiting_.pop_front();
      }
      not_full_.notify_one();
      if (message == nullptr) return;
      benchmark::DoNotOptimize(*message);
    }
  }

  std::mutex mutex_;
  std::condition_variable not_empty_;
  std::condition_variable not_full_;
  std::deque<Message> waiting_;
  std::thread thread_;
};

void manyPublishersByHand(benchmark::State& state) {
  static BoundedByHand* queue = nullptr;
  if (state.thread_index() == 0) queue = new BoundedByHand;
  const Message message = std::make_shared<const int>(1);
  for (auto _ : state) queue->push(message);
  if (state.thread_index() == 0) delete queue;
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(manyPublishersByHand)
    ->Name("publishers_queued/mutex_deque")
    ->ThreadRange(1, 4)
    ->UseRealTime();

void publishByName(benchmark::State& state) {
  const Messenger messenger;
  std::int64_t received = 0;
  const Subscriber subscriber = messenger.subscribe<int>("n", [&](const int&) { ++received; });
  const Message message = std::make_shared<const int>(1);
  for (auto _ : state) messenger.publish<int>("/n", message);
  benchmark::DoNotOptimize(received);
}
BENCHMARK(publishByName)->Name("publish_by_name/gslam");

}  // namespace
