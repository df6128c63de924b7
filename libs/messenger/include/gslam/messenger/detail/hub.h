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

  Hub() : errors_(std::make_shared<ErrorSink>()) {}
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
    std::shared_ptr<Topic>& found = topics_[name];
    if (!found) found = makeTopic(name, type);
    if (found->type() != type) throw TypeMismatch(name, found->type().name(), type.name());
    return found;
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
        if (matchesPattern(subscription->topic(), one.first)) matching.push_back(one.second);
      }
    }
    for (const std::shared_ptr<Topic>& one : matching) one->add(subscription);
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

  /// Takes a subscription out of topics and ends it.
  static void end(const std::shared_ptr<Subscription>& subscription,
                  const std::vector<std::shared_ptr<Topic>>& topics, Pending pending) {
    if (!subscription->is_active.exchange(false)) return;
    for (const std::shared_ptr<Topic>& one : topics) one->remove(subscription);
    subscription->close(pending);  // lets publishers go that wait for room
    for (const std::shared_ptr<Topic>& one : topics) one->waitForPublishers();
    subscription->finish();
  }

 private:
  std::shared_ptr<Topic> makeTopic(const std::string& name, const PayloadType& type) {
    const std::shared_ptr<Topic> made = Topic::make(name, type, errors_);
    for (const std::shared_ptr<Subscription>& one : patterns_) {
      if (matchesPattern(one->topic(), name)) made->add(one);
    }
    return made;
  }

  const std::shared_ptr<ErrorSink> errors_;
  mutable std::mutex mutex_;  // guards all below
  Topics topics_;
  std::vector<std::shared_ptr<Subscription>> patterns_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_HUB_H
