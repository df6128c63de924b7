// Descriptors as DBoW2 and DBoW3 write them into YAML.
//
// Sources: FORB::toString(), FSurf64::toString() and FBrief::toString() of DBoW2
// (https://github.com/dorian3d/DBoW2), DescManip::toString() of DBoW3
// (https://github.com/rmsalinas/DBow3).
#ifndef GSLAM_VOCABULARY_DETAIL_DESCRIPTOR_TEXT_H
#define GSLAM_VOCABULARY_DETAIL_DESCRIPTOR_TEXT_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/digits.h>
#include <gslam/vocabulary/detail/node_list.h>
#include <gslam/vocabulary/detail/text_cursor.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

enum class DescriptorSpelling {
  plain,   // "d0 d1 ...": DBoW2
  typed,   // "type count d0 d1 ...": old DBoW3; the type is that of OpenCV
  marked,  // "dbw3 type count d0 d1 ...": newer DBoW3
  bits     // "0110...", the last bit first: FBrief of DBoW2
};

constexpr std::size_t kMarkSize = 4;  // of "dbw3"

// A text between quotes, or up to what ends it.
struct TextRange {
  const char* begin;
  const char* end;
};

// Finds out how descriptors are spelled, and reads them.
class DescriptorTextReader {
 public:
  explicit DescriptorTextReader(const VocabularyText& text) : text_(text) {}

  DescriptorFormat format() const noexcept {
    DescriptorFormat format;
    format.type = is_binary_ ? DescriptorType::binary : DescriptorType::float32;
    format.size = count_;
    return format;
  }
  DescriptorSpelling spelling() const noexcept { return spelling_; }

  // Decides by one descriptor, of which all others must be like.
  void decide(TextRange range) {
    const Words words = wordsOf(range);
    if (isBits(range, words)) {
      spelling_ = DescriptorSpelling::bits;
      return setShape(range, true, words.first_length / 8);
    }
    if (words.is_marked) {
      spelling_ = DescriptorSpelling::marked;
      return decideByType(range, words.numbers[0], words.numbers[1]);
    }
    if (isTyped(words)) {
      spelling_ = DescriptorSpelling::typed;
      return decideByType(range, words.numbers[0], words.numbers[1]);
    }
    decidePlain(range);
  }

  void decidePlain(TextRange range) {
    const Words words = wordsOf(range);
    spelling_ = DescriptorSpelling::plain;
    setShape(range, words.are_bytes, words.count);
  }

  // The bytes of old DBoW3 could be those of DBoW2: "0 32" in front can be chance, but hardly
  // twice.
  bool looksTyped(TextRange range) const { return isTyped(wordsOf(range)); }

