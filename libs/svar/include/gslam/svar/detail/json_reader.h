// From JSON text to a Svar. What json.h says of parseJson() is done here.
#ifndef GSLAM_SVAR_DETAIL_JSON_READER_H
#define GSLAM_SVAR_DETAIL_JSON_READER_H

#include <gslam/svar/detail/json_lexer.h>
#include <gslam/svar/detail/parse_number.h>
#include <gslam/svar/detail/svar_parts.h>
#include <gslam/svar/json.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// What was read and has no place yet; costs less to keep than a Svar. The type says all of null;
/// of a string, array or object it says that the next one comes here.
struct JsonPart {
  explicit JsonPart(SvarType of) noexcept : type(of), integer(0) {}
  explicit JsonPart(bool value) noexcept : type(SvarType::boolean), integer(value ? 1 : 0) {}
  explicit JsonPart(std::int64_t value) noexcept : type(SvarType::integer), integer(value) {}
  explicit JsonPart(double value) noexcept : type(SvarType::real), real(value) {}

  SvarType type;
  union {
    std::int64_t integer;  // also bool, as 0 or 1
    double real;
  };
};

/// Goes through parts that are doubles: a vector takes a range of them faster than one by one.
class JsonReals {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = double;
  using difference_type = std::ptrdiff_t;
  using pointer = const double*;
  using reference = const double&;

  explicit JsonReals(const JsonPart* part) noexcept : part_(part) {}
  reference operator*() const noexcept { return part_->real; }
  JsonReals& operator++() noexcept {
    ++part_;
    return *this;
  }
  JsonReals operator++(int) noexcept { return JsonReals(part_++); }
  friend bool operator==(JsonReals a, JsonReals b) noexcept { return a.part_ == b.part_; }
  friend bool operator!=(JsonReals a, JsonReals b) noexcept { return a.part_ != b.part_; }

 private:
  const JsonPart* part_;
};

/// Reads one text. What was read lies on a stack; where an array or object ends, a vector of just
/// their number is made of its parts. Nothing recurses.
class JsonReader {
 public:
  JsonReader(Text text, const std::string& source, const JsonOptions& options)
      : lexer_(text, source, options.comments), options_(options) {
    parts_.reserve(32);
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
    const Open all(nullptr, false, 0, 0, 0);
    Cursor cursor = partsOf(all);
    return take(cursor);
  }

 private:
  // An array or object whose end was not read yet.
  struct Open {
    Open(const char* place, bool object, std::size_t part, std::size_t made, std::size_t name)
        : at(place), is_object(object), first_part(part), first_made(made), first_name(name) {}

    const char* at;
    bool is_object;
    std::size_t first_part;  // where its parts begin, and its
    std::size_t first_made;  // those of them that are more than numbers and words, and its
    std::size_t first_name;  // names
  };

