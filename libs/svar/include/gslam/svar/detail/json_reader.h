// From JSON text to a Svar. What json.h says of parseJson() is done here.
#ifndef GSLAM_SVAR_DETAIL_JSON_READER_H
#define GSLAM_SVAR_DETAIL_JSON_READER_H

#include <gslam/svar/detail/json_lexer.h>
#include <gslam/svar/detail/parse_number.h>
#include <gslam/svar/detail/svar_parts.h>
#include <gslam/svar/json.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Reads one text. Finished values lie on a stack; where an array or object ends, its parts are
/// moved from there into a vector of just their number. Nothing recurses.
class JsonReader {
 public:
  JsonReader(Text text, const std::string& source, const JsonOptions& options)
      : lexer_(text, source, options.comments), options_(options) {
    values_.reserve(32);
  }

  Svar read() {
    if (lexer_.isEmpty()) lexer_.fail(lexer_.at(), "the text is empty, expected a value");
    lexer_.skipSpace();
    readValue("a value");
    while (!open_.empty()) {
      lexer_.skipSpace();
      if (open_.back().is_object) {
        continueObject();
      } else {
        continueArray();
      }
    }
    lexer_.skipSpace();
    if (!lexer_.isAtEnd()) lexer_.failExpected(lexer_.at(), "the end of the text");
    return std::move(values_.back());
  }

 private:
  // An array or object whose end was not read yet.
  struct Open {
    const char* at;
    std::size_t first_value;  // index of its first value on the stack
    bool is_object;
  };

  // A value, or the beginning of one: goes on to the first scalar or empty array or object inside.
  void readValue(const char* expected) {
    for (;;) {
      switch (lexer_.peek()) {
        case '[':
          if (!openArray()) return;
          expected = "a value or ']'";
          break;
        case '{':
          if (!openObject()) return;
          expected = "a value";
          break;
        case '"':
          return readString();
        default:
          return readNumberOrWord(expected);
      }
    }
  }

  void readString() {
    const JsonString string = lexer_.skipString();
    if (string.has_escapes) {
      values_.emplace_back(decodeEscapes(string));
    } else {
      values_.push_back(SvarParts::string(Text(string.begin, string.size())));
    }
  }

  void readNumberOrWord(const char* expected) {
    const char c = lexer_.peek();
    if (isNumberNext()) {
      readNumber();
    } else if (c == 't' && lexer_.skipWord("true")) {
      values_.emplace_back(true);
    } else if (c == 'f' && lexer_.skipWord("false")) {
      values_.emplace_back(false);
    } else if (c == 'n' && lexer_.skipWord("null")) {
      values_.emplace_back();
    } else {
      lexer_.failExpected(lexer_.at(), expected);
    }
  }

  // --- arrays and objects: what opens them says whether there is something inside

  void open(bool is_object) {
    if (open_.size() >= options_.max_depth) {
      lexer_.fail(lexer_.at(), "expected at most " + std::to_string(options_.max_depth) +
                                   " arrays and objects inside one another, found one more");
    }
    open_.push_back({lexer_.at(), values_.size(), is_object});
    lexer_.moveTo(lexer_.at() + 1);
    lexer_.skipSpace();
  }

  bool openArray() {
    open(false);
    if (!lexer_.skip(']')) return true;
    closeArray();
    return false;
  }

  bool openObject() {
    open(true);
    if (!lexer_.skip('}')) {
      readName("a name in quotes or '}'");
      return true;
    }
    closeObject();
    return false;
  }

  void continueArray() {
    while (lexer_.skip(',')) {
      lexer_.skipSpace();
      if (!isNumberNext()) return readValue("a value");
      readNumber();
      lexer_.skipSpace();
    }
    if (lexer_.skip(']')) {
      closeArray();
    } else {
      failOpen("',' or ']'", "array");
    }
  }

  void continueObject() {
    if (lexer_.skip(',')) {
      lexer_.skipSpace();
      readName("a name in quotes");
      readValue("a value");
    } else if (lexer_.skip('}')) {
      closeObject();
    } else {
      failOpen("',' or '}'", "object");
    }
  }

