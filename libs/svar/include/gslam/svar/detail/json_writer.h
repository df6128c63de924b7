// From a Svar to JSON text. What json.h says of printJson() is done here.
#ifndef GSLAM_SVAR_DETAIL_JSON_WRITER_H
#define GSLAM_SVAR_DETAIL_JSON_WRITER_H

#include <gslam/base/error.h>
#include <gslam/svar/detail/json_text.h>
#include <gslam/svar/detail/print_number.h>
#include <gslam/svar/detail/svar_parts.h>
#include <gslam/svar/json.h>

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Text that grows at its end, with room that may be written without asking for each byte.
class JsonBuffer {
 public:
  JsonBuffer() : text_(1024, '\0'), at_(&text_[0]) {}

  /// Where `size` more bytes may be written; advance() says how many were.
  char* room(std::size_t size) {
    if (static_cast<std::size_t>(&text_[0] + text_.size() - at_) < size) grow(size);
    return at_;
  }
  void advance(std::size_t size) noexcept { at_ += size; }

  void add(char c) {
    *room(1) = c;
    ++at_;
  }
  void add(const char* begin, std::size_t size) {
    std::memcpy(room(size), begin, size);
    at_ += size;
  }
  void addSpaces(std::size_t count) {
    std::memset(room(count), ' ', count);
    at_ += count;
  }
  std::string take() {
    text_.resize(static_cast<std::size_t>(at_ - text_.data()));
    return std::move(text_);
  }

 private:
  void grow(std::size_t size) {
    const std::size_t used = static_cast<std::size_t>(at_ - text_.data());
    text_.resize(2 * text_.size() + size);
    at_ = &text_[0] + used;
  }

  std::string text_;
  char* at_;
};

/// Prints one value. The arrays and objects around the current place lie on a stack: nothing
/// recurses.
class JsonWriter {
 public:
  explicit JsonWriter(std::size_t indent) : indent_(indent) {}

  std::string write(const Svar& root) {
    begin(root);
    while (!open_.empty()) {
      Open& inner = open_.back();
      if (inner.next == inner.size) {
        end();
      } else if (inner.is_object) {
        const Svar::Member& member = inner.members[inner.next];
        beginPart(inner);
        writeString(member.first);
        out_.add(": ", indent_ != 0 ? 2 : 1);
        begin(member.second);
      } else {
        const Svar& element = inner.elements[inner.next];
        beginPart(inner);
        begin(element);
      }
    }
    return out_.take();
  }

 private:
  // An array or object that is printed up to the part before `next`.
  struct Open {
    const Svar* elements;         // of an array
    const Svar::Member* members;  // of an object
    bool is_object;
    std::size_t size;
    std::size_t next;
  };

  // A scalar, or the beginning of an array or object.
  void begin(const Svar& value) {
    switch (value.type()) {
      case SvarType::null:
        return out_.add("null", 4);
      case SvarType::boolean:
        return SvarParts::boolean(value) ? out_.add("true", 4) : out_.add("false", 5);
      case SvarType::integer:
        return out_.advance(printInt64(SvarParts::integer(value), out_.room(kNumberSize)));
      case SvarType::real:
        return writeReal(SvarParts::real(value));
      case SvarType::string:
        return writeString(SvarParts::text(value));
      case SvarType::binary:
      case SvarType::function:
      case SvarType::native:
        fail(path(open_.size()), "a value that JSON has", SvarParts::describe(value));
      case SvarType::array:
        out_.add('[');
        open_.push_back({SvarParts::elements(value).data(), nullptr, false, value.size(), 0});
        return;
      case SvarType::object:
        out_.add('{');
        open_.push_back({nullptr, SvarParts::members(value).data(), true, value.size(), 0});
        return;
    }
  }

  void beginPart(Open& inner) {
    if (inner.next != 0) out_.add(',');
    ++inner.next;
    if (indent_ != 0) beginLine();
  }

  void end() {
    const Open inner = open_.back();
    open_.pop_back();
    if (indent_ != 0 && inner.size != 0) beginLine();
    out_.add(inner.is_object ? '}' : ']');
  }

