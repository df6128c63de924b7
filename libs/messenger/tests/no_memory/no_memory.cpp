// A system without memory: what is lost is told, and nothing waits for ever.
#include <gslam/messenger.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace {

// Counts down in this thread; the allocation at 1 fails.
thread_local int allocations_left = 0;

void* allocate(std::size_t size) {
  if (allocations_left > 0 && --allocations_left == 0) throw std::bad_alloc();
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// Out of line, or g++ takes free() and operator new for a pair that does not match.
GSLAM_COLD void* operator new(std::size_t size) {
  return allocate(size);
}
GSLAM_COLD void* operator new[](std::size_t size) {
  return allocate(size);
}
GSLAM_COLD void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return std::malloc(size > 0 ? size : 1);
}
GSLAM_COLD void operator delete(void* memory) noexcept {
  std::free(memory);
}
GSLAM_COLD void operator delete[](void* memory) noexcept {
  std::free(memory);
}
GSLAM_COLD void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
GSLAM_COLD void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

using gslam::Messenger;
using gslam::Pending;
using gslam::Subscriber;

TEST(NoMemory, LosesNoMessageThatIsInTheQueueOfAnExecutor) {
  bool was_told = false;
  bool was_in_queue = false;
  for (int failing = 1; failing < 6; ++failing) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    std::atomic<int> told{0};
    messenger.onError([&](const std::string&, const std::exception_ptr&) { ++told; });
    std::vector<int> seen;
    Subscriber subscriber =
        messenger.subscribe<int>("n", gslam::onExecutor(std::make_shared<gslam::ThreadPool>(1)),
                                 [&](const int& n) { seen.push_back(n); });
    const auto message = std::make_shared<const int>(1);
    allocations_left = failing;
    publisher.publish(message);
    allocations_left = 0;
    const std::size_t waiting = subscriber.waiting();
    if (told > 0) was_told = true;
    if (told > 0 && waiting > 0) was_in_queue = true;
    const bool is_lost = told > 0 && waiting == 0;
    publisher.publish(2);
    subscriber.unsubscribe(Pending::drain);
    EXPECT_EQ(seen, is_lost ? std::vector<int>({2}) : std::vector<int>({1, 2})) << failing;
  }
  EXPECT_TRUE(was_told);
  EXPECT_TRUE(was_in_queue);
}

TEST(NoMemory, EndsWithWhatNoThreadOfAnExecutorTook) {
  for (const Pending pending : {Pending::discard, Pending::drain}) {
    const Messenger messenger;
    const auto publisher = messenger.advertise<int>("n");
    messenger.onError([](const std::string&, const std::exception_ptr&) {});
    Subscriber subscriber = messenger.subscribe<int>(
        "n", gslam::onExecutor(std::make_shared<gslam::ThreadPool>(1)), [](const int&) {});
    const auto message = std::make_shared<const int>(1);
    allocations_left = 2;  // the first is the queue's
    publisher.publish(message);
    allocations_left = 0;
    EXPECT_EQ(subscriber.waiting(), 1u);
    subscriber.unsubscribe(pending);
    EXPECT_EQ(subscriber.dropped(), 1u);
  }
}

}  // namespace
