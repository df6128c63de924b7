// Messages of a recording as structs.
#ifndef GSLAM_DATASETS_ROS_SRC_MESSAGES_DECODE_H
#define GSLAM_DATASETS_ROS_SRC_MESSAGES_DECODE_H

#include <gslam/datasets_ros/recording.h>

#include <cstdint>
#include <string>
#include <vector>

#include "messages.h"
#include "wire.h"

namespace gslam {
inline namespace v1 {
namespace ros {

enum class WireKind { ros1, cdr, unknown };

/// How messages of a topic are serialized.
inline WireKind wireKindOf(const RecordedTopic& topic) noexcept {
  if (topic.encoding == "ros1") return WireKind::ros1;
  return topic.encoding == "cdr" ? WireKind::cdr : WireKind::unknown;
}

/// Reads a message of this type.
/// @param name  of it for errors; must live as long as this runs
/// @throws ParseError when it ends early, or has another serialization
template <class Message>
Message decode(Bytes bytes, WireKind kind, const std::string& name) {
  Message message;
  if (kind == WireKind::ros1) {
    Ros1Wire wire(bytes, name);
    wire(message);
  } else if (kind == WireKind::cdr) {
    CdrWire wire(bytes, name);
    wire(message);
  } else {
    throw ParseError(name, 0, 0, "the serialization is neither of ROS 1 nor CDR");
  }
  return message;
}

/// "run.bag, topic /imu, message at 12.5 s".
std::string nameOf(const Recording& recording, const MessageRef& message);

/// Reads a message of a recording. Not for those that view their bytes.
template <class Message>
Message readMessage(const Recording& recording, const MessageRef& ref) {
  const std::vector<std::uint8_t> bytes = recording.read(ref);
  const WireKind kind = wireKindOf(recording.topics()[ref.topic]);
  return decode<Message>(Bytes(bytes), kind, nameOf(recording, ref));
}

/// The header, which all messages with a stamp begin with.
Header readHeader(const Recording& recording, const MessageRef& ref);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MESSAGES_DECODE_H
