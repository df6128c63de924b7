#ifndef GSLAM_MESSENGER_TOPIC_H
#define GSLAM_MESSENGER_TOPIC_H

#include <gslam/base/platform.h>
#include <gslam/messenger/detail/payload_type.h>
#include <gslam/messenger/detail/read_mostly.h>
#include <gslam/messenger/detail/subscription.h>
#include <gslam/messenger/info.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

/// @file
/// One topic: its name, its type, and who listens. Used through Publisher and Subscriber.

namespace gslam {
inline namespace v1 {
namespace detail {

class Topic final : public Mortal {
 public:
  using List = std::vector<std::shared_ptr<Subscription>>;

  /// @param changes  the topic that tells of changes; null for that topic itself
  Topic(const std::string& name, PayloadType type, std::shared_ptr<ErrorSink> errors,
        const std::shared_ptr<Topic>& changes)
      : facts_{std::make_shared<std::string>(name), type},
        errors_(std::move(errors)),
        changes_(changes),
        list_(List()) {}

  const std::string& name() const noexcept { return *facts_.name; }
  const PayloadType& type() const noexcept { return facts_.type; }
  const ErrorSink& errors() const noexcept { return *errors_; }

  /// A topic may lose its last owner in one of its own callbacks: it then ends after them.
  static std::shared_ptr<Topic> make(const std::string& name, PayloadType type,
                                     std::shared_ptr<ErrorSink> errors,
                                     const std::shared_ptr<Topic>& changes) {
    Topic* const made = new Topic(name, type, std::move(errors), changes);
    return std::shared_ptr<Topic>(made, &Topic::endLater);
  }

  /// Nobody publishes or subscribes any more.
  ~Topic() override {
    for (const std::shared_ptr<Subscription>& one : list_.copy()) leave(one, *errors_);
  }

  /// Calls everyone who listens now, in the order of subscribing.
  void deliver(AnyLetter& letter) {
    const Delivering delivering(errors_->thread());
    if (is_latched_.load(std::memory_order_relaxed)) return deliverAndKeep(letter);
    const ReadMostly<List>::Reader list(list_);
    deliverTo(*list, letter);
  }

  /// From now on the last message is kept for those who subscribe later.
  void latch() noexcept { is_latched_.store(true); }
  bool isLatched() const noexcept { return is_latched_.load(); }

  /// Adds one who listens; where a message is latched he gets it first, and none before it.
  void add(const std::shared_ptr<Subscription>& subscription) {
    std::uint64_t seen = 0;
    while (!addAfter(seen, subscription)) {
      const Latched last = latched();
      seen = last.number;
      if (last.letter == nullptr) continue;
      const Delivering delivering(errors_->thread());
      errors_->guard(name(), [&] { subscription->receive(*last.letter, facts_); });
    }
  }

  /// Adds the one who answers; false where there is one already.
  bool addOnly(const std::shared_ptr<Subscription>& subscription) {
    bool added = false;
    list_.replace([&](const List& list) {
      added = list.empty();
      List next = list;
      if (added) next.push_back(subscription);
      return next;
    });
    if (added) ++subscription->places;
    return added;
  }

  /// False where it was not there. Publishers that are delivering just now may still reach it.
  bool remove(const std::shared_ptr<Subscription>& subscription) {
    bool was_there = false;
    list_.replace([&](const List& list) {
      List next;
      for (const std::shared_ptr<Subscription>& one : list) {
        if (one != subscription) next.push_back(one);
      }
      was_there = next.size() != list.size();
      return next;
    });
    if (was_there) --subscription->places;
    return was_there;
  }
  /// Waits for the publishers that are delivering just now. Not to be called in a callback.
  void waitForPublishers() { list_.waitForReaders(); }

  /// Tells those who want to know.
  void tell(TopicChange::Kind kind) const {
    const std::shared_ptr<Topic> changes = changes_.lock();
    if (changes == nullptr || changes->subscriptions().empty()) return;
    const TopicChange change = {kind, name(), type().name()};
    Letter<TopicChange> letter(change);
    changes->deliver(letter);
  }

  List subscriptions() const { return list_.copy(); }
  std::uint64_t messageCount() const noexcept { return list_.readCount(); }

  std::atomic<std::size_t> publisher_count{0};

  /// One place less; who gives up the last ends the subscription.
  static void leave(const std::shared_ptr<Subscription>& subscription, const ErrorSink& errors) {
    if (--subscription->places > 0 || !subscription->is_active.exchange(false)) return;
    subscription->close(subscription->atEnd());
    if (!errors.thread().isCalling()) subscription->finish();
  }

 private:
  static void endLater(Topic* topic) { topic->errors_->thread().destroyLater(topic); }

  struct Latched {
    std::shared_ptr<AnyLetter> letter;
    std::uint64_t number;
  };

  Latched latched() {
    const std::lock_guard<std::mutex> lock(latch_mutex_);
    return latched_;
  }

  void deliverTo(const List& list, AnyLetter& letter) {
    const std::shared_ptr<Subscription>* next = list.data();
    const std::shared_ptr<Subscription>* const end = next + list.size();
    while (next != end) {
      errors_->guard(name(), [&] {
        while (next != end) {
          Subscription& one = **next;
          ++next;  // who throws has had his turn
          if (one.is_active.load()) one.receive(letter, facts_);
        }
      });
    }
  }

  // Who is added after the message was kept gets it from there, and so not from this list.
  GSLAM_COLD void deliverAndKeep(AnyLetter& letter) {
    const std::shared_ptr<AnyLetter> kept = letter.kept();
    std::unique_lock<std::mutex> lock(latch_mutex_);
    latched_.letter = kept;
    ++latched_.number;
    const ReadMostly<List>::Reader list(list_);
    lock.unlock();
    deliverTo(*list, letter);
  }

  // False where a message was latched after number `seen`.
  bool addAfter(std::uint64_t seen, const std::shared_ptr<Subscription>& subscription) {
    const std::lock_guard<std::mutex> lock(latch_mutex_);
    if (latched_.number != seen) return false;
    list_.replace([&](const List& list) {
      List next = list;
      next.push_back(subscription);
      return next;
    });
    ++subscription->places;
    return true;
  }

  const TopicFacts facts_;
  const std::shared_ptr<ErrorSink> errors_;
  const std::weak_ptr<Topic> changes_;
  ReadMostly<List> list_;
  std::atomic<bool> is_latched_{false};
  std::mutex latch_mutex_;
  Latched latched_ = {nullptr, 0};
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_TOPIC_H
