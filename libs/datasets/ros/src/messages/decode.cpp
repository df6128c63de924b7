#include "decode.h"

#include <gslam/core/stamp.h>

#include <algorithm>

namespace gslam {
inline namespace v1 {
namespace ros {

std::string plainType(const std::string& type) {
  const std::size_t middle = type.find("/msg/");
  return middle == std::string::npos ? type : type.substr(0, middle) + type.substr(middle + 4);
}

std::string nameOf(const Recording& recording, const MessageRef& message) {
  return recording.path() + ", topic " + recording.topics()[message.topic].name + ", message at " +
         secondsText(message.stamp) + " s";
}

Header readHeader(const Recording& recording, const MessageRef& ref) {
  constexpr std::size_t kUsual = 128;  // names of frames are short
  const WireKind kind = wireKindOf(recording.topics()[ref.topic]);
  const std::vector<std::uint8_t> head = recording.readHead(ref, kUsual);
  try {
    return decode<Header>(Bytes(head), kind, nameOf(recording, ref));
  } catch (const ParseError&) {
    if (head.size() < kUsual) throw;
  }
  return readMessage<Header>(recording, ref);
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
