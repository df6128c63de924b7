#ifndef GSLAM_MESSENGER_INFO_H
#define GSLAM_MESSENGER_INFO_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What a messenger tells of its topics.

namespace gslam {
inline namespace v1 {

/// One who listens to a topic.
struct SubscriberInfo {
  std::string name;       ///< as SubscribeOptions::named() gave it; may be empty
  std::string pattern;    ///< the name or pattern it subscribed to
  bool takes_any;         ///< whether it takes messages of any type
  std::size_t waiting;    ///< messages in its queue now, of all topics
  std::uint64_t dropped;  ///< messages that it lost, of all topics
};

/// One topic at one moment.
struct TopicInfo {
  std::string name;                          ///< with its first slash
  std::string type;                          ///< as C++ calls it
  std::size_t type_size;                     ///< of the type itself, in bytes
  std::size_t publishers;                    ///< handles that were advertised and are still there
  std::uint64_t messages;                    ///< published since the topic was made
  std::uint64_t bytes;                       ///< of all these; 0 for types that point elsewhere
  bool is_latched;                           ///< whether the last one is kept
  std::vector<SubscriberInfo> subscribers;   ///< in the order of subscribing
  std::chrono::steady_clock::time_point at;  ///< when this was true
};

/// What has changed among the topics of a messenger, which says so on the topic
/// "/messenger/changes":
///
///     messenger.subscribe<TopicChange>("/messenger/changes", show);
///
/// It is said in the thread that made the change, after it.
struct TopicChange {
  /// What can change.
  enum Kind { publisher_came, publisher_left, subscriber_came, subscriber_left };
  Kind kind;          ///< what has changed
  std::string topic;  ///< where
  std::string type;   ///< of its messages, as C++ calls it
};

/// Messages a second between two moments of one topic; 0 where no time passed.
inline double messageRate(const TopicInfo& before, const TopicInfo& after) {
  const double seconds = std::chrono::duration<double>(after.at - before.at).count();
  return seconds > 0 ? static_cast<double>(after.messages - before.messages) / seconds : 0;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_INFO_H
