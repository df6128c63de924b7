#include "records.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace mcap {
namespace {

std::uint64_t u64(ByteReader& in, const char* what) {
  return in.number<std::uint64_t>(what);
}
std::uint32_t u32(ByteReader& in, const char* what) {
  return in.number<std::uint32_t>(what);
}
std::uint16_t u16(ByteReader& in, const char* what) {
  return in.number<std::uint16_t>(what);
}

// The part that a length before it bounds.
ByteReader partOf(ByteReader& in, const char* what) {
  const Bytes part = in.block(what);
  return ByteReader(part, in.name(), in.offset() - part.size());
}

std::map<std::string, std::string> textMap(ByteReader& in, const char* what) {
  std::map<std::string, std::string> map;
  ByteReader part = partOf(in, what);
  while (part.left() > 0) {
    std::string key = part.text(what);
    map[std::move(key)] = part.text(what);
  }
  return map;
}

std::map<std::uint16_t, std::uint64_t> numberMap(ByteReader& in, const char* what) {
  std::map<std::uint16_t, std::uint64_t> map;
  ByteReader part = partOf(in, what);
  while (part.left() > 0) {
    const std::uint16_t key = u16(part, what);
    map[key] = u64(part, what);
  }
  return map;
}

void read(ByteReader& in, Header& record) {
  record.profile = in.text("the profile of the header");
  record.library = in.text("the library of the header");
}
void read(ByteReader& in, Footer& record) {
  record.summary_start = u64(in, "the footer");
  record.summary_offset_start = u64(in, "the footer");
  record.summary_crc = u32(in, "the footer");
}
void read(ByteReader& in, Schema& record) {
  record.id = u16(in, "the id of a schema");
  record.name = in.text("the name of a schema");
  record.encoding = in.text("the encoding of a schema");
  record.data = in.block("the data of a schema");
}
void read(ByteReader& in, Channel& record) {
  record.id = u16(in, "the id of a channel");
  record.schema_id = u16(in, "the schema of a channel");
  record.topic = in.text("the topic of a channel");
  record.message_encoding = in.text("the encoding of a channel");
  record.metadata = textMap(in, "the metadata of a channel");
}
void read(ByteReader& in, Message& record) {
  record.channel_id = u16(in, "the channel of a message");
  record.sequence = u32(in, "the sequence of a message");
  record.log_time = u64(in, "the log time of a message");
  record.publish_time = u64(in, "the publish time of a message");
  record.data = in.bytes(in.left(), "the data of a message");
}
void read(ByteReader& in, MessageIndex& record) {
  record.channel_id = u16(in, "the channel of a message index");
  ByteReader part = partOf(in, "the entries of a message index");
  record.records.reserve(part.left() / 16);
  while (part.left() > 0) {
    const std::uint64_t time = u64(part, "an entry of a message index");
    record.records.emplace_back(time, u64(part, "an entry of a message index"));
  }
}
void read(ByteReader& in, ChunkIndex& record) {
  record.message_start_time = u64(in, "a chunk index");
  record.message_end_time = u64(in, "a chunk index");
  record.chunk_start_offset = u64(in, "a chunk index");
  record.chunk_length = u64(in, "a chunk index");
  record.message_index_offsets = numberMap(in, "the offsets of a chunk index");
  record.message_index_length = u64(in, "a chunk index");
  record.compression = in.text("the compression of a chunk index");
  record.compressed_size = u64(in, "a chunk index");
  record.uncompressed_size = u64(in, "a chunk index");
}
void read(ByteReader& in, Attachment& record) {
  record.log_time = u64(in, "an attachment");
  record.create_time = u64(in, "an attachment");
  record.name = in.text("the name of an attachment");
  record.media_type = in.text("the media type of an attachment");
  const std::uint64_t size = u64(in, "an attachment");
  record.data = in.bytes(size, "the data of an attachment");
  record.size_before_crc = in.at();
  record.crc = u32(in, "an attachment");
}
void read(ByteReader& in, AttachmentIndex& record) {
  record.offset = u64(in, "an attachment index");
  record.length = u64(in, "an attachment index");
  record.log_time = u64(in, "an attachment index");
  record.create_time = u64(in, "an attachment index");
  record.data_size = u64(in, "an attachment index");
  record.name = in.text("the name of an attachment index");
  record.media_type = in.text("the media type of an attachment index");
}
void read(ByteReader& in, Statistics& record) {
  record.message_count = u64(in, "the statistics");
  record.schema_count = u16(in, "the statistics");
  record.channel_count = u32(in, "the statistics");
  record.attachment_count = u32(in, "the statistics");
  record.metadata_count = u32(in, "the statistics");
  record.chunk_count = u32(in, "the statistics");
  record.message_start_time = u64(in, "the statistics");
  record.message_end_time = u64(in, "the statistics");
  record.channel_message_counts = numberMap(in, "the counts of the statistics");
}
void read(ByteReader& in, Metadata& record) {
  record.name = in.text("the name of metadata");
  record.metadata = textMap(in, "metadata");
}
void read(ByteReader& in, MetadataIndex& record) {
  record.offset = u64(in, "a metadata index");
  record.length = u64(in, "a metadata index");
  record.name = in.text("the name of a metadata index");
}
void read(ByteReader& in, SummaryOffset& record) {
  record.group_opcode = in.number<std::uint8_t>("a summary offset");
  record.group_start = u64(in, "a summary offset");
  record.group_length = u64(in, "a summary offset");
}
void read(ByteReader& in, DataEnd& record) {
  record.data_section_crc = u32(in, "the end of the data");
}

template <class T>
bool readAs(ByteReader& in, Record& record) {
  read(in, record.emplace<T>());
  return true;
}

}  // namespace

