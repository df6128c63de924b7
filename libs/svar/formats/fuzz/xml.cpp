// Whatever is accepted must print to text that is read as the same value.
#include <gslam/svar_formats.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

void roundTrip(const gslam::Svar& value) {
  const std::string text = gslam::printXml(value);
  const gslam::Svar again = gslam::parseXml(text, "printed");
  const bool may_have_nan = text.find(".nan") != std::string::npos;
  if (again != value && !may_have_nan) std::abort();
  // Attributes come first when a text is read, so the order of members settles but then.
  const std::string settled = gslam::printXml(again);
  if (gslam::printXml(gslam::parseXml(settled, "printed")) != settled) std::abort();
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gslam::detail::Text text(reinterpret_cast<const char*>(data), size);
  gslam::XmlOptions options;
  options.max_depth = 500;
  try {
    roundTrip(gslam::parseXml(text, "fuzz", options));
  } catch (const gslam::ParseError& error) {
    if (error.source() != "fuzz" || error.line() == 0 || error.column() == 0) std::abort();
  }
  return 0;
}
