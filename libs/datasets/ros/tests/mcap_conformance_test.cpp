// All files of the conformance suite of MCAP
// (https://github.com/foxglove/mcap/tree/main/tests/conformance).
//
// The data has what each file must contain, as JSON, and of the file itself Git LFS' pointer: its
// size and SHA-256. So the bytes are written here from the JSON; that these have the size and the
// SHA-256 of the true file proves that they are it. Then the reader must find what the JSON says.
#include <gslam/core/detail/shared_library.h>
#include <gslam/svar/json.h>
#include <gslam/svar/svar.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "mcap/scan.h"
#include "mcap_writer.h"
#include "sha256.h"
#include "storage/storage.h"
#include "test_data.h"

namespace {

using gslam::Svar;
using mcap_writer::Out;
namespace mcap = gslam::ros::mcap;

std::uint64_t numberOf(const Svar& value) {
  return std::stoull(value.as<std::string>());
}

std::vector<std::uint8_t> bytesOf(const Svar& array) {
  std::vector<std::uint8_t> bytes;
  for (const Svar& one : array) bytes.push_back(static_cast<std::uint8_t>(numberOf(one)));
  return bytes;
}

// A record of the JSON: its fields by name.
struct Expected {
  explicit Expected(const Svar& record) : type(record.get<std::string>("type")) {
    for (const Svar& field : record.get<Svar>("fields")) {
      fields.set(field.get<std::string>("0"), field.get<Svar>("1"));
    }
  }
  std::uint64_t number(const char* name) const { return numberOf(fields.get<Svar>(name)); }
  std::string text(const char* name) const { return fields.get<std::string>(name); }
  std::vector<std::uint8_t> bytes(const char* name) const {
    return bytesOf(fields.get<Svar>(name));
  }
  gslam::Span<const Svar::Member> map(const char* name) const {
    map_ = fields.get<Svar>(name);
    return map_.members();
  }

