// Sets of messages with the same stamp.
#ifndef GSLAM_MESSENGER_DETAIL_EXACT_MATCHER_H
#define GSLAM_MESSENGER_DETAIL_EXACT_MATCHER_H

#include <gslam/messenger/detail/matcher.h>

#include <map>

namespace gslam {
inline namespace v1 {
namespace detail {

/// What ExactTime says.
class ExactMatcher final : public Matcher {
 public:
  ExactMatcher(std::size_t topics, std::size_t queue_size)
      : topics_(topics), queue_size_(queue_size) {}

  void add(std::size_t topic, StampedMessage one, MatchResult& result) override {
    if (has_delivered_ && one.stamp <= last_delivered_) {
      result.dropped.push_back({topic, std::move(one.message)});
      return;
    }
    const Sets::iterator set = sets_.emplace(one.stamp, MessageSet()).first;
    std::shared_ptr<const void>& place = set->second[topic];
    place.swap(one.message);
    if (one.message != nullptr) {
      result.dropped.push_back({topic, std::move(one.message)});
    } else if (isComplete(set->second)) {
      deliver(set, result);
    } else if (sets_.size() > queue_size_) {
      dropFirst(result);
    }
  }

  void clear(MatchResult& result) override {
    while (!sets_.empty()) dropFirst(result);
    has_delivered_ = false;
  }

  std::size_t waiting(std::size_t topic) const override {
    std::size_t count = 0;
    for (const Sets::value_type& set : sets_) count += set.second[topic] != nullptr ? 1 : 0;
    return count;
  }

 private:
  using Sets = std::map<std::int64_t, MessageSet>;  // by stamp

  bool isComplete(const MessageSet& set) const {
    for (std::size_t topic = 0; topic < topics_; ++topic) {
      if (set[topic] == nullptr) return false;
    }
    return true;
  }

  void deliver(Sets::iterator set, MatchResult& result) {
    while (sets_.begin() != set) dropFirst(result);
    result.sets.push_back(std::move(set->second));
    last_delivered_ = set->first;
    has_delivered_ = true;
    sets_.erase(set);
  }

  void dropFirst(MatchResult& result) {
    MessageSet& first = sets_.begin()->second;
    for (std::size_t topic = 0; topic < topics_; ++topic) {
      if (first[topic] != nullptr) result.dropped.push_back({topic, std::move(first[topic])});
    }
    sets_.erase(sets_.begin());
  }

  const std::size_t topics_;
  const std::size_t queue_size_;
  Sets sets_;
  std::int64_t last_delivered_ = 0;
  bool has_delivered_ = false;
};

inline std::unique_ptr<Matcher> makeMatcher(const ExactTime&, std::size_t topics,
                                            std::size_t queue_size) {
  return std::unique_ptr<Matcher>(new ExactMatcher(topics, queue_size));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_EXACT_MATCHER_H