  // A value, or the beginning of one: goes on to the first scalar or empty array or object inside.
  void readValue(const char* expected) {
    for (;;) {
      switch (lexer_.peek()) {
        case '[':
          if (!openArray() || readShortNumbers()) return;
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
    const char* const begin = lexer_.at() + 1;
    const bool has_escapes = lexer_.skipString();
    const JsonString string(begin, lexer_.at() - 1, has_escapes);
    made_.push_back(SvarParts::string(textOf(string)));
    parts_.emplace_back(SvarType::string);
  }

  // What a string stands for, until the next one is asked for.
  Text textOf(const JsonString& string) {
    if (!string.has_escapes) return Text(string.begin, string.size());
    decodeEscapes(string, decoded_);
    return decoded_;
  }

  void readNumberOrWord(const char* expected) {
    const char c = lexer_.peek();
    if (isNumberNext()) {
      readNumber(parseNumber(lexer_.at(), lexer_.end()));
    } else if (c == 't' && lexer_.skipWord("true")) {
      parts_.emplace_back(true);
    } else if (c == 'f' && lexer_.skipWord("false")) {
      parts_.emplace_back(false);
    } else if (c == 'n' && lexer_.skipWord("null")) {
      parts_.emplace_back(SvarType::null);
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
    open_.emplace_back(lexer_.at(), is_object, parts_.size(), made_.size(), names_.size());
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
      if (!readShortNumbers()) {
        if (!isNumberNext()) return readValue("a value");
        readNumber(parseAnyNumber(lexer_.at(), lexer_.end()));
      }
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
    const char* const begin = lexer_.at() + 1;
    const bool has_escapes = lexer_.skipString();
    names_.emplace_back(begin, lexer_.at() - 1, has_escapes);
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

  // Goes through the parts of the innermost array or object.
  struct Cursor {
    const JsonPart* part;
    const JsonPart* end;
    Svar* made;
    const JsonString* name;
  };

  Cursor partsOf(const Open& open) noexcept {
    return {parts_.data() + open.first_part, parts_.data() + parts_.size(),
            made_.data() + open.first_made, names_.data() + open.first_name};
  }

  void closeArray() {
    const Open open = open_.back();
    Cursor cursor = partsOf(open);
    std::vector<Svar> elements;
    elements.reserve(static_cast<std::size_t>(cursor.end - cursor.part));
    while (cursor.part != cursor.end) {
      if (cursor.part->type == SvarType::real) {
        const JsonPart* const first = cursor.part;
        cursor.part = pastReals(cursor);
        elements.insert(elements.end(), JsonReals(first), JsonReals(cursor.part));
      } else {
        elements.push_back(take(cursor));
      }
    }
    close(open, SvarParts::array(std::move(elements)));
  }

  static const JsonPart* pastReals(const Cursor& cursor) noexcept {
    const JsonPart* part = cursor.part;
    while (part != cursor.end && part->type == SvarType::real) ++part;
    return part;
  }

  void closeObject() {
    const Open open = open_.back();
    Cursor cursor = partsOf(open);
    const std::size_t count = static_cast<std::size_t>(cursor.end - cursor.part);
    std::vector<Svar::Member> members;
    members.reserve(count);
    while (cursor.part != cursor.end) {
      const Text name = textOf(*cursor.name++);
      members.emplace_back();
      members.back().first.assign(name.data(), name.size());
      members.back().second = take(cursor);
    }
    OrderedMap<Svar> map;
    const OrderedMap<Svar>::Repeat repeat = map.assign(std::move(members));
    if (repeat.first != count) resolveRepeat(map, repeat, open.first_name);
    close(open, SvarParts::object(std::move(map)));
  }

  // Puts an array or object in the place of its parts.
  void close(const Open& open, Svar value) {
    while (parts_.size() > open.first_part) parts_.pop_back();
    while (names_.size() > open.first_name) names_.pop_back();
    while (made_.size() > open.first_made) made_.pop_back();
    parts_.emplace_back(value.type());
    made_.push_back(std::move(value));
    open_.pop_back();
  }

  // The value of the next part.
  static Svar take(Cursor& cursor) {
    const JsonPart& part = *cursor.part++;
    switch (part.type) {
      case SvarType::null:
        break;
      case SvarType::boolean:
        return Svar(part.integer != 0);
      case SvarType::integer:
        return Svar(part.integer);
      case SvarType::real:
        return Svar(part.real);
      default:
        return std::move(*cursor.made++);
    }
    return Svar();
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
    return c == '-' || isDigit(c);
  }

  // Numbers with commas between, which is what long arrays are made of; stops after the last that
  // is short. Keeps the place in a register. False where there is none.
  bool readShortNumbers() {
    const char* const end = lexer_.end();
    const char* after = nullptr;
    for (const char* p = lexer_.at();;) {
      ShortNumber number = {false, 0};
      p = parseShortNumber(p, end, number);
      if (p == nullptr) break;
      if (number.is_integer) {
        parts_.emplace_back(number.integer());
      } else {
        parts_.emplace_back(number.real());
      }
      after = p;
      if (*p != ',') break;
      do {
        ++p;
      } while (p != end && isSpace(*p));
    }
    if (after != nullptr) lexer_.moveTo(after);
    return after != nullptr;
  }

  void readNumber(const ParsedNumber& number) {
    if (number.status != NumberStatus::ok) return readOddNumber(number);
    if (number.is_integer) {
      parts_.emplace_back(number.integer);
    } else {
      parts_.emplace_back(number.real);
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
    parts_.emplace_back(number.real);
    lexer_.moveTo(number.end);
  }

  static std::string shortened(const std::string& digits) {
    return digits.size() <= 40 ? digits : digits.substr(0, 40) + "...";
  }

  JsonLexer lexer_;
  const JsonOptions& options_;
  std::vector<JsonPart> parts_;    // of all open arrays and objects
  std::vector<Svar> made_;         // the strings, arrays and objects among them
  std::vector<JsonString> names_;  // of the members among them
  std::vector<Open> open_;
  std::string decoded_;  // a string whose escapes were replaced
};

}  // namespace detail

inline Svar parseJson(detail::Text text, const std::string& source, const JsonOptions& options) {
  return detail::JsonReader(text, source, options).read();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_JSON_READER_H
