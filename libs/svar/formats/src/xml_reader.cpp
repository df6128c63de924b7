// From XML text to values. What xml.h says of parseXml() and loadXml() is done here.
#include <gslam/svar_formats/xml.h>

#include <cstring>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "base64.h"
#include "opencv.h"
#include "plain_scalar.h"
#include "source_text.h"
#include "xml_check.h"
#include "xml_marks.h"

namespace gslam {
namespace formats {
namespace {

using detail::OrderedMap;
using detail::SvarParts;
using detail::Text;
using Members = std::vector<Svar::Member>;

bool hasPrefix(const char* text, const char* prefix) {
  return std::strncmp(text, prefix, std::strlen(prefix)) == 0;
}

std::size_t offsetOf(const pugi::xml_node& node) {
  const std::ptrdiff_t offset = node.offset_debug();
  return offset < 0 ? 0 : static_cast<std::size_t>(offset);
}

bool isText(const pugi::xml_node& node) {
  return node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata;
}

/// An object of these members; those of the same name become an array at the place of the first.
Svar objectOf(Members members) {
  OrderedMap<Svar> map;
  const std::size_t size = members.size();
  if (map.assign(std::move(members)).first == size) return SvarParts::object(std::move(map));
  OrderedMap<std::vector<Svar>> groups;
  for (Svar::Member& member : map.members()) {
    std::vector<Svar>* group = groups.find(member.first);
    if (group == nullptr) group = &groups.insert(member.first, {});
    group->push_back(std::move(member.second));
  }
  Members grouped;
  for (auto& group : groups.members()) {
    const bool is_one = group.second.size() == 1;
    Svar value =
        is_one ? std::move(group.second.front()) : SvarParts::array(std::move(group.second));
    grouped.emplace_back(std::move(group.first), std::move(value));
  }
  map.assign(std::move(grouped));
  return SvarParts::object(std::move(map));
}

/// Makes the value of a document. The elements around the current one lie on a stack: nothing
/// recurses.
class XmlReader {
 public:
  XmlReader(const SourceText& source, const XmlOptions& options)
      : source_(source), options_(options) {}

  Svar read(const pugi::xml_node& root) {
    is_opencv_ = std::strcmp(root.name(), "opencv_storage") == 0;
    has_marks_ =
        std::strcmp(root.attribute(xml_marks::kDeclaration).value(), xml_marks::kNamespace) == 0;
    open(root, true);
    for (;;) {
      const pugi::xml_node child = open_.back().next;
      if (child.empty()) {
        Svar::Member done = close();
        if (open_.empty()) return std::move(done.second);
        open_.back().members.push_back(std::move(done));
        continue;
      }
      open_.back().next = child.next_sibling();
      if (child.type() == pugi::node_element) {
        open(child, false);
      } else if (isText(child)) {
        open_.back().text += child.value();
      }
    }
  }

 private:
  // An element whose end was not reached yet.
  struct Open {
    pugi::xml_node node;
    pugi::xml_node next;
    std::string name;
    std::string type;     // of the mark svar:type, or OpenCV's type_id
    std::string text;     // so far
    Members members;      // attributes, then elements
    std::size_t element;  // the first of them that is an element
  };

  void open(const pugi::xml_node& node, bool is_root) {
    if (open_.size() >= options_.max_depth) {
      source_.fail(offsetOf(node), "expected at most " + std::to_string(options_.max_depth) +
                                       " elements inside one another, found one more");
    }
    open_.push_back({node, node.first_child(), node.name(), "", "", {}, 0});
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      if (!readMark(attribute, is_root)) addAttribute(attribute);
    }
    open_.back().element = open_.back().members.size();
    if (open_.back().element > 1) checkAttributes(open_.back());
  }

  void checkAttributes(const Open& element) const {
    OrderedMap<Svar> map;
    const OrderedMap<Svar>::Repeat repeat = map.assign(element.members);
    if (repeat.first == element.members.size()) return;
    const std::string& name = element.members[repeat.second].first;
    source_.fail(offsetOf(element.node),
                 "expected each attribute once, found " + quoted(name.substr(1)) + " twice");
  }

