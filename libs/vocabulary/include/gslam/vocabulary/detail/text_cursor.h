// A place in the text of a vocabulary, and how to say where it is.
#ifndef GSLAM_VOCABULARY_DETAIL_TEXT_CURSOR_H
#define GSLAM_VOCABULARY_DETAIL_TEXT_CURSOR_H

#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

// The whole text, which others own; lines are counted when somebody asks.
class VocabularyText {
 public:
  VocabularyText(const std::uint8_t* data, std::size_t size, const std::string& source)
      : begin_(reinterpret_cast<const char*>(data)), end_(begin_ + size), source_(&source) {}

  const char* begin() const noexcept { return begin_; }
  const char* end() const noexcept { return end_; }
  const std::string& source() const noexcept { return *source_; }

  // "expected WHAT, got ..." at that place.
  [[noreturn]] void failExpected(const char* at, const std::string& what) const {
    fail(at, "expected " + what + ", got " + shown(at));
  }

  [[noreturn]] void fail(const char* at, const std::string& problem) const {
    std::size_t line = 1;
    const char* line_begin = begin_;
    while (const char* const newline = findNewline(line_begin, at)) {
      line_begin = newline + 1;
      ++line;
    }
    throw ParseError(*source_, line, static_cast<std::size_t>(at - line_begin) + 1, problem);
  }

  // Null where there is none.
  static const char* findNewline(const char* from, const char* to) noexcept {
    if (from == to) return nullptr;
    return static_cast<const char*>(std::memchr(from, '\n', static_cast<std::size_t>(to - from)));
  }

 private:
  // What stands there, up to the next space: never much, and nothing that harms a terminal.
  std::string shown(const char* at) const {
    if (at == end_) return "the end of the file";
    if (*at == '\n' || *at == '\r') return "the end of the line";
    std::string word;
    for (; at != end_ && word.size() < 20 && *at != ' ' && *at != '\n' && *at != '\r'; ++at) {
      word += *at >= ' ' && *at <= '~' ? *at : '?';
    }
    return word.empty() ? "a space" : "'" + word + "'";
  }

  const char* begin_;
  const char* end_;
  const std::string* source_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_TEXT_CURSOR_H
