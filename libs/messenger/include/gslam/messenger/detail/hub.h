// What all handles of a messenger share: its topics, and who listens to all that match a pattern.
#ifndef GSLAM_MESSENGER_DETAIL_HUB_H
#define GSLAM_MESSENGER_DETAIL_HUB_H

#include <gslam/messenger/detail/topic_name.h>
#include <gslam/messenger/topic.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

using Topics = std::vector<std::shared_ptr<Topic>>;

/// Topics in the order of their names, found by halving: there are few, and they stay.
class TopicTable {
 public:
  const Topics& all() const noexcept { return all_; }

  /// Null where there is none of that name.
  std::shared_ptr<Topic> find(const std::string& name) const {
    const std::size_t place = placeOf(name);
    return place < all_.size() && all_[place]->name() == name ? all_[place] : nullptr;
  }

  void add(const std::shared_ptr<Topic>& topic) {
    const std::size_t place = placeOf(topic->name());
    all_.push_back(topic);
    for (std::size_t i = all_.size() - 1; i > place; --i) all_[i].swap(all_[i - 1]);
  }

 private:
  // Of the first that is not before the name.
  std::size_t placeOf(const std::string& name) const {
    std::size_t first = 0;
    for (std::size_t end = all_.size(); first < end;) {
      const std::size_t middle = first + (end - first) / 2;
      if (all_[middle]->name() < name) {
        first = middle + 1;
      } else {
        end = middle;
      }
    }
    return first;
  }

  Topics all_;
};

/// All that is in a messenger.
class Hub {
 public:
  Hub()
      : errors_(std::make_shared<ErrorSink>()),
        changes_(
            Topic::make("/messenger/changes", PayloadType::of<TopicChange>(), errors_, nullptr)) {
    topics_.add(changes_);
  }
  ~Hub() {
    for (const std::shared_ptr<Subscription>& one : patterns_) Topic::leave(one, *errors_);
  }
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  const std::shared_ptr<ErrorSink>& errors() const noexcept { return errors_; }

  /// The topic of that name, made where there is none.
  /// @throws TypeMismatch where it carries another type
  std::shared_ptr<Topic> topic(const std::string& name, const PayloadType& type) {
    const std::lock_guard<std::mutex> lock(mutex_);
    refuseIfShutDown();
    std::shared_ptr<Topic> found = topics_.find(name);
    if (!found) found = makeTopic(name, type);
    if (found->type() != type) throw TypeMismatch(name, found->type().name(), type.name());
    return found;
  }

