// From values to XML text. What xml.h says of printXml() and saveXml() is done here.
#include <gslam/svar_formats/xml.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "base64.h"
#include "plain_scalar.h"
#include "print_path.h"
#include "source_text.h"
#include "xml_marks.h"

namespace gslam {
namespace formats {
namespace {

using detail::SvarParts;
using detail::Text;

bool beginsWith(Text text, Text prefix) {
  return text.size() >= prefix.size() && Text(text.data(), prefix.size()) == prefix;
}

/// Whether an element or attribute may have that name. Those beyond ASCII are not told from what is
/// no letter.
bool isXmlName(Text name) {
  const auto is_letter = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':';
  };
  if (name.empty() || !is_letter(*name.begin()) || beginsWith(name, xml_marks::kPrefix))
    return false;
  return std::all_of(name.begin(), name.end(), [&](char c) {
    return is_letter(c) || detail::isDigit(c) || c == '-' || c == '.';
  });
}

/// Whether the text of a string is read as that string.
bool meansItself(Text text, bool is_trimmed) {
  const bool is_whole = !is_trimmed || trimmed(text).size() == text.size();
  return is_whole && plainType(text) == SvarType::string;
}

bool isPlainScalar(const Svar& value, bool is_trimmed) {
  switch (value.type()) {
    case SvarType::boolean:
    case SvarType::integer:
    case SvarType::real:
      return true;
    case SvarType::string:
      return meansItself(SvarParts::text(value), is_trimmed);
    default:
      return false;
  }
}

bool isAttribute(const Svar::Member& member) {
  const Text name(member.first);
  if (!beginsWith(name, "@") || !isPlainScalar(member.second, false)) return false;
  const Text rest(name.data() + 1, name.size() - 1);
  return isXmlName(rest) && !(rest == Text(xml_marks::kDeclaration));
}

bool isInlineText(const Svar::Member& member) {
  return member.first == xml_marks::kText && isPlainScalar(member.second, true);
}

bool isElement(const Svar::Member& member) {
  return !isAttribute(member) && !isInlineText(member);
}

/// Prints one value. The arrays and objects around the current place lie on a stack: nothing
/// recurses.
class XmlWriter {
 public:
  std::string write(const Svar& root) {
    out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<";
    out_ += xml_marks::kRoot;
    const std::size_t root_name_end = out_.size();
    beginValue(root, xml_marks::kRoot);
    while (!open_.empty()) {
      Open& inner = open_.back();
      if (inner.part.next == inner.part.size) {
        end();
      } else if (inner.part.members == nullptr) {
        const Svar& element = inner.part.elements[inner.part.next++];
        beginElement(inner.item, element);
      } else {
        writeMember(inner.part.members[inner.part.next++]);
      }
    }
    if (has_marks_) {
      out_.insert(root_name_end, std::string(" ") + xml_marks::kDeclaration + "=\"" +
                                     xml_marks::kNamespace + "\"");
    }
    return std::move(out_);
  }

 private:
  struct Open {
    OpenPart part;
    std::string name;  // of the element; empty for the elements of an array that have none around
    std::string item;  // the name of what is inside an array
  };

  void writeMember(const Svar::Member& member) {
    if (!isElement(member)) return;
    const bool is_repeated = member.second.type() == SvarType::array && member.second.size() > 1;
    if (!is_repeated) return beginElement(member.first, member.second);
    open_.push_back({openPart(member.second), "", member.first});
  }

  void beginElement(const std::string& name, const Svar& value) {
    beginLine();
    out_ += '<';
    const bool is_name = isXmlName(name);
    const std::string tag = is_name ? name : xml_marks::kItem;
    out_ += tag;
    if (!is_name) writeMark(xml_marks::kName, name);
    beginValue(value, tag);
  }

  // From after the name of the element on.
  void beginValue(const Svar& value, const std::string& tag) {
    switch (value.type()) {
      case SvarType::array:
        writeMark(xml_marks::kType, "array");
        return beginParts(value, tag);
      case SvarType::object:
        return beginObject(value, tag);
      case SvarType::null:
        out_ += "/>";
        return;
      case SvarType::function:
      case SvarType::native:
        failType(open_, "XML", value);
      case SvarType::binary:
        writeMark(xml_marks::kType, "binary");
        break;
      default:
        if (!isPlainScalar(value, true)) writeMark(xml_marks::kType, "string");
    }
    out_ += '>';
    writeScalar(value, false);
    writeEnd(tag);
  }