  void beginLine() {
    const std::size_t levels = open_.size() < kDeepestIndent ? open_.size() : kDeepestIndent;
    out_.add('\n');
    out_.addSpaces(levels * indent_);
  }

  void writeReal(double value) {
    if (!(value - value == 0)) {
      fail(path(open_.size()), "a finite number",
           value != value ? "NaN"
           : value > 0    ? "infinity"
                          : "-infinity");
    }
    out_.advance(printDouble(value, out_.room(kNumberSize)));
  }

  // Most strings are plain: what is, is copied while it is looked at.
  void writeString(Text text) {
    const char* const begin = text.begin();
    const char* const end = text.end();
    char* const out = out_.room(text.size() + 2);
    out[0] = '"';
    const char* const p = copyPlain(begin, end, out + 1);
    out_.advance(static_cast<std::size_t>(p - begin) + 1);
    if (p != end) writeRest(p, text);
    out_.add('"');
  }

  void writeRest(const char* p, Text text) {
    const char* const end = text.end();
    while (p != end) {
      p = writeSpecial(p, text);
      const char* const plain = p;
      p = skipPlain(p, end);
      out_.add(plain, static_cast<std::size_t>(p - plain));
    }
  }

  const char* writeSpecial(const char* p, Text text) {
    const char* const end = text.end();
    const char* const begin = p;
    while (p != end && static_cast<unsigned char>(*p) >= 0x80) {
      const std::size_t length = utf8Length(p, end);
      if (length == 0) failUtf8(text, p);
      p += length;
    }
    if (p == begin)
      writeEscape(*p++);
    else
      out_.add(begin, static_cast<std::size_t>(p - begin));
    return p;
  }

  void writeEscape(char c) {
    static const char digits[] = "0123456789abcdef";
    const unsigned char byte = static_cast<unsigned char>(c);
    char escape[6] = {'\\', 'u', '0', '0', digits[byte >> 4], digits[byte & 0xF]};
    static const char letters[] = "btn\0fr";  // for 0x08 to 0x0D
    const bool is_short = byte >= 0x20 || (byte >= 0x08 && byte <= 0x0D && byte != 0x0B);
    if (is_short) escape[1] = byte >= 0x20 ? c : letters[byte - 0x08];
    out_.add(escape, is_short ? 2 : 6);
  }

  // --- errors

  // The path of the part at that depth; all of them is the path of what is being printed.
  std::string path(std::size_t depth) const {
    std::string names;
    for (std::size_t i = 0; i < depth; ++i) {
      const Open& outer = open_[i];
      if (i != 0) names += '.';
      names +=
          outer.is_object ? outer.members[outer.next - 1].first : std::to_string(outer.next - 1);
    }
    return names;
  }

  [[noreturn]] static void fail(const std::string& path, const std::string& expected,
                                const std::string& found) {
    throw SvarError(path, "cannot be printed as JSON: expected " + expected + ", found " + found);
  }

  [[noreturn]] void failUtf8(Text text, const char* at) const {
    char byte[8];
    std::snprintf(byte, sizeof(byte), "0x%02X", static_cast<unsigned char>(*at));
    const std::string found =
        std::string("byte ") + byte + " at " + std::to_string(at - text.data());
    const std::size_t depth = open_.size();
    if (depth != 0 && open_.back().is_object) {
      const std::size_t index = open_.back().next - 1;
      if (open_.back().members[index].first.data() == text.data()) {
        fail(path(depth - 1), "UTF-8", found + " of the name of member " + std::to_string(index));
      }
    }
    fail(path(depth), "UTF-8", found);
  }

  static constexpr std::size_t kNumberSize = 40;
  static constexpr std::size_t kDeepestIndent = 100;

  JsonBuffer out_;
  std::size_t indent_;
  std::vector<Open> open_;
};

}  // namespace detail

inline std::string printJson(const Svar& value, int indent) {
  if (indent < 0 || indent > 16) {
    throw ArgumentError("indent", "is " + std::to_string(indent) + ", expected 0 to 16 spaces");
  }
  return detail::JsonWriter(static_cast<std::size_t>(indent)).write(value);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_JSON_WRITER_H
