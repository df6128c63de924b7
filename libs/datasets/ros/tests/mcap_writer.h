// Writes MCAP files of any shape that the format allows.
#ifndef GSLAM_DATASETS_ROS_TESTS_MCAP_WRITER_H
#define GSLAM_DATASETS_ROS_TESTS_MCAP_WRITER_H

#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "recorded.h"

namespace mcap_writer {

using Bytes = std::vector<std::uint8_t>;

class Out {
 public:
  template <class T>
  Out& number(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
    }
    return *this;
  }
  Out& u8(std::uint64_t value) { return number(static_cast<std::uint8_t>(value)); }
  Out& u16(std::uint64_t value) { return number(static_cast<std::uint16_t>(value)); }
  Out& u32(std::uint64_t value) { return number(static_cast<std::uint32_t>(value)); }
  Out& u64(std::uint64_t value) { return number(value); }
  Out& raw(const Bytes& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return *this;
  }
  Out& text(const std::string& text) {
    u32(text.size());
    bytes.insert(bytes.end(), text.begin(), text.end());
    return *this;
  }
  Out& block(const Bytes& block) { return u32(block.size()).raw(block); }

  Bytes bytes;
};

inline Bytes magic() {
  return {0x89, 'M', 'C', 'A', 'P', 0x30, '\r', '\n'};
}

inline Bytes record(int opcode, const Bytes& content, const Bytes& padding = {}) {
  Out out;
  out.u8(std::uint64_t(opcode)).u64(content.size() + padding.size()).raw(content).raw(padding);
  return out.bytes;
}

inline std::uint32_t crc(const Bytes& bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, bytes.data(), bytes.size()));
}