  // Plain ones do not say what they are, and floats may begin with integers.
  bool isOfFloatsAfterAll(TextRange range) const noexcept {
    if (spelling_ != DescriptorSpelling::plain || !is_binary_) return false;
    return std::any_of(range.begin, range.end,
                       [](char c) { return c == '.' || c == '-' || c == 'e'; });
  }
  // Makes floats of the bytes that were read.
  void becomeFloats(std::vector<std::uint8_t>& bytes) {
    is_binary_ = false;
    std::vector<std::uint8_t> numbers(bytes.size() * sizeof(float));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const float value = bytes[i];
      std::memcpy(&numbers[i * sizeof value], &value, sizeof value);
    }
    bytes.swap(numbers);
  }

  // Appends one.
  void read(TextRange range, std::vector<std::uint8_t>& bytes) const {
    const char* p = skipSpace(range.begin, range.end);
    if (spelling_ == DescriptorSpelling::bits) return readBits({p, range.end}, bytes);
    if (spelling_ == DescriptorSpelling::marked) p = readMark({p, range.end});
    if (spelling_ != DescriptorSpelling::plain) {
      p = readFixed({p, range.end}, is_binary_ ? kOpenCvBytes : kOpenCvFloats, "the type");
      p = readFixed({p, range.end}, count_, "the length");
    }
    const std::size_t size = bytesOf(format());
    bytes.resize(bytes.size() + size);
    std::uint8_t* const out = &bytes[bytes.size() - size];
    p = is_binary_ ? readBytes({p, range.end}, out) : readFloats({p, range.end}, out);
    if (p != range.end) fail(p, "the end of a descriptor");
  }

 private:
  // What is in a descriptor before one knows what it means.
  struct Words {
    std::size_t count = 0;         // without the mark
    std::size_t first_length = 0;  // bytes of the first
    bool is_marked = false;
    bool are_bytes = true;                  // whether all are numbers up to 255
    std::uint32_t numbers[2] = {256, 256};  // the first two, where they are numbers
  };

  static bool isSpace(char c) noexcept { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  static const char* skipSpace(const char* p, const char* end) noexcept {
    while (p != end && isSpace(*p)) ++p;
    return p;
  }
  [[noreturn]] void fail(const char* at, const std::string& what) const {
    text_.failExpected(at, what);
  }

  static Words wordsOf(TextRange range) {
    Words words;
    for (const char* p = skipSpace(range.begin, range.end); p != range.end;) {
      const char* end = p;
      while (end != range.end && !isSpace(*end)) ++end;
      const std::size_t length = static_cast<std::size_t>(end - p);
      if (words.count == 0 && length == kMarkSize && std::memcmp(p, "dbw3", kMarkSize) == 0) {
        words.is_marked = true;
      } else {
        std::uint32_t number = 0;
        const bool is_number = scanUnsigned(p, end, 100000, number) == end;
        if (words.count == 0) words.first_length = length;
        if (words.count < 2 && is_number) words.numbers[words.count] = number;
        if (!is_number || number > 255) words.are_bytes = false;
        ++words.count;
      }
      p = skipSpace(end, range.end);
    }
    return words;
  }

  static bool isTyped(const Words& words) {
    return !words.is_marked && words.count > 2 && isOpenCvType(words.numbers[0]) &&
           words.numbers[1] == words.count - 2;
  }

  static bool isBits(TextRange range, const Words& words) {
    if (words.is_marked || words.count != 1 || words.first_length % 8 != 0) return false;
    const char* const first = skipSpace(range.begin, range.end);
    for (std::size_t i = 0; i < words.first_length; ++i) {
      if (first[i] != '0' && first[i] != '1') return false;
    }
    return true;
  }

  void decideByType(TextRange range, std::uint32_t type, std::uint32_t count) {
    if (!isOpenCvType(type)) text_.fail(range.begin, "the descriptor " + strangeType(type));
    setShape(range, type == kOpenCvBytes, count);
  }

  void setShape(TextRange range, bool is_binary, std::size_t count) {
    if (count < 1 || count > 4096) {
      text_.fail(range.begin,
                 "the descriptor has " + std::to_string(count) + " numbers, expected 1 to 4096");
    }
    is_binary_ = is_binary;
    count_ = static_cast<std::uint32_t>(count);
  }

  const char* readMark(TextRange range) const {
    const bool is_there = range.end - range.begin > static_cast<std::ptrdiff_t>(kMarkSize) &&
                          std::memcmp(range.begin, "dbw3", kMarkSize) == 0 &&
                          isSpace(range.begin[kMarkSize]);
    if (!is_there) fail(range.begin, "dbw3, as other descriptors have it");
    return skipSpace(range.begin + kMarkSize, range.end);
  }

  // Behind a number: the end, or spaces.
  const char* endNumber(const char* number, const char* p, const char* end,
                        const char* what) const {
    if (p == nullptr || (p != end && !isSpace(*p))) failNumber(number, what);
    if (p != end) ++p;
    return p != end && isSpace(*p) ? skipSpace(p, end) : p;
  }
  [[noreturn]] void failNumber(const char* at, const char* what) const {
    fail(at, std::string(what) + ", of " + std::to_string(count_) + " as in the first descriptor");
  }

  const char* readFixed(TextRange range, std::uint32_t expected, const char* what) const {
    std::uint32_t number = 0;
    const char* const p = scanUnsigned(range.begin, range.end, 100000, number);
    if (p == nullptr || number != expected || (p != range.end && !isSpace(*p))) {
      fail(range.begin,
           std::string(what) + " " + std::to_string(expected) + ", as in the first descriptor");
    }
    return skipSpace(p, range.end);
  }

  const char* readBytes(TextRange range, std::uint8_t* out) const {
    const char* p = range.begin;
    for (std::uint32_t i = 0; i < count_; ++i) {
      p = endNumber(p, scanByte(p, range.end, out[i]), range.end, "a byte of 0 to 255");
    }
    return p;
  }

  const char* readFloats(TextRange range, std::uint8_t* out) const {
    const char* p = range.begin;
    for (std::uint32_t i = 0; i < count_; ++i) {
      float value = 0;
      p = endNumber(p, scanFloat(p, range.end, value), range.end, "a number");
      std::memcpy(out + i * sizeof(value), &value, sizeof(value));
    }
    return p;
  }

  // Bit i is bit i % 8 of byte i / 8.
  void readBits(TextRange range, std::vector<std::uint8_t>& bytes) const {
    const std::size_t bits = std::size_t(count_) * 8;
    const char* p = range.begin;
    bytes.resize(bytes.size() + count_);
    std::uint8_t* const out = &bytes[bytes.size() - count_];
    for (std::size_t i = bits; i-- > 0; ++p) {
      if (p == range.end || (*p != '0' && *p != '1')) failNumber(p, "a bit");
      if (*p == '1') out[i / 8] = static_cast<std::uint8_t>(out[i / 8] | (1U << (i % 8)));
    }
    p = skipSpace(p, range.end);
    if (p != range.end) fail(p, "the end of a descriptor");
  }

  const VocabularyText& text_;
  DescriptorSpelling spelling_ = DescriptorSpelling::plain;
  bool is_binary_ = true;
  std::uint32_t count_ = 0;  // bytes or floats
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_DESCRIPTOR_TEXT_H
