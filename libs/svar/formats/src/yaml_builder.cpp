#include "yaml_builder.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base64.h"
#include "opencv.h"
#include "plain_scalar.h"

namespace gslam {
namespace formats {

using detail::OrderedMap;
using detail::SvarParts;
using detail::Text;
using YAML::Mark;

namespace {

// Marks count bytes; that of something at the end may be beyond it, or none.
std::size_t offsetOf(const Mark& mark) {
  return mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos);
}

// "int" of "tag:yaml.org,2002:int"; empty for tags that are not YAML's own.
std::string typeOfTag(const std::string& tag) {
  static const std::string prefix = "tag:yaml.org,2002:";
  return tag.compare(0, prefix.size(), prefix) == 0 ? tag.substr(prefix.size()) : "";
}

// yaml-cpp makes single bytes of the escapes \N and \_, U+0085 and U+00A0. As the text was UTF-8,
// there are no others that begin no character.
std::string inUtf8(const std::string& value) {
  const char* const end = value.data() + value.size();
  std::string text;
  for (const char* p = value.data(); p != end;) {
    const std::size_t length = detail::utf8Length(p, end);
    if (length == 0) text += '\xC2';
    const char* const next = p + (length == 0 ? 1 : length);
    text.append(p, next);
    p = next;
  }
  return text;
}

bool hasOddEscape(const std::string& value) {
  return value.find_first_of("\x85\xA0") != std::string::npos;
}

bool isScalarType(const std::string& type) {
  return type == "str" || type == "int" || type == "float" || type == "bool" || type == "null" ||
         type == "binary";
}

}  // namespace

// --- documents

void YamlBuilder::OnDocumentStart(const Mark& mark) {
  const std::size_t offset = offsetOf(mark);
  const bool is_marked = text_.hasMarkAt(offset, "---");
  // yaml-cpp takes whatever follows a value for a new document, some of it again and again.
  const bool is_stuck = saw_document_ && offset <= document_;
  if (!is_marked && (is_stuck || (saw_document_ && !text_.isAfterDocumentEnd(offset)))) {
    text_.fail(offset, "expected the end of the document, found something after its value");
  }
  is_no_document_ = text_.hasMarkAt(offset, "...");
  if (one_ && !documents_.empty() && !is_no_document_) {
    text_.fail(offset,
               "expected one document, found a second one; parseYamlDocuments() reads them all");
  }
  saw_document_ = true;
  document_ = offset;
  anchored_.clear();
}

void YamlBuilder::OnDocumentEnd() {
  if (!is_no_document_) documents_.push_back(std::move(values_.back()));
  values_.clear();
}

// --- scalars and aliases

void YamlBuilder::OnNull(const Mark& mark, YAML::anchor_t anchor) {
  const std::size_t offset = offsetOf(mark);
  refuseLoneComma(offset);
  addScalar(offset, Svar(), anchor, expectsName() || anchor != 0 ? nullText(offset) : "");
}

void YamlBuilder::OnScalar(const Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           const std::string& value) {
  if (hasOddEscape(value)) return onScalar(mark, tag, anchor, inUtf8(value));
  onScalar(mark, tag, anchor, value);
}

void YamlBuilder::onScalar(const Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           const std::string& value) {
  const std::size_t offset = offsetOf(mark);
  if (expectsName() && anchor == 0) {
    addName(offset, value, tag == "?" && value == "<<");
    return;
  }
  addScalar(offset, tag == "?" ? plainValue(offset, value) : taggedValue(offset, tag, value),
            anchor, value);
}

void YamlBuilder::OnAlias(const Mark& mark, YAML::anchor_t anchor) {
  const std::size_t offset = offsetOf(mark);
  const bool is_finished = anchor <= anchored_.size() && anchored_[anchor - 1].is_finished;
  if (!is_finished) {
    text_.fail(offset, "expected an alias of a finished value, found one of a value around it");
  }
  const Anchored& anchored = anchored_[anchor - 1];
  if (expectsName()) {
    if (anchored.height != 0)
      text_.fail(offset, "expected a scalar as a name, found an alias of more");
    return addName(offset, anchored.text, false);
  }
  count(offset, anchored.count);
  if (anchored.height > options_.max_depth - open_.size()) {
    text_.fail(offset, "expected at most " + std::to_string(options_.max_depth) +
                           " arrays and objects inside one another, found more by this alias");
  }
  addValue(anchored.value.clone(), anchored.height);
}

void YamlBuilder::addName(std::size_t offset, const std::string& text, bool merges) {
  names_.push_back({text, offset, merges});
  open_.back().expects_name = false;
}

void YamlBuilder::addValue(Svar value, std::size_t height) {
  values_.push_back(std::move(value));
  if (open_.empty()) return;
  Open& inner = open_.back();
  inner.expects_name = inner.is_object;
  if (height > inner.height) inner.height = height;
}

void YamlBuilder::addScalar(std::size_t offset, Svar value, YAML::anchor_t anchor,
                            const std::string& text) {
  Anchored anchored;
  anchored.value = value;
  anchored.text = text;
  anchored.count = 1;
  remember(anchor, anchored);
  if (expectsName()) return addName(offset, text, false);
  count(offset, 1);
  addValue(std::move(value), 0);
}

void YamlBuilder::remember(YAML::anchor_t anchor, const Anchored& anchored) {
  if (anchor == 0) return;
  if (anchored_.size() < anchor) anchored_.resize(anchor);
  anchored_[anchor - 1] = anchored;
  anchored_[anchor - 1].is_finished = true;
}

void YamlBuilder::count(std::size_t offset, std::size_t values) {
  if (values > options_.max_values - count_) {
    text_.fail(offset, "expected at most " + std::to_string(options_.max_values) +
                           " values, found more; aliases count as what they stand for");
  }
  count_ += values;
}

// yaml-cpp takes [1,,2] and [,1] and {,a: 1} for something with a null in it.
void YamlBuilder::refuseLoneComma(std::size_t offset) const {
  if (text_.at(offset) != ',') return;
  const bool is_member_value =
      !open_.empty() && open_.back().is_object && !open_.back().expects_name;
  if (!is_member_value) text_.fail(offset, "expected a value, found ','");
}

// yaml-cpp does not say which of its words a null is.
std::string YamlBuilder::nullText(std::size_t offset) const {
  const std::size_t at = text_.skipProperties(offset);
  for (const char* const word : {"null", "Null", "NULL", "~"}) {
    const std::string found = text_.text().substr(std::min(at, text_.text().size()), 5);
    if (Text(found.data(), std::min(found.size(), Text(word).size())) == Text(word)) return word;
  }
  return "";
}

// --- types

Svar YamlBuilder::plainValue(std::size_t offset, const std::string& text) const {
  PlainScalar scalar = plainScalar(text);
  if (!scalar.problem.empty()) text_.fail(offset, scalar.problem);
  return std::move(scalar.value);
}

Svar YamlBuilder::taggedValue(std::size_t offset, const std::string& tag,
                              const std::string& text) const {
  if (tag == "!") return Svar(text);  // in quotes, or a block
  const std::string type = typeOfTag(tag);
  if (isScalarType(type)) return typedValue(offset, type, text);
  const char first = text_.at(text_.skipProperties(offset));
  const bool is_plain = first != '"' && first != '\'' && first != '|' && first != '>';
  return is_plain ? plainValue(offset, text) : Svar(text);
}

Svar YamlBuilder::typedValue(std::size_t offset, const std::string& type,
                             const std::string& text) const {
  if (type == "str") return Svar(text);
  if (type == "binary") return binaryValue(offset, text);
  const SvarType plain = plainType(text);
  const bool is_number = plain == SvarType::integer || plain == SvarType::real;
  const bool fits = type == "int"     ? plain == SvarType::integer
                    : type == "float" ? is_number
                    : type == "bool"  ? plain == SvarType::boolean
                                      : type == "null" && plain == SvarType::null;
  if (!fits)
    text_.fail(offset, "expected what the tag !!" + type + " stands for, found " + quoted(text));
  if (type != "float") return plainValue(offset, text);
  PlainScalar scalar = plainReal(text);
  if (!scalar.problem.empty()) text_.fail(offset, scalar.problem);
  return std::move(scalar.value);
}

Svar YamlBuilder::binaryValue(std::size_t offset, const std::string& text) const {
  std::vector<std::uint8_t> bytes;
  if (!readBase64(text, bytes))
    text_.fail(offset, "expected base64 after !!binary, found " + quoted(text));
  return Svar::binary(bytes.data(), bytes.size());
}

// --- arrays and objects

void YamlBuilder::OnSequenceStart(const Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                                  YAML::EmitterStyle::value) {
  open(offsetOf(mark), tag, anchor, false);
}

void YamlBuilder::OnMapStart(const Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                             YAML::EmitterStyle::value) {
  open(offsetOf(mark), tag, anchor, true);
}

void YamlBuilder::open(std::size_t offset, const std::string& tag, YAML::anchor_t anchor,
                       bool is_object) {
  const char* const what = is_object ? "an object" : "an array";
  if (expectsName()) failName(offset, what);
  if (open_.size() >= options_.max_depth) {
    text_.fail(offset, "expected at most " + std::to_string(options_.max_depth) +
                           " arrays and objects inside one another, found one more");
  }
  const std::string type = typeOfTag(tag);
  const bool fits = !isScalarType(type) && type != (is_object ? "seq" : "map");
  const bool is_matrix = isOpenCvMatrix(type);
  if (!fits || (is_matrix && !is_object)) {
    text_.fail(offset, "expected what the tag !!" + type + " stands for, found " + what);
  }
  count(offset, 1);
  open_.push_back(
      {offset, tag, anchor, values_.size(), names_.size(), count_ - 1, 0, is_object, is_object});
}

// yaml-cpp also takes a bracket for the beginning of a name where the text ends before it is
// closed.
void YamlBuilder::failName(std::size_t offset, const std::string& what) const {
  const std::size_t at = text_.skipProperties(offset);
  const bool is_bracket = text_.at(at) == '[' || text_.at(at) == '{';
  if (is_bracket && !text_.hasClosedBrackets(at)) {
    text_.fail(at, std::string("expected '") + (text_.at(at) == '[' ? ']' : '}') +
                       "' at the end of " + what + ", found the end of the text");
  }
  text_.fail(offset, "expected a scalar as a name, found " + what);
}

void YamlBuilder::OnSequenceEnd() {
  const auto first = values_.begin() + static_cast<std::ptrdiff_t>(open_.back().first_value);
  std::vector<Svar> elements(std::make_move_iterator(first),
                             std::make_move_iterator(values_.end()));
  close(SvarParts::array(std::move(elements)));
}

void YamlBuilder::OnMapEnd() {
  std::vector<Svar::Member> merged;
  OrderedMap<Svar> map = ownMembers(merged);
  for (Svar::Member& member : merged) {
    if (map.find(member.first) == nullptr) map.insert(member.first, std::move(member.second));
  }
  const Svar object = SvarParts::object(std::move(map));
  const std::string type = typeOfTag(open_.back().tag);
  if (isOpenCvMatrix(type)) checkMatrix(type, object);
  close(object);
}

void YamlBuilder::close(Svar value) {
  const Open done = std::move(open_.back());
  open_.pop_back();
  values_.resize(done.first_value);
  names_.resize(done.first_name);
  if (done.anchor != 0) {
    Anchored anchored;
    anchored.value = value;
    anchored.count = count_ - done.count_before;
    anchored.height = done.height + 1;
    remember(done.anchor, anchored);
  }
  addValue(std::move(value), done.height + 1);
}

// The members that the object names itself; what it merges is appended to `merged`.
OrderedMap<Svar> YamlBuilder::ownMembers(std::vector<Svar::Member>& merged) {
  const Open& inner = open_.back();
  const std::size_t size = values_.size() - inner.first_value;
  std::vector<Svar::Member> members;
  std::vector<std::size_t> offsets;
  members.reserve(size);
  offsets.reserve(size);
  std::size_t merge_offset = 0;
  bool has_merge = false;
  for (std::size_t i = 0; i < size; ++i) {
    const Name& name = names_[inner.first_name + i];
    Svar& value = values_[inner.first_value + i];
    if (!name.merges) {
      members.emplace_back(name.text, std::move(value));
      offsets.push_back(name.offset);
      continue;
    }
    if (has_merge && !options_.allow_duplicate_names) {
      text_.fail(name.offset,
                 "expected each name once, found \"<<\" also at " + text_.placeName(merge_offset));
    }
    has_merge = true;
    merge_offset = name.offset;
    addMerged(name.offset, value, merged);
  }
  OrderedMap<Svar> map;
  const OrderedMap<Svar>::Repeat repeat = map.assign(std::move(members));
  if (repeat.first != offsets.size()) resolveRepeat(map, repeat, offsets);
  return map;
}

void YamlBuilder::addMerged(std::size_t offset, const Svar& value,
                            std::vector<Svar::Member>& merged) {
  const auto add = [&](const Svar& object) {
    if (object.type() != SvarType::object) {
      text_.fail(offset, "expected an object, or an array of objects, to merge by \"<<\"");
    }
    const std::vector<Svar::Member>& members = SvarParts::members(object);
    merged.insert(merged.end(), members.begin(), members.end());
  };
  if (value.type() != SvarType::array) return add(value);
  for (const Svar& element : value) add(element);
}

void YamlBuilder::resolveRepeat(OrderedMap<Svar>& map, OrderedMap<Svar>::Repeat repeat,
                                const std::vector<std::size_t>& offsets) const {
  if (options_.allow_duplicate_names) return map.keepLast();
  text_.fail(offsets[repeat.second], "expected each name once, found " +
                                         quoted(map.members()[repeat.first].first) + " also at " +
                                         text_.placeName(offsets[repeat.first]));
}

void YamlBuilder::checkMatrix(const std::string& type, const Svar& matrix) const {
  const MatrixProblem wrong = checkOpenCvMatrix(type, matrix);
  if (wrong.problem.empty()) return;
  std::size_t offset = open_.back().offset;
  for (std::size_t i = open_.back().first_name; i < names_.size(); ++i) {
    if (names_[i].text == wrong.member) offset = names_[i].offset;
  }
  text_.fail(offset, wrong.problem);
}

}  // namespace formats
}  // namespace gslam
