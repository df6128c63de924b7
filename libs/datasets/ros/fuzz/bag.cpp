// Any bytes are a ROS 1 bag, or are refused with an error.
#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>

#include "bytes/byte_source.h"
#include "storage/storage.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::vector<std::uint8_t> bytes(data, data + size);
    const auto storage = gslam::ros::openBag(gslam::ros::openMemory(bytes, "fuzz"));
    for (const gslam::MessageRef& ref : storage->messages) {
      try {
        storage->readHead(ref, 16);
        storage->read(ref);
      } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): a damaged chunk
      }
    }
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