  void addAttribute(const pugi::xml_attribute& attribute) {
    open_.back().members.emplace_back(std::string("@") + attribute.name(),
                                      scalar(attribute.value()));
  }

  // Whether the attribute says how to read the element.
  bool readMark(const pugi::xml_attribute& attribute, bool is_root) {
    Open& inner = open_.back();
    const char* const name = attribute.name();
    if (is_opencv_ && std::strcmp(name, "type_id") == 0) {
      inner.type = attribute.value();
      return true;
    }
    if (!has_marks_) return false;
    if (is_root && std::strcmp(name, xml_marks::kDeclaration) == 0) return true;
    if (std::strcmp(name, xml_marks::kName) == 0) {
      inner.name = attribute.value();
      return true;
    }
    if (!hasPrefix(name, xml_marks::kPrefix)) return false;
    const Text type(attribute.value());
    const bool is_known = type == Text("string") || type == Text("binary") ||
                          type == Text("array") || type == Text("object");
    if (std::strcmp(name, xml_marks::kType) != 0 || !is_known) {
      source_.fail(
          offsetOf(inner.node),
          "expected the mark svar:type=\"string\", \"binary\", \"array\" or \"object\", found " +
              std::string(name) + "=" + quoted(type));
    }
    inner.type = attribute.value();
    return true;
  }

  Svar::Member close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    Svar value = is_opencv_ ? openCvValueOf(done) : valueOf(done);
    return {std::move(done.name), std::move(value)};
  }

  Svar valueOf(Open& done) const {
    if (done.type == "string" || done.type == "binary") {
      if (!done.members.empty()) fail(done, "text only in what is marked as a " + done.type);
      return done.type == "string" ? SvarParts::string(done.text) : binaryOf(done);
    }
    const Text text = trimmed(done.text);
    if (done.type == "array") {
      if (done.element != 0 || !text.empty())
        fail(done, "elements only in what is marked as an array");
      return arrayOf(done.members);
    }
    if (done.members.empty() && done.type.empty()) return scalarOf(done, text);
    if (!text.empty()) done.members.emplace_back(xml_marks::kText, scalarOf(done, text));
    return objectOf(std::move(done.members));
  }

  Svar binaryOf(const Open& element) const {
    std::vector<std::uint8_t> bytes;
    if (!readBase64(element.text, bytes)) {
      source_.fail(offsetOf(element.node), "expected base64, found " + quoted(element.text));
    }
    return Svar::binary(bytes.data(), bytes.size());
  }

  static Svar arrayOf(Members& members) {
    std::vector<Svar> elements;
    elements.reserve(members.size());
    for (Svar::Member& member : members) elements.push_back(std::move(member.second));
    return SvarParts::array(std::move(elements));
  }

  [[noreturn]] void fail(const Open& element, const std::string& expected) const {
    source_.fail(offsetOf(element.node), "expected " + expected + ", found more");
  }

  // --- scalars

  Svar scalar(Text text) const { return scalarOf(open_.back(), text); }

  Svar scalarOf(const Open& element, Text text) const {
    PlainScalar read = plainScalar(text);
    if (!read.problem.empty()) source_.fail(offsetOf(element.node), read.problem);
    return std::move(read.value);
  }

  // --- OpenCV's FileStorage

  Svar openCvValueOf(Open& done) const {
    const bool is_matrix = isOpenCvMatrix(done.type);
    if (done.members.empty() && !is_matrix) return openCvText(done);
    bool is_array = done.element == 0;
    for (const Svar::Member& member : done.members) is_array = is_array && member.first == "_";
    if (is_array && !done.members.empty()) return arrayOf(done.members);
    if (is_matrix) makeArrays(done.members);
    const Svar value = objectOf(std::move(done.members));
    if (!is_matrix) return value;
    const MatrixProblem wrong = checkOpenCvMatrix(done.type, value);
    if (wrong.problem.empty()) return value;
    const pugi::xml_node place = done.node.child(wrong.member.c_str());
    source_.fail(offsetOf(place.empty() ? done.node : place), wrong.problem);
  }

