// Any bytes, taken as three files with lines `=` between them, are a bundle whose indices are
// there, or are refused with a ParseError.
#include <gslam/base/error.h>
#include <gslam/optimizer/files/colmap.h>

#include <cstddef>
#include <cstdint>

#include "check_bundle_indices.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string files[3];
  std::string rest(reinterpret_cast<const char*>(data), size);
  for (std::string& file : files) {
    const std::size_t end = rest.find("\n=\n");
    file = rest.substr(0, end);
    rest = end == std::string::npos ? "" : rest.substr(end + 3);
  }
  try {
    checkBundleIndices(gslam::parseColmap(files[0], files[1], files[2], "fuzz"));
  } catch (const gslam::ParseError&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
