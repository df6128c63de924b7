// Any bytes are a pose that goes to text and back to the bit, or are refused with a gslam::Error.
#include <gslam/geometry/text.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <class G>
void roundTrip(const std::string& text) {
  try {
    const G element = gslam::fromText<G>(text);
    const G again = gslam::fromText<G>(gslam::toText(element));
    if (std::memcmp(&element, &again, sizeof(G)) != 0) std::abort();
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  roundTrip<gslam::SO3d>(text);
  roundTrip<gslam::SE3f>(text);
  roundTrip<gslam::SIM3d>(text);
  roundTrip<gslam::SE2d>(text);
  return 0;
}
