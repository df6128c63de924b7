// The words of JSON and their places: spaces, strings, what errors say.
#ifndef GSLAM_SVAR_DETAIL_JSON_LEXER_H
#define GSLAM_SVAR_DETAIL_JSON_LEXER_H

#include <gslam/base/error.h>
#include <gslam/svar/detail/json_text.h>
#include <gslam/svar/text.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

/// A place in a JSON text. Goes on from word to word, and throws ParseError with line and column.
class JsonLexer {
 public:
  /// Begins after a byte order mark. The text and its name must outlive this.
  JsonLexer(Text text, const std::string& source, bool comments)
      : begin_(text.begin()), end_(text.end()), source_(source), comments_(comments) {
    if (text.size() >= 3 && Text(begin_, 3) == Text("\xEF\xBB\xBF", 3)) begin_ += 3;
    at_ = begin_;
  }

  const char* at() const noexcept { return at_; }
  const char* end() const noexcept { return end_; }
  bool isAtEnd() const noexcept { return at_ == end_; }
  bool isEmpty() const noexcept { return begin_ == end_; }
  /// The next byte; a zero byte at the end.
  char peek() const noexcept { return at_ != end_ ? *at_ : '\0'; }
  void moveTo(const char* at) noexcept { at_ = at; }

  bool skip(char c) noexcept {
    const bool there = at_ != end_ && *at_ == c;
    if (there) ++at_;
    return there;
  }

  /// Spaces, line ends and, where they are accepted, comments.
  void skipSpace() {
    while (at_ != end_ && isSpace(*at_)) ++at_;
    if (comments_ && at_ != end_ && *at_ == '/') skipComments();
  }

  /// Skips `word` where just that stands here: "nul" and "nullify" are not "null".
  bool skipWord(Text word) noexcept {
    const bool there =
        static_cast<std::size_t>(end_ - at_) >= word.size() && Text(at_, word.size()) == word;
    if (!there || isOfWord(at_ + word.size())) return false;
    at_ += word.size();
    return true;
  }

  /// Goes past a string, from the quote at which it begins to behind that at which it ends, and
  /// checks all of it. Says whether there are escapes in it.
  bool skipString() {
    bool has_escapes = false;
    const char* p = skipPlain(at_ + 1, end_);
    while (p == end_ || *p != '"') {
      if (p == end_) {
        fail(at_, "expected '\"' at the end of this string, found the end of the text");
      }
      has_escapes = has_escapes || *p == '\\';
      p = skipPlain(*p == '\\' ? pastEscape(p) : pastUtf8(p), end_);
    }
    at_ = p + 1;
    return has_escapes;
  }

  /// Line and column, both from 1.
  std::pair<std::size_t, std::size_t> place(const char* at) const noexcept {
    std::size_t line = 1;
    const char* line_begin = begin_;
    for (const char* p = begin_; p != at; ++p) {
      if (*p != '\n') continue;
      ++line;
      line_begin = p + 1;
    }
    return {line, static_cast<std::size_t>(at - line_begin) + 1};
  }
  /// "line 3, column 5"
  std::string placeName(const char* at) const {
    const std::pair<std::size_t, std::size_t> found = place(at);
    return "line " + std::to_string(found.first) + ", column " + std::to_string(found.second);
  }

  [[noreturn]] void fail(const char* at, const std::string& problem) const {
    const std::pair<std::size_t, std::size_t> found = place(at);
    throw ParseError(source_, found.first, found.second, problem);
  }

  [[noreturn]] void failExpected(const char* at, const std::string& expected) const {
    fail(at, "expected " + expected + ", found " + describe(at));
  }

 private:
  bool isOfWord(const char* p) const noexcept {
    if (p == end_) return false;
    const char lower = static_cast<char>(*p | 0x20);
    return (*p >= '0' && *p <= '9') || (lower >= 'a' && lower <= 'z') || *p == '_' || *p == '+' ||
           *p == '-' || *p == '.';
  }

