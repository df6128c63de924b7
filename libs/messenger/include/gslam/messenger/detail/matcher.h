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
template <std::size_t Topics>
using MessageSet = std::array<std::shared_ptr<const void>, Topics>;

/// What becomes of messages when one more has come.
template <std::size_t Topics>
struct MatchResult {
  struct Dropped {
    std::size_t topic;
    std::shared_ptr<const void> message;
  };
  std::vector<MessageSet<Topics>> sets;  // in the order of time
  std::vector<Dropped> dropped;          // kept, so that they can be destroyed without a lock
};

/// Keeps messages until it knows their set. Not thread-safe.
template <std::size_t Topics>
class Matcher {
 public:
  using Result = MatchResult<Topics>;

  Matcher() = default;
  virtual ~Matcher() = default;
  Matcher(const Matcher&) = delete;
  Matcher& operator=(const Matcher&) = delete;

  /// One more message.
  virtual void add(std::size_t topic, StampedMessage message, Result& result) = 0;
  /// Drops all messages, and forgets all stamps.
  virtual void clear(Result& result) = 0;
  /// Messages of a topic that are kept.
  virtual std::size_t waiting(std::size_t topic) const = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_MATCHER_H
