// Recordings of ROS 1.
//
// The files are read here and not by rosbag_storage, which takes sizes and offsets in them as they
// come: to check those inside of a chunk, the chunk must be unpacked, and then its messages are
// there. (The tests compare the two.)
#include <gslam/base/error.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "../bytes/block_cache.h"
#include "../storage/few_sentences.h"
#include "../storage/storage.h"
#include "records.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace bag {
namespace {

constexpr std::uint32_t kIndexEntry = 12;  // bytes: a time, and an offset in the chunk

void checkVersion(const ByteSource& file) {
  if (file.size() == 0) throw FileError(file.name(), "is empty, expected a ROS bag");
  std::string version(std::size_t(std::min<std::uint64_t>(file.size(), kVersionSize)), '\0');
  std::vector<std::uint8_t> raw = file.read(0, version.size());
  std::copy(raw.begin(), raw.end(), version.begin());
  if (version == kVersion) return;
  if (version.compare(0, 8, "#ROSBAG ") == 0 || version.compare(0, 8, "#ROSRECO") == 0) {
    throw FileError(file.name(), "is a bag of another version ('" +
                                     version.substr(0, version.find('\n')) +
                                     "'), expected 2.0; `rosbag fix` makes one of it");
  }
  throw FileError(file.name(), "at byte 0: does not begin as ROS bags do: #ROSBAG V2.0");
}

class BagStorage : public Storage {
 public:
  explicit BagStorage(std::shared_ptr<const ByteSource> file) : file_(std::move(file)) {
    checkVersion(*file_);
    std::string problem;
    if (!readIndex(problem)) lookThrough(problem);
    sayUnknown();
  }

  std::vector<std::uint8_t> read(const MessageRef& message) const override {
    return readMessage(message, UINT32_MAX);
  }
  std::vector<std::uint8_t> readHead(const MessageRef& message, std::size_t size) const override {
    return readMessage(message, size);
  }

 private:
  // --- what there is -----------------------------------------------------------------------------

  void addConnection(const Connection& connection) {
    // The first one counts: the last may be that of a damaged index.
    if (connections_.find(connection.id) != connections_.end()) return;
    connections_[connection.id] =
        list.add(connection.topic, connection.type, "ros1", file_->name());
  }

  void addMessage(std::uint32_t connection, std::int64_t stamp, std::uint64_t chunk,
                  std::uint64_t offset) {
    const auto found = connections_.find(connection);
    if (found == connections_.end()) {
      ++unknown_;
    } else {
      messages.push_back({stamp, found->second, 0, chunk, offset});
    }
  }

  // False, with the reason, where there is no index that can be used.
  bool readIndex(std::string& problem) {
    std::uint64_t index = 0;
    try {
      index = readBagHeader();
      if (index == 0) problem = "it was not closed (`rosbag reindex` makes an index)";
      if (index != 0) problem = readIndexAt(index);
    } catch (const FileError& error) {
      problem = std::string("its index is damaged (") + error.what() + ")";
    }
    if (is_encrypted_) {
      throw FileError(file_->name(), "is encrypted, which cannot be read");
    }
    return problem.empty();
  }

  // Where the index begins; 0: there is none.
  std::uint64_t readBagHeader() {
    const RecordHead head = bag::readHead(*file_, kVersionSize);
    const Fields fields = head.fields(*file_);
    if (fields.op() != Op::header) file_->fail(kVersionSize, "expected the header of the bag");
    const Bytes* const encryptor = fields.find("encryptor");
    is_encrypted_ = encryptor != nullptr && encryptor->size() > 0;
    connection_count_ = fields.number<std::uint32_t>("conn_count");
    chunk_count_ = fields.number<std::uint32_t>("chunk_count");
    first_record_ = head.end();
    return fields.number<std::uint64_t>("index_pos");
  }

  std::string readIndexAt(std::uint64_t offset) {
    if (offset < first_record_ || offset > file_->size()) {
      return "its index should be at byte " + std::to_string(offset) + ", where there is none";
    }
    std::vector<std::uint64_t> chunks;
    std::uint64_t message_count = 0;
    const std::uint64_t end = offset;
    while (offset < file_->size()) {
      const RecordHead head = bag::readHead(*file_, offset);
      const Fields fields = head.fields(*file_);
      if (fields.op() == Op::connection) addConnection(connectionOf(fields, head));
      if (fields.op() == Op::chunk_info) {
        chunks.push_back(fields.number<std::uint64_t>("chunk_pos"));
        message_count += countOf(head);
      }
      offset = head.end();
    }
    std::sort(chunks.begin(), chunks.end());
    std::uint64_t from = first_record_;
    for (const std::uint64_t chunk : chunks) {
      if (chunk < from || chunk >= end) return "its index names chunks that overlap";
      from = readChunkIndex(chunk, end);
    }
    if (chunks.size() != chunk_count_ || connections_.size() != connection_count_) {
      return "its index does not have all chunks and connections";
    }
    if (message_count != messages.size() + unknown_) return "its index does not have all messages";
    if (unknown_ > 0) return "its index has messages of connections that are not described";
    return "";
  }

