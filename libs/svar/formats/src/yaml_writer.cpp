// From values to YAML text. What yaml.h says of printYaml() and saveYaml() is done here.
#include <gslam/svar_formats/yaml.h>

#include <cctype>
#include <cstdio>
#include <vector>

#include "base64.h"
#include "plain_scalar.h"
#include "print_path.h"
#include "source_text.h"

namespace gslam {
namespace formats {
namespace {

using detail::SvarParts;
using detail::Text;

/// Words that YAML 1.1 takes for bool or null. Not "y" and "n": hardly a reader does, and they are
/// names of coordinates.
bool isWordOfYaml(Text text) {
  static const char* const words[] = {"null", "true", "false", "yes", "no", "on", "off"};
  for (const char* const word : words) {
    if (text.size() != Text(word).size()) continue;
    std::size_t i = 0;
    while (i < text.size() && (text.data()[i] | 0x20) == word[i]) ++i;
    if (i == text.size()) return true;
  }
  return false;
}

/// Whether the text means itself without quotes, whoever reads it.
bool isPlain(Text text) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  if (text.empty() || text.size() > 200) return false;
  const char first = *text.begin();
  if (!is_letter(first) && first != '_' && first != '/') return false;
  for (const char c : text) {
    const bool is_safe = is_letter(c) || detail::isDigit(c) || c == '_' || c == '.' || c == '/' ||
                         c == '-' || c == '+' || c == ' ';
    if (!is_safe) return false;
  }
  return text.end()[-1] != ' ' && !isWordOfYaml(text);
}

/// Prints one value. The arrays and objects around the current place lie on a stack: nothing
/// recurses.
class YamlWriter {
 public:
  std::string write(const Svar& root) {
    begin(root, true);
    while (!open_.empty()) {
      if (open_.back().part.next == open_.back().part.size) {
        end();
      } else if (open_.back().is_flow) {
        writeFlowPart();
      } else {
        writeBlockPart();
      }
    }
    return std::move(out_);
  }

 private:
  struct Open {
    OpenPart part;
    bool is_flow;
    bool begins_line;  // its first part stands on the line that is there
    std::size_t indent;
  };

  // A scalar, or the beginning of an array or object.
  // @param may_begin_here  whether a block may begin on this line: after a dash, not after a name
  void begin(const Svar& value, bool may_begin_here) {
    if (!isContainer(value)) return writeScalar(value);
    const bool in_flow = !open_.empty() && open_.back().is_flow;
    if (value.size() == 0) {
      out_ += value.type() == SvarType::array ? "[]" : "{}";
      return;
    }
    if (!in_flow && value.type() == SvarType::array && writeFlowArray(value)) return;
    const bool is_flow = in_flow || open_.size() >= kDeepestBlock;
    const std::size_t indent = open_.empty() ? 0 : open_.back().indent + 2;
    if (is_flow) out_ += value.type() == SvarType::array ? '[' : '{';
    open_.push_back({openPart(value), is_flow, may_begin_here, indent});
  }

  void end() {
    if (open_.back().is_flow) out_ += open_.back().part.members != nullptr ? '}' : ']';
    open_.pop_back();
  }

  void writeBlockPart() {
    Open& inner = open_.back();
    const bool is_first = inner.part.next == 0;
    if (!is_first || !inner.begins_line) beginLine(inner.indent);
    const std::size_t index = inner.part.next++;
    if (inner.part.members == nullptr) {
      const Svar& element = inner.part.elements[index];
      out_ += "- ";
      begin(element, true);
      return;
    }
    const Svar::Member& member = inner.part.members[index];
    writeName(member.first);
    out_ += ':';
    if (beginsBlock(member.second)) return begin(member.second, false);
    out_ += ' ';
    begin(member.second, false);
  }

  void writeFlowPart() {
    Open& inner = open_.back();
    if (inner.part.next != 0) out_ += ", ";
    const std::size_t index = inner.part.next++;
    if (inner.part.members == nullptr) return begin(inner.part.elements[index], false);
    const Svar::Member& member = inner.part.members[index];
    writeName(member.first);
    out_ += ": ";
    begin(member.second, false);
  }

  void beginLine(std::size_t indent) {
    out_ += '\n';
    out_.append(indent, ' ');
  }

  // Whether the value goes on in lines of its own after a name.
  bool beginsBlock(const Svar& value) {
    if (!isContainer(value) || value.size() == 0 || open_.size() >= kDeepestBlock) return false;
    return value.type() == SvarType::object || !isFlowArray(value);
  }

  // --- arrays in brackets: those of numbers, and those of scalars that fit into a line