inline Bytes packed(const Bytes& bytes, const std::string& compression) {
  if (compression == "zstd") {
    Bytes out(ZSTD_compressBound(bytes.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
    return out;
  }
  if (compression == "lz4") {
    Bytes out(LZ4F_compressFrameBound(bytes.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
    return out;
  }
  return bytes;
}

struct Shape {
  std::string compression;  // "", lz4 or zstd
  bool has_chunks = true;
  bool has_index = true;  // message indexes and the summary
  bool has_crc = true;
  bool is_closed = true;           // with DataEnd, summary and footer
  std::size_t chunk_messages = 3;  // in a chunk
  bool has_strangers = false;      // records of unknown kinds, attachments and metadata between
  std::string encoding = "cdr";
};

inline Bytes channelRecord(std::size_t id, const Recorded& of, const Shape& shape) {
  Out channel;
  channel.u16(id).u16(id).text(of.topic).text(shape.encoding).u32(0);
  return record(0x04, channel.bytes);
}

inline Bytes schemaRecord(std::size_t id, const Recorded& of, const Shape& shape) {
  Out schema;
  schema.u16(id).text(shape.encoding == "ros1" ? of.type : ros2Type(of.type));
  schema.text("ros2msg").block({'#'});
  return record(0x03, schema.bytes);
}

inline Bytes attachmentRecord(bool is_damaged) {
  Out content;
  content.u64(5).u64(6).text("notes.txt").text("text/plain").u64(3).raw({'a', 'b', 'c'});
  content.u32(crc(content.bytes) ^ (is_damaged ? 1U : 0U));
  return record(0x09, content.bytes);
}

/// All messages, in this order.
class Writer {
 public:
  Writer(const std::vector<Recorded>& messages, const Shape& shape)
      : messages_(messages), shape_(shape) {}

  Bytes run() {
    file_.raw(magic()).raw(record(0x01, Out().text("ros2").text("test").bytes));
    if (shape_.has_strangers) {
      file_.raw(record(0x7F, {1, 2, 3})).raw(record(0x99, {})).raw(attachmentRecord(false));
      file_.raw(record(0x0C, Out().text("who").u32(0).bytes));
    }
    for (std::size_t i = 0; i < messages_.size(); ++i) add(i);
    endChunk();
    if (shape_.is_closed) close();
    return file_.bytes;
  }

 private:
  Out& target() { return shape_.has_chunks ? chunk_ : file_; }

  void add(std::size_t i) {
    const Recorded& one = messages_[i];
    const auto known = ids_.emplace(one.topic, ids_.size() + 1);
    const std::size_t id = known.first->second;
    if (known.second) {
      descriptions_.raw(schemaRecord(id, one, shape_)).raw(channelRecord(id, one, shape_));
      target().raw(schemaRecord(id, one, shape_)).raw(channelRecord(id, one, shape_));
    }
    const std::uint64_t time = static_cast<std::uint64_t>(one.received);
    index_[id].u64(time).u64(chunk_.bytes.size());
    first_ = std::min(first_, time);
    last_ = std::max(last_, time);
    Out message;
    message.u16(id).u32(i).u64(time).u64(time).raw(one.bytes);
    target().raw(record(0x05, message.bytes));
    if (++in_chunk_ == shape_.chunk_messages) endChunk();
  }

  void endChunk() {
    if (!shape_.has_chunks || in_chunk_ == 0) return;
    const Bytes records = packed(chunk_.bytes, shape_.compression);
    Out content;
    content.u64(first_).u64(last_).u64(chunk_.bytes.size());
    content.u32(shape_.has_crc ? crc(chunk_.bytes) : 0).text(shape_.compression);
    content.u64(records.size()).raw(records);
    const std::size_t start = file_.bytes.size();
    file_.raw(record(0x06, content.bytes));
    const std::size_t end = file_.bytes.size();
    Out offsets;
    for (const auto& entry : index_) {
      if (!shape_.has_index) break;
      offsets.u16(entry.first).u64(file_.bytes.size());
      file_.raw(record(0x07, Out().u16(entry.first).block(entry.second.bytes).bytes));
    }
    Out index;
    index.u64(first_).u64(last_).u64(start).u64(end - start).block(offsets.bytes);
    index.u64(file_.bytes.size() - end).text(shape_.compression).u64(records.size());
    index.u64(chunk_.bytes.size());
    chunk_indexes_.raw(record(0x08, index.bytes));
    ++chunks_;
    chunk_ = Out();
    index_.clear();
    in_chunk_ = 0;
  }

  void close() {
    const std::uint32_t data_crc = shape_.has_crc ? crc(file_.bytes) : 0;
    file_.raw(record(0x0F, Out().u32(data_crc).bytes));
    const std::size_t start = file_.bytes.size();
    Out summary;
    if (shape_.has_index) {
      summary.raw(descriptions_.bytes).raw(statistics()).raw(chunk_indexes_.bytes);
    }
    Out footer;
    footer.u64(summary.bytes.empty() ? 0 : start).u64(0);
    Out before_crc;
    before_crc.raw(summary.bytes).u8(0x02).u64(20).raw(footer.bytes);
    footer.u32(shape_.has_crc ? crc(before_crc.bytes) : 0);
    file_.raw(summary.bytes).raw(record(0x02, footer.bytes)).raw(magic());
  }

  Bytes statistics() const {
    Out out;
    out.u64(messages_.size()).u16(ids_.size()).u32(ids_.size()).u32(0).u32(0).u32(chunks_);
    out.u64(first_).u64(last_).u32(0);
    return record(0x0B, out.bytes);
  }

  const std::vector<Recorded>& messages_;
  Shape shape_;
  Out file_, chunk_, descriptions_, chunk_indexes_;
  std::map<std::string, std::size_t> ids_;
  std::map<std::size_t, Out> index_;
  std::size_t in_chunk_ = 0, chunks_ = 0;
  std::uint64_t first_ = std::numeric_limits<std::uint64_t>::max(), last_ = 0;
};

inline Bytes write(const std::vector<Recorded>& messages, const Shape& shape = Shape()) {
  return Writer(messages, shape).run();
}

}  // namespace mcap_writer

#endif  // GSLAM_DATASETS_ROS_TESTS_MCAP_WRITER_H
