#include "storage.h"

#include <gslam/base/error.h>

#include "file_kind.h"

namespace gslam {
inline namespace v1 {
namespace ros {

std::uint32_t TopicList::add(const std::string& name, const std::string& type,
                             const std::string& encoding, const std::string& file) {
  constexpr std::size_t kMost = 1U << 16;
  const auto found = places_.find({name, type, encoding});
  if (found != places_.end()) return found->second;
  if (topics.size() == kMost) {
    throw FileError(file, "has more than " + std::to_string(kMost) + " topics");
  }
  const std::uint32_t place = static_cast<std::uint32_t>(topics.size());
  places_.emplace(std::array<std::string, 3>{name, type, encoding}, place);
  RecordedTopic topic;
  topic.name = name;
  topic.type = type;
  topic.encoding = encoding;
  topics.push_back(topic);
  return place;
}

void TopicList::clear() {
  topics.clear();
  places_.clear();
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
