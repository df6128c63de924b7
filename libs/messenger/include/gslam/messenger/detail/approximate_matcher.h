// Sets of messages that are close in time.
#ifndef GSLAM_MESSENGER_DETAIL_APPROXIMATE_MATCHER_H
#define GSLAM_MESSENGER_DETAIL_APPROXIMATE_MATCHER_H

#include <gslam/messenger/detail/matcher.h>

#include <algorithm>
#include <deque>
#include <limits>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Nanoseconds from one stamp to a later one: right for all that an int64 can hold.
inline std::uint64_t nanosecondsBetween(std::int64_t from, std::int64_t to) noexcept {
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

/// What ApproximateTime says, which names the terms used here.
template <std::size_t Topics>
class ApproximateMatcher final : public Matcher<Topics> {
 public:
  using Result = MatchResult<Topics>;

  ApproximateMatcher(const ApproximateTime& policy, std::size_t queue_size)
      : policy_(policy), queue_size_(queue_size) {}

  void add(std::size_t topic, StampedMessage one, Result& result) override {
    Queue& queue = queues_[topic];
    if (one.stamp < queue.newest) {
      result.dropped.push_back({topic, std::move(one.message)});
      return;
    }
    queue.newest = one.stamp;
    queue.messages.push_back(std::move(one));
    match(result);
    if (queue.messages.size() <= queue_size_) return;
    dropFirst(topic, result);
    match(result);
  }

  void clear(Result& result) override {
    for (std::size_t topic = 0; topic < Topics; ++topic) {
      while (!queues_[topic].messages.empty()) dropFirst(topic, result);
      queues_[topic].newest = Queue().newest;
    }
  }

  std::size_t waiting(std::size_t topic) const override { return queues_[topic].messages.size(); }

 private:
  struct Queue {
    std::deque<StampedMessage> messages;
    std::int64_t newest = std::numeric_limits<std::int64_t>::min();  // also of those that left
  };
  // One message of each queue, by its place there.
  using Places = std::array<std::size_t, Topics>;

  void match(Result& result) {
    while (dropHopeless(result)) {
      Places best = {{0}};
      if (!findBest(best)) return dropWorse(best, result);
      deliver(best, result);
    }
  }

  // Every set to come has a message at the pivot or later, so what is too early for the pivot is
  // too early for all. Then the first messages of the queues make a set. False where there is none.
  bool dropHopeless(Result& result) {
    for (std::size_t topic = 0; topic < Topics;) {
      if (std::any_of(queues_.begin(), queues_.end(), isEmpty)) return false;
      if (nanosecondsBetween(firstStamp(topic), pivot()) <= policy_.max_gap) {
        ++topic;
      } else {
        dropFirst(topic, result);
        topic = 0;  // the pivot may be another now
      }
    }
    return true;
  }

  // The best set of the messages that are there; false where there may be a better one with
  // messages to come.
  bool findBest(Places& best) const {
    const std::int64_t middle = pivot();
    Places at = best;
    std::uint64_t least = cost(at, middle);
    for (;;) {
      const std::size_t topic = earliest(at, middle);
      if (stamp(topic, at[topic], middle) >= middle) return true;
      ++at[topic];
      const std::uint64_t next = cost(at, middle);
      if (next >= least) continue;
      if (isBeyondQueues(at)) return false;
      least = next;
      best = at;
    }
  }

  // Sets before the best one so far are out of question. Up to the pivot their messages can go; it
  // saves to look at them again.
  void dropWorse(const Places& best, Result& result) {
    const std::int64_t middle = pivot();
    for (std::size_t topic = 0; topic < Topics; ++topic) {
      for (std::size_t i = 0; i < best[topic]; ++i) {
        if (queues_[topic].messages[1].stamp > middle) break;
        dropFirst(topic, result);
      }
    }
  }

  void deliver(const Places& best, Result& result) {
    MessageSet<Topics> set;
    for (std::size_t topic = 0; topic < Topics; ++topic) {
      for (std::size_t i = 0; i < best[topic]; ++i) dropFirst(topic, result);
      set[topic] = std::move(queues_[topic].messages.front().message);
      queues_[topic].messages.pop_front();
    }
    result.sets.push_back(std::move(set));
  }

  void dropFirst(std::size_t topic, Result& result) {
    std::deque<StampedMessage>& messages = queues_[topic].messages;
    result.dropped.push_back({topic, std::move(messages.front().message)});
    messages.pop_front();
  }

  static bool isEmpty(const Queue& queue) { return queue.messages.empty(); }
  std::int64_t firstStamp(std::size_t topic) const { return queues_[topic].messages.front().stamp; }
  std::int64_t pivot() const {
    std::int64_t latest = firstStamp(0);
    for (std::size_t i = 1; i < Topics; ++i) latest = std::max(latest, firstStamp(i));
    return latest;
  }

  // Of a message to come: the best that it can have, which is at the pivot.
  std::int64_t stamp(std::size_t topic, std::size_t place, std::int64_t middle) const {
    const Queue& queue = queues_[topic];
    if (place < queue.messages.size()) return queue.messages[place].stamp;
    const std::int64_t distance = policy_.least_distance[topic];
    const std::int64_t end = std::numeric_limits<std::int64_t>::max();
    return std::max(middle, queue.newest > end - distance ? end : queue.newest + distance);
  }

  bool isBeyondQueues(const Places& at) const {
    for (std::size_t i = 0; i < Topics; ++i) {
      if (at[i] >= queues_[i].messages.size()) return true;
    }
    return false;
  }

  std::size_t earliest(const Places& at, std::int64_t middle) const {
    std::size_t first = 0;
    for (std::size_t i = 1; i < Topics; ++i) {
      if (stamp(i, at[i], middle) < stamp(first, at[first], middle)) first = i;
    }
    return first;
  }

  // The spread, and the penalty for what lies beyond the pivot.
  std::uint64_t cost(const Places& at, std::int64_t middle) const {
    std::int64_t from = middle;
    std::int64_t to = middle;
    for (std::size_t i = 0; i < Topics; ++i) {
      from = std::min(from, stamp(i, at[i], middle));
      to = std::max(to, stamp(i, at[i], middle));
    }
    const std::uint64_t spread = nanosecondsBetween(from, to);
    const double penalty =
        to > middle ? policy_.age_penalty * static_cast<double>(nanosecondsBetween(middle, to)) : 0;
    const std::uint64_t room = std::numeric_limits<std::uint64_t>::max() - spread;
    // the double next to 2^64 may be beyond it
    if (penalty >= static_cast<double>(room)) return spread + room;
    return spread + static_cast<std::uint64_t>(penalty);
  }

  const ApproximateTime policy_;
  const std::size_t queue_size_;
  std::array<Queue, Topics> queues_;
};

template <std::size_t Topics>
std::unique_ptr<Matcher<Topics>> makeMatcher(const ApproximateTime& policy,
                                             std::size_t queue_size) {
  return std::unique_ptr<Matcher<Topics>>(new ApproximateMatcher<Topics>(policy, queue_size));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_APPROXIMATE_MATCHER_H
