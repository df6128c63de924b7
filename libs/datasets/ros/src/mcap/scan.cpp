#include "scan.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "../bytes/decompress.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace mcap {
namespace {

std::string hex(std::uint32_t value) {
  static const char kDigits[] = "0123456789abcdef";
  std::string text = "0x";
  for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[value >> shift & 15U];
  return text;
}

RecordHead headOf(ByteReader& in) {
  RecordHead head;
  head.opcode = in.number<std::uint8_t>("a record");
  head.size = in.number<std::uint64_t>("the length of a record");
  head.content = in.offset();
  return head;
}

std::vector<std::uint8_t> unpacked(const Chunk& chunk, std::vector<std::uint8_t> packed) {
  if (chunk.compression == "lz4") return unpackLz4(Bytes(packed), chunk.uncompressed_size);
  if (chunk.compression == "zstd") return unpackZstd(Bytes(packed), chunk.uncompressed_size);
  if (!chunk.compression.empty()) {
    throw Error("is compressed by '" + chunk.compression.substr(0, 40) +
                "', expected lz4, zstd or nothing");
  }
  if (packed.size() != chunk.uncompressed_size) {
    throw Error("has " + std::to_string(packed.size()) + " bytes, but should have " +
                std::to_string(chunk.uncompressed_size));
  }
  return packed;
}

}  // namespace

void checkMagic(const ByteSource& file) {
  if (file.size() == 0) throw FileError(file.name(), "is empty, expected an MCAP file");
  std::uint8_t magic[sizeof(kMagic)] = {};
  file.read(0, magic, std::size_t(std::min<std::uint64_t>(file.size(), sizeof(magic))));
  if (std::memcmp(magic, kMagic, sizeof(magic)) != 0) {
    throw FileError(file.name(), "at byte 0: does not begin as MCAP files do");
  }
}

std::uint32_t crcOf(const ByteSource& file, std::uint64_t begin, std::uint64_t end) {
  std::vector<std::uint8_t> part(std::size_t(std::min<std::uint64_t>(end - begin, 1U << 20)));
  std::uint32_t crc = 0;
  while (begin < end) {
    const std::size_t size = std::size_t(std::min<std::uint64_t>(end - begin, part.size()));
    file.read(begin, part.data(), size);
    crc = crc32Of(Bytes(part.data(), size), crc);
    begin += size;
  }
  return crc;
}

RecordHead readHead(const ByteSource& file, std::uint64_t offset) {
  std::uint8_t raw[kHeadSize];
  file.read(offset, raw, sizeof(raw));
  ByteReader in(Bytes(raw, sizeof(raw)), file.name(), offset);
  const RecordHead head = headOf(in);
  if (head.size > file.size() - head.content) {
    file.fail(offset, "a record of kind " + std::to_string(head.opcode) + " should have " +
                          std::to_string(head.size) + " bytes, but the file ends at byte " +
                          std::to_string(file.size()));
  }
  return head;
}

Chunk readChunkHead(const ByteSource& file, const RecordHead& head) {
  if (Opcode(head.opcode) != Opcode::chunk) {
    file.fail(head.content - kHeadSize,
              "expected a chunk, found a record of kind " + std::to_string(head.opcode));
  }
  constexpr std::uint64_t kMostHead = 256;  // the name of the compression is short
  const auto raw = file.read(head.content, std::min(head.size, kMostHead));
  ByteReader in(Bytes(raw), file.name(), head.content);
  const Chunk chunk = parseChunkHead(in);
  if (chunk.records_size > head.size - chunk.records_at) {
    in.fail("the records of a chunk should have " + std::to_string(chunk.records_size) +
            " bytes, but the chunk ends before");
  }
  return chunk;
}

std::vector<std::uint8_t> readChunk(const ByteSource& file, const RecordHead& head) {
  const Chunk chunk = readChunkHead(file, head);
  if (chunk.records_size > kMostInMemory) {
    file.fail(head.content - kHeadSize, "the chunk has " + std::to_string(chunk.records_size) +
                                            " bytes, more than " + std::to_string(kMostInMemory));
  }
  std::vector<std::uint8_t> records =
      file.read(head.content + chunk.records_at, chunk.records_size);
  try {
    records = unpacked(chunk, std::move(records));
  } catch (const Error& error) {
    file.fail(head.content - kHeadSize, std::string("the chunk ") + error.what());
  }
  const std::uint32_t crc = chunk.uncompressed_crc == 0 ? 0 : crc32Of(Bytes(records));
  if (crc != chunk.uncompressed_crc) {
    file.fail(head.content - kHeadSize, "the chunk is damaged: its CRC is " + hex(crc) +
                                            ", expected " + hex(chunk.uncompressed_crc));
  }
  return records;
}

void scanChunk(Bytes records, const std::string& name, std::uint64_t chunk, const Visitor& visit) {
  ByteReader in(records, name, 0);
  Record record;
  while (in.left() > 0) {
    const RecordPlace place = {true, chunk, in.offset()};
    const RecordHead head = headOf(in);
    const Bytes content = in.bytes(head.size, "a record in a chunk");
    ByteReader fields(content, name, head.content);
    if (parse(Opcode(head.opcode), fields, record)) visit(record, place);
  }
}

