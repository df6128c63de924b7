// The YAML files of DBoW2 and DBoW3, as cv::FileStorage writes them.
//
// Source: save() and load() of TemplatedVocabulary.h of https://github.com/dorian3d/DBoW2 and of
// Vocabulary.cpp of https://github.com/rmsalinas/DBow3. No YAML in general: what is in these files
// and how they are laid out is known, so numbers are read where they stand.
//
//     %YAML:1.0
//     ---
//     vocabulary:
//        k: 9
//        L: 3
//        scoringType: 0
//        weightingType: 0
//        nodes:
//           - { nodeId:1, parentId:0, weight:0.,
//               descriptor:"212 176 157 " }
//        words:
//           - { wordId:0, nodeId:1 }
#ifndef GSLAM_VOCABULARY_DETAIL_READ_DBOW_YAML_H
#define GSLAM_VOCABULARY_DETAIL_READ_DBOW_YAML_H

#include <gslam/vocabulary/detail/descriptor_text.h>
#include <gslam/vocabulary/detail/digits.h>
#include <gslam/vocabulary/detail/node_list.h>
#include <gslam/vocabulary/detail/text_cursor.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Walks over spaces, names and values.
class YamlCursor {
 public:
  explicit YamlCursor(const VocabularyText& text) : text_(text), at_(text.begin()) {}

  const char* at() const noexcept { return at_; }
  bool isAtEnd() const noexcept { return at_ == text_.end(); }
  bool beginsLine() const noexcept { return at_ == text_.begin() || at_[-1] == '\n'; }
  [[noreturn]] void failExpected(const std::string& what) const { text_.failExpected(at_, what); }

  void skipSpace() noexcept {
    while (at_ != text_.end() && isSpace(*at_)) ++at_;
  }
  void skipLine() noexcept {
    const char* const newline = VocabularyText::findNewline(at_, text_.end());
    at_ = newline == nullptr ? text_.end() : newline + 1;
  }
  // Whether these characters come; goes behind them.
  bool take(const char* characters) noexcept {
    const std::size_t size = std::strlen(characters);
    if (static_cast<std::size_t>(text_.end() - at_) < size) return false;
    if (std::memcmp(at_, characters, size) != 0) return false;
    at_ += size;
    return true;
  }
  void expect(const char* character) {
    skipSpace();
    if (!take(character)) failExpected("'" + std::string(character) + "'");
  }

  // One of the names and a colon.
  template <std::size_t count>
  std::size_t readName(const char* const (&names)[count], const char* what) {
    skipSpace();
    for (std::size_t i = 0; i < count; ++i) {
      if (!take(names[i])) continue;
      while (at_ != text_.end() && (*at_ == ' ' || *at_ == '\t')) ++at_;
      if (!take(":")) failExpected("':'");
      skipSpace();
      return i;
    }
    failExpected(what);
  }

  std::uint32_t readUnsigned(std::uint32_t largest, std::uint32_t least = 0) {
    std::uint32_t value = 0;
    const char* const after = scanUnsigned(at_, text_.end(), largest, value);
    if (after == nullptr || value < least || !isEndOfValue(after)) {
      failExpected("a number of " + std::to_string(least) + " to " + std::to_string(largest));
    }
    at_ = after;
    return value;
  }

  // .Nan and .Inf are what FileStorage makes of those.
  double readReal() {
    double value = 0;
    const char* after = scanDouble(at_, text_.end(), value);
    if (after == nullptr) after = scanNonFinite(value);
    if (after == nullptr || !isEndOfValue(after)) failExpected("a number");
    at_ = after;
    return value;
  }

  // Between quotes, or without them up to what ends a value.
  TextRange readText() {
    const char* const end = text_.end();
    if (at_ != end && (*at_ == '"' || *at_ == '\'')) {
      const char* const begin = at_ + 1;
      const void* const quote = std::memchr(begin, *at_, static_cast<std::size_t>(end - begin));
      if (quote == nullptr) text_.fail(at_, "this quote is not closed");
      at_ = static_cast<const char*>(quote) + 1;
      return {begin, at_ - 1};
    }
    const char* const begin = at_;
    while (at_ != end && *at_ != ',' && *at_ != '}' && *at_ != '\n') ++at_;
    return {begin, at_};
  }

