// Bytes that are read at any place: a file, or memory that stands for one.
#ifndef GSLAM_DATASETS_ROS_SRC_BYTES_BYTE_SOURCE_H
#define GSLAM_DATASETS_ROS_SRC_BYTES_BYTE_SOURCE_H

#include <gslam/datasets_ros/export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace ros {

/// Bytes at offsets. Threads may share one.
class GSLAM_DATASETS_ROS_EXPORT ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// What errors call it.
  const std::string& name() const noexcept { return name_; }
  std::uint64_t size() const noexcept { return size_; }

  /// All of these bytes. Memory is taken after the range was checked.
  /// @throws FileError when they are not all there
  std::vector<std::uint8_t> read(std::uint64_t offset, std::uint64_t size) const;
  /// The same to memory of the caller.
  void read(std::uint64_t offset, std::uint8_t* to, std::size_t size) const;

  /// @throws FileError "name: at byte N: problem"
  [[noreturn]] void fail(std::uint64_t offset, const std::string& problem) const;

 protected:
  ByteSource(std::string name, std::uint64_t size);

 private:
  virtual void get(std::uint64_t offset, std::uint8_t* to, std::size_t size) const = 0;

  std::string name_;
  std::uint64_t size_;
};

/// @throws FileError when it cannot be opened, or is no file
GSLAM_DATASETS_ROS_EXPORT std::shared_ptr<const ByteSource> openFile(const std::string& path);

/// The same for bytes in memory.
GSLAM_DATASETS_ROS_EXPORT std::shared_ptr<const ByteSource> openMemory(
    std::vector<std::uint8_t> bytes, const std::string& name);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_BYTES_BYTE_SOURCE_H
