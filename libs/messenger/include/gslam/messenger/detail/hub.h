// What all handles of a messenger share: its topics, and who listens to all that match a pattern.
#ifndef GSLAM_MESSENGER_DETAIL_HUB_H
#define GSLAM_MESSENGER_DETAIL_HUB_H

#include <gslam/messenger/detail/topic_name.h>
#include <gslam/messenger/topic.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Topics by name.
class Hub {
 public:
  using Topics = std::map<std::string, std::shared_ptr<Topic>>;

  Hub()
      : errors_(std::make_shared<ErrorSink>()),
        changes_(
            Topic::make("/messenger/changes", PayloadType::of<TopicChange>(), errors_, nullptr)) {
    topics_[changes_->name()] = changes_;
  }
  ~Hub() {
    for (const std::shared_ptr<Subscription>& one : patterns_) Topic::leave(one);
  }
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  const std::shared_ptr<ErrorSink>& errors() const noexcept { return errors_; }

  /// The topic of that name, made where there is none.
  /// @throws TypeMismatch where it carries another type
  std::shared_ptr<Topic> topic(const std::string& name, const PayloadType& type) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_shut_down_) throw Error("the messenger was shut down: nothing can be joined to it");
    std::shared_ptr<Topic>& found = topics_[name];
    if (!found) found = makeTopic(name, type);
    if (found->type() != type) throw TypeMismatch(name, found->type().name(), type.name());
    return found;
  }

  /// The topic of that name and type, or null.
  std::shared_ptr<Topic> knownTopic(const std::string& name, const PayloadType& type) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_shut_down_) return nullptr;
    const Topics::const_iterator found = topics_.find(name);
    return found != topics_.end() && found->second->type() == type ? found->second : nullptr;
  }

  /// The topic on which calls of that service go, made where there is none.
  /// @throws TypeMismatch where it has other types
  std::shared_ptr<Topic> service(const std::string& name, const PayloadType& type) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_shut_down_) throw Error("the messenger was shut down: nothing can be joined to it");
    std::shared_ptr<Topic>& found = services_[name];
    if (!found) found = Topic::make(name, type, errors_, nullptr);
    if (found->type() != type) throw TypeMismatch(name, found->type().name(), type.name());
    return found;
  }

  /// Whether somebody answers calls of that service.
  bool isServed(const std::string& name) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Topics::const_iterator found = services_.find(name);
    return found != services_.end() && !found->second->subscriptions().empty();
  }

  /// Ends all subscriptions, and refuses more.
  void shutDown(Pending pending) {
    std::vector<std::shared_ptr<Topic>> all;
    std::vector<std::shared_ptr<Subscription>> subscriptions;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_shut_down_ = true;
      subscriptions.swap(patterns_);
      for (const Topics* topics : {&topics_, &services_}) {
        for (const Topics::value_type& one : *topics) all.push_back(one.second);
      }
    }
    for (const std::shared_ptr<Topic>& one : all) {
      const Topic::List list = one->subscriptions();
      subscriptions.insert(subscriptions.end(), list.begin(), list.end());
    }
    for (const std::shared_ptr<Subscription>& one : subscriptions) end(one, all, pending);
  }

  /// All topics that there are now.
  Topics topics() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return topics_;
  }

  /// Adds one who listens to all topics that match its pattern, now and later.
  void addPattern(const std::shared_ptr<Subscription>& subscription) {
    std::vector<std::shared_ptr<Topic>> matching;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      patterns_.push_back(subscription);
      ++subscription->places;
      for (const Topics::value_type& one : topics_) {
        if (matches(subscription->topic(), one.first)) matching.push_back(one.second);
      }
    }
    for (const std::shared_ptr<Topic>& one : matching) {
      one->add(subscription);
      one->tell(TopicChange::subscriber_came);
    }
  }

  /// Ends a subscription to a pattern.
  void endPattern(const std::shared_ptr<Subscription>& subscription, Pending pending) {
    std::vector<std::shared_ptr<Topic>> all;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (auto one = patterns_.begin(); one != patterns_.end(); ++one) {
        if (*one != subscription) continue;
        patterns_.erase(one);
        --subscription->places;
        break;
      }
      for (const Topics::value_type& one : topics_) all.push_back(one.second);
    }
    end(subscription, all, pending);
  }

  /// Takes a subscription out of those of the topics that it is in, and ends it.
  static void end(const std::shared_ptr<Subscription>& subscription,
                  const std::vector<std::shared_ptr<Topic>>& topics, Pending pending) {
    if (!subscription->is_active.exchange(false)) return;
    std::vector<std::shared_ptr<Topic>> left;
    for (const std::shared_ptr<Topic>& one : topics) {
      if (one->remove(subscription)) left.push_back(one);
    }
    subscription->close(pending);  // lets publishers go that wait for room
    for (const std::shared_ptr<Topic>& one : left) one->waitForPublishers();
    subscription->finish();
    for (const std::shared_ptr<Topic>& one : left) one->tell(TopicChange::subscriber_left);
  }

 private:
  // What the messenger tells of itself must be asked for: who records all topics does not change
  // what there is to record.
  static bool matches(const std::string& pattern, const std::string& name) {
    const std::string ours = "/messenger/";
    const bool is_ours = name.compare(0, ours.size(), ours) == 0;
    return matchesPattern(pattern, name) &&
           (!is_ours || pattern.compare(0, ours.size(), ours) == 0);
  }

  std::shared_ptr<Topic> makeTopic(const std::string& name, const PayloadType& type) {
    std::shared_ptr<Topic> made = Topic::make(name, type, errors_, changes_);
    for (const std::shared_ptr<Subscription>& one : patterns_) {
      if (matches(one->topic(), name)) made->add(one);
    }
    return made;
  }

  const std::shared_ptr<ErrorSink> errors_;
  const std::shared_ptr<Topic> changes_;
  mutable std::mutex mutex_;  // guards all below
  Topics topics_;
  Topics services_;
  std::vector<std::shared_ptr<Subscription>> patterns_;
  bool is_shut_down_ = false;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_HUB_H
