// What all kinds of recordings have in common: topics, an index of messages, and their bytes.
#ifndef GSLAM_DATASETS_ROS_SRC_STORAGE_STORAGE_H
#define GSLAM_DATASETS_ROS_SRC_STORAGE_STORAGE_H

#include <gslam/datasets_ros/recording.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "../bytes/byte_source.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// Topics of a recording, each once: what several publishers write to one topic is one topic.
class TopicList {
 public:
  /// Its number; adds it where it is new.
  /// @param file  for errors
  /// @throws FileError when there are more than any robot has
  std::uint32_t add(const std::string& name, const std::string& type, const std::string& encoding,
                    const std::string& file);
  void clear();
  std::vector<RecordedTopic> topics;

 private:
  std::map<std::array<std::string, 3>, std::uint32_t> places_;
};

/// One file of a recording that was opened: its index is complete, the messages are not loaded.
class Storage {
 public:
  virtual ~Storage() = default;

  /// `count`, `first_stamp` and `last_stamp` are set by whoever puts files together.
  TopicList list;
  /// In the order of the file; `file` is 0.
  std::vector<MessageRef> messages;
  std::vector<std::string> remarks;

  /// The bytes of a message. Threads may call it at once.
  virtual std::vector<std::uint8_t> read(const MessageRef& message) const = 0;
  /// At most the first bytes of a message, where that costs less; it may give all.
  virtual std::vector<std::uint8_t> readHead(const MessageRef& message, std::size_t size) const = 0;

 protected:
  /// Says once for a file how many stamps no int64 can hold.
  void sayHuge(std::size_t skipped, const std::string& file);
};

/// Whether nanoseconds fit.
inline bool isStamp(std::uint64_t nanoseconds) noexcept {
  return nanoseconds <= std::uint64_t(std::numeric_limits<std::int64_t>::max());
}

/// @{
/// @throws FileError that says what is wrong and where
GSLAM_DATASETS_ROS_EXPORT std::unique_ptr<Storage> openBag(std::shared_ptr<const ByteSource> file);
GSLAM_DATASETS_ROS_EXPORT std::unique_ptr<Storage> openMcap(std::shared_ptr<const ByteSource> file);
GSLAM_DATASETS_ROS_EXPORT std::unique_ptr<Storage> openDb3(const std::string& path);
/// @}

/// A file of any of these kinds, by its ending. @throws FileError for another
std::unique_ptr<Storage> openStorage(const std::string& path);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_STORAGE_STORAGE_H
