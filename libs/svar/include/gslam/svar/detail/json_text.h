// The inside of JSON strings: UTF-8 and escapes.
#ifndef GSLAM_SVAR_DETAIL_JSON_TEXT_H
#define GSLAM_SVAR_DETAIL_JSON_TEXT_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

/// What stands between the quotes of a string.
struct JsonString {
  JsonString(const char* first, const char* last, bool escapes) noexcept
      : begin(first), end(last), has_escapes(escapes) {}

  const char* begin;
  const char* end;
  bool has_escapes;

  std::size_t size() const noexcept { return static_cast<std::size_t>(end - begin); }
};

/// Whether a character may stand between the words of JSON.
inline bool isSpace(char c) noexcept {
  return c <= ' ' && (c == ' ' || c == '\n' || c == '\r' || c == '\t');
}

/// Eight bytes, the first one lowest on every machine. Compilers make one instruction of it.
inline std::uint64_t eightBytes(const char* p) noexcept {
  const auto byte = [p](int i) {
    return static_cast<std::uint64_t>(static_cast<unsigned char>(p[i])) << (8 * i);
  };
  return byte(0) | byte(1) | byte(2) | byte(3) | byte(4) | byte(5) | byte(6) | byte(7);
}

/// The top bits of bytes, of which the lowest marks the first that is a quote, a backslash, a
/// control character or not ASCII; 0 where none is.
inline std::uint64_t markSpecial(std::uint64_t word) noexcept {
  const std::uint64_t ones = 0x0101010101010101u;
  const std::uint64_t quote = word ^ (ones * '"');
  const std::uint64_t backslash = word ^ (ones * '\\');
  // Of a byte below 0x80, subtracting n sets the top bit where the byte is below n; what that
  // borrows changes only bytes above it.
  return ((word - ones * 0x20) | (quote - ones) | (backslash - ones) | word) & (ones * 0x80);
}

inline bool isSpecial(char c) noexcept {
  const unsigned char byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte >= 0x80 || c == '"' || c == '\\';
}

/// The first byte that markSpecial() would mark, or `end`.
inline const char* skipPlain(const char* p, const char* end) noexcept {
  for (; end - p >= 8; p += 8) {
    const std::uint64_t marks = markSpecial(eightBytes(p));
    if (marks == 0) continue;
    const std::uint64_t first = (marks & (~marks + 1)) >> 7;  // 1 << 8 * (index of the byte)
    return p + (first * 0x0001020304050607u >> 56);
  }
  while (p != end && !isSpecial(*p)) ++p;
  return p;
}

/// Copies until the byte at which skipPlain() stops, and returns where that is; may write up to
/// where `end` comes to lie.
inline const char* copyPlain(const char* p, const char* end, char* out) noexcept {
  for (; end - p >= 8; p += 8, out += 8) {
    if (markSpecial(eightBytes(p)) != 0) break;
    std::memcpy(out, p, 8);
  }
  for (; p != end && !isSpecial(*p); ++p, ++out) *out = *p;
  return p;
}

/// Length of the UTF-8 character that begins at p, from 1 to 4; 0 where none does, be it overlong,
/// a surrogate or beyond U+10FFFF (RFC 3629, section 4). p must not be `end`.
inline std::size_t utf8Length(const char* p, const char* end) noexcept {
  const auto byte = [p](std::size_t i) { return static_cast<unsigned char>(p[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (static_cast<std::size_t>(end - p) < length) return 0;
  const unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80) return 0;
  }
  return length;
}

inline void appendUtf8(std::uint32_t code, std::string& out) {
  const auto add = [&out](std::uint32_t byte) { out.push_back(static_cast<char>(byte)); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add(0x80 | (code >> 6 & 0x3F));
  } else {
    add(0xF0 | code >> 18);
    add(0x80 | (code >> 12 & 0x3F));
    add(0x80 | (code >> 6 & 0x3F));
  }
  add(0x80 | (code & 0x3F));
}

/// -1 where c is no hexadecimal digit.
inline int hexDigit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// The value of four hexadecimal digits; beyond 0xFFFF where they are not four.
inline std::uint32_t fourHexDigits(const char* p, const char* end) noexcept {
  std::uint32_t value = 0;
  if (end - p < 4) return 0x10000;
  for (int i = 0; i < 4; ++i) {
    const int digit = hexDigit(p[i]);
    if (digit < 0) return 0x10000;
    value = value << 4 | static_cast<std::uint32_t>(digit);
  }
  return value;
}

inline bool isHighSurrogate(std::uint32_t code) noexcept {
  return code >> 10 == 0xD800 >> 10;
}
inline bool isLowSurrogate(std::uint32_t code) noexcept {
  return code >> 10 == 0xDC00 >> 10;
}

/// What the letter after a backslash stands for; 0 where it is none of those, or is u.
inline char unescape(char letter) noexcept {
  switch (letter) {
    case '"':
    case '\\':
    case '/':
      return letter;
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    default:
      return 0;
  }
}

/// Sets `text` to what a string stands for, all of which must be known to be well-formed.
inline void decodeEscapes(const JsonString& string, std::string& text) {
  text.clear();
  text.reserve(string.size());
  for (const char* p = string.begin; p != string.end;) {
    const char* const begin = p;
    while (p != string.end && *p != '\\') ++p;
    text.append(begin, p);
    if (p == string.end) break;
    const char letter = p[1];
    p += 2;
    if (letter != 'u') {
      text.push_back(unescape(letter));
      continue;
    }
    std::uint32_t code = fourHexDigits(p, string.end);
    p += 4;
    if (isHighSurrogate(code)) {
      code = 0x10000 + ((code & 0x3FF) << 10) + (fourHexDigits(p + 2, string.end) & 0x3FF);
      p += 6;
    }
    appendUtf8(code, text);
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_JSON_TEXT_H
