#include "records.h"

#include <gslam/base/error.h>

#include <algorithm>

#include "../bytes/decompress.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace bag {

Fields::Fields(ByteReader in) : place_(in.name()), offset_(in.offset()) {
  while (in.left() > 0) {
    const Bytes field = in.block("a field of a header");
    const auto* const equals = std::find(field.begin(), field.end(), std::uint8_t('='));
    if (equals == field.end() || equals == field.begin()) {
      in.fail("a field of a header should be name=value");
    }
    const std::size_t length = std::size_t(equals - field.begin());
    fields_.emplace_back(std::string(field.begin(), equals),
                         Bytes(equals + 1, field.size() - length - 1));
  }
}

const Bytes* Fields::find(const char* name) const noexcept {
  for (const auto& field : fields_) {
    if (field.first == name) return &field.second;
  }
  return nullptr;
}

std::string Fields::text(const char* name) const {
  const Bytes* const value = find(name);
  if (value == nullptr) fail(name, 0);
  return ByteReader::textOf(*value);
}

std::int64_t Fields::stamp(const char* name) const {
  return stampOf(number<std::uint64_t>(name));
}

void Fields::fail(const char* name, std::size_t size) const {
  std::string expected = std::string("expected a field '") + name + "'";
  if (size > 0) expected += " of " + std::to_string(size) + " bytes";
  throw FileError(place_,
                  "at byte " + std::to_string(offset_) + ": " + expected + " in the header");
}

std::int64_t stampOf(std::uint64_t time) noexcept {
  const std::int64_t seconds = static_cast<std::int64_t>(time & 0xFFFFFFFFU);
  return seconds * 1000000000 + static_cast<std::int64_t>(time >> 32);
}

RecordHead readHead(const ByteSource& file, std::uint64_t offset) {
  RecordHead head;
  std::uint8_t raw[4];
  const auto length = [&](std::uint64_t at) {
    file.read(at, raw, sizeof(raw));
    return ByteReader(Bytes(raw, 4), file.name(), at).number<std::uint32_t>("a length");
  };
  head.header_offset = offset + 4;
  // Some fields: what is long, such as definitions of messages, is in the data.
  constexpr std::uint32_t kMostHeader = 1U << 20;
  const std::uint32_t header_size = length(offset);
  if (header_size > kMostHeader) {
    file.fail(offset, "the header of a record should have " + std::to_string(header_size) +
                          " bytes, more than " + std::to_string(kMostHeader));
  }
  head.header = file.read(head.header_offset, header_size);
  const std::uint64_t at = head.header_offset + head.header.size();
  head.size = length(at);
  head.data = at + 4;
  if (head.size > file.size() - head.data) {
    file.fail(offset, "a record should have " + std::to_string(head.size) +
                          " bytes of data, but the file ends at byte " +
                          std::to_string(file.size()));
  }
  return head;
}

bool isPacked(const Fields& chunk) {
  return chunk.text("compression") != "none";
}

namespace {

std::vector<std::uint8_t> unpacked(const std::string& compression, std::vector<std::uint8_t> packed,
                                   std::uint32_t size) {
  if (compression == "bz2") return unpackBzip2(Bytes(packed), size);
  if (compression == "lz4") return unpackLz4(Bytes(packed), size);
  if (compression != "none") {
    throw Error("is compressed by '" + compression.substr(0, 40) + "', expected none, bz2 or lz4");
  }
  if (packed.size() != size) {
    throw Error("has " + std::to_string(packed.size()) + " bytes, but should have " +
                std::to_string(size));
  }
  return packed;
}

}  // namespace

std::vector<std::uint8_t> readChunk(const ByteSource& file, const RecordHead& head) {
  const Fields fields = head.fields(file);
  if (fields.op() != Op::chunk) file.fail(head.header_offset - 4, "expected a chunk");
  try {
    return unpacked(fields.text("compression"), file.read(head.data, head.size),
                    fields.number<std::uint32_t>("size"));
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    file.fail(head.header_offset - 4, std::string("the chunk ") + error.what());
  }
}

Connection readConnection(const Fields& fields, ByteReader data) {
  Connection connection;
  connection.id = fields.number<std::uint32_t>("conn");
  connection.topic = fields.text("topic");
  connection.type = Fields(data).text("type");
  return connection;
}

}  // namespace bag
}  // namespace ros
}  // namespace v1
}  // namespace gslam
