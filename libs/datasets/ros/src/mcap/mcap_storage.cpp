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
    if (message.block == kNoBlock) return readInPlace(message, file_->size(), kAll);
    const RecordHead head = mcap::readHead(*file_, message.block);
    const Chunk chunk = readChunkHead(*file_, head);
    // Without a CRC there is no need of the rest of the chunk.
    const bool is_checked =
        chunk.uncompressed_crc != 0 || chunk.uncompressed_size != chunk.records_size;
    if (chunk.compression.empty() && !is_checked) return readInChunk(message, head, chunk, kAll);
    return readUnpacked(message, head, kAll);
  }

  std::vector<std::uint8_t> readHead(const MessageRef& message, std::size_t size) const override {
    if (message.block == kNoBlock) return readInPlace(message, file_->size(), size);
    const RecordHead head = mcap::readHead(*file_, message.block);
    const Chunk chunk = readChunkHead(*file_, head);
    if (chunk.compression.empty()) return readInChunk(message, head, chunk, size);
    return readUnpacked(message, head, size);
  }

 private:
  static constexpr std::size_t kMessageHead = 22;  // fields of a message before its data
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  // --- what there is -----------------------------------------------------------------------------

  void addSchema(std::uint16_t id, const std::string& name) { schemas_[id] = name; }
  void addChannel(const Channel& channel) {
    const auto schema = schemas_.find(channel.schema_id);
    const std::string type = schema == schemas_.end() ? "" : schema->second;
    channels_[channel.id] = list.add(channel.topic, type, channel.message_encoding, file_->name());
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
    list.clear();
    messages.clear();
    schemas_.clear();
    channels_.clear();
    unknown_ = huge_ = 0;
  }

  // Sets `problem` where the summary does not name all messages.
  void useSummary(Summary& summary) {
    try {
      for (const NamedSchema& schema : summary.schemas) addSchema(schema.id, schema.name);
      for (const Channel& channel : summary.channels) addChannel(channel);
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
    std::vector<std::uint64_t> offsets;
    for (const MessageIndex& index : readMessageIndexes(*file_, chunk)) {
      for (const auto& entry : index.records) {
        offsets.push_back(entry.second);
        addMessage(index.channel_id, entry.first, chunk.chunk_start_offset, entry.second);
      }
    }
    // A small file could name one large message a million times.
    std::sort(offsets.begin(), offsets.end());
    if (std::adjacent_find(offsets.begin(), offsets.end()) != offsets.end()) {
      file_->fail(chunk.chunk_start_offset, "the index of a chunk names a message twice");
    }
  }

  void lookThrough(const std::string& problem) {
    clear();
    bool is_over = false;  // what comes then repeats the descriptions, and may be what is damaged
    const auto take = [&](const Record& record, const RecordPlace& place) {
      is_over = is_over || std::get_if<DataEnd>(&record) != nullptr;
      if (is_over) return;
      if (const auto* schema = std::get_if<Schema>(&record)) {
        addSchema(schema->id, schema->name);
      } else if (const auto* channel = std::get_if<Channel>(&record)) {
        addChannel(*channel);
      } else if (const auto* message = std::get_if<Message>(&record)) {
        addMessage(message->channel_id, message->log_time,
                   place.is_in_chunk ? place.chunk : kNoBlock, place.offset);
      }
    };
    const ScanResult result = scan(*file_, take, kMessageHead);
    remarks.push_back(file_->name() + " was looked through from its beginning: " + problem);
    if (!result.early_end.empty()) remarks.push_back("it ends early: " + result.early_end);
    result.damaged.appendTo(remarks, "damaged: ");
  }

  void sayUnknown() {
    if (unknown_ == 0) return;
    remarks.push_back(file_->name() + ": " + std::to_string(unknown_) +
                      " messages of channels that are not described were skipped");
  }

  // --- messages ----------------------------------------------------------------------------------

  // From the file, where the message ends before `end`.
  std::vector<std::uint8_t> readInPlace(const MessageRef& message, std::uint64_t end,
                                        std::size_t most) const {
    const RecordHead head = mcap::readHead(*file_, message.offset);
    if (head.end() > end) file_->fail(message.offset, "a message is longer than its chunk");
    const std::uint64_t beside = std::min<std::uint64_t>(head.size, kMessageHead);
    const std::uint64_t wanted = beside + std::min<std::uint64_t>(head.size - beside, most);
    const auto content = file_->read(head.content, wanted);
    return dataOf(head.opcode, Bytes(content), head.content, message, most);
  }

  // From a chunk that is not compressed, without the rest of it.
  std::vector<std::uint8_t> readInChunk(MessageRef message, const RecordHead& head,
                                        const Chunk& chunk, std::size_t most) const {
    if (message.offset > chunk.records_size) failOffset(message);
    const std::uint64_t begin = head.content + chunk.records_at;
    message.offset += begin;
    return readInPlace(message, begin + chunk.records_size, most);
  }

  std::vector<std::uint8_t> readUnpacked(const MessageRef& message, const RecordHead& head,
                                         std::size_t most) const {
    const BlockCache::Block block =
        cache_.get(message.block, [&] { return readChunk(*file_, head); });
    if (message.offset > block->size()) failOffset(message);
    const std::string name = nameOf(message.block);
    const std::size_t offset = static_cast<std::size_t>(message.offset);
    ByteReader in(Bytes(block->data() + offset, block->size() - offset), name, offset);
    const std::uint8_t opcode = in.number<std::uint8_t>("a message");
    const std::uint64_t size = in.number<std::uint64_t>("a message");
    const std::uint64_t at = in.offset();
    return dataOf(opcode, in.bytes(size, "a message"), at, message, most);
  }

  std::string nameOf(std::uint64_t chunk) const {
    return file_->name() + ", chunk at byte " + std::to_string(chunk);
  }

  [[noreturn]] void failOffset(const MessageRef& message) const {
    throw FileError(nameOf(message.block), "ends before byte " + std::to_string(message.offset) +
                                               ", where a message should be");
  }

  std::vector<std::uint8_t> dataOf(std::uint8_t opcode, Bytes content, std::uint64_t offset,
                                   const MessageRef& ref, std::size_t most) const {
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
    const auto channel = channels_.find(message.channel_id);
    if (channel == channels_.end() || channel->second != ref.topic) {
      in.fail("the message is of channel " + std::to_string(message.channel_id) +
              ", which is not that of the index");
    }
    const Bytes& data = message.data;
    return std::vector<std::uint8_t>(data.begin(), data.begin() + std::min(data.size(), most));
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
