// Whatever is accepted must print to text that is read as the same value.
#include <gslam/svar.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

void roundTrip(const gslam::Svar& value, const gslam::JsonOptions& options) {
  const std::string text = gslam::printJson(value);
  const gslam::Svar again = gslam::parseJson(text, "printed", options);
  if (again != value || gslam::printJson(again) != text) std::abort();
  if (gslam::parseJson(gslam::printJson(value, 1), "pretty", options) != value) std::abort();
}

void parse(gslam::detail::Text text, const gslam::JsonOptions& options) {
  try {
    roundTrip(gslam::parseJson(text, "fuzz", options), options);
  } catch (const gslam::ParseError& error) {
    if (error.source() != "fuzz" || error.line() == 0 || error.column() == 0) std::abort();
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gslam::detail::Text text(reinterpret_cast<const char*>(data), size);
  gslam::JsonOptions options;
  parse(text, options);
  options.comments = true;
  options.allow_duplicate_names = true;
  options.max_depth = 100000;
  parse(text, options);
  return 0;
}