  Connection connectionOf(const Fields& fields, const RecordHead& head) const {
    constexpr std::uint32_t kMost = 64U << 20;  // the definition of the message is in it
    if (head.size > kMost) file_->fail(head.data, "a connection is longer than any definition");
    const auto data = file_->read(head.data, head.size);
    return readConnection(fields, ByteReader(Bytes(data), file_->name(), head.data));
  }

  // Messages of a chunk as its info has them: connections and counts of 32 bits.
  std::uint64_t countOf(const RecordHead& info) const {
    const auto data = file_->read(info.data, info.size);
    ByteReader in(Bytes(data), file_->name(), info.data);
    std::uint64_t count = 0;
    while (in.left() > 0) {
      in.number<std::uint32_t>("the connection of a chunk info");
      count += in.number<std::uint32_t>("the count of a chunk info");
    }
    return count;
  }

  // Reads the index records behind a chunk; gives where they end.
  std::uint64_t readChunkIndex(std::uint64_t chunk, std::uint64_t end) {
    const RecordHead head = bag::readHead(*file_, chunk);
    if (head.fields(*file_).op() != Op::chunk) file_->fail(chunk, "expected a chunk");
    std::uint64_t offset = head.end();
    std::vector<std::uint32_t> offsets;
    while (offset < end) {
      const RecordHead record = bag::readHead(*file_, offset);
      const Fields fields = record.fields(*file_);
      if (fields.op() != Op::index) break;
      addEntries(fields, record, chunk, offsets);
      offset = record.end();
    }
    // A small file could name one large message a million times.
    std::sort(offsets.begin(), offsets.end());
    if (std::adjacent_find(offsets.begin(), offsets.end()) != offsets.end()) {
      file_->fail(chunk, "the index of a chunk names a message twice");
    }
    return offset;
  }

  void addEntries(const Fields& fields, const RecordHead& record, std::uint64_t chunk,
                  std::vector<std::uint32_t>& offsets) {
    const std::uint32_t connection = fields.number<std::uint32_t>("conn");
    const std::uint32_t count = fields.number<std::uint32_t>("count");
    if (fields.number<std::uint32_t>("ver") != 1 ||
        std::uint64_t(count) * kIndexEntry != record.size) {
      file_->fail(record.header_offset - 4,
                  "the index of a chunk has not the size of " + std::to_string(count) + " entries");
    }
    const auto data = file_->read(record.data, record.size);
    ByteReader in(Bytes(data), file_->name(), record.data);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::int64_t stamp = stampOf(in.number<std::uint64_t>("an entry of an index"));
      offsets.push_back(in.number<std::uint32_t>("an entry of an index"));
      addMessage(connection, stamp, chunk, offsets.back());
    }
  }

  // --- without an index --------------------------------------------------------------------------

  void lookThrough(const std::string& problem) {
    list.clear();
    messages.clear();
    connections_.clear();
    unknown_ = 0;
    remarks.push_back(file_->name() + " was looked through from its beginning: " + problem);
    const std::string early_end = lookAtRecords();
    damaged_.appendTo(remarks, "damaged: ");
    if (homeless_ > 0) {
      remarks.push_back(file_->name() + ": " + std::to_string(homeless_) +
                        " messages outside of chunks were skipped");
    }
    if (!early_end.empty()) remarks.push_back("it ends early: " + early_end);
  }

  // Why not all of the file was read; empty: it was.
  std::string lookAtRecords() {
    std::uint64_t offset = kVersionSize;
    while (offset < file_->size()) {
      RecordHead head;
      try {
        head = bag::readHead(*file_, offset);
      } catch (const FileError& error) {
        return error.what();
      }
      try {
        if (!lookInto(head, offset)) {
          return nameOf(offset) + " was not closed, and what is compressed in it is lost";
        }
      } catch (const FileError& error) {
        damaged_.add(error.what());
      }
      offset = head.end();
    }
    return "";
  }

  // False where nothing behind it can be read.
  bool lookInto(const RecordHead& head, std::uint64_t offset) {
    const Fields fields = head.fields(*file_);
    const Op op = fields.op();
    if (op == Op::connection) addConnection(connectionOf(fields, head));
    if (op == Op::message) takeOpen(fields, offset);
    if (op == Op::index || op == Op::chunk) open_chunk_ = 0;
    if (op != Op::chunk) return true;
    // rosbag writes the size of a chunk when it closes it.
    if (head.size == 0) {
      if (isPacked(fields)) return false;
      open_chunk_ = offset;
      open_data_ = head.data;
      return true;
    }
    const auto data = readChunk(*file_, head);
    lookIntoChunk(Bytes(data), offset);
    return true;
  }

  // A message of a chunk that was not closed: it looks like one of the file.
  void takeOpen(const Fields& fields, std::uint64_t offset) {
    if (open_chunk_ == 0) {
      ++homeless_;
      return;
    }
    addMessage(fields.number<std::uint32_t>("conn"), fields.stamp("time"), open_chunk_,
               offset - open_data_);
  }

