// Goes through all records of an MCAP file, those inside of chunks too.
#ifndef GSLAM_DATASETS_ROS_SRC_MCAP_SCAN_H
#define GSLAM_DATASETS_ROS_SRC_MCAP_SCAN_H

#include <gslam/datasets_ros/export.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "../bytes/byte_source.h"
#include "../storage/few_sentences.h"
#include "records.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace mcap {

/// A record that was not read yet.
struct RecordHead {
  std::uint8_t opcode = 0;
  std::uint64_t content = 0;  // offset
  std::uint64_t size = 0;     // of the content
  std::uint64_t end() const noexcept { return content + size; }
};

/// @throws FileError when the file ends before the record does
RecordHead readHead(const ByteSource& file, std::uint64_t offset);

/// The longest record, and the longest chunk, that is read as a whole.
constexpr std::uint64_t kMostInMemory = std::uint64_t(1) << 30;

/// The beginning of a chunk. @param head  of a chunk
Chunk readChunkHead(const ByteSource& file, const RecordHead& head);

/// The records of a chunk, unpacked, with their CRC checked.
/// @throws FileError when they are damaged
std::vector<std::uint8_t> readChunk(const ByteSource& file, const RecordHead& head);

/// Where a record is: in the file, or in an unpacked chunk.
struct RecordPlace {
  bool is_in_chunk = false;
  std::uint64_t chunk = 0;   // offset of the chunk's record in the file
  std::uint64_t offset = 0;  // of the record itself, in the file or the chunk
};

/// Calls back for each record of an unpacked chunk.
using Visitor = std::function<void(const Record&, const RecordPlace&)>;
void scanChunk(Bytes records, const std::string& name, std::uint64_t chunk, const Visitor& visit);

/// What scan() has to say.
struct ScanResult {
  std::string early_end;  // why not all was read; empty: it was
  FewSentences damaged;   // records and chunks that cannot be read, and CRCs that are wrong
};

/// Calls back for each record from the first to the last, those of chunks in place of the chunk.
/// Records of unknown kinds are passed over. Goes on behind what is damaged, and stops where a
/// record is longer than the file.
/// @param most  bytes of messages outside of chunks that are read; attachments that have more are
///   checked, but not called back for
GSLAM_DATASETS_ROS_EXPORT ScanResult scan(const ByteSource& file, const Visitor& visit,
                                          std::uint64_t most = kMostInMemory);

/// @throws FileError when the file does not begin as MCAP does
void checkMagic(const ByteSource& file);

/// The checksum of a part of the file.
std::uint32_t crcOf(const ByteSource& file, std::uint64_t begin, std::uint64_t end);

}  // namespace mcap
}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MCAP_SCAN_H