 private:
  static bool isSpace(char c) noexcept { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  bool isEndOfValue(const char* p) const noexcept {
    return p == text_.end() || isSpace(*p) || *p == ',' || *p == '}';
  }

  const char* scanNonFinite(double& value) noexcept {
    const char* const begin = at_;
    const bool is_negative = take("-");
    const char* after = nullptr;
    if (take(".Inf") || take(".inf") || take(".INF")) {
      value = std::numeric_limits<double>::infinity();
      after = at_;
    } else if (take(".Nan") || take(".NaN") || take(".nan") || take(".NAN")) {
      value = std::numeric_limits<double>::quiet_NaN();
      after = at_;
    }
    if (is_negative) value = -value;
    at_ = begin;
    return after;
  }

  const VocabularyText& text_;
  const char* at_;
};

class DbowYamlReader {
 public:
  explicit DbowYamlReader(const VocabularyText& text)
      : text_(text), cursor_(text), descriptors_(text) {}

  TreeData read() {
    skipHead();
    static const char* const name[] = {"vocabulary"};
    cursor_.readName(name, "'vocabulary'");
    while (!isOver()) readField();
    for (unsigned i = 0; i < 6; ++i) {
      if ((fields_ & 1U << i) == 0)
        cursor_.failExpected("the field " + std::string(fieldNames()[i]));
    }
    dropInnerWeights(data_);
    if (hasPlainIds()) data_.ids.clear();
    return std::move(data_);
  }

 private:
  static const char* const (&fieldNames())[6] {
    static const char* const names[] = {"k", "L", "scoringType", "weightingType", "nodes", "words"};
    return names;
  }

  // Of FileStorage: int.
  static std::uint32_t largestId() noexcept { return 0x7FFFFFFF; }

  void skipHead() {
    cursor_.take("\xEF\xBB\xBF");
    if (cursor_.take("%YAML")) cursor_.skipLine();
    cursor_.skipSpace();
    if (cursor_.take("---")) cursor_.skipLine();
  }

  // A database of DBoW has its own field behind the vocabulary.
  bool isOver() {
    cursor_.skipSpace();
    if (cursor_.isAtEnd()) return true;
    return cursor_.beginsLine() && (cursor_.take("database:") || cursor_.take("..."));
  }

  // Marks a field as read.
  void mark(unsigned& fields, std::size_t field, const char* at) const {
    if ((fields & 1U << field) != 0) text_.fail(at, "this field is there twice");
    fields |= 1U << field;
  }

  void readField() {
    const char* const at = cursor_.at();
    const std::size_t field = cursor_.readName(fieldNames(),
                                               "k, L, scoringType, weightingType, nodes, "
                                               "words or the end of the file");
    mark(fields_, field, at);
    switch (field) {
      case 0:
        data_.branching = cursor_.readUnsigned(kMostChildren, 2);
        break;
      case 1:
        data_.depth = cursor_.readUnsigned(kMostDepth, 1);
        break;
      case 2:
        data_.scoring = static_cast<Scoring>(cursor_.readUnsigned(5));
        break;
      case 3:
        data_.weighting = static_cast<Weighting>(cursor_.readUnsigned(3));
        break;
      case 4:
        readNodes();
        break;
      default:
        readWords(at);
        break;
    }
  }

  void readNodes() {
    nodes_ = cursor_.at();
    for (cursor_.skipSpace(); cursor_.take("-"); cursor_.skipSpace()) readNode();
    if (data_.ids.empty()) cursor_.failExpected("'-' and a node");
    data_.format = descriptors_.format();
    index_of_ =
        indexOfIds(data_, [this](std::size_t i, const std::string& what) { failNode(i, what); });
    data_.words.assign(data_.ids.size(), kNone);
  }

