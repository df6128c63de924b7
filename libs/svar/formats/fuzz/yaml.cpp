// Whatever is accepted must print to text that is read as the same value.
#include <gslam/svar_formats.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

void roundTrip(const gslam::Svar& value) {
  const std::string text = gslam::printYaml(value);
  const gslam::Svar again = gslam::parseYaml(text, "printed");
  const bool may_have_nan = text.find(".nan") != std::string::npos;
  if (again != value && !may_have_nan) std::abort();
  if (gslam::printYaml(again) != text) std::abort();
}

void parse(gslam::detail::Text text, const gslam::YamlOptions& options) {
  try {
    for (const gslam::Svar& value : gslam::parseYamlDocuments(text, "fuzz", options)) {
      roundTrip(value);
    }
  } catch (const gslam::ParseError& error) {
    if (error.source() != "fuzz" || error.line() == 0 || error.column() == 0) std::abort();
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gslam::detail::Text text(reinterpret_cast<const char*>(data), size);
  gslam::YamlOptions options;
  options.max_values = 10000;
  parse(text, options);
  options.allow_duplicate_names = true;
  parse(text, options);
  return 0;
}