  std::string type;
  Svar fields = Svar::object();
  mutable Svar map_;
};

// --- writing -------------------------------------------------------------------------------------

std::vector<std::uint8_t> textMap(const Expected& record, const char* name) {
  Out out;
  for (const Svar::Member& one : record.map(name)) {
    out.text(one.first).text(one.second.as<std::string>());
  }
  return out.bytes;
}

std::vector<std::uint8_t> numberMap(const Expected& record, const char* name) {
  Out out;
  for (const Svar::Member& one : record.map(name)) {
    out.u16(std::stoull(one.first)).u64(numberOf(one.second));
  }
  return out.bytes;
}

std::vector<std::uint8_t> write(const Expected& r, const std::vector<std::uint8_t>& padding) {
  Out out;
  const auto padded = [&](int opcode) { return mcap_writer::record(opcode, out.bytes, padding); };
  if (r.type == "Header") {
    out.text(r.text("profile")).text(r.text("library"));
    return padded(0x01);
  }
  if (r.type == "Footer") {
    out.u64(r.number("summary_start")).u64(r.number("summary_offset_start"));
    out.u32(r.number("summary_crc"));
    return mcap_writer::record(0x02, out.bytes);
  }
  if (r.type == "Schema") {
    out.u16(r.number("id")).text(r.text("name")).text(r.text("encoding")).block(r.bytes("data"));
    return padded(0x03);
  }
  if (r.type == "Channel") {
    out.u16(r.number("id")).u16(r.number("schema_id")).text(r.text("topic"));
    out.text(r.text("message_encoding")).block(textMap(r, "metadata"));
    return padded(0x04);
  }
  if (r.type == "Message") {
    out.u16(r.number("channel_id")).u32(r.number("sequence")).u64(r.number("log_time"));
    out.u64(r.number("publish_time")).raw(r.bytes("data"));
    return mcap_writer::record(0x05, out.bytes);
  }
  if (r.type == "ChunkIndex") {
    for (const char* name :
         {"message_start_time", "message_end_time", "chunk_start_offset", "chunk_length"}) {
      out.u64(r.number(name));
    }
    out.block(numberMap(r, "message_index_offsets")).u64(r.number("message_index_length"));
    out.text(r.text("compression"));
    out.u64(r.number("compressed_size")).u64(r.number("uncompressed_size"));
    return padded(0x08);
  }
  if (r.type == "Statistics") {
    out.u64(r.number("message_count")).u16(r.number("schema_count"));
    for (const char* name :
         {"channel_count", "attachment_count", "metadata_count", "chunk_count"}) {
      out.u32(r.number(name));
    }
    out.u64(r.number("message_start_time")).u64(r.number("message_end_time"));
    out.block(numberMap(r, "channel_message_counts"));
    return padded(0x0B);
  }
  if (r.type == "SummaryOffset") {
    out.u8(r.number("group_opcode")).u64(r.number("group_start")).u64(r.number("group_length"));
    return padded(0x0E);
  }
  EXPECT_EQ(r.type, "DataEnd");
  out.u32(r.number("data_section_crc"));
  return mcap_writer::record(0x0F, out.bytes);
}

// The records of the data as one chunk, with its message indexes.
std::vector<std::uint8_t> writeChunk(const std::vector<Expected>& records, bool has_indexes,
                                     const std::vector<std::uint8_t>& padding) {
  Out inside, indexes;
  std::uint64_t first = UINT64_MAX, last = 0;
  for (const Expected& one : records) {
    if (one.type == "Message") {
      Out entry;
      entry.u64(one.number("log_time")).u64(inside.bytes.size());
      Out index;
      index.u16(one.number("channel_id")).block(entry.bytes);
      indexes.raw(mcap_writer::record(0x07, index.bytes, padding));
      first = std::min(first, one.number("log_time"));
      last = std::max(last, one.number("log_time"));
    }
    inside.raw(write(one, {}));
  }
  Out chunk;
  chunk.u64(first).u64(last).u64(inside.bytes.size()).u32(mcap_writer::crc(inside.bytes)).text("");
  chunk.u64(inside.bytes.size()).raw(inside.bytes);
  Out out;
  out.raw(mcap_writer::record(0x06, chunk.bytes));
  if (has_indexes) out.raw(indexes.bytes);
  return out.bytes;
}

struct Case {
  std::vector<Expected> records;
  std::set<std::string> features;
  bool has(const char* feature) const { return features.count(feature) > 0; }
};

std::vector<std::uint8_t> write(const Case& one) {
  const std::vector<std::uint8_t> padding =
      one.has("pad") ? std::vector<std::uint8_t>{1, 0xFF, 0xFF} : std::vector<std::uint8_t>();
  Out out;
  out.raw(mcap_writer::magic()).raw(write(one.records[0], padding));
  std::vector<Expected> data;
  std::size_t i = 1;
  for (; one.records[i].type != "DataEnd"; ++i) data.push_back(one.records[i]);
  if (one.has("ch")) {
    out.raw(writeChunk(data, one.has("mx"), padding));
  } else {
    for (const Expected& record : data) out.raw(write(record, padding));
  }
  for (; i < one.records.size(); ++i) out.raw(write(one.records[i], padding));
  return out.raw(mcap_writer::magic()).bytes;
}

// --- comparing -----------------------------------------------------------------------------------

class Comparison {
 public:
  explicit Comparison(const std::vector<Expected>& expected) : expected_(expected) {}

  void take(const mcap::Record& record) {
    if (std::holds_alternative<mcap::MessageIndex>(record)) return;  // the JSON has none
    ASSERT_LT(next_, expected_.size());
    const Expected& wanted = expected_[next_++];
    std::visit([&](const auto& one) { compare(one, wanted); }, record);
  }
  std::size_t count() const { return next_; }

