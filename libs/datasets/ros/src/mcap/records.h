// The records of an MCAP file. Source: https://mcap.dev/spec, version 0 of the format.
#ifndef GSLAM_DATASETS_ROS_SRC_MCAP_RECORDS_H
#define GSLAM_DATASETS_ROS_SRC_MCAP_RECORDS_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "../bytes/byte_reader.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace mcap {

constexpr std::uint8_t kMagic[] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
constexpr std::size_t kHeadSize = 9;     // opcode and length of a record
constexpr std::size_t kFooterSize = 20;  // least content

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F
};

struct Header {
  std::string profile, library;
};
struct Footer {
  std::uint64_t summary_start = 0, summary_offset_start = 0;
  std::uint32_t summary_crc = 0;
};
struct Schema {
  std::uint16_t id = 0;
  std::string name, encoding;
  Bytes data;
};
struct Channel {
  std::uint16_t id = 0, schema_id = 0;
  std::string topic, message_encoding;
  std::map<std::string, std::string> metadata;
};
struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;
  Bytes data;
};
struct Chunk {
  std::uint64_t message_start_time = 0, message_end_time = 0, uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;
  std::string compression;
  std::uint64_t records_size = 0;
  std::size_t records_at = 0;  // of the first byte of the records in the content of this one
};
struct MessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> records;  // time, offset in the chunk
};
struct ChunkIndex {
  std::uint64_t message_start_time = 0, message_end_time = 0;
  std::uint64_t chunk_start_offset = 0, chunk_length = 0;
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0, uncompressed_size = 0;
};
struct Attachment {
  std::uint64_t log_time = 0, create_time = 0;
  std::string name, media_type;
  Bytes data;
  std::uint32_t crc = 0;
  std::size_t size_before_crc = 0;
};
struct AttachmentIndex {
  std::uint64_t offset = 0, length = 0, log_time = 0, create_time = 0, data_size = 0;
  std::string name, media_type;
};
struct Statistics {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0, attachment_count = 0, metadata_count = 0, chunk_count = 0;
  std::uint64_t message_start_time = 0, message_end_time = 0;
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};
struct Metadata {
  std::string name;
  std::map<std::string, std::string> metadata;
};
struct MetadataIndex {
  std::uint64_t offset = 0, length = 0;
  std::string name;
};
struct SummaryOffset {
  std::uint8_t group_opcode = 0;
  std::uint64_t group_start = 0, group_length = 0;
};
struct DataEnd {
  std::uint32_t data_section_crc = 0;
};

using Record =
    std::variant<Header, Footer, Schema, Channel, Message, MessageIndex, ChunkIndex, Attachment,
                 AttachmentIndex, Statistics, Metadata, MetadataIndex, SummaryOffset, DataEnd>;

/// Reads the content of a record; bytes behind its last field are left alone, as the format wants.
/// @param content  views it; so do the data of the result
/// @return false for an opcode that is not in Record: chunks, and what this does not know
/// @throws FileError when it ends early
bool parse(Opcode opcode, ByteReader& content, Record& record);

/// The fields of an attachment before its data; gives the size of these.
std::uint64_t parseAttachmentHead(ByteReader& content);

/// The fields of a chunk before its records, which need not be there.
Chunk parseChunkHead(ByteReader& content);

}  // namespace mcap
}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MCAP_RECORDS_H