  void readName(const char* expected) {
    if (lexer_.peek() != '"') lexer_.failExpected(lexer_.at(), expected);
    names_.push_back(lexer_.skipString());
    lexer_.skipSpace();
    if (!lexer_.skip(':')) lexer_.failExpected(lexer_.at(), "':' after the name");
    lexer_.skipSpace();
  }

  [[noreturn]] void failOpen(const char* expected, const char* what) const {
    if (!lexer_.isAtEnd()) lexer_.failExpected(lexer_.at(), expected);
    lexer_.fail(lexer_.at(), std::string("expected ") + expected +
                                 ", found the end of the text; the " + what + " begins at " +
                                 lexer_.placeName(open_.back().at));
  }

  void closeArray() {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(open_.back().first_value);
    open_.pop_back();
    std::vector<Svar> elements(std::make_move_iterator(first),
                               std::make_move_iterator(values_.end()));
    values_.erase(first, values_.end());
    values_.push_back(SvarParts::array(std::move(elements)));
  }

  void closeObject() {
    const std::size_t first_value = open_.back().first_value;
    const std::size_t count = values_.size() - first_value;
    const std::size_t first_name = names_.size() - count;
    std::vector<Svar::Member> members;
    members.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const JsonString& name = names_[first_name + i];
      members.emplace_back(
          name.has_escapes ? decodeEscapes(name) : std::string(name.begin, name.size()),
          std::move(values_[first_value + i]));
    }
    OrderedMap<Svar> map;
    const OrderedMap<Svar>::Repeat repeat = map.assign(std::move(members));
    if (repeat.first != count) resolveRepeat(map, repeat, first_name);
    open_.pop_back();
    names_.resize(first_name);
    values_.resize(first_value);
    values_.push_back(SvarParts::object(std::move(map)));
  }

  void resolveRepeat(OrderedMap<Svar>& map, OrderedMap<Svar>::Repeat repeat,
                     std::size_t first_name) const {
    if (options_.allow_duplicate_names) return map.keepLast();
    const JsonString& earlier = names_[first_name + repeat.first];
    const JsonString& later = names_[first_name + repeat.second];
    const char* end = later.end;
    while (end - later.begin > 40 || (static_cast<unsigned char>(*end) & 0xC0u) == 0x80) --end;
    lexer_.fail(later.begin - 1, "expected each name once, found \"" +
                                     std::string(later.begin, end) + "\" also at " +
                                     lexer_.placeName(earlier.begin - 1));
  }

  // --- numbers

  bool isNumberNext() const noexcept {
    const char c = lexer_.peek();
    return c == '-' || (c >= '0' && c <= '9');
  }

  void readNumber() {
    const char* const begin = lexer_.at();
    const ParsedNumber number = parseNumber(begin, lexer_.end());
    if (number.status != NumberStatus::ok) return readOddNumber(number);
    if (number.is_integer) {
      values_.emplace_back(number.integer);
    } else {
      values_.emplace_back(number.real);
    }
    lexer_.moveTo(number.end);
  }

  void readOddNumber(const ParsedNumber& number) {
    const char* const begin = lexer_.at();
    const std::string found = ", found " + shortened(std::string(begin, number.end));
    switch (number.status) {
      case NumberStatus::malformed:
        lexer_.failExpected(number.end, "a digit");
      case NumberStatus::out_of_range:
        lexer_.fail(begin, "expected a number that a double can hold" + found);
      case NumberStatus::integer_rounded:
        lexer_.fail(begin, "expected an integer that int64 or double can hold exactly" + found);
      case NumberStatus::ok:
      case NumberStatus::integer_as_double:
        break;
    }
    values_.emplace_back(number.real);
    lexer_.moveTo(number.end);
  }

  static std::string shortened(const std::string& digits) {
    return digits.size() <= 40 ? digits : digits.substr(0, 40) + "...";
  }

  JsonLexer lexer_;
  const JsonOptions& options_;
  std::vector<Svar> values_;
  std::vector<JsonString> names_;  // of the members of all open objects
  std::vector<Open> open_;
};

}  // namespace detail

inline Svar parseJson(detail::Text text, const std::string& source, const JsonOptions& options) {
  return detail::JsonReader(text, source, options).read();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_JSON_READER_H
