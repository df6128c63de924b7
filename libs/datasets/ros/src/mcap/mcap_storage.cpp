// Recordings in MCAP files.
#include <gslam/base/error.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "../bytes/block_cache.h"
#include "../storage/storage.h"
#include "scan.h"
#include "summary.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace mcap {
namespace {

constexpr std::uint64_t kNoBlock = std::numeric_limits<std::uint64_t>::max();

class McapStorage : public Storage {
 public:
  explicit McapStorage(std::shared_ptr<const ByteSource> file) : file_(std::move(file)) {
    checkMagic(*file_);
    Summary summary = readSummary(*file_);
    if (summary.problem.empty()) useSummary(summary);
    if (!summary.problem.empty()) lookThrough(summary.problem);
    sayHuge(huge_, file_->name());
    sayUnknown();
  }

  std::vector<std::uint8_t> read(const MessageRef& message) const override {
    if (message.block == kNoBlock) {
      const RecordHead head = mcap::readHead(*file_, message.offset);
      const auto content = file_->read(head.content, head.size);
      return dataOf(head.opcode, Bytes(content), head.content, message);
    }
    const BlockCache::Block block =
        cache_.get(message.block, [&] { return readChunk(*file_, chunkAt(message)); });
    return fromBlock(*block, message);
  }

  std::vector<std::uint8_t> readHead(const MessageRef& message, std::size_t size) const override {
    std::uint64_t offset = message.offset;
    std::uint64_t end = file_->size();
    if (message.block != kNoBlock) {
      const RecordHead head = chunkAt(message);
      const Chunk chunk = readChunkHead(*file_, head);
      if (!chunk.compression.empty()) return read(message);
      if (offset > chunk.records_size) return read(message);  // which says what is wrong
      offset += head.content + chunk.records_at;
      end = head.content + chunk.records_at + chunk.records_size;
    }
    const RecordHead head = mcap::readHead(*file_, offset);
    if (head.end() > end) return read(message);
    const std::uint64_t wanted = std::min<std::uint64_t>(head.size, kMessageHead + size);
    const auto content = file_->read(head.content, wanted);
    return dataOf(head.opcode, Bytes(content), head.content, message);
  }

 private:
  static constexpr std::size_t kMessageHead = 22;  // fields of a message before its data

  // --- what there is -----------------------------------------------------------------------------

  void addSchema(std::uint16_t id, const std::string& name) { schemas_[id] = name; }
  void addChannel(const Channel& channel) {
    const auto schema = schemas_.find(channel.schema_id);
    const std::string type = schema == schemas_.end() ? "" : schema->second;
    channels_[channel.id] = list.add(channel.topic, type, channel.message_encoding);
  }

  void addMessage(std::uint16_t channel, std::uint64_t time, std::uint64_t block,
                  std::uint64_t offset) {
    const auto found = channels_.find(channel);
    if (found == channels_.end()) {
      ++unknown_;
    } else if (!isStamp(time)) {
      ++huge_;
    } else {
      messages.push_back({static_cast<std::int64_t>(time), found->second, 0, block, offset});
    }
  }

  void clear() {
    list.topics.clear();
    messages.clear();
    schemas_.clear();
    channels_.clear();
    unknown_ = huge_ = 0;
  }

  // Sets `problem` where the summary does not name all messages.
  void useSummary(Summary& summary) {
    for (const NamedSchema& schema : summary.schemas) addSchema(schema.id, schema.name);
    for (const Channel& channel : summary.channels) addChannel(channel);
    try {
      for (const ChunkIndex& chunk : summary.chunks) addIndexed(chunk);
    } catch (const FileError& error) {
      summary.problem = std::string("its index is damaged (") + error.what() + ")";
      return;
    }
    const std::uint64_t found = messages.size() + unknown_ + huge_;
    if (unknown_ > 0) {
      summary.problem = "its summary does not repeat the channels";
    } else if (!summary.has_statistics) {
      summary.problem = "its summary does not count the messages";
    } else if (summary.statistics.message_count != found) {
      summary.problem = "its index has " + std::to_string(found) + " of " +
                        std::to_string(summary.statistics.message_count) + " messages";
    } else if (summary.statistics.channel_count != summary.channels.size()) {
      summary.problem = "its summary does not repeat the channels";
    }
  }

