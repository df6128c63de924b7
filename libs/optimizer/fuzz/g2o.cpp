// Any bytes are a pose graph whose indices are there, or are refused with a ParseError.
#include <gslam/base/error.h>
#include <gslam/optimizer/files/g2o.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "check_graph.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    std::visit(CheckGraph(), gslam::parseG2o(text, "fuzz"));
  } catch (const gslam::ParseError&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