 private:
  static void compare(const mcap::Header& a, const Expected& b) {
    ASSERT_EQ(b.type, "Header");
    EXPECT_EQ(a.profile, b.text("profile"));
    EXPECT_EQ(a.library, b.text("library"));
  }
  static void compare(const mcap::Footer& a, const Expected& b) {
    ASSERT_EQ(b.type, "Footer");
    EXPECT_EQ(a.summary_start, b.number("summary_start"));
    EXPECT_EQ(a.summary_offset_start, b.number("summary_offset_start"));
    EXPECT_EQ(a.summary_crc, b.number("summary_crc"));
  }
  static void compare(const mcap::Schema& a, const Expected& b) {
    ASSERT_EQ(b.type, "Schema");
    EXPECT_EQ(a.id, b.number("id"));
    EXPECT_EQ(a.name, b.text("name"));
    EXPECT_EQ(a.encoding, b.text("encoding"));
    EXPECT_EQ(std::vector<std::uint8_t>(a.data.begin(), a.data.end()), b.bytes("data"));
  }
  static void compare(const mcap::Channel& a, const Expected& b) {
    ASSERT_EQ(b.type, "Channel");
    EXPECT_EQ(a.id, b.number("id"));
    EXPECT_EQ(a.schema_id, b.number("schema_id"));
    EXPECT_EQ(a.topic, b.text("topic"));
    EXPECT_EQ(a.message_encoding, b.text("message_encoding"));
    std::map<std::string, std::string> metadata;
    for (const Svar::Member& one : b.map("metadata")) {
      metadata[one.first] = one.second.as<std::string>();
    }
    EXPECT_EQ(a.metadata, metadata);
  }
  static void compare(const mcap::Message& a, const Expected& b) {
    ASSERT_EQ(b.type, "Message");
    EXPECT_EQ(a.channel_id, b.number("channel_id"));
    EXPECT_EQ(a.sequence, b.number("sequence"));
    EXPECT_EQ(a.log_time, b.number("log_time"));
    EXPECT_EQ(a.publish_time, b.number("publish_time"));
    EXPECT_EQ(std::vector<std::uint8_t>(a.data.begin(), a.data.end()), b.bytes("data"));
  }
  static void compare(const mcap::ChunkIndex& a, const Expected& b) {
    ASSERT_EQ(b.type, "ChunkIndex");
    EXPECT_EQ(a.message_start_time, b.number("message_start_time"));
    EXPECT_EQ(a.message_end_time, b.number("message_end_time"));
    EXPECT_EQ(a.chunk_start_offset, b.number("chunk_start_offset"));
    EXPECT_EQ(a.chunk_length, b.number("chunk_length"));
    EXPECT_EQ(a.message_index_offsets, mapOf(b, "message_index_offsets"));
    EXPECT_EQ(a.message_index_length, b.number("message_index_length"));
    EXPECT_EQ(a.compression, b.text("compression"));
    EXPECT_EQ(a.compressed_size, b.number("compressed_size"));
    EXPECT_EQ(a.uncompressed_size, b.number("uncompressed_size"));
  }
  static void compare(const mcap::Statistics& a, const Expected& b) {
    ASSERT_EQ(b.type, "Statistics");
    EXPECT_EQ(a.message_count, b.number("message_count"));
    EXPECT_EQ(a.schema_count, b.number("schema_count"));
    EXPECT_EQ(a.channel_count, b.number("channel_count"));
    EXPECT_EQ(a.attachment_count, b.number("attachment_count"));
    EXPECT_EQ(a.metadata_count, b.number("metadata_count"));
    EXPECT_EQ(a.chunk_count, b.number("chunk_count"));
    EXPECT_EQ(a.message_start_time, b.number("message_start_time"));
    EXPECT_EQ(a.message_end_time, b.number("message_end_time"));
    EXPECT_EQ(a.channel_message_counts, mapOf(b, "channel_message_counts"));
  }
  static void compare(const mcap::SummaryOffset& a, const Expected& b) {
    ASSERT_EQ(b.type, "SummaryOffset");
    EXPECT_EQ(a.group_opcode, b.number("group_opcode"));
    EXPECT_EQ(a.group_start, b.number("group_start"));
    EXPECT_EQ(a.group_length, b.number("group_length"));
  }
  static void compare(const mcap::DataEnd& a, const Expected& b) {
    ASSERT_EQ(b.type, "DataEnd");
    EXPECT_EQ(a.data_section_crc, b.number("data_section_crc"));
  }
  template <class Other>
  static void compare(const Other&, const Expected& b) {
    FAIL() << "a record that the suite has not, expected " << b.type;
  }

