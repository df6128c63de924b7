// The records of a ROS 1 bag. Source: http://wiki.ros.org/Bags/Format/2.0.
#ifndef GSLAM_DATASETS_ROS_SRC_BAG_RECORDS_H
#define GSLAM_DATASETS_ROS_SRC_BAG_RECORDS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "../bytes/byte_reader.h"
#include "../bytes/byte_source.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace bag {

constexpr char kVersion[] = "#ROSBAG V2.0\n";
constexpr std::size_t kVersionSize = sizeof(kVersion) - 1;

enum class Op : std::uint8_t {
  message = 0x02,
  header = 0x03,
  index = 0x04,
  chunk = 0x05,
  chunk_info = 0x06,
  connection = 0x07
};

/// The fields of a record's header: name=value.
class Fields {
 public:
  /// @throws FileError when one has no name, or is longer than the header
  explicit Fields(ByteReader in);

  /// Null where there is none of this name.
  const Bytes* find(const char* name) const noexcept;
  std::string text(const char* name) const;
  Op op() const { return Op(number<std::uint8_t>("op")); }
  /// @throws FileError when there is none of this name, or it has another size
  template <class T>
  T number(const char* name) const {
    const Bytes* const value = find(name);
    if (value == nullptr || value->size() != sizeof(T)) fail(name, sizeof(T));
    std::uint64_t number = 0;
    for (std::size_t i = sizeof(T); i-- > 0;) number = number << 8 | (*value)[i];
    return static_cast<T>(number);
  }
  /// A time, seconds and nanoseconds of 32 bits each, as nanoseconds.
  std::int64_t stamp(const char* name) const;

 private:
  [[noreturn]] void fail(const char* name, std::size_t size) const;

  std::string place_;
  std::uint64_t offset_;
  std::vector<std::pair<std::string, Bytes>> fields_;
};

/// Nanoseconds of a time of ROS 1: seconds in the lower half.
std::int64_t stampOf(std::uint64_t time) noexcept;

/// A record of a file whose data were not read yet.
struct RecordHead {
  std::vector<std::uint8_t> header;  // what Fields reads
  std::uint64_t header_offset = 0;
  std::uint64_t data = 0;  // offset
  std::uint32_t size = 0;  // of the data
  std::uint64_t end() const noexcept { return data + size; }
  Fields fields(const ByteSource& file) const {
    return Fields(ByteReader(Bytes(header), file.name(), header_offset));
  }
};

/// @throws FileError when the file ends before the record does
RecordHead readHead(const ByteSource& file, std::uint64_t offset);

/// The data of a chunk, unpacked. @throws FileError when they are damaged
std::vector<std::uint8_t> readChunk(const ByteSource& file, const RecordHead& head);

/// Bytes that data of a chunk begin at, where they are not compressed.
bool isPacked(const Fields& chunk);

/// The kind of a connection: its topic, and type.
struct Connection {
  std::uint32_t id = 0;
  std::string topic, type;
};
/// @param fields  of the record's header
/// @param data    a second header
Connection readConnection(const Fields& fields, ByteReader data);

}  // namespace bag
}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_BAG_RECORDS_H
