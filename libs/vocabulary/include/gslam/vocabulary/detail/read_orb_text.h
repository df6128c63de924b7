// The text files of ORB-SLAM: ORBvoc.txt.
//
// Source: loadFromTextFile() and saveToTextFile() of the DBoW2 in
// https://github.com/raulmur/ORB_SLAM2. The first line has K, L, the scoring and the weighting.
// Each other line is a node, whose id is the number of the line less one: its parent, 1 for a leaf
// or 0, the bytes of the descriptor, and the weight. Words are numbered as leaves come.
#ifndef GSLAM_VOCABULARY_DETAIL_READ_ORB_TEXT_H
#define GSLAM_VOCABULARY_DETAIL_READ_ORB_TEXT_H

#include <gslam/base/parallel.h>
#include <gslam/vocabulary/detail/digits.h>
#include <gslam/vocabulary/detail/text_cursor.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

class OrbTextReader {
 public:
  // @param piece  bytes that a thread reads at once
  explicit OrbTextReader(const VocabularyText& text, std::size_t piece = std::size_t(1) << 20)
      : text_(text), piece_(piece), end_(text.end()) {
    // The last line may have an end, or not; ORB-SLAM makes a node of what is behind it.
    while (end_ != text.begin() && isSpace(end_[-1])) --end_;
  }

  TreeData read(const ParallelOptions& options = ParallelOptions()) {
    readHeader();
    if (body_ == end_) text_.fail(end_, "ends before the first node");
    data_.format.size = countBytes();
    const std::vector<std::size_t> firsts = firstNodes(options);
    allocate(firsts.back());
    parallelFor(
        0, firsts.size() - 1, [&](std::size_t i) { readPiece(i, firsts); }, options);
    numberWords();
    return std::move(data_);
  }

 private:
  static bool isBlank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r'; }
  static bool isSpace(char c) noexcept { return isBlank(c) || c == '\n'; }
  const char* skipBlanks(const char* p) const noexcept {
    while (p != end_ && isBlank(*p)) ++p;
    return p;
  }

  // At least one; one is what most write.
  const char* skipOneBlank(const char* p, const char* expected) const {
    if (p == end_ || !isBlank(*p)) text_.failExpected(p, expected);
    ++p;
    return p != end_ && isBlank(*p) ? skipBlanks(p) : p;
  }

  // Blanks in front, and a space or the end behind.
  std::uint32_t readNumber(const char*& p, std::uint32_t largest, const char* what,
                           std::uint32_t least = 0) const {
    p = skipBlanks(p);
    std::uint32_t value = 0;
    const char* const after = scanUnsigned(p, end_, largest, value);
    if (after == nullptr || value < least || (after != end_ && !isSpace(*after))) {
      text_.failExpected(
          p, std::string(what) + " of " + std::to_string(least) + " to " + std::to_string(largest));
    }
    p = after;
    return value;
  }

  void endLine(const char*& p) const {
    p = skipBlanks(p);
    if (p == end_) return;
    if (*p != '\n') text_.failExpected(p, "the end of the line");
    ++p;
  }

  void readHeader() {
    const char* p = text_.begin();
    data_.branching = readNumber(p, kMostChildren, "the branching K", 2);
    data_.depth = readNumber(p, kMostDepth, "the depth L", 1);
    data_.scoring = static_cast<Scoring>(readNumber(p, 5, "the number of a scoring"));
    data_.weighting = static_cast<Weighting>(readNumber(p, 3, "the number of a weighting"));
    endLine(p);
    body_ = p;
  }

  // The numbers in the first line of a node, less parent, kind and weight.
  std::uint32_t countBytes() const {
    std::size_t count = 0;
    for (const char* p = skipBlanks(body_); p != end_ && *p != '\n'; p = skipBlanks(p)) {
      ++count;
      while (p != end_ && !isSpace(*p)) ++p;
    }
    if (count < 4 || count > 3 + 4096) {
      text_.fail(body_, "the first node has " + std::to_string(count) +
                            " numbers, expected a parent, 0 or 1, 1 to 4096 bytes and a weight");
    }
    return static_cast<std::uint32_t>(count - 3);
  }

  std::size_t bodySize() const noexcept { return static_cast<std::size_t>(end_ - body_); }
  const char* pieceBegin(std::size_t i) const noexcept {
    return body_ + std::min(bodySize(), i * piece_);
  }

