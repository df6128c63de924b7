// Any bytes are a map whose parts know each other and that comes back from a file, or are refused
// with a ParseError. Checksums are made right first: a fuzzer finds none.
#include <gslam/core/covisibility.h>
#include <gslam/core/map_check.h>
#include <gslam/core/map_file.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;

void sign(Bytes& bytes) {
  std::size_t begin = 16;
  while (begin < bytes.size() && bytes.size() - begin >= 24) {
    const std::uint64_t length = gslam::detail::loadLittle<std::uint64_t>(&bytes[begin + 8]);
    if (length > bytes.size() - begin - 24) return;
    const std::size_t end = begin + 16 + static_cast<std::size_t>(length);
    gslam::detail::storeLittle(&bytes[end], gslam::detail::Xxh64::of(&bytes[begin], end - begin));
    begin = end + 8;
  }
}

bool isAboutNumbers(const std::string& problem) {
  for (const char* const part : {"finite", "symmetric", "scale", "diagonal", "rig does not have"}) {
    if (problem.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, data + size);
  sign(bytes);
  try {
    gslam::Map map = gslam::mapFromBytes(bytes);
    for (const std::string& problem : gslam::validate(map)) {
      if (!isAboutNumbers(problem)) std::abort();
    }
    const Bytes first = gslam::mapToBytes(map);
    if (gslam::mapToBytes(gslam::mapFromBytes(first)) != first) std::abort();
    gslam::covisibilityGraph(map);
    gslam::connectedParts(map);
    while (!map.keyframes().empty()) map.remove((*map.keyframes().begin()).id);
    if (map.observationCount() != 0 || !map.edges().empty()) std::abort();
  } catch (const gslam::ParseError&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