  // One number is data, too.
  static void makeArrays(Members& members) {
    for (Svar::Member& member : members) {
      const bool is_list = member.first == "data" || member.first == "sizes";
      if (!is_list || member.second.type() == SvarType::array) continue;
      member.second = member.second.isNull() ? Svar::array() : Svar::array({member.second});
    }
  }

  // Words with white space between them.
  Svar openCvText(const Open& done) const {
    std::vector<Svar> words;
    for (Text rest = trimmed(done.text); !rest.empty(); rest = trimmed(rest)) {
      const char* end = rest.begin();
      if (*end == '"') {
        words.emplace_back(unquote(done, end, rest.end()));
      } else {
        while (end != rest.end() && !isSpace(*end)) ++end;
        const Text word(rest.begin(), static_cast<std::size_t>(end - rest.begin()));
        words.push_back(scalarOf(done, word));
      }
      rest = Text(end, static_cast<std::size_t>(rest.end() - end));
    }
    if (words.size() > 1) return SvarParts::array(std::move(words));
    return words.empty() ? Svar() : words.front();
  }

  // From one quote past the other.
  std::string unquote(const Open& done, const char*& p, const char* end) const {
    std::string text;
    for (++p; p != end && *p != '"'; ++p) {
      const bool is_escape = *p == '\\' && end - p > 1;
      if (is_escape) ++p;
      text += is_escape ? (*p == 'n' ? '\n' : *p == 't' ? '\t' : *p == 'r' ? '\r' : *p) : *p;
    }
    if (p == end) source_.fail(offsetOf(done.node), "expected '\"' at the end of this string");
    ++p;
    return text;
  }

  const SourceText& source_;
  const XmlOptions& options_;
  std::vector<Open> open_;
  bool is_opencv_ = false;
  bool has_marks_ = false;
};

const char* expectedBy(pugi::xml_parse_status status) {
  switch (status) {
    case pugi::status_bad_pi:
      return "an XML declaration or a processing instruction, and its end";
    case pugi::status_bad_comment:
      return "a comment and its end";
    case pugi::status_bad_cdata:
      return "a CDATA section and its end";
    case pugi::status_bad_doctype:
      return "a DOCTYPE and its end";
    case pugi::status_bad_start_element:
      return "the name of an element, and '>' or '/>' after it";
    case pugi::status_bad_attribute:
      return "an attribute with its value in quotes";
    case pugi::status_bad_end_element:
      return "the name of the element and '>' at its end";
    case pugi::status_end_element_mismatch:
      return "the end of the element that was begun last";
    default:
      return "an element";
  }
}

/// The one element of a document that was parsed as a fragment, so that nothing was dropped.
pugi::xml_node rootOf(const pugi::xml_document& document, const SourceText& source) {
  pugi::xml_node root;
  for (const pugi::xml_node& node : document.children()) {
    if (isText(node)) {
      std::size_t offset = offsetOf(node);
      while (offset < source.text().size() && isSpace(source.text().data()[offset])) ++offset;
      source.fail(offset, "expected an element, found text outside of it");
    }
    if (node.type() != pugi::node_element) continue;
    if (!root.empty()) source.fail(offsetOf(node), "expected one root element, found a second one");
    root = node;
  }
  if (root.empty()) source.fail(source.text().size(), "expected an element, found nothing");
  return root;
}

}  // namespace
}  // namespace formats

inline namespace v1 {

Svar parseXml(detail::Text text, const std::string& source, const XmlOptions& options) {
  const formats::SourceText xml(text, source);
  xml.checkCharacters();
  formats::checkXmlReferences(xml);
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(xml.text().data(), xml.text().size(),
                           pugi::parse_default | pugi::parse_fragment, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result && result.status != pugi::status_no_document_element) {
    const std::size_t offset = static_cast<std::size_t>(result.offset);
    const bool is_at_end = offset + 1 >= xml.text().size();
    xml.fail(offset, std::string("expected ") + formats::expectedBy(result.status) + ", found " +
                         (is_at_end ? "the end of the text" : "something else"));
  }
  return formats::XmlReader(xml, options).read(formats::rootOf(document, xml));
}

Svar loadXml(const std::string& path, const XmlOptions& options) {
  return parseXml(detail::readFile(path), path, options);
}

}  // namespace v1
}  // namespace gslam