  // How many nodes begin before each piece, and in all.
  std::vector<std::size_t> firstNodes(const ParallelOptions& options) const {
    const std::size_t count = bodySize() / piece_ + 1;
    std::vector<std::size_t> firsts(count + 1);
    parallelFor(
        0, count,
        [&](std::size_t i) {
          // A node begins behind each end of a line, of which one is in front of the body.
          const char* p = pieceBegin(i) - 1;
          const char* const end = std::max(p, pieceBegin(i + 1) - 1);
          while ((p = VocabularyText::findNewline(p, end)) != nullptr) {
            ++p;
            ++firsts[i + 1];
          }
        },
        options);
    for (std::size_t i = 0; i < count; ++i) firsts[i + 1] += firsts[i];
    return firsts;
  }

  // Refuses more lines than the bytes suffice for: so memory is at most 3 times the file.
  void allocate(std::size_t count) {
    const std::size_t least = std::size_t(data_.format.size) * 2 + 5;  // "0 1 2 3 4.5" has no end
    if (count > (bodySize() + 1) / (least + 1)) failShortLine(least);
    if (count > 0x7FFFFFFF) text_.fail(body_, "more than 2^31 - 1 nodes follow");
    data_.parents.resize(count);
    data_.weights.resize(count);
    data_.words.resize(count);
    data_.descriptors.resize(count * data_.format.size);
  }

  [[noreturn]] void failShortLine(std::size_t least) const {
    const char* p = body_;
    for (;;) {
      const char* const newline = VocabularyText::findNewline(p, end_);
      const char* const line_end = newline == nullptr ? end_ : newline;
      if (newline == nullptr || static_cast<std::size_t>(line_end - p) < least) break;
      p = newline + 1;
    }
    text_.fail(p, "the line is too short for a node with a descriptor of " +
                      std::to_string(data_.format.size) + " bytes");
  }

  void readPiece(std::size_t piece, const std::vector<std::size_t>& firsts) {
    std::size_t i = firsts[piece];
    const std::size_t last = firsts[piece + 1];
    if (i == last) return;
    const char* p = pieceBegin(piece) - 1;
    p = VocabularyText::findNewline(p, end_) + 1;  // there is one: it was counted
    for (; i != last; ++i) p = readNode(p, i);
  }

  const char* readNode(const char* p, std::size_t i) {
    const char* const begin = p;
    data_.parents[i] = readNumber(p, 0x7FFFFFFF, "a parent");
    if (data_.parents[i] > i) {
      text_.fail(begin, "the parent " + std::to_string(data_.parents[i]) + " of node " +
                            std::to_string(i + 1) + " does not come before it");
    }
    data_.words[i] = readNumber(p, 1, "the mark of a leaf");
    p = readBytes(p, &data_.descriptors[i * data_.format.size]);
    p = skipOneBlank(p, "a weight");
    const char* const after = scanDouble(p, end_, data_.weights[i]);
    if (after == nullptr || (after != end_ && !isSpace(*after))) {
      text_.failExpected(p, "a weight");
    }
    p = after;
    endLine(p);
    return p;
  }

  const char* readBytes(const char* p, std::uint8_t* bytes) const {
    std::uint8_t* const bytes_end = bytes + data_.format.size;
    for (; bytes != bytes_end; ++bytes) {
      p = skipOneBlank(p, "a byte of 0 to 255");
      const char* const after = scanByte(p, end_, *bytes);
      if (after == nullptr) text_.failExpected(p, "a byte of 0 to 255");
      p = after;
    }
    return p;
  }

  // Marks of leaves become words, if they are right.
  void numberWords() {
    const std::size_t count = data_.parents.size();
    std::vector<bool> has_children(count + 1);
    for (const std::uint32_t parent : data_.parents) has_children[parent] = true;
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_leaf = data_.words[i] != 0;
      if (is_leaf == has_children[i + 1]) failMark(i, is_leaf);
      data_.words[i] = is_leaf ? word++ : kNone;
    }
  }

  [[noreturn]] void failMark(std::size_t i, bool is_leaf) const {
    const std::string node = "node " + std::to_string(i + 1);
    throw ParseError(text_.source(), i + 2, 0,
                     is_leaf ? node + " is marked as a leaf, but has children"
                             : node + " is not marked as a leaf, but has no children");
  }

  const VocabularyText& text_;
  const std::size_t piece_;
  const char* end_;             // without spaces at the end
  const char* body_ = nullptr;  // the first node
  TreeData data_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_READ_ORB_TEXT_H
