#include "storage.h"

#include <gslam/base/error.h>

#include <algorithm>

#include "file_kind.h"

namespace gslam {
inline namespace v1 {
namespace ros {

std::uint32_t TopicList::add(const std::string& name, const std::string& type,
                             const std::string& encoding) {
  const auto found = std::find_if(topics.begin(), topics.end(), [&](const RecordedTopic& topic) {
    return topic.name == name && topic.type == type && topic.encoding == encoding;
  });
  const std::size_t place = std::size_t(found - topics.begin());
  if (found == topics.end()) {
    RecordedTopic topic;
    topic.name = name;
    topic.type = type;
    topic.encoding = encoding;
    topics.push_back(topic);
  }
  return static_cast<std::uint32_t>(place);
}

void Storage::sayHuge(std::size_t skipped, const std::string& file) {
  if (skipped == 0) return;
  remarks.push_back(file + ": " + std::to_string(skipped) +
                    " messages were skipped whose stamps are beyond the year 2262");
}

std::unique_ptr<Storage> openStorage(const std::string& path) {
  switch (fileKindOf(path)) {
    case RecordingKind::bag:
      return openBag(openFile(path));
    case RecordingKind::mcap:
      return openMcap(openFile(path));
    case RecordingKind::db3:
      return openDb3(path);
    case RecordingKind::packed:
      throw FileError(path,
                      "is compressed as a whole; `zstd -d` makes a file of it that can be read");
    case RecordingKind::none:
      break;
  }
  throw FileError(path, "is no recording, expected a file that ends in .bag, .db3 or .mcap");
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
