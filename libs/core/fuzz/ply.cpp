// Any bytes are points, or are refused with a ParseError.
#include <gslam/core/ply.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    if (gslam::parsePly(gslam::Span<const std::uint8_t>(data, size), "fuzz").size() > size) {
      std::abort();
    }
  } catch (const gslam::ParseError&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
