// Descriptors of more images than the memory holds.
#ifndef GSLAM_APPS_DESCRIPTOR_SPOOL_H
#define GSLAM_APPS_DESCRIPTOR_SPOOL_H

#include <gslam/base/span.h>
#include <gslam/vocabulary/descriptors.h>

#include <cstdint>
#include <string>
#include <vector>

namespace app {

/// Descriptors in a temporary file that nobody else sees, and that is gone with the process however
/// it ends: first they are added, then they are read, any number of times. Features are found once
/// only, and the system has in memory what fits there.
class DescriptorSpool {
 public:
  /// @param beside  a file, in whose folder the temporary one is
  /// @throws FileError when none can be made there
  explicit DescriptorSpool(const std::string& beside);
  DescriptorSpool(const DescriptorSpool&) = delete;
  DescriptorSpool& operator=(const DescriptorSpool&) = delete;
  ~DescriptorSpool();

  /// Adds those of an image, which may have none.
  /// @throws FileError when the disk is full
  void add(const gslam::Descriptors& image);
  /// Those of all images, as long as this lives. Nothing is added any more.
  gslam::Span<const gslam::Descriptors> images();
  /// How many descriptors there are.
  std::uint64_t count() const noexcept { return count_; }

 private:
  void write(const std::uint8_t* bytes, std::size_t size);

  const std::string name_;  // for messages
  int file_ = -1;
  std::size_t size_ = 0;  // bytes in it
  void* memory_ = nullptr;
  std::uint64_t count_ = 0;
  std::vector<gslam::Descriptors> images_;
};

}  // namespace app

#endif  // GSLAM_APPS_DESCRIPTOR_SPOOL_H