  static std::map<std::uint16_t, std::uint64_t> mapOf(const Expected& b, const char* name) {
    std::map<std::uint16_t, std::uint64_t> map;
    for (const Svar::Member& one : b.map(name)) {
      map[static_cast<std::uint16_t>(std::stoul(one.first))] = numberOf(one.second);
    }
    return map;
  }

  const std::vector<Expected>& expected_;
  std::size_t next_ = 0;
};

// --- all files -----------------------------------------------------------------------------------

// The true file: what is there, or what its pointer stands for.
std::vector<std::uint8_t> trueFile(const std::string& path, const Case& one) {
  const std::vector<std::uint8_t> there = readFile(path);
  const std::vector<std::uint8_t> written = write(one);
  const std::string text(there.begin(), there.end());
  if (text.compare(0, 8, "version ") != 0) {
    EXPECT_EQ(there, written) << path;
    return there;
  }
  std::istringstream words(text.substr(text.find("sha256:") + 7));
  std::string sha, word;
  std::size_t size = 0;
  words >> sha >> word >> size;
  EXPECT_EQ(written.size(), size) << path;
  EXPECT_EQ(Sha256::of(written), sha) << path;
  return written;
}

void checkMessages(const std::vector<std::uint8_t>& bytes, const Case& one) {
  const auto storage = gslam::ros::openMcap(gslam::ros::openMemory(bytes, "case.mcap"));
  std::vector<std::vector<std::uint8_t>> found, wanted;
  for (const gslam::MessageRef& ref : storage->messages) found.push_back(storage->read(ref));
  for (const Expected& record : one.records) {
    if (record.type == "Message") wanted.push_back(record.bytes("data"));
  }
  EXPECT_EQ(found, wanted);
}

void check(const std::string& path) {
  const std::vector<std::uint8_t> json = readFile(path);
  const Svar document = gslam::parseJson(std::string(json.begin(), json.end()), path);
  Case one;
  for (const Svar& record : document.get<Svar>("records")) one.records.emplace_back(record);
  for (const Svar& feature : document.get<Svar>("meta.variant.features")) {
    one.features.insert(feature.as<std::string>());
  }
  const auto bytes = trueFile(path.substr(0, path.size() - 4) + "mcap", one);
  Comparison comparison(one.records);
  const auto file = gslam::ros::openMemory(bytes, path);
  const mcap::ScanResult result = mcap::scan(
      *file,
      [&](const mcap::Record& record, const mcap::RecordPlace&) { comparison.take(record); });
  EXPECT_EQ(comparison.count(), one.records.size());
  EXPECT_EQ(result.early_end, "");
  EXPECT_TRUE(result.damaged.empty());
  checkMessages(bytes, one);
}

TEST(mcap_conformance, every_file_has_exactly_the_records_of_its_json) {
  NEEDS_TEST_DATA();
  const std::string root = test_data::folder() + "bags/mcap_conformance/";
  int checked = 0;
  for (const std::string& folder : gslam::detail::namesIn(root)) {
    for (const std::string& name : gslam::detail::namesIn(root + folder)) {
      if (name.size() < 5 || name.substr(name.size() - 5) != ".json") continue;
      SCOPED_TRACE(name);
      check(root + folder + "/" + name);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 234);
}

TEST(mcap_conformance, sha256_is_that_of_fips_180) {
  EXPECT_EQ(Sha256::of({'a', 'b', 'c'}),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
