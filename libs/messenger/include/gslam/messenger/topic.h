#ifndef GSLAM_MESSENGER_TOPIC_H
#define GSLAM_MESSENGER_TOPIC_H

#include <gslam/base/error.h>
#include <gslam/base/log.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

/// @file
/// One topic: its name, its type, and who listens. Used through Publisher and Subscriber.

namespace gslam {
inline namespace v1 {
namespace detail {

// One callback that waits for messages of one topic. It gets the address of the publisher's
// std::shared_ptr<const T>, whose T the topic has checked: passing it on costs no reference count.
struct Subscription {
  using Callback = std::function<void(const void*)>;

  explicit Subscription(Callback function) : callback(std::move(function)) {}

  const Callback callback;
  std::atomic<bool> active{true};
};

// Publishing reads an immutable list of subscriptions; subscribing replaces that list. So no lock
// is held while a callback runs, and callbacks may subscribe, unsubscribe and publish.
class Topic {
 public:
  using List = std::vector<std::shared_ptr<Subscription>>;

  Topic(std::string name, const std::type_info& type)
      : name_(std::move(name)), type_(type), list_(std::make_shared<const List>()) {}

  const std::string& name() const noexcept { return name_; }
  const std::type_info& type() const noexcept { return type_; }

  void add(const std::shared_ptr<Subscription>& subscription) {
    std::lock_guard<std::mutex> lock(mutex_);
    auto list = std::make_shared<List>(*list_);
    list->push_back(subscription);
    list_ = std::move(list);
  }

  void remove(const std::shared_ptr<Subscription>& subscription) noexcept {
    subscription->active.store(false, std::memory_order_release);
    std::shared_ptr<const List> old;  // its callbacks end after the lock, they may be anything
    try {
      std::lock_guard<std::mutex> lock(mutex_);
      auto list = std::make_shared<List>(*list_);
      list->erase(std::remove(list->begin(), list->end(), subscription), list->end());
      old = std::move(list_);
      list_ = std::move(list);
    } catch (const std::bad_alloc&) {  // it stays in the list, and is passed over
    }
  }

  std::size_t subscriberCount() const { return subscriptions()->size(); }

  // Calls everyone who listens now, in the order of subscribing.
  void deliver(const void* message) const {
    const std::shared_ptr<const List> list = subscriptions();
    for (const std::shared_ptr<Subscription>& subscription : *list) {
      if (!subscription->active.load(std::memory_order_acquire)) continue;
      try {
        subscription->callback(message);
      } catch (const std::exception& error) {
        GSLAM_LOG(error) << "a subscriber of " << name_ << " threw: " << error.what();
      } catch (...) {
        GSLAM_LOG(error) << "a subscriber of " << name_ << " threw something that is no exception";
      }
    }
  }

 private:
  std::shared_ptr<const List> subscriptions() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return list_;
  }

  const std::string name_;
  const std::type_info& type_;
  mutable std::mutex mutex_;  // guards list_
  std::shared_ptr<const List> list_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_TOPIC_H
