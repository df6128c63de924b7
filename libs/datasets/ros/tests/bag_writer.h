// Writes bags of one uncompressed chunk, without rosbag. Source:
// http://wiki.ros.org/Bags/Format/2.0.
#ifndef GSLAM_DATASETS_ROS_TESTS_BAG_WRITER_H
#define GSLAM_DATASETS_ROS_TESTS_BAG_WRITER_H

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mcap_writer.h"

namespace bag_writer {

using Bytes = std::vector<std::uint8_t>;
using mcap_writer::Out;
using FieldList = std::vector<std::pair<std::string, Bytes>>;

inline Bytes fields(const FieldList& list) {
  Out out;
  for (const auto& one : list) {
    out.u32(one.first.size() + 1 + one.second.size());
    out.bytes.insert(out.bytes.end(), one.first.begin(), one.first.end());
    out.u8('=').raw(one.second);
  }
  return out.bytes;
}

inline Bytes record(const FieldList& header, const Bytes& data) {
  return Out().block(fields(header)).block(data).bytes;
}

inline Bytes u32(std::uint64_t value) {
  return Out().u32(value).bytes;
}
inline Bytes text(const std::string& value) {
  return Bytes(value.begin(), value.end());
}

struct Bag {
  Bytes bytes;
  std::size_t index = 0;  // where the connections and infos of chunks begin
};

struct Shape {
  std::size_t messages = 10;
  std::size_t times_named = 1;  // by the index, each message
  bool is_encrypted = false;
  bool is_chunk_closed = true;
};

inline Bytes headerRecord(std::uint64_t index, const Shape& shape) {
  FieldList list = {{"op", {3}},
                    {"index_pos", Out().u64(index).bytes},
                    {"conn_count", u32(1)},
                    {"chunk_count", u32(1)}};
  if (shape.is_encrypted) list.emplace_back("encryptor", text("rosbag/AesCbcEncryptor"));
  return record(list, Bytes(200, ' '));
}

/// Messages of /imu at 10, 11, ... s, of 30 bytes that are the number of the message.
inline Bag write(const Shape& shape = Shape()) {
  const Bytes connection = record({{"op", {7}}, {"conn", u32(0)}, {"topic", text("/imu")}},
                                  fields({{"topic", text("/imu")}, {"type", text("a/Imu")}}));
  Out chunk, entries;
  chunk.raw(connection);
  for (std::size_t i = 0; i < shape.messages; ++i) {
    const Bytes time = Out().u32(10 + i).u32(0).bytes;
    for (std::size_t k = 0; k < shape.times_named; ++k) {
      entries.raw(time).u32(chunk.bytes.size());
    }
    chunk.raw(record({{"op", {2}}, {"conn", u32(0)}, {"time", time}},
                     Bytes(30, static_cast<std::uint8_t>(i))));
  }
  const std::size_t named = shape.messages * shape.times_named;
  Out file;
  file.raw(text("#ROSBAG V2.0\n")).raw(headerRecord(0, shape));
  const std::size_t start = file.bytes.size();
  const Bytes size = u32(shape.is_chunk_closed ? chunk.bytes.size() : 0);
  file.block(fields({{"op", {5}}, {"compression", text("none")}, {"size", size}}));
  file.raw(size).raw(chunk.bytes);
  Bag bag;
  if (shape.is_chunk_closed) {
    file.raw(record({{"op", {4}}, {"ver", u32(1)}, {"conn", u32(0)}, {"count", u32(named)}},
                    entries.bytes));
    bag.index = file.bytes.size();
    file.raw(connection);
    file.raw(record({{"op", {6}},
                     {"ver", u32(1)},
                     {"chunk_pos", Out().u64(start).bytes},
                     {"start_time", Out().u64(10).bytes},
                     {"end_time", Out().u64(10).bytes},
                     {"count", u32(1)}},
                    Out().u32(0).u32(named).bytes));
  }
  const Bytes header = headerRecord(bag.index, shape);
  std::copy(header.begin(), header.end(), file.bytes.begin() + 13);
  bag.bytes = file.bytes;
  return bag;
}

}  // namespace bag_writer

#endif  // GSLAM_DATASETS_ROS_TESTS_BAG_WRITER_H
