// Queues without a lock, for one publisher. They cannot wait: their threads never sleep.
#include <boost/lockfree/spsc_queue.hpp>
#include <vector>

#include "queue.h"

namespace {

class Consumer {
 public:
  explicit Consumer(Handled& handled) : handled_(handled), thread_([this] { work(); }) {}
  ~Consumer() {
    stop_ = true;
    thread_.join();
  }
  void push(const QueuedMessage& message) {
    while (!waiting_.push(message)) std::this_thread::yield();
  }

 private:
  void work() {
    while (!stop_) {
      if (!waiting_.consume_one([this](const QueuedMessage& message) { handled_.add(message); })) {
        std::this_thread::yield();
      }
    }
  }

  Handled& handled_;
  boost::lockfree::spsc_queue<QueuedMessage, boost::lockfree::capacity<4096>> waiting_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class Lockfree {
 public:
  Lockfree(std::size_t subscribers, std::size_t, Handled& handled) {
    for (std::size_t i = 0; i < subscribers; ++i) consumers_.emplace_back(new Consumer(handled));
  }
  void push(const QueuedMessage& message) {
    for (const auto& consumer : consumers_) consumer->push(message);
  }

 private:
  std::vector<std::unique_ptr<Consumer>> consumers_;
};

BURST_PEER(Lockfree, "boost_lockfree_awake");

}  // namespace
