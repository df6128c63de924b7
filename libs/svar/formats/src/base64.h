// Bytes as text (RFC 4648, section 4).
#ifndef GSLAM_SVAR_FORMATS_SRC_BASE64_H
#define GSLAM_SVAR_FORMATS_SRC_BASE64_H

#include <gslam/svar.h>

#include <cstdint>
#include <string>
#include <vector>

namespace gslam {
namespace formats {

void appendBase64(Span<const std::uint8_t> bytes, std::string& out);

/// Skips white space. False where the text is no base64 with all its padding, or where bits that
/// stand for nothing are not 0.
bool readBase64(detail::Text text, std::vector<std::uint8_t>& out);

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_BASE64_H