  // There is one brace for each node.
  [[noreturn]] void failNode(std::size_t i, const std::string& what) const {
    const char* brace = nodes_;
    for (std::size_t left = i + 1; left != 0; --left, ++brace) {
      while (*brace != '{') ++brace;
    }
    text_.fail(brace - 1, "the node " + what);
  }

  void readNode() {
    static const char* const names[] = {"nodeId", "parentId", "weight", "descriptor"};
    cursor_.expect("{");
    unsigned fields = 0;
    do {
      cursor_.skipSpace();
      const char* const at = cursor_.at();
      const std::size_t field = cursor_.readName(names, "nodeId, parentId, weight or descriptor");
      mark(fields, field, at);
      if (field == 0) data_.ids.push_back(cursor_.readUnsigned(largestId()));
      if (field == 1) data_.parents.push_back(cursor_.readUnsigned(largestId()));
      if (field == 2) data_.weights.push_back(cursor_.readReal());
      if (field == 3) readDescriptor(cursor_.readText());
      cursor_.skipSpace();
    } while (cursor_.take(","));
    if (fields != 15) cursor_.failExpected("nodeId, parentId, weight and descriptor");
    cursor_.expect("}");
  }

  void readDescriptor(TextRange range) {
    if (descriptor_count_ == 0) {
      first_ = range;
      descriptors_.decide(range);
    } else if (descriptor_count_ == 1 && descriptors_.spelling() == DescriptorSpelling::typed &&
               !descriptors_.looksTyped(range)) {
      data_.descriptors.clear();
      descriptors_.decidePlain(first_);
      descriptors_.read(first_, data_.descriptors);
    }
    if (descriptors_.isOfFloatsAfterAll(range)) descriptors_.becomeFloats(data_.descriptors);
    descriptors_.read(range, data_.descriptors);
    ++descriptor_count_;
  }

  void readWords(const char* at) {
    if ((fields_ & 16) == 0) text_.fail(at, "words come before the nodes");
    for (cursor_.skipSpace(); cursor_.take("-"); cursor_.skipSpace()) readWord();
  }

  void readWord() {
    static const char* const names[] = {"wordId", "nodeId"};
    cursor_.expect("{");
    unsigned fields = 0;
    std::uint32_t values[2] = {0, 0};
    const char* at = cursor_.at();
    do {
      cursor_.skipSpace();
      at = cursor_.at();
      const std::size_t field = cursor_.readName(names, "wordId or nodeId");
      mark(fields, field, at);
      values[field] = cursor_.readUnsigned(largestId());
      cursor_.skipSpace();
    } while (cursor_.take(","));
    if (fields != 3) cursor_.failExpected("wordId and nodeId");
    cursor_.expect("}");
    setWord(values[0], values[1], at);
  }

  void setWord(std::uint32_t word, std::uint32_t id, const char* at) {
    const std::string node = "the node " + std::to_string(id);
    if (id == 0 || id >= index_of_.size()) text_.fail(at, node + " is not there");
    std::uint32_t& known = data_.words[index_of_[id]];
    if (known != kNone) text_.fail(at, node + " has two words");
    if (word >= data_.ids.size()) {
      text_.fail(at, "there are not as many nodes as the word " + std::to_string(word) + " needs");
    }
    known = word;
  }

  bool hasPlainIds() const {
    for (std::size_t i = 0; i < data_.ids.size(); ++i) {
      if (data_.ids[i] != i + 1) return false;
    }
    return true;
  }

  const VocabularyText& text_;
  YamlCursor cursor_;
  DescriptorTextReader descriptors_;
  unsigned fields_ = 0;          // a bit for each that was read
  const char* nodes_ = nullptr;  // where the list begins
  TextRange first_ = {nullptr, nullptr};
  std::size_t descriptor_count_ = 0;
  std::vector<std::uint32_t> index_of_;  // in the list, of each id
  TreeData data_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_READ_DBOW_YAML_H
