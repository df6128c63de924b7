#include "source_text.h"

#include <algorithm>
#include <cstdio>

namespace gslam {
namespace formats {

using detail::Text;

namespace {

const char kByteOrderMark[] = "\xEF\xBB\xBF";

std::string describeByte(char c) {
  char text[16];
  std::snprintf(text, sizeof(text), "byte 0x%02X", static_cast<unsigned char>(c));
  return text;
}

bool isControl(char c) {
  return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
}

// U+FFFE and U+FFFF.
bool isNoCharacter(const char* p, std::size_t length) {
  return length == 3 && p[0] == '\xEF' && p[1] == '\xBF' &&
         static_cast<unsigned char>(p[2]) >= 0xBE;
}

}  // namespace

WrongCharacter findWrongCharacter(Text text) {
  const char* const end = text.end();
  for (const char* p = text.begin(); p != end;) {
    const std::size_t offset = static_cast<std::size_t>(p - text.begin());
    if (isControl(*p)) return {offset, "no control character", describeByte(*p)};
    const std::size_t length = detail::utf8Length(p, end);
    if (length == 0) return {offset, "UTF-8", describeByte(*p)};
    if (isNoCharacter(p, length)) {
      return {offset, "characters",
              p[2] == '\xBE' ? "U+FFFE, which is none" : "U+FFFF, which is none"};
    }
    p += length;
  }
  return {text.size(), "", ""};
}

SourceText::SourceText(Text text, const std::string& name) : text_(text), name_(name) {
  const Text mark(kByteOrderMark);
  while (text_.size() >= mark.size() && Text(text_.data(), mark.size()) == mark) {
    text_ = Text(text_.data() + mark.size(), text_.size() - mark.size());
  }
}

void SourceText::checkCharacters() const {
  const WrongCharacter wrong = findWrongCharacter(text_);
  if (wrong.expected.empty()) return;
  fail(wrong.offset, "expected " + wrong.expected + ", found " + wrong.found);
}

void SourceText::fail(std::size_t offset, const std::string& problem) const {
  const std::pair<std::size_t, std::size_t> found = place(offset);
  throw ParseError(name_, found.first, found.second, problem);
}

std::string SourceText::placeName(std::size_t offset) const {
  const std::pair<std::size_t, std::size_t> found = place(offset);
  return "line " + std::to_string(found.first) + ", column " + std::to_string(found.second);
}

std::pair<std::size_t, std::size_t> SourceText::place(std::size_t offset) const {
  const char* const at = text_.begin() + std::min(offset, text_.size());
  const char* line_begin = at;
  while (line_begin != text_.begin() && line_begin[-1] != '\n') --line_begin;
  const std::ptrdiff_t lines = std::count(text_.begin(), line_begin, '\n');
  return {static_cast<std::size_t>(lines) + 1, static_cast<std::size_t>(at - line_begin) + 1};
}

std::string quoted(Text text) {
  std::size_t cut = 40;
  if (text.size() <= cut) return "\"" + text.str() + "\"";
  while (cut > 0 && (static_cast<unsigned char>(text.data()[cut]) & 0xC0u) == 0x80u) --cut;
  return "\"" + std::string(text.data(), cut) + "...\"";  // cut between characters
}

Text trimmed(Text text) noexcept {
  const char* begin = text.begin();
  const char* end = text.end();
  while (begin != end && isSpace(*begin)) ++begin;
  while (begin != end && isSpace(end[-1])) --end;
  return Text(begin, static_cast<std::size_t>(end - begin));
}

}  // namespace formats
}  // namespace gslam
