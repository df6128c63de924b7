#include <gslam/base/error.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/datasets_ros/recording.h>

#include <algorithm>
#include <map>
#include <utility>

#include "bytes/decompress.h"
#include "storage/file_kind.h"
#include "storage/folder.h"
#include "storage/storage.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

bool isEarlier(const MessageRef& a, const MessageRef& b) noexcept {
  return a.stamp < b.stamp;
}

// The files of a recording as one.
class Files : public Recording {
 public:
  explicit Files(const std::string& path) : path_(path) {
    if (detail::fileKind(path) == detail::FileKind::folder) {
      openFolder();
    } else {
      add(openStorage(path));
    }
    finish();
  }

  const std::string& path() const noexcept override { return path_; }
  const std::vector<RecordedTopic>& topics() const noexcept override { return list_.topics; }
  const std::vector<std::string>& remarks() const noexcept override { return remarks_; }

  std::size_t topic(const std::string& name) const override {
    const auto& all = list_.topics;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const RecordedTopic& topic) { return topic.name == name; });
    if (found != all.end()) return std::size_t(found - all.begin());
    std::string names;
    for (const RecordedTopic& topic : all) {
      names += (names.empty() ? "" : ", ") + topic.name + " (" + topic.type + ")";
    }
    throw FileError(path_,
                    "has no topic '" + name + "'; there are: " + (names.empty() ? "none" : names));
  }

  std::vector<MessageRef> messages(const std::vector<std::size_t>& topics) const override {
    std::vector<char> is_wanted(list_.topics.size());
    for (const std::size_t topic : topics) {
      if (topic >= is_wanted.size()) {
        throw ArgumentError("topics", "has " + std::to_string(topic) + ", but there are " +
                                          std::to_string(is_wanted.size()));
      }
      is_wanted[topic] = 1;
    }
    std::vector<MessageRef> result;
    std::copy_if(messages_.begin(), messages_.end(), std::back_inserter(result),
                 [&](const MessageRef& message) { return is_wanted[message.topic] != 0; });
    return result;
  }
  std::vector<MessageRef> messages() const override { return messages_; }

  std::vector<std::uint8_t> read(const MessageRef& message) const override {
    return unpacked(storageOf(message).read(inFile(message)), message);
  }
  std::vector<std::uint8_t> readHead(const MessageRef& message, std::size_t size) const override {
    if (are_packed_) return read(message);
    return storageOf(message).readHead(inFile(message), size);
  }

 private:
  void openFolder() {
    RecordingFolder folder = readFolder(path_);
    remarks_ = std::move(folder.remarks);
    are_packed_ = folder.are_messages_packed;
    for (const std::string& file : folder.files) add(openStorage(file));
    if (folder.has_count && folder.message_count != messages_.size()) {
      remarks_.push_back("metadata.yaml counts " + std::to_string(folder.message_count) +
                         " messages, but there are " + std::to_string(messages_.size()));
    }
  }

  void add(std::unique_ptr<Storage> storage) {
    std::vector<std::uint32_t> places;
    for (const RecordedTopic& topic : storage->list.topics) {
      places.push_back(list_.add(topic.name, topic.type, topic.encoding, path_));
    }
    std::map<std::uint32_t, std::uint32_t> back;
    for (std::uint32_t i = 0; i < places.size(); ++i) back[places[i]] = i;
    const std::uint32_t file = static_cast<std::uint32_t>(files_.size());
    messages_.reserve(messages_.size() + storage->messages.size());
    for (MessageRef message : storage->messages) {
      message.topic = places[message.topic];
      message.file = file;
      messages_.push_back(message);
    }
    storage->messages = {};
    remarks_.insert(remarks_.end(), storage->remarks.begin(), storage->remarks.end());
    files_.push_back(std::move(storage));
    topics_in_files_.push_back(std::move(back));
  }

  void finish() {
    if (!std::is_sorted(messages_.begin(), messages_.end(), isEarlier)) {
      std::stable_sort(messages_.begin(), messages_.end(), isEarlier);
    }
    for (const MessageRef& message : messages_) {
      RecordedTopic& topic = list_.topics[message.topic];
      if (topic.count == 0) topic.first_stamp = message.stamp;
      topic.last_stamp = message.stamp;
      ++topic.count;
    }
  }

  const Storage& storageOf(const MessageRef& message) const {
    if (message.file >= files_.size()) {
      throw ArgumentError("message", "is of another recording");
    }
    return *files_[message.file];
  }

  // The message with the topic's number in its own file.
  MessageRef inFile(MessageRef message) const {
    const auto& topics = topics_in_files_[message.file];
    const auto found = topics.find(message.topic);
    if (found == topics.end()) throw ArgumentError("message", "is of another recording");
    message.topic = found->second;
    return message;
  }

  std::vector<std::uint8_t> unpacked(std::vector<std::uint8_t> bytes,
                                     const MessageRef& message) const {
    if (!are_packed_) return bytes;
    try {
      return unpackZstd(Bytes(bytes));
    } catch (const Error& error) {
      throw FileError(path_, "the message of " + std::to_string(message.stamp) + " ns on topic " +
                                 list_.topics[message.topic].name + " " + error.what());
    }
  }

  std::string path_;
  TopicList list_;
  std::vector<MessageRef> messages_;
  std::vector<std::string> remarks_;
  std::vector<std::unique_ptr<Storage>> files_;
  // For each file: from topics of all to its own.
  std::vector<std::map<std::uint32_t, std::uint32_t>> topics_in_files_;
  bool are_packed_ = false;
};

}  // namespace
}  // namespace ros

Recording::~Recording() = default;

std::shared_ptr<const Recording> Recording::open(const std::string& path) {
  return std::make_shared<ros::Files>(path);
}

bool isRecording(const std::string& path) {
  switch (detail::fileKind(path)) {
    case detail::FileKind::folder:
      return ros::isRecordingFolder(path);
    case detail::FileKind::file:
      return ros::fileKindOf(path) != ros::RecordingKind::none;
    default:
      return false;
  }
}

}  // namespace v1
}  // namespace gslam
