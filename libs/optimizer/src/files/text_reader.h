#ifndef GSLAM_OPTIMIZER_SRC_FILES_TEXT_READER_H
#define GSLAM_OPTIMIZER_SRC_FILES_TEXT_READER_H

#include <gslam/base/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

// Words and numbers of a text, whatever the locale, with errors that name the place.

namespace gslam {
inline namespace v1 {
namespace detail {

// All of a file. Says so where it is compressed.
// @throws FileError when it cannot be read
std::string readTextFile(const std::string& path);

class TextReader {
 public:
  // @param has_lines  whether numbers end with the line; else a line end is a space like others
  TextReader(const std::string& text, const std::string& name, bool has_lines)
      : begin_(text.data()),
        end_(text.data() + text.size()),
        place_(begin_),
        name_(&name),
        has_lines_(has_lines) {
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) place_ += 3;  // byte order mark of UTF-8
  }

  // Goes to the next word (of this line, where there are lines).
  // @return whether there is one
  bool hasWord() {
    while (place_ != end_ && isSpace(*place_)) ++place_;
    return place_ != end_ && *place_ != '\n';
  }
  // Goes to the next line that is neither empty nor a comment.
  // @return whether there is one
  bool hasLine() {
    while (true) {
      if (hasWord() && *place_ != '#') return true;
      if (!skipLine()) return false;
    }
  }
  // Goes behind the end of this line.
  // @return whether there was an end
  bool skipLine() {
    place_ = lineEnd();
    if (place_ == end_) return false;
    ++place_;
    return true;
  }
  // All is read but white space and comments.
  void expectEnd() {
    if (hasLine()) fail("is too much: the file should end here");
  }
  // This line is read but white space; goes behind its end.
  void expectLineEnd() {
    if (hasWord()) fail("is too much: the line should end here");
    skipLine();
  }

  std::string_view word(const char* what) {
    if (!hasWord()) failEnd(what);
    return std::string_view(place_, static_cast<std::size_t>(wordEnd() - place_));
  }
  // Behind the word that word() gave.
  void skipWord() { place_ = wordEnd(); }
  // What is left of this line, without spaces around it.
  std::string_view restOfLine() {
    hasWord();
    const char* end = lineEnd();
    const char* const begin = place_;
    place_ = end;
    while (end != begin && isSpace(end[-1])) --end;
    return std::string_view(begin, static_cast<std::size_t>(end - begin));
  }

  // A finite number.
  double number(const char* what) {
    if (!hasWord()) failEnd(what);
    double value = 0;
    const char* const first = place_ + (*place_ == '+' ? 1 : 0);
    const auto read = std::from_chars(first, end_, value);
    if (read.ec == std::errc::result_out_of_range && isTiny(first, read.ptr)) {
      value = 0;
    } else if (read.ec != std::errc() || !std::isfinite(value) ||
               (*place_ == '+' && *first == '-')) {
      failWord(what, "a finite number");
    }
    if (read.ptr != end_ && !isAnySpace(*read.ptr)) failWord(what, "a finite number");
    place_ = read.ptr;
    return value;
  }
  std::int64_t integer(const char* what) { return whole<std::int64_t>(what, "a whole number"); }
  // A number of things, or of one thing of `limit`.
  std::uint64_t below(const char* what, std::uint64_t limit) {
    const char* const begin = hasWord() ? place_ : end_;
    const auto value = whole<std::uint64_t>(what, "a whole number, 0 or more");
    if (value < limit) return value;
    place_ = begin;
    fail(std::string("is ") + what + ", expected below " + std::to_string(limit));
  }

  // Bytes that were not read.
  std::size_t rest() const { return static_cast<std::size_t>(end_ - place_); }
  // Where it is, for failAt().
  const char* place() const { return place_; }

  // "name:line:column: word problem"
  [[noreturn]] void fail(const std::string& problem) const { failAt(place_, problem); }
  [[noreturn]] void failAt(const char* place, const std::string& problem) const {
    const char* const stop = std::find_if(place, end_, isAnySpace);
    const std::string found(place,
                            std::min<std::size_t>(40, static_cast<std::size_t>(stop - place)));
    throwAt(place, "'" + printable(found) + "' " + problem);
  }
  // The same without the word.
  [[noreturn]] void throwAt(const char* place, const std::string& problem) const {
    const auto line = 1 + static_cast<std::size_t>(std::count(begin_, place, '\n'));
    const char* start = place;
    while (start != begin_ && start[-1] != '\n') --start;
    throw ParseError(*name_, line, static_cast<std::size_t>(place - start) + 1, problem);
  }
  [[noreturn]] void failEnd(const char* what) const {
    throwAt(place_,
            std::string(place_ == end_ ? "the file" : "the line") + " ends, expected " + what);
  }

  const std::string& name() const { return *name_; }

 private:
  static bool isAnySpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  bool isSpace(char c) const { return isAnySpace(c) && !(has_lines_ && c == '\n'); }
  const char* wordEnd() const { return std::find_if(place_, end_, isAnySpace); }
  const char* lineEnd() const {
    const void* const found = std::memchr(place_, '\n', static_cast<std::size_t>(end_ - place_));
    return found == nullptr ? end_ : static_cast<const char*>(found);
  }
  // Of a number that is no double: whether it is below all of them.
  static bool isTiny(const char* begin, const char* end) {
    const char* const e = std::find_if(begin, end, [](char c) { return c == 'e' || c == 'E'; });
    return e != end && e + 1 != end && e[1] == '-';
  }
  static std::string printable(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    return text;
  }

  template <class Integer>
  Integer whole(const char* what, const char* expected) {
    if (!hasWord()) failEnd(what);
    Integer value = 0;
    const auto read = std::from_chars(place_, end_, value);
    if (read.ec != std::errc() || (read.ptr != end_ && !isAnySpace(*read.ptr))) {
      failWord(what, expected);
    }
    place_ = read.ptr;
    return value;
  }
  [[noreturn]] void failWord(const char* what, const char* expected) const {
    fail(std::string("is ") + what + ", expected " + expected);
  }

  const char* begin_;
  const char* end_;
  const char* place_;
  const std::string* name_;
  bool has_lines_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FILES_TEXT_READER_H
