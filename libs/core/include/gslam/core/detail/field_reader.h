// Goes through lines of numbers.
#ifndef GSLAM_CORE_DETAIL_FIELD_READER_H
#define GSLAM_CORE_DETAIL_FIELD_READER_H

#include <gslam/base/error.h>
#include <gslam/base/platform.h>
#include <gslam/core/detail/stamp_text.h>
#include <gslam/svar/detail/parse_number.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Lines of fields, which blanks, tabs or a comma separate. What follows a # is a comment, lines
/// without fields are passed over, and so are a byte order mark and the \r of \r\n. A comma may
/// stand at the end of a line.
class FieldReader {
 public:
  /// @param text      must outlive it
  /// @param source    what errors call the text
  /// @param expected  what a line should have, for errors
  FieldReader(const std::string& text, const std::string& source, const char* expected)
      : at_(text.data()), end_(at_ + text.size()), source_(source), expected_(expected) {
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) at_ += 3;
    line_begin_ = at_;
    const bool is_wide = text.compare(0, 2, "\xFF\xFE") == 0 || text.compare(0, 2, "\xFE\xFF") == 0;
    if (is_wide) throw ParseError(source, 1, 1, "is text in UTF-16, expected UTF-8 or ASCII");
  }

  /// Goes to the first field of the next line that has one; false where there is none.
  bool nextLine() {
    if (line_ != 0) skipToNextLine();
    line_ += line_ == 0 ? 1 : 0;
    count_ = 0;
    while (at_ != end_) {
      skipBlanks();
      if (!isLineEnd()) return true;
      skipToNextLine();
    }
    return false;
  }

  std::size_t line() const noexcept { return line_; }    ///< number of the line, from 1
  std::size_t count() const noexcept { return count_; }  ///< how many of its fields were read
  bool isLineEnd() const noexcept {                      ///< whether all were
    return at_ == end_ || *at_ == '\n' || *at_ == '#';
  }
  const char* place() const noexcept { return at_; }  ///< the next field

  /// The next field, a finite number.
  double number(const char* name) {
    const char* const field = at_;
    requireField();
    const ParsedNumber parsed = parseNumber(field, end_);
    const bool is_usual = parsed.status != NumberStatus::malformed &&
                          parsed.status != NumberStatus::out_of_range && isFieldEnd(parsed.end);
    if (!is_usual) return unusualNumber(name);
    skipField(parsed.end);
    return parsed.is_integer ? static_cast<double>(parsed.integer) : parsed.real;
  }

  /// The next field, a stamp of the unit that has so many decimals.
  std::int64_t stamp(const char* unit, int places) {
    const char* const field = at_;
    requireField();
    const ParsedStamp parsed = parseStamp(field, end_, places);
    if (parsed.status == StampStatus::out_of_range)
      fail(field, hugeStampText(word(), unit, places));
    if (parsed.status != StampStatus::ok || !isFieldEnd(parsed.end)) {
      fail(field, quotedText(word()) + " is no number, expected a stamp in " + unit);
    }
    if (places == 0 && !parsed.is_exact) {
      fail(field, quotedText(word()) + " is no whole number of nanoseconds; is it in seconds?");
    }
    skipField(parsed.end);
    return parsed.value;
  }

  /// The text of the next field.
  std::string word() const {
    const char* p = at_;
    while (!isFieldEnd(p)) ++p;
    return std::string(at_, p);
  }

  /// Passes over a field, whatever it is.
  void skipWord() {
    const char* p = at_;
    requireField();
    while (!isFieldEnd(p)) ++p;
    skipField(p);
  }

  /// @throws ParseError unless all fields of the line were read
  void endLine() const {
    if (isLineEnd()) return;
    fail(at_, "the line goes on after " + std::to_string(count_) + " numbers with " +
                  quotedText(word()) + ", expected " + expected_);
  }

  [[noreturn]] GSLAM_COLD void fail(const char* at, const std::string& problem) const {
    throw ParseError(source_, line_, static_cast<std::size_t>(at - line_begin_) + 1, problem);
  }

 private:
  bool isFieldEnd(const char* p) const noexcept {
    if (p == end_) return true;
    const char c = *p;
    return c == ' ' || c == '\n' || c == ',' || c == '\t' || c == '\r' || c == '#';
  }
  void skipBlanks() noexcept {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\r')) ++at_;
  }
  // To the field after this one, past at most one comma.
  void skipField(const char* field_end) noexcept {
    at_ = field_end;
    ++count_;
    skipBlanks();
    if (at_ == end_ || *at_ != ',') return;
    ++at_;
    skipBlanks();
  }
  void skipToNextLine() noexcept {
    const void* const found =
        at_ == end_ ? nullptr : std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
    at_ = found == nullptr ? end_ : static_cast<const char*>(found) + 1;
    line_begin_ = at_;
    ++line_;
  }
  void requireField() const {
    if (isLineEnd()) {
      fail(at_,
           "the line ends after " + std::to_string(count_) + " numbers, expected " + expected_);
    }
    if (*at_ != ',') return;
    fail(at_, std::string("nothing stands before this comma, expected ") + expected_);
  }

  // What JSON does not have: +1, .5, 5., 007; and what is no number.
  GSLAM_COLD double unusualNumber(const char* name) {
    const std::string text = word();
    std::string usual;
    std::size_t i = text[0] == '-' || text[0] == '+' ? 1 : 0;
    if (text[0] == '-') usual = "-";
    while (i + 1 < text.size() && text[i] == '0' && isDigit(text[i + 1])) ++i;
    const bool has_digit =
        i < text.size() &&
        (isDigit(text[i]) || (text[i] == '.' && i + 1 < text.size() && isDigit(text[i + 1])));
    if (has_digit && text[i] == '.') usual += '0';
    for (; i < text.size(); ++i) {
      usual += text[i];
      if (text[i] == '.' && (i + 1 == text.size() || !isDigit(text[i + 1]))) usual += '0';
    }
    const char* const usual_end = usual.data() + usual.size();
    const ParsedNumber parsed = parseNumber(usual.data(), usual_end);
    if (parsed.status == NumberStatus::out_of_range) {
      fail(at_, std::string(name) + " is " + quotedText(text) + ", too large for a double");
    }
    if (!has_digit || parsed.status == NumberStatus::malformed || parsed.end != usual_end) {
      fail(at_, std::string(name) + " is " + quotedText(text) + ", expected a finite number");
    }
    skipField(at_ + text.size());
    return parsed.is_integer ? static_cast<double>(parsed.integer) : parsed.real;
  }

  const char* at_;
  const char* end_;
  const char* line_begin_;
  std::size_t line_ = 0;
  std::size_t count_ = 0;
  const std::string& source_;
  const char* expected_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_FIELD_READER_H