  static bool isFlowArray(const Svar& array) {
    std::size_t width = 0;
    bool only_numbers = true;
    for (const Svar& element : array) {
      if (isContainer(element)) return false;
      const SvarType type = element.type();
      const bool is_number = type == SvarType::integer || type == SvarType::real;
      only_numbers = only_numbers && is_number;
      const bool has_size = type == SvarType::string || type == SvarType::binary;
      width += has_size ? SvarParts::text(element).size() + 4 : 8;
      if (!only_numbers && width > kWidth) return false;
    }
    return true;
  }

  // Lines are broken where they get long, after a comma.
  bool writeFlowArray(const Svar& array) {
    if (!isFlowArray(array)) return false;
    const std::size_t indent = open_.empty() ? 2 : open_.back().indent + 2;
    open_.push_back({openPart(array), true, false, indent});
    std::size_t line_begin = out_.rfind('\n') + 1;
    out_ += '[';
    for (const Svar& element : array) {
      Open& inner = open_.back();
      if (inner.part.next++ != 0) {
        out_ += ',';
        if (out_.size() - line_begin > kWidth - 20) {
          line_begin = out_.size() + 1;
          beginLine(indent);
        } else {
          out_ += ' ';
        }
      }
      writeScalar(element);
    }
    out_ += ']';
    open_.pop_back();
    return true;
  }

  // --- scalars

  void writeScalar(const Svar& value) {
    switch (value.type()) {
      case SvarType::string:
        return writeString(SvarParts::text(value), false);
      case SvarType::binary:
        out_ += "!!binary \"";
        appendBase64(value.bytes(), out_);
        out_ += '"';
        return;
      case SvarType::function:
      case SvarType::native:
        failType(open_, "YAML", value);
      default:
        appendPlain(value, out_);
    }
  }

  // What is longer than readers look for a colon is marked as a name.
  void writeName(const std::string& name) {
    if (name.size() > kLongestName) {
      out_ += "? ";
      writeString(name, true);
      if (open_.back().is_flow) {
        out_ += ' ';
      } else {
        beginLine(open_.back().indent);
      }
      return;
    }
    writeString(name, true);
  }

  void writeString(Text text, bool is_name) {
    if (isPlain(text)) {
      out_.append(text.data(), text.size());
      return;
    }
    out_ += '"';
    for (const char* p = text.begin(); p != text.end();) {
      const std::size_t length = detail::utf8Length(p, text.end());
      if (length == 0) failCharacter(open_, "YAML", is_name, findWrongUtf8(text, p));
      if (length == 1) {
        writeByte(*p);
      } else {
        writeCharacter(Text(p, length));
      }
      p += length;
    }
    out_ += '"';
  }

  static WrongCharacter findWrongUtf8(Text text, const char* at) {
    const WrongCharacter wrong =
        findWrongCharacter(Text(at, static_cast<std::size_t>(text.end() - at)));
    return {static_cast<std::size_t>(at - text.begin()), wrong.expected, wrong.found};
  }

  void writeByte(char c) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out_ += '\\';
      out_ += c;
    } else if (c == '\n' || c == '\t' || c == '\r') {
      out_ += c == '\n' ? "\\n" : c == '\t' ? "\\t" : "\\r";
    } else if (byte < 0x20 || byte == 0x7F) {
      writeEscape("\\x%02X", byte);
    } else {
      out_ += c;
    }
  }

  // Characters that are not to be seen, or end a line for some, are escaped.
  void writeCharacter(Text character) {
    const auto byte = [&character](std::size_t i) {
      return static_cast<unsigned>(static_cast<unsigned char>(character.data()[i]));
    };
    const unsigned code = character.size() == 2 ? (byte(0) & 0x1F) << 6 | (byte(1) & 0x3F)
                          : character.size() == 3
                              ? (byte(0) & 0xF) << 12 | (byte(1) & 0x3F) << 6 | (byte(2) & 0x3F)
                              : 0x10000;
    const bool is_seen = code >= 0xA1 && code != 0x2028 && code != 0x2029 && code != 0xFEFF &&
                         code != 0xFFFE && code != 0xFFFF;
    if (!is_seen) return writeEscape("\\u%04X", code);
    out_.append(character.data(), character.size());
  }

  void writeEscape(const char* format, unsigned code) {
    char escape[16];
    std::snprintf(escape, sizeof(escape), format, code);
    out_ += escape;
  }

  static constexpr std::size_t kWidth = 100;
  static constexpr std::size_t kDeepestBlock = 40;  // below it all is in brackets, on one line
  static constexpr std::size_t kLongestName = 200;

  std::string out_;
  std::vector<Open> open_;
};

}  // namespace
}  // namespace formats

inline namespace v1 {

std::string printYaml(const Svar& value) {
  return formats::YamlWriter().write(value);
}

void saveYaml(const std::string& path, const Svar& value) {
  detail::writeTextFile(path, printYaml(value) + "\n");
}

}  // namespace v1
}  // namespace gslam
