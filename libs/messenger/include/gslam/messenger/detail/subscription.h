// One who listens to a topic.
#ifndef GSLAM_MESSENGER_DETAIL_SUBSCRIPTION_H
#define GSLAM_MESSENGER_DETAIL_SUBSCRIPTION_H

#include <gslam/messenger/any_message.h>
#include <gslam/messenger/detail/error_sink.h>
#include <gslam/messenger/detail/letter.h>
#include <gslam/messenger/detail/message_queue.h>

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

/// What subscriptions may know of the topic that a message comes from.
struct TopicFacts {
  std::shared_ptr<const std::string> name;
  PayloadType type;
};

class Subscription {
 public:
  Subscription(const SubscribeOptions& options, std::string topic, std::string type)
      : name_(options.name),
        topic_(std::move(topic)),
        type_name_(std::move(type)),
        at_end_(options.at_end) {}
  virtual ~Subscription() = default;
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;

  /// Called by publishers, at the same time by several, without a lock.
  virtual void receive(AnyLetter& letter, const TopicFacts& topic) = 0;
  /// Takes no more messages; publishers that wait for room are let go.
  virtual void close(Pending) {}
  /// Waits for callbacks, when no publisher is in receive() any more. May be called several times,
  /// and by several threads at once.
  virtual void finish() {}
  virtual QueueCounts counts() const { return {0, 0}; }
  /// What was dropped, also after this has gone; null where nothing can be.
  virtual SharedCount dropped() const { return nullptr; }

  const std::string& name() const noexcept { return name_; }
  const std::string& topic() const noexcept { return topic_; }
  const std::string& typeName() const noexcept { return type_name_; }
  Pending atEnd() const noexcept { return at_end_; }

  /// Cleared once, by whoever ends it.
  std::atomic<bool> is_active{true};
  /// How many topics have it in their lists, and the messenger, if it may add more.
  std::atomic<int> places{0};

 private:
  const std::string name_;
  const std::string topic_;
  const std::string type_name_;
  const Pending at_end_;
};

/// Messages of one type: callbacks take `const T&` or `std::shared_ptr<const T>`.
template <class T>
struct TypedPayload {
  using Item = std::shared_ptr<const T>;
  static std::string typeName() { return PayloadType::of<T>().name(); }
  static Item take(AnyLetter& letter, const TopicFacts&) {
    return static_cast<Letter<T>&>(letter).share();
  }
  template <class F>
  static void callNow(F& f, AnyLetter& letter, const TopicFacts&) {
    callNow(f, static_cast<Letter<T>&>(letter), 0);
  }
  template <class F>
  static void call(F& f, const Item& item) {
    call(f, item, 0);
  }

 private:
  // int is the better match for 0, where the call is possible. A generic lambda, which any call
  // fits, gets a reference.
  template <class F>
  static auto callNow(F& f, Letter<T>& letter, int)
      -> decltype(f(std::declval<const T&>()), void()) {
    f(letter.object());
  }
  template <class F>
  static void callNow(F& f, Letter<T>& letter, long) {
    f(letter.share());
  }
  template <class F>
  static auto call(F& f, const Item& item, int) -> decltype(f(std::declval<const T&>()), void()) {
    f(*item);
  }
  template <class F>
  static void call(F& f, const Item& item, long) {
    f(item);
  }
};

/// Messages of all types.
struct AnyPayload {
  using Item = AnyMessage;
  static std::string typeName() { return "any"; }
  static Item take(AnyLetter& letter, const TopicFacts& topic) {
    return AnyMessage(topic.name, topic.type, letter.shareAny());
  }
  template <class F>
  static void callNow(F& f, AnyLetter& letter, const TopicFacts& topic) {
    f(static_cast<const AnyMessage&>(take(letter, topic)));
  }
  template <class F>
  static void call(F& f, const Item& item) {
    f(item);
  }
};

/// Calls back in the publisher's thread.
template <class Payload, class F>
class SynchronousSubscription final : public Subscription {
 public:
  SynchronousSubscription(const SubscribeOptions& options, const std::string& topic, F callback)
      : Subscription(options, topic, Payload::typeName()), callback_(std::move(callback)) {}
  void receive(AnyLetter& letter, const TopicFacts& topic) override {
    Payload::callNow(callback_, letter, topic);
  }

 private:
  F callback_;
};