  /// The topic of that name and type, or null.
  std::shared_ptr<Topic> knownTopic(const std::string& name, const PayloadType& type) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_shut_down_) return nullptr;
    std::shared_ptr<Topic> found = topics_.find(name);
    if (found != nullptr && found->type() != type) found.reset();
    return found;
  }

  /// The topic on which calls of that service go, made where there is none.
  /// @throws TypeMismatch where it has other types
  std::shared_ptr<Topic> service(const std::string& name, const PayloadType& type) {
    const std::lock_guard<std::mutex> lock(mutex_);
    refuseIfShutDown();
    std::shared_ptr<Topic> found = services_.find(name);
    if (!found) {
      found = Topic::make(name, type, errors_, nullptr);
      services_.add(found);
    }
    if (found->type() != type) throw TypeMismatch(name, found->type().name(), type.name());
    return found;
  }

  /// Whether somebody answers calls of that service.
  bool isServed(const std::string& name) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::shared_ptr<Topic> found = services_.find(name);
    return found != nullptr && !found->subscriptions().empty();
  }

  /// For who has just joined a subscription: a shutdown that did not see it has begun before.
  /// @throws Error after a shutdown
  void refuseAfterShutDown() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    refuseIfShutDown();
  }

  /// Ends all subscriptions, and refuses more.
  void shutDown(Pending pending) {
    Topics all;
    Topic::List subscriptions;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_shut_down_ = true;
      subscriptions.swap(patterns_);
      all = topics_.all();
      for (const std::shared_ptr<Topic>& one : services_.all()) all.push_back(one);
    }
    for (const std::shared_ptr<Topic>& one : all) {
      for (const std::shared_ptr<Subscription>& its : one->subscriptions()) {
        subscriptions.push_back(its);
      }
    }
    for (const std::shared_ptr<Subscription>& one : subscriptions) {
      end(one, all.data(), all.size(), pending);
    }
  }

  /// All topics that there are now.
  Topics topics() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return topics_.all();
  }

  /// Adds one who listens to all topics that match its pattern, now and later.
  /// @throws Error after a shutdown, also one that comes meanwhile
  void addPattern(const std::shared_ptr<Subscription>& subscription) {
    Topics matching;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      refuseIfShutDown();
      patterns_.push_back(subscription);
      ++subscription->places;
      for (const std::shared_ptr<Topic>& one : topics_.all()) {
        if (matches(subscription->topic(), one->name())) matching.push_back(one);
      }
    }
    for (const std::shared_ptr<Topic>& one : matching) {
      one->add(subscription);
      one->tell(TopicChange::subscriber_came);
    }
    refuseAfterShutDown();
  }

  /// Ends a subscription to a pattern.
  void endPattern(const std::shared_ptr<Subscription>& subscription, Pending pending) {
    Topics all;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (std::size_t i = 0; i < patterns_.size(); ++i) {
        if (patterns_[i] != subscription) continue;
        for (; i + 1 < patterns_.size(); ++i) patterns_[i].swap(patterns_[i + 1]);
        patterns_.pop_back();
        --subscription->places;
      }
      all = topics_.all();
    }
    end(subscription, all.data(), all.size(), pending);
  }

  /// Takes a subscription out of those of the topics that it is in, and ends it. Several may do so
  /// at once: each waits for its callbacks, unless he is in a callback himself.
  /// @param topics  `count` of them, one at least
  static void end(const std::shared_ptr<Subscription>& subscription,
                  const std::shared_ptr<Topic>* topics, std::size_t count, Pending pending) {
    const bool is_first = subscription->is_active.exchange(false);
    Topics left;
    for (std::size_t i = 0; i < count; ++i) {
      if (topics[i]->remove(subscription)) left.push_back(topics[i]);
    }
    if (is_first) subscription->close(pending);  // lets publishers go that wait for room
    if (!topics[0]->errors().thread().isCalling()) {
      for (std::size_t i = 0; i < count; ++i) {
        // who is not the first does not know where it was taken out
        const bool was_in =
            is_first ? isAmong(left, topics[i]) : matches(subscription->topic(), topics[i]->name());
        if (was_in) topics[i]->waitForPublishers();
      }
      subscription->finish();
    }
    for (const std::shared_ptr<Topic>& one : left) one->tell(TopicChange::subscriber_left);
  }

 private:
  static bool isAmong(const Topics& topics, const std::shared_ptr<Topic>& topic) {
    return std::find(topics.begin(), topics.end(), topic) != topics.end();
  }

  // What the messenger tells of itself must be asked for: who records all topics does not change
  // what there is to record.
  static bool matches(const std::string& pattern, const std::string& name) {
    const std::string ours = "/messenger/";
    const bool is_ours = name.compare(0, ours.size(), ours) == 0;
    return matchesPattern(pattern, name) &&
           (!is_ours || pattern.compare(0, ours.size(), ours) == 0);
  }

  void refuseIfShutDown() const {
    if (is_shut_down_) throw Error("the messenger was shut down: nothing can be joined to it");
  }

  std::shared_ptr<Topic> makeTopic(const std::string& name, const PayloadType& type) {
    std::shared_ptr<Topic> made = Topic::make(name, type, errors_, changes_);
    for (const std::shared_ptr<Subscription>& one : patterns_) {
      if (matches(one->topic(), name)) made->add(one);
    }
    topics_.add(made);
    return made;
  }

  const std::shared_ptr<ErrorSink> errors_;
  const std::shared_ptr<Topic> changes_;
  mutable std::mutex mutex_;  // guards all below
  TopicTable topics_;
  TopicTable services_;
  Topic::List patterns_;
  bool is_shut_down_ = false;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_HUB_H
