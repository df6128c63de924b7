// Finds messages of several topics that belong together.
#ifndef GSLAM_MESSENGER_DETAIL_MATCHER_H
#define GSLAM_MESSENGER_DETAIL_MATCHER_H

#include <gslam/messenger/time_policy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

struct StampedMessage {
  std::int64_t stamp;  // nanoseconds
  std::shared_ptr<const void> message;
};

/// One message of each topic.
using MessageSet = std::array<std::shared_ptr<const void>, max_synchronized_topics>;

/// What becomes of messages when one more has come.
struct MatchResult {
  struct Dropped {
    std::size_t topic;
    std::shared_ptr<const void> message;
  };
  std::vector<MessageSet> sets;  // in the order of time
  std::vector<Dropped> dropped;  // kept, so that they can be destroyed without a lock
};

/// Keeps messages until it knows their set. Not thread-safe.
class Matcher {
 public:
  Matcher() = default;
  virtual ~Matcher() = default;
  Matcher(const Matcher&) = delete;
  Matcher& operator=(const Matcher&) = delete;

  /// One more message.
  virtual void add(std::size_t topic, StampedMessage message, MatchResult& result) = 0;
  /// Drops all messages, and forgets all stamps.
  virtual void clear(MatchResult& result) = 0;
  /// Messages of a topic that are kept.
  virtual std::size_t waiting(std::size_t topic) const = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_MATCHER_H
