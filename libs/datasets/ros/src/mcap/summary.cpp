#include "summary.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cstring>

#include "../bytes/decompress.h"
#include "scan.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace mcap {
namespace {

constexpr std::uint64_t kFooterAndMagic = kHeadSize + kFooterSize + sizeof(kMagic);

// False where the file does not end with a footer.
bool readFooter(const ByteSource& file, std::uint64_t offset, Footer& footer) {
  const auto raw = file.read(offset, kFooterAndMagic);
  const std::uint8_t* const magic = raw.data() + kHeadSize + kFooterSize;
  if (std::memcmp(magic, kMagic, sizeof(kMagic)) != 0) return false;
  ByteReader in(Bytes(raw), file.name(), offset);
  const bool is_footer = Opcode(in.number<std::uint8_t>("the footer")) == Opcode::footer &&
                         in.number<std::uint64_t>("the footer") == kFooterSize;
  Record record;
  if (!is_footer || !parse(Opcode::footer, in, record)) return false;
  footer = std::get<Footer>(record);
  return true;
}

void take(const Record& record, Summary& summary) {
  if (const auto* schema = std::get_if<Schema>(&record)) {
    summary.schemas.push_back({schema->id, schema->name});
  } else if (const auto* channel = std::get_if<Channel>(&record)) {
    summary.channels.push_back(*channel);
  } else if (const auto* chunk = std::get_if<ChunkIndex>(&record)) {
    summary.chunks.push_back(*chunk);
  } else if (const auto* statistics = std::get_if<Statistics>(&record)) {
    summary.has_statistics = true;
    summary.statistics = *statistics;
  }
}

// Chunks that overlap are none of a file that somebody wrote: a small file could name one of them
// a million times.
bool areApart(std::vector<ChunkIndex>& chunks, std::uint64_t end) {
  std::sort(chunks.begin(), chunks.end(), [](const ChunkIndex& a, const ChunkIndex& b) {
    return a.chunk_start_offset < b.chunk_start_offset;
  });
  std::uint64_t from = sizeof(kMagic);
  for (const ChunkIndex& chunk : chunks) {
    if (chunk.chunk_start_offset < from || chunk.chunk_start_offset > end) return false;
    const std::uint64_t room = end - chunk.chunk_start_offset;
    if (chunk.chunk_length > room || chunk.message_index_length > room - chunk.chunk_length) {
      return false;
    }
    from = chunk.chunk_start_offset + chunk.chunk_length + chunk.message_index_length;
  }
  return true;
}

void readRecords(const ByteSource& file, std::uint64_t begin, std::uint64_t footer_offset,
                 const Footer& footer, Summary& summary) {
  // The CRC is of all up to itself, the beginning of the footer included.
  constexpr std::uint64_t kFooterBeforeCrc = kHeadSize + 16;
  constexpr std::uint64_t kMost = 256U << 20;  // that of hours has some MB
  if (footer_offset - begin > kMost) {
    summary.problem = "its summary should begin at byte " + std::to_string(begin) +
                      ", which is too far from the end of the file";
    return;
  }
  const auto raw = file.read(begin, footer_offset - begin + kFooterBeforeCrc);
  if (footer.summary_crc != 0 && crc32Of(Bytes(raw)) != footer.summary_crc) {
    summary.problem = "its summary is damaged (the CRC is wrong)";
    return;
  }
  const Bytes records(raw.data(), std::size_t(footer_offset - begin));
  scanChunk(records, file.name() + ", summary at byte " + std::to_string(begin), 0,
            [&](const Record& record, const RecordPlace&) { take(record, summary); });
  if (!areApart(summary.chunks, begin)) summary.problem = "its summary names chunks that overlap";
}

}  // namespace

Summary readSummary(const ByteSource& file) {
  Summary summary;
  Footer footer;
  if (file.size() < sizeof(kMagic) + kFooterAndMagic) {
    summary.problem = "it was not closed";
    return summary;
  }
  const std::uint64_t offset = file.size() - kFooterAndMagic;
  try {
    if (!readFooter(file, offset, footer)) {
      summary.problem = "it was not closed";
    } else if (footer.summary_start == 0) {
      summary.problem = "it has no summary";
    } else if (footer.summary_start < sizeof(kMagic) || footer.summary_start > offset) {
      summary.problem = "its summary should begin at byte " + std::to_string(footer.summary_start) +
                        ", where there is none";
    } else {
      readRecords(file, footer.summary_start, offset, footer, summary);
    }
  } catch (const FileError& error) {
    summary.problem = std::string("its summary is damaged (") + error.what() + ")";
  }
  return summary;
}

std::vector<MessageIndex> readMessageIndexes(const ByteSource& file, const ChunkIndex& chunk) {
  const std::uint64_t begin = chunk.chunk_start_offset + chunk.chunk_length;
  const auto raw = file.read(begin, chunk.message_index_length);
  std::vector<MessageIndex> indexes;
  const std::string name = file.name() + ", message indexes at byte " + std::to_string(begin);
  scanChunk(Bytes(raw), name, 0, [&](const Record& record, const RecordPlace&) {
    if (const auto* index = std::get_if<MessageIndex>(&record)) indexes.push_back(*index);
  });
  return indexes;
}

}  // namespace mcap
}  // namespace ros
}  // namespace v1
}  // namespace gslam