  void beginObject(const Svar& value, const std::string& tag) {
    const std::vector<Svar::Member>& members = SvarParts::members(value);
    if (std::all_of(members.begin(), members.end(), isInlineText)) {
      writeMark(xml_marks::kType, "object");
    }
    open_.push_back({openPart(value), tag, xml_marks::kItem});
    for (const Svar::Member& member : members) {
      ++open_.back().part.next;  // for the path of errors
      if (isAttribute(member)) writeAttribute(member);
    }
    const auto text = std::find_if(members.begin(), members.end(), isInlineText);
    const bool has_elements = std::any_of(members.begin(), members.end(), isElement);
    const bool is_empty = !has_elements && text == members.end();
    out_ += is_empty ? "/>" : ">";
    if (text != members.end()) {
      open_.back().part.next = static_cast<std::size_t>(text - members.begin()) + 1;
      writeScalar(text->second, false);
    }
    open_.back().part.next = 0;
    if (has_elements) return;
    if (!is_empty) writeEnd(tag);
    open_.pop_back();
  }

  void beginParts(const Svar& value, const std::string& tag) {
    if (value.size() == 0) {
      out_ += "/>";
      return;
    }
    out_ += '>';
    open_.push_back({openPart(value), tag, xml_marks::kItem});
  }

  void end() {
    const Open inner = std::move(open_.back());
    open_.pop_back();
    if (inner.name.empty()) return;  // only repeated
    beginLine();
    writeEnd(inner.name);
  }

  void writeEnd(const std::string& tag) { out_ += "</" + tag + ">"; }

  void beginLine() {
    std::size_t level = 0;
    for (std::size_t i = 0; i < open_.size() && level < kDeepestIndent; ++i) {
      level += open_[i].name.empty() ? 0 : 1;
    }
    out_ += '\n';
    out_.append(2 * level, ' ');
  }

  void writeMark(const char* name, const std::string& text) {
    has_marks_ = true;
    out_ += ' ';
    out_ += name;
    out_ += "=\"";
    writeText(text, true, Text(name) == Text(xml_marks::kName));
    out_ += '"';
  }

  void writeAttribute(const Svar::Member& member) {
    out_ += ' ';
    out_.append(member.first, 1, std::string::npos);
    out_ += "=\"";
    writeScalar(member.second, true);
    out_ += '"';
  }

  void writeScalar(const Svar& value, bool is_attribute) {
    if (value.type() == SvarType::binary) return appendBase64(value.bytes(), out_);
    if (value.type() != SvarType::string) return appendPlain(value, out_);
    writeText(SvarParts::text(value), is_attribute, false);
  }

  // What a reader of XML would change or take for markup is written as a reference.
  void writeText(Text text, bool is_attribute, bool is_name) {
    const WrongCharacter wrong = findWrongCharacter(text);
    if (!wrong.expected.empty()) failCharacter(open_, "XML", is_name, wrong);
    const bool only_space = !is_attribute && trimmed(text).empty();
    for (const char c : text) {
      const bool is_line_end = c == '\r' || (c == '\n' && is_attribute);
      if (is_line_end || (c == '\t' && is_attribute) || only_space) {
        out_ += "&#" + std::to_string(static_cast<int>(c)) + ";";
      } else if (c == '<') {
        out_ += "&lt;";
      } else if (c == '>') {
        out_ += "&gt;";
      } else if (c == '&') {
        out_ += "&amp;";
      } else if (c == '"' && is_attribute) {
        out_ += "&quot;";
      } else {
        out_ += c;
      }
    }
  }

  static constexpr std::size_t kDeepestIndent = 100;

  std::string out_;
  std::vector<Open> open_;
  bool has_marks_ = false;
};

}  // namespace
}  // namespace formats

inline namespace v1 {

std::string printXml(const Svar& value) {
  return formats::XmlWriter().write(value);
}

void saveXml(const std::string& path, const Svar& value) {
  detail::writeTextFile(path, printXml(value) + "\n");
}

}  // namespace v1
}  // namespace gslam