bool parse(Opcode opcode, ByteReader& content, Record& record) {
  switch (opcode) {
    case Opcode::header:
      return readAs<Header>(content, record);
    case Opcode::footer:
      return readAs<Footer>(content, record);
    case Opcode::schema:
      return readAs<Schema>(content, record);
    case Opcode::channel:
      return readAs<Channel>(content, record);
    case Opcode::message:
      return readAs<Message>(content, record);
    case Opcode::message_index:
      return readAs<MessageIndex>(content, record);
    case Opcode::chunk_index:
      return readAs<ChunkIndex>(content, record);
    case Opcode::attachment:
      return readAs<Attachment>(content, record);
    case Opcode::attachment_index:
      return readAs<AttachmentIndex>(content, record);
    case Opcode::statistics:
      return readAs<Statistics>(content, record);
    case Opcode::metadata:
      return readAs<Metadata>(content, record);
    case Opcode::metadata_index:
      return readAs<MetadataIndex>(content, record);
    case Opcode::summary_offset:
      return readAs<SummaryOffset>(content, record);
    case Opcode::data_end:
      return readAs<DataEnd>(content, record);
    case Opcode::chunk:
      break;
  }
  return false;
}

std::uint64_t parseAttachmentHead(ByteReader& content) {
  u64(content, "an attachment");
  u64(content, "an attachment");
  content.text("the name of an attachment");
  content.text("the media type of an attachment");
  return u64(content, "an attachment");
}

Chunk parseChunkHead(ByteReader& content) {
  Chunk chunk;
  chunk.message_start_time = u64(content, "a chunk");
  chunk.message_end_time = u64(content, "a chunk");
  chunk.uncompressed_size = u64(content, "a chunk");
  chunk.uncompressed_crc = u32(content, "a chunk");
  chunk.compression = content.text("the compression of a chunk");
  chunk.records_size = u64(content, "a chunk");
  chunk.records_at = content.at();
  return chunk;
}

}  // namespace mcap
}  // namespace ros
}  // namespace v1
}  // namespace gslam