  // What stands there, for messages: a word, a character or a byte.
  std::string describe(const char* p) const {
    if (p == end_) return "the end of the text";
    const char* word_end = p;
    while (isOfWord(word_end) && word_end - p < 20) ++word_end;
    const bool after_zero = p != begin_ && p[-1] == '0' && *p >= '0' && *p <= '9';
    if (after_zero) return "'" + std::string(1, *p) + "' (no number begins with a 0 and a digit)";
    if (word_end != p) return "\"" + std::string(p, word_end) + "\"";
    if (*p == '/' && !comments_) return "'/' (comments are accepted on request only)";
    if (*p >= 0x20 && *p < 0x7F) return "'" + std::string(1, *p) + "'";
    return describeByte(*p);
  }

  static std::string describeByte(char c) {
    char text[16];
    std::snprintf(text, sizeof(text), "byte 0x%02X", static_cast<unsigned char>(c));
    return text;
  }

  void skipComments() {
    while (at_ != end_ && *at_ == '/') {
      const char second = end_ - at_ > 1 ? at_[1] : '\0';
      if (second == '/') {
        while (at_ != end_ && *at_ != '\n') ++at_;
      } else if (second == '*') {
        skipBlockComment();
      } else {
        failExpected(at_ + 1, "\"//\" or \"/*\"");
      }
      while (at_ != end_ && isSpace(*at_)) ++at_;
    }
  }

  void skipBlockComment() {
    for (const char* p = at_ + 2; end_ - p > 1; ++p) {
      if (p[0] != '*' || p[1] != '/') continue;
      at_ = p + 2;
      return;
    }
    fail(at_, "expected \"*/\" at the end of this comment, found the end of the text");
  }

  const char* pastUtf8(const char* p) const {
    do {
      if (static_cast<unsigned char>(*p) < 0x20) {
        fail(p, "expected an escape such as \\n or \\u0000, found a control character, " +
                    describeByte(*p));
      }
      const std::size_t length = utf8Length(p, end_);
      if (length == 0) fail(p, "expected UTF-8, found " + describeByte(*p) + invalidUtf8(p));
      p += length;
    } while (p != end_ && static_cast<unsigned char>(*p) >= 0x80);
    return p;
  }

  // The bytes after the first one of what is no UTF-8.
  std::string invalidUtf8(const char* p) const {
    std::string text;
    for (const char* next = p + 1; next != end_ && next - p < 4; ++next) {
      if ((static_cast<unsigned char>(*next) & 0xC0u) != 0x80) break;
      text += " " + describeByte(*next).substr(5);
    }
    return text;
  }

  const char* pastEscape(const char* backslash) const {
    const char* const letter = backslash + 1;
    if (letter != end_ && *letter == 'u') return pastUnicodeEscape(backslash);
    if (letter == end_ || unescape(*letter) == 0) {
      failExpected(letter, "one of \" \\ / b f n r t u after a backslash");
    }
    return letter + 1;
  }

  const char* pastUnicodeEscape(const char* backslash) const {
    const std::uint32_t code = hexAfter(backslash);
    const char* const next = backslash + 6;
    if (isLowSurrogate(code)) {
      fail(backslash, "expected a character, found the second half of a surrogate pair, " +
                          std::string(backslash, next));
    }
    if (!isHighSurrogate(code)) return next;
    const bool another = end_ - next > 1 && next[0] == '\\' && next[1] == 'u';
    if (!another || !isLowSurrogate(hexAfter(next))) {
      fail(backslash,
           "expected a second half, \\uDC00 to \\uDFFF, after the first half of a "
           "surrogate pair, " +
               std::string(backslash, next));
    }
    return next + 6;
  }

  std::uint32_t hexAfter(const char* backslash) const {
    const std::uint32_t code = fourHexDigits(backslash + 2, end_);
    if (code > 0xFFFF) fail(backslash, "expected four hexadecimal digits after \\u");
    return code;
  }

  const char* begin_;
  const char* end_;
  const char* at_;
  const std::string& source_;
  bool comments_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_JSON_LEXER_H
