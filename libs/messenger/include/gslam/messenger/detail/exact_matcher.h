// Sets of messages with the same stamp.
#ifndef GSLAM_MESSENGER_DETAIL_EXACT_MATCHER_H
#define GSLAM_MESSENGER_DETAIL_EXACT_MATCHER_H

#include <gslam/messenger/detail/matcher.h>

#include <map>

namespace gslam {
inline namespace v1 {
namespace detail {

/// What ExactTime says.
template <std::size_t Topics>
class ExactMatcher final : public Matcher<Topics> {
 public:
  using Result = MatchResult<Topics>;

  explicit ExactMatcher(std::size_t queue_size) : queue_size_(queue_size) {}

  void add(std::size_t topic, StampedMessage one, Result& result) override {
    if (has_delivered_ && one.stamp <= last_delivered_) {
      result.dropped.push_back({topic, std::move(one.message)});
      return;
    }
    const SetPlace set = sets_.emplace(one.stamp, MessageSet<Topics>()).first;
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

  void clear(Result& result) override {
    while (!sets_.empty()) dropFirst(result);
    has_delivered_ = false;
  }

  std::size_t waiting(std::size_t topic) const override {
    std::size_t count = 0;
    for (const typename Sets::value_type& set : sets_)
      count += set.second[topic] != nullptr ? 1 : 0;
    return count;
  }

 private:
  using Sets = std::map<std::int64_t, MessageSet<Topics>>;  // by stamp
  using SetPlace = typename Sets::iterator;

  static bool isComplete(const MessageSet<Topics>& set) {
    for (const std::shared_ptr<const void>& message : set) {
      if (message == nullptr) return false;
    }
    return true;
  }

  void deliver(SetPlace set, Result& result) {
    while (sets_.begin() != set) dropFirst(result);
    result.sets.push_back(std::move(set->second));
    last_delivered_ = set->first;
    has_delivered_ = true;
    sets_.erase(set);
  }

  void dropFirst(Result& result) {
    MessageSet<Topics>& first = sets_.begin()->second;
    for (std::size_t topic = 0; topic < Topics; ++topic) {
      if (first[topic] != nullptr) result.dropped.push_back({topic, std::move(first[topic])});
    }
    sets_.erase(sets_.begin());
  }

  const std::size_t queue_size_;
  Sets sets_;
  std::int64_t last_delivered_ = 0;
  bool has_delivered_ = false;
};

template <std::size_t Topics>
std::unique_ptr<Matcher<Topics>> makeMatcher(const ExactTime&, std::size_t queue_size) {
  return std::unique_ptr<Matcher<Topics>>(new ExactMatcher<Topics>(queue_size));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_EXACT_MATCHER_H