/// Calls back in a thread of its own or of a pool.
template <class Payload, class F>
class QueuedSubscription final
    : public Subscription,
      public std::enable_shared_from_this<QueuedSubscription<Payload, F>> {
 public:
  using Item = typename Payload::Item;

  QueuedSubscription(const SubscribeOptions& options, const std::string& topic, F callback,
                     std::shared_ptr<ErrorSink> errors)
      : Subscription(options, topic, Payload::typeName()),
        queue_(options),
        pool_(options.executor),
        callback_(std::move(callback)),
        errors_(std::move(errors)) {}
  ~QueuedSubscription() override {
    if (thread_.joinable()) thread_.detach();  // the last to go is the thread itself
    if (pool_ == nullptr) return;
    // It ended in its own callback, so this may be a thread of the pool, which cannot end the pool.
    const auto pool = std::make_shared<std::shared_ptr<ThreadPool>>(std::move(pool_));
    std::thread([pool] { pool->reset(); }).detach();
  }

  /// To be called once, when a shared_ptr holds this.
  void start() {
    if (pool_ != nullptr) return;
    const std::shared_ptr<QueuedSubscription> self = this->shared_from_this();
    thread_ = std::thread([self] { self->work(); });
  }

  void receive(AnyLetter& letter, const TopicFacts& topic) override {
    const bool was_idle = queue_.push(Payload::take(letter, topic));
    if (was_idle && pool_ != nullptr) startOnPool();
  }
  void close(Pending pending) override {
    if (pending == Pending::discard) is_discarding_ = true;
    queue_.close(pending);
  }
  void finish() override {
    if (queue_.isConsumer()) return;  // a message that ends it when it goes
    const std::lock_guard<std::mutex> lock(finish_mutex_);
    if (thread_.joinable()) return thread_.join();
    if (pool_ == nullptr) return;
    queue_.waitUntilIdle();
    queue_.close(Pending::discard);  // where the pool took no task, something may be left
    pool_.reset();                   // nobody posts any more
  }
  QueueCounts counts() const override { return queue_.counts(); }
  SharedCount dropped() const override { return queue_.dropped(); }

 private:
  using Consuming = typename MessageQueue<Item>::Consuming;

  void work() {
    const Consuming consuming(&queue_);
    CallbackThread& thread = errors_->thread();
    if (queue_.isBounded()) {
      Item item;
      while (queue_.waitPop(item)) deliver(std::move(item), thread);
      return;
    }
    Ring<Item> items;
    while (queue_.waitPopAll(items)) {
      while (!items.empty() && !is_discarding_) {
        queue_.setTaken(items.size() - 1);
        deliver(items.pop(), thread);
      }
      if (items.empty()) continue;
      queue_.countDropped(items.size());
      queue_.setTaken(0);
      Ring<Item>().swap(items);
    }
  }

  // The message is in the queue and waits there for the next one where this throws.
  void startOnPool() {
    std::shared_ptr<QueuedSubscription> self = this->shared_from_this();
    try {
      post(self);
    } catch (...) {
      queue_.stayIdle();
      throw;
    }
  }

  // A pool runs all that it was given, so the task needs no pointer that owns: with one it would be
  // allocated each time. Where it throws, nothing is posted, and `self` is as it was.
  void post(std::shared_ptr<QueuedSubscription>& self) {
    alive_while_posted_ = std::move(self);
    try {
      pool_->post([this] { workAWhile(); });
    } catch (...) {
      self = std::move(alive_while_posted_);
      throw;
    }
  }

  void workAWhile() {
    std::shared_ptr<QueuedSubscription> self = std::move(alive_while_posted_);
    const Consuming consuming(&queue_);
    while (!workOnce()) {
      try {
        return post(self);  // others have their turn
      } catch (...) {       // there is no memory for it: they have it later
      }
    }
  }

  // True where nothing is left to do.
  bool workOnce() {
    CallbackThread& thread = errors_->thread();
    Item item;
    for (int i = 0; i < 32; ++i) {
      if (queue_.tryPop(item)) {
        deliver(std::move(item), thread);
      } else if (queue_.goIdle()) {
        return true;
      }
    }
    return false;
  }

  // What the callback gives up ends with it, and not when the thread does.
  void deliver(Item taken, CallbackThread& thread) {
    const Delivering delivering(thread);
    const Item item = std::move(taken);
    errors_->guard(topic(), [&] { Payload::call(callback_, item); });
  }

  MessageQueue<Item> queue_;
  std::shared_ptr<ThreadPool> pool_;
  std::shared_ptr<QueuedSubscription> alive_while_posted_;  // of whoever is busy, see MessageQueue
  F callback_;
  const std::shared_ptr<ErrorSink> errors_;
  std::atomic<bool> is_discarding_{false};
  std::mutex finish_mutex_;  // who ends it changes thread_ and pool_
  std::thread thread_;
};

/// Keeps messages for one who asks for them.
template <class Payload>
class InboxSubscription final : public Subscription {
 public:
  using Item = typename Payload::Item;
  InboxSubscription(const SubscribeOptions& options, const std::string& topic)
      : Subscription(options, topic, Payload::typeName()), queue_(options) {}
  void receive(AnyLetter& letter, const TopicFacts& topic) override {
    queue_.push(Payload::take(letter, topic));
  }
  void close(Pending pending) override { queue_.close(pending); }
  QueueCounts counts() const override { return queue_.counts(); }
  SharedCount dropped() const override { return queue_.dropped(); }
  MessageQueue<Item>& queue() noexcept { return queue_; }

 private:
  MessageQueue<Item> queue_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_SUBSCRIPTION_H