  std::string nameOf(std::uint64_t chunk) const {
    return file_->name() + ", chunk at byte " + std::to_string(chunk);
  }

  void lookIntoChunk(Bytes data, std::uint64_t chunk) {
    const std::string name = nameOf(chunk);
    ByteReader in(data, name, 0);
    while (in.left() > 0) {
      const std::uint64_t offset = in.offset();
      const Fields fields = fieldsIn(in);
      const Bytes content = in.block("the data of a record");
      if (fields.op() == Op::connection) {
        addConnection(
            readConnection(fields, ByteReader(content, name, in.offset() - content.size())));
      } else if (fields.op() == Op::message) {
        addMessage(fields.number<std::uint32_t>("conn"), fields.stamp("time"), chunk, offset);
      }
    }
  }

  static Fields fieldsIn(ByteReader& in) {
    const Bytes header = in.block("the header of a record");
    return Fields(ByteReader(header, in.name(), in.offset() - header.size()));
  }

  void sayUnknown() {
    if (unknown_ == 0) return;
    remarks.push_back(file_->name() + ": " + std::to_string(unknown_) +
                      " messages of connections that are not described were skipped");
  }

  // --- messages ----------------------------------------------------------------------------------

  std::vector<std::uint8_t> readMessage(const MessageRef& message, std::size_t most) const {
    const RecordHead chunk = bag::readHead(*file_, message.block);
    if (!isPacked(chunk.fields(*file_))) return readInPlace(chunk, message, most);
    const BlockCache::Block block =
        cache_.get(message.block, [&] { return readChunk(*file_, chunk); });
    const std::string name = nameOf(message.block);
    if (message.offset > block->size()) failOffset(message);
    const std::size_t offset = static_cast<std::size_t>(message.offset);
    ByteReader in(Bytes(block->data() + offset, block->size() - offset), name, offset);
    for (std::size_t hops = 0;; ++hops) {
      const Fields fields = fieldsIn(in);
      const Bytes data = in.block("the data of a message");
      if (isHop(fields, hops)) continue;
      checkMessage(fields, message);
      return std::vector<std::uint8_t>(data.begin(),
                                       data.begin() + std::min<std::size_t>(data.size(), most));
    }
  }

  // From a chunk that is not compressed, without the rest of it.
  std::vector<std::uint8_t> readInPlace(const RecordHead& chunk, const MessageRef& message,
                                        std::size_t most) const {
    // One that was not closed has no size: it goes to the end of the file.
    const std::uint64_t end = chunk.size == 0 ? file_->size() : chunk.end();
    if (message.offset > end - chunk.data) failOffset(message);
    std::uint64_t offset = chunk.data + message.offset;
    for (std::size_t hops = 0;; ++hops) {
      const RecordHead head = bag::readHead(*file_, offset);
      if (head.end() > end) file_->fail(offset, "a message is longer than its chunk");
      const Fields fields = head.fields(*file_);
      offset = head.end();
      if (isHop(fields, hops)) continue;
      checkMessage(fields, message);
      return file_->read(head.data, std::min<std::uint64_t>(head.size, most));
    }
  }

  // Recorders that merged bags may point at a connection before a message.
  bool isHop(const Fields& fields, std::size_t hops) const {
    constexpr std::size_t kMost = 256;
    return fields.op() == Op::connection && hops < std::min(connections_.size(), kMost);
  }

  void checkMessage(const Fields& fields, const MessageRef& message) const {
    bool is_it = fields.op() == Op::message && fields.stamp("time") == message.stamp;
    if (is_it) {
      const auto connection = connections_.find(fields.number<std::uint32_t>("conn"));
      is_it = connection != connections_.end() && connection->second == message.topic;
    }
    if (is_it) return;
    throw FileError(nameOf(message.block), "at byte " + std::to_string(message.offset) +
                                               ": expected a message of " + topicOf(message) +
                                               " with the stamp " + std::to_string(message.stamp) +
                                               " ns");
  }
  std::string topicOf(const MessageRef& message) const {
    return message.topic < list.topics.size() ? list.topics[message.topic].name : "no topic";
  }

  [[noreturn]] void failOffset(const MessageRef& message) const {
    throw FileError(nameOf(message.block), "ends before byte " + std::to_string(message.offset) +
                                               ", where a message should be");
  }

  std::shared_ptr<const ByteSource> file_;
  mutable BlockCache cache_;
  std::map<std::uint32_t, std::uint32_t> connections_;  // to topics
  std::uint64_t first_record_ = 0;
  std::uint32_t connection_count_ = 0, chunk_count_ = 0;
  bool is_encrypted_ = false;
  std::size_t unknown_ = 0;                       // messages of connections that are not described
  std::size_t homeless_ = 0;                      // messages outside of chunks
  std::uint64_t open_chunk_ = 0, open_data_ = 0;  // the chunk that was not closed; 0: there is none
  FewSentences damaged_;
};

}  // namespace
}  // namespace bag

std::unique_ptr<Storage> openBag(std::shared_ptr<const ByteSource> file) {
  return std::make_unique<bag::BagStorage>(std::move(file));
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
