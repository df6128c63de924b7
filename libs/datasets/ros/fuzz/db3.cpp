// Any bytes are a database of ROS 2, or are refused with an error.
#include <gslam/base/error.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "storage/storage.h"

namespace {

// SQLite opens files: one for all runs of a process.
const std::string& pathOfRuns() {
  static const std::string path = [] {
    const char* const folder = std::getenv("TMPDIR");
    return std::string(folder != nullptr ? folder : "/tmp") + "/gslam_fuzz_" +
           std::to_string(::getpid()) + ".db3";
  }();
  return path;
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::ofstream(pathOfRuns(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const auto storage = gslam::ros::openDb3(pathOfRuns());
    for (const gslam::MessageRef& ref : storage->messages) {
      try {
        storage->readHead(ref, 16);
        storage->read(ref);
      } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): a damaged page
      }
    }
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  ::unlink(pathOfRuns().c_str());
  return 0;
}
