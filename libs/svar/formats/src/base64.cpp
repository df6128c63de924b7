#include "base64.h"

#include <cstring>

#include "source_text.h"

namespace gslam {
namespace formats {
namespace {

const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// -1 where c is none.
int digitOf(char c) {
  const void* const found = std::memchr(kDigits, c, 64);
  return found == nullptr ? -1 : static_cast<int>(static_cast<const char*>(found) - kDigits);
}

}  // namespace

void appendBase64(Span<const std::uint8_t> bytes, std::string& out) {
  std::uint32_t bits = 0;
  int count = 0;
  for (const std::uint8_t byte : bytes) {
    bits = bits << 8 | byte;
    for (count += 8; count >= 6; count -= 6) out += kDigits[bits >> (count - 6) & 0x3F];
  }
  if (count != 0) out += kDigits[bits << (6 - count) & 0x3F];
  if (count != 0) out.append(count == 2 ? "==" : "=");
}

bool readBase64(detail::Text text, std::vector<std::uint8_t>& out) {
  std::uint32_t bits = 0;
  int count = 0;  // of bits that are in no byte yet
  std::size_t digits = 0;
  std::size_t padding = 0;
  for (const char c : text) {
    if (isSpace(c)) continue;
    const int digit = digitOf(c);
    padding += c == '=' ? 1 : 0;
    if (c == '=') continue;
    if (digit < 0 || padding != 0) return false;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    ++digits;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(static_cast<std::uint8_t>(bits >> count & 0xFF));
  }
  const bool is_whole = (digits + padding) % 4 == 0 && padding < 3 && count < 6;
  return is_whole && (bits & ((1u << count) - 1)) == 0;
}

}  // namespace formats
}  // namespace gslam