  void addIndexed(const ChunkIndex& chunk) {
    for (const MessageIndex& index : readMessageIndexes(*file_, chunk)) {
      for (const auto& entry : index.records) {
        addMessage(index.channel_id, entry.first, chunk.chunk_start_offset, entry.second);
      }
    }
  }

  void lookThrough(const std::string& problem) {
    clear();
    const ScanResult result = scan(*file_, [this](const Record& record, const RecordPlace& place) {
      if (const auto* schema = std::get_if<Schema>(&record)) {
        addSchema(schema->id, schema->name);
      } else if (const auto* channel = std::get_if<Channel>(&record)) {
        addChannel(*channel);
      } else if (const auto* message = std::get_if<Message>(&record)) {
        addMessage(message->channel_id, message->log_time,
                   place.is_in_chunk ? place.chunk : kNoBlock, place.offset);
      }
    });
    remarks.push_back(file_->name() + " was looked through from its beginning: " + problem);
    if (!result.early_end.empty()) remarks.push_back("it ends early: " + result.early_end);
    for (const std::string& damage : result.damaged) remarks.push_back("damaged: " + damage);
  }

  void sayUnknown() {
    if (unknown_ == 0) return;
    remarks.push_back(file_->name() + ": " + std::to_string(unknown_) +
                      " messages of channels that are not described were skipped");
  }

  // --- messages ----------------------------------------------------------------------------------

  RecordHead chunkAt(const MessageRef& message) const {
    return mcap::readHead(*file_, message.block);
  }

  std::vector<std::uint8_t> fromBlock(const std::vector<std::uint8_t>& block,
                                      const MessageRef& message) const {
    const std::string name = file_->name() + ", chunk at byte " + std::to_string(message.block);
    if (message.offset > block.size()) {
      throw FileError(name, "ends before byte " + std::to_string(message.offset) +
                                ", where a message should be");
    }
    const std::size_t offset = static_cast<std::size_t>(message.offset);
    ByteReader in(Bytes(block.data() + offset, block.size() - offset), name, offset);
    const std::uint8_t opcode = in.number<std::uint8_t>("a message");
    const std::uint64_t size = in.number<std::uint64_t>("a message");
    const std::uint64_t at = in.offset();
    return dataOf(opcode, in.bytes(size, "a message"), at, message);
  }

  std::vector<std::uint8_t> dataOf(std::uint8_t opcode, Bytes content, std::uint64_t offset,
                                   const MessageRef& ref) const {
    ByteReader in(content, file_->name(), offset);
    Record record;
    if (Opcode(opcode) != Opcode::message || !parse(Opcode::message, in, record)) {
      in.fail("expected a message, found a record of kind " + std::to_string(opcode));
    }
    const Message& message = std::get<Message>(record);
    if (message.log_time != static_cast<std::uint64_t>(ref.stamp)) {
      in.fail("the message has another stamp than the index: " + std::to_string(message.log_time) +
              " ns, expected " + std::to_string(ref.stamp));
    }
    return std::vector<std::uint8_t>(message.data.begin(), message.data.end());
  }

  std::shared_ptr<const ByteSource> file_;
  mutable BlockCache cache_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, std::uint32_t> channels_;
  std::size_t unknown_ = 0, huge_ = 0;
};

}  // namespace
}  // namespace mcap

std::unique_ptr<Storage> openMcap(std::shared_ptr<const ByteSource> file) {
  return std::make_unique<mcap::McapStorage>(std::move(file));
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
