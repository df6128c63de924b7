#ifndef GSLAM_MESSENGER_OPTIONS_H
#define GSLAM_MESSENGER_OPTIONS_H

#include <gslam/base/error.h>
#include <gslam/base/workers.h>

#include <chrono>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>

/// @file
/// How a subscriber gets its messages.

namespace gslam {
inline namespace v1 {

/// What happens when a message comes and the queue of a subscriber is full.
enum class Overflow {
  drop_oldest,     ///< the message that waited longest is dropped
  drop_newest,     ///< the message that comes is dropped
  block_publisher  ///< publish() waits until there is room
};

/// What happens at the end of a subscription to the messages that wait in its queue.
enum class Pending {
  discard,  ///< they are dropped, and counted as such
  drain     ///< they are still delivered, before the end returns
};

/// In whose thread a callback runs.
enum class Delivery {
  synchronous,  ///< the publisher's, before publish() returns
  own_thread,   ///< one that the subscription has for itself
  executor      ///< any of a thread pool, one message of the subscription at a time, in order
};

/// How a subscriber gets its messages: synchronously unless told.
///
///     messenger.subscribe<Image>("image", gslam::inOwnThread().keepLast(1), show);
class SubscribeOptions {
 public:
  /// Runs the callback in the publisher's thread.
  SubscribeOptions() = default;

  /// The queue holds the newest `count` messages.
  /// @throws ArgumentError for 0
  SubscribeOptions keepLast(std::size_t count) const {
    return withQueue(count, Overflow::drop_oldest);
  }
  /// The queue holds `count` messages; what comes while it is full is dropped.
  /// @throws ArgumentError for 0
  SubscribeOptions dropNewest(std::size_t count) const {
    return withQueue(count, Overflow::drop_newest);
  }
  /// The queue holds `count` messages; publish() waits while it is full, but not in a callback of
  /// this same subscriber, which would wait for itself. A callback on an executor that waits so for
  /// another subscriber on the same executor holds a worker: when all do, they wait for ever. Give
  /// one of the two a thread of its own, or another executor.
  /// @throws ArgumentError for 0
  SubscribeOptions blockPublisher(std::size_t count) const {
    return withQueue(count, Overflow::block_publisher);
  }
  /// Messages that wait at the end of the subscription are still delivered.
  SubscribeOptions drainAtEnd() const {
    SubscribeOptions changed = *this;
    changed.at_end = Pending::drain;
    return changed;
  }
  /// A thread of its own looks for messages this long before it sleeps: faster by the 5 us or so
  /// that waking takes, at the price of a busy processor.
  SubscribeOptions spinFor(std::chrono::microseconds time) const {
    SubscribeOptions changed = *this;
    changed.spin = time;
    return changed;
  }
  /// What introspection and errors call the subscriber.
  SubscribeOptions named(const std::string& its_name) const {
    SubscribeOptions changed = *this;
    changed.name = its_name;
    return changed;
  }

  Delivery delivery = Delivery::synchronous;                       ///< in whose thread
  std::shared_ptr<ThreadPool> executor = nullptr;                  ///< for Delivery::executor
  std::size_t capacity = std::numeric_limits<std::size_t>::max();  ///< of the queue
  Overflow overflow = Overflow::drop_oldest;                       ///< when the queue is full
  Pending at_end = Pending::discard;                               ///< when the handle goes
  std::chrono::microseconds spin{0};  ///< before a thread of its own sleeps
  std::string name;                   ///< may be empty

 private:
  SubscribeOptions withQueue(std::size_t count, Overflow policy) const {
    if (count == 0) throw ArgumentError("count", "is 0, expected room for 1 message or more");
    SubscribeOptions changed = *this;
    changed.capacity = count;
    changed.overflow = policy;
    return changed;
  }
};

/// The callback runs in a thread of its own; messages wait for it in a queue without bound unless
/// told.
inline SubscribeOptions inOwnThread() {
  SubscribeOptions options;
  options.delivery = Delivery::own_thread;
  return options;
}

/// The callback runs in threads of the pool, one message at a time and in order; messages wait in a
/// queue without bound unless told. The pool lives as long as the subscription.
/// @throws ArgumentError for a null pointer
inline SubscribeOptions onExecutor(std::shared_ptr<ThreadPool> pool) {
  if (pool == nullptr) throw ArgumentError("pool", "is null, expected a thread pool");
  SubscribeOptions options;
  options.delivery = Delivery::executor;
  options.executor = std::move(pool);
  return options;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_OPTIONS_H