namespace {

// Goes through a file, and keeps what there is to say of it.
class Scanner {
 public:
  Scanner(const ByteSource& file, const Visitor& visit, std::uint64_t most)
      : file_(file), visit_(visit), most_(most) {}

  ScanResult run() {
    checkMagic(file_);
    std::uint64_t offset = sizeof(kMagic);
    bool is_over = false;
    while (!is_over) {
      RecordHead head;
      try {
        head = readHead(file_, offset);
      } catch (const FileError& error) {
        result_.early_end = error.what();
        return result_;
      }
      try {
        readRecord(head, offset);
      } catch (const FileError& error) {
        result_.damaged.add(error.what());
      }
      is_over = Opcode(head.opcode) == Opcode::footer;
      offset = head.end();
    }
    checkEnd(offset);
    return result_;
  }

 private:
  void readRecord(const RecordHead& head, std::uint64_t offset) {
    if (Opcode(head.opcode) == Opcode::chunk) return readChunkAt(head, offset);
    if (!isKnown(head.opcode)) return;
    if (Opcode(head.opcode) == Opcode::attachment && head.size > most_) {
      return checkLongAttachment(head, offset);
    }
    const bool is_message = Opcode(head.opcode) == Opcode::message;
    if (!is_message && head.size > kMostInMemory) file_.fail(offset, "a record is too long");
    const auto content =
        file_.read(head.content, is_message ? std::min(head.size, most_) : head.size);
    ByteReader fields(Bytes(content), file_.name(), head.content);
    Record record;
    if (!parse(Opcode(head.opcode), fields, record)) return;
    if (const auto* end = std::get_if<DataEnd>(&record)) checkData(*end, offset);
    if (const auto* one = std::get_if<Attachment>(&record)) checkAttachment(*one, content, offset);
    visit_(record, {false, 0, offset});
  }

  static bool isKnown(std::uint8_t opcode) noexcept {
    return opcode >= std::uint8_t(Opcode::header) && opcode <= std::uint8_t(Opcode::data_end);
  }

  void readChunkAt(const RecordHead& head, std::uint64_t offset) {
    const std::vector<std::uint8_t> records = readChunk(file_, head);
    const std::string name = file_.name() + ", chunk at byte " + std::to_string(offset);
    scanChunk(Bytes(records), name, offset, visit_);
  }

  void checkData(const DataEnd& end, std::uint64_t offset) {
    // Only the first can be the end: each takes all of the file before it.
    if (is_data_checked_ || end.data_section_crc == 0) return;  // 0: unknown
    is_data_checked_ = true;
    const std::uint32_t crc = crcOf(file_, 0, offset);
    if (crc == end.data_section_crc) return;
    result_.damaged.add(file_.name() + ": the data up to byte " + std::to_string(offset) +
                        " have the CRC " + hex(crc) + ", expected " + hex(end.data_section_crc));
  }

  void checkAttachment(const Attachment& one, const std::vector<std::uint8_t>& content,
                       std::uint64_t offset) {
    compareAttachment(crc32Of(Bytes(content.data(), one.size_before_crc)), one.crc, offset);
  }

  // Without all of it in memory.
  void checkLongAttachment(const RecordHead& head, std::uint64_t offset) {
    constexpr std::uint64_t kMostHead = 1U << 20;  // names
    const auto raw = file_.read(head.content, std::min(head.size, kMostHead));
    ByteReader in(Bytes(raw), file_.name(), head.content);
    const std::uint64_t size = parseAttachmentHead(in);
    constexpr std::uint64_t kCrc = 4;
    if (head.size < in.at() + kCrc || size > head.size - in.at() - kCrc) {
      in.fail("the data of an attachment should have " + std::to_string(size) +
              " bytes, but the record ends before");
    }
    const std::uint64_t end = in.offset() + size;
    const auto stored = file_.read(end, kCrc);
    ByteReader crc(Bytes(stored), file_.name(), end);
    compareAttachment(crcOf(file_, head.content, end),
                      crc.number<std::uint32_t>("the CRC of an attachment"), offset);
  }

  void compareAttachment(std::uint32_t crc, std::uint32_t expected, std::uint64_t offset) {
    if (expected == 0 || expected == crc) return;
    result_.damaged.add(file_.name() + ": the attachment at byte " + std::to_string(offset) +
                        " has the CRC " + hex(crc) + ", expected " + hex(expected));
  }

  void checkEnd(std::uint64_t offset) {
    std::uint8_t magic[sizeof(kMagic)] = {};
    const std::uint64_t left = file_.size() - offset;
    if (left >= sizeof(magic)) file_.read(offset, magic, sizeof(magic));
    if (left >= sizeof(magic) && std::memcmp(magic, kMagic, sizeof(magic)) == 0) return;
    result_.early_end =
        file_.name() + ": at byte " + std::to_string(offset) + ": does not end as MCAP files do";
  }

  const ByteSource& file_;
  const Visitor& visit_;
  std::uint64_t most_;
  bool is_data_checked_ = false;
  ScanResult result_;
};

}  // namespace

ScanResult scan(const ByteSource& file, const Visitor& visit, std::uint64_t most) {
  return Scanner(file, visit, most).run();
}

}  // namespace mcap
}  // namespace ros
}  // namespace v1
}  // namespace gslam
