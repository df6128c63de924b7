#ifndef GSLAM_MESSENGER_TIME_POLICY_H
#define GSLAM_MESSENGER_TIME_POLICY_H

#include <gslam/base/error.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

/// @file
/// Which messages of several topics belong together.

namespace gslam {
inline namespace v1 {

/// A Synchronizer takes no more topics than that.
constexpr std::size_t max_synchronized_topics = 4;

/// Messages with the same stamp belong together.
///
/// A set is delivered once all topics have a message of its stamp; sets that are older and still
/// lack a message are dropped then. Messages may come in any order, but those that are not later
/// than the last set are dropped. When two messages of one topic have the same stamp, the one that
/// came first is dropped. As many incomplete sets are kept as the queue size says; beyond that the
/// oldest is dropped.
class ExactTime {};

/// Messages that are close in time belong together; how close follows from the messages.
///
/// The algorithm is the one that message_filters of ROS describes as ApproximateTime (wiki page
/// message_filters/ApproximateTime). The **spread** of a set is the time between its earliest and
/// its latest message. What holds, as long as no queue is full:
///
/// 1. There is nothing to tune: no rate, no epsilon. What can be set is optional.
/// 2. A message is in one set at most; the rest is dropped.
/// 3. Sets do not cross: of two sets, one has the earlier message on every topic.
/// 4. Sets are contiguous: from what lies between two of them no other set could have been made.
/// 5. Each set has the least spread of all that are contiguous to the one before; of equal ones it
///    is the earliest.
/// 6. The sets follow from the stamps alone, not from which topic was faster. A set is delivered
///    as soon as nothing that may still come could be better.
///
/// The key is the *pivot*: the latest of the first messages of the queues. It is in the best set,
/// since who leaves it out for a later message of its topic gains nothing. Sets that hold the pivot
/// are tried from the earliest on, by leaving out the earliest message each time, until that is the
/// pivot. Where a queue ends before, the message to come is taken to be as good as it can be; if
/// even so it makes no better set, the best is delivered, else it waits.
///
/// A message that is earlier than the one before on its topic is dropped; equal stamps are fine.
/// When a queue is full its first message is dropped, and 4 to 6 hold for what is left.
///
/// A value; copies may be used by any thread.
class ApproximateTime {
 public:
  /// With sets of any spread.
  ApproximateTime() = default;

  /// With sets of no more than this spread: a message that is in none such is dropped, and sets are
  /// contiguous among those that keep to it.
  /// @param nanoseconds  the greatest spread
  /// @throws ArgumentError where it is negative
  ApproximateTime maxGap(std::int64_t nanoseconds) const {
    if (nanoseconds < 0) throw ArgumentError("max_gap", "is negative, expected nanoseconds");
    ApproximateTime changed = *this;
    changed.max_gap = static_cast<std::uint64_t>(nanoseconds);
    return changed;
  }

  /// Prefers early sets: when sets are compared, the time that one reaches beyond the pivot counts
  /// (1 + penalty) times. Sets come earlier and there may be more of them, but they are worse.
  /// @throws ArgumentError for what is negative or no number
  ApproximateTime agePenalty(double penalty) const {
    if (!(penalty >= 0)) throw ArgumentError("penalty", "is no number of 0 or more");
    ApproximateTime changed = *this;
    changed.age_penalty = penalty;
    return changed;
  }

  /// Promises that messages of a topic are no closer in time than this, so that sets may come
  /// earlier: the next message need not be waited for. Where the promise is broken sets may not be
  /// the best.
  /// @param topic        its place among the topics of the Synchronizer, from 0
  /// @param nanoseconds  the least time between two messages
  /// @throws ArgumentError where there can be no such topic, or the time is negative
  ApproximateTime atLeastApart(std::size_t topic, std::int64_t nanoseconds) const {
    if (topic >= max_synchronized_topics) throw ArgumentError("topic", "is none, expected 0 to 3");
    if (nanoseconds < 0) throw ArgumentError("time", "is negative, expected nanoseconds");
    ApproximateTime changed = *this;
    changed.least_distance[topic] = nanoseconds;
    return changed;
  }

  std::uint64_t max_gap = std::numeric_limits<std::uint64_t>::max();         ///< nanoseconds
  double age_penalty = 0;                                                    ///< of 0 or more
  std::array<std::int64_t, max_synchronized_topics> least_distance = {{0}};  ///< nanoseconds
};

/// Messages with the same stamp belong together.
inline ExactTime exactTime() {
  return ExactTime();
}

/// Messages that are close in time belong together.
inline ApproximateTime approximateTime() {
  return ApproximateTime();
}
/// Messages that are close in time belong together, but no further apart than this.
/// @param max_gap  nanoseconds between the earliest and the latest of a set
/// @throws ArgumentError where it is negative
inline ApproximateTime approximateTime(std::int64_t max_gap) {
  return ApproximateTime().maxGap(max_gap);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_TIME_POLICY_H
