#include "xml_check.h"

#include <algorithm>
#include <cstdint>

namespace gslam {
namespace formats {

using detail::Text;

namespace {

// Production [2] of XML 1.0.
bool isXmlCharacter(std::uint32_t code) {
  return code == 0x9 || code == 0xA || code == 0xD || (code >= 0x20 && code <= 0xD7FF) ||
         (code >= 0xE000 && code <= 0xFFFD) || (code >= 0x10000 && code <= 0x10FFFF);
}

// Of #65 and #x41.
bool isCharacterNumber(Text name) {
  const bool is_hex = name.size() > 1 && name.data()[1] == 'x';
  const char* p = name.begin() + (is_hex ? 2 : 1);
  if (p == name.end()) return false;
  std::uint32_t code = 0;
  for (; p != name.end(); ++p) {
    const int digit = detail::hexDigit(*p);
    if (digit < 0 || (digit > 9 && !is_hex) || code > 0x10FFFF) return false;
    code = code * (is_hex ? 16 : 10) + static_cast<std::uint32_t>(digit);
  }
  return isXmlCharacter(code);
}

bool isReference(Text name) {
  for (const char* const known : {"lt", "gt", "amp", "quot", "apos"}) {
    if (name == Text(known)) return true;
  }
  return !name.empty() && *name.begin() == '#' && isCharacterNumber(name);
}

// Past what begins with one mark and ends with another, where such begins at p; else p.
const char* skipSection(const char* p, const char* end, Text begin_mark, Text end_mark) {
  const bool begins = static_cast<std::size_t>(end - p) >= begin_mark.size() &&
                      std::equal(begin_mark.begin(), begin_mark.end(), p);
  if (!begins) return p;
  const char* const mark =
      std::search(p + begin_mark.size(), end, end_mark.begin(), end_mark.end());
  return mark == end ? end : mark + end_mark.size();
}

const char* skipSections(const char* p, const char* end) {
  const char* past = skipSection(p, end, "<!--", "-->");
  if (past == p) past = skipSection(p, end, "<![CDATA[", "]]>");
  return past != p ? past : skipSection(p, end, "<?", "?>");
}

/// Goes through a text, and tells what is inside of tags and quotes from what is not.
class ReferenceCheck {
 public:
  explicit ReferenceCheck(const SourceText& source)
      : source_(source), p_(source.text().begin()), end_(source.text().end()) {}

  void run() {
    while (p_ != end_) {
      const char c = *p_;
      if (c == '&') {
        checkReference();
      } else if (c == '<') {
        beginMarkup();
      } else {
        follow(c);
        ++p_;
      }
    }
  }

 private:
  void beginMarkup() {
    if (quote_ != 0) fail("expected &lt; inside of quotes, found '<'");
    const char* const past = in_tag_ ? p_ : skipSections(p_, end_);
    const bool is_declaration = end_ - p_ > 1 && p_[1] == '!';  // of a DTD
    in_tag_ = in_tag_ || (past == p_ && !is_declaration);
    p_ = past == p_ ? p_ + 1 : past;
  }

  void follow(char c) {
    if (!in_tag_) return;
    if (quote_ != 0) {
      if (c == quote_) quote_ = 0;
    } else if (c == '"' || c == '\'') {
      quote_ = c;
    } else if (c == '>') {
      in_tag_ = false;
    }
  }

  void checkReference() {
    const char* const name_begin = p_ + 1;
    const char* const limit = name_begin + std::min<std::ptrdiff_t>(end_ - name_begin, 20);
    const char* const semicolon = std::find(name_begin, limit, ';');
    const Text name(name_begin, static_cast<std::size_t>(semicolon - name_begin));
    if (semicolon == limit || !isReference(name)) {
      const std::string found = semicolon != limit ? "&" + name.str() + ";" : "&";
      fail("expected one of &lt; &gt; &amp; &quot; &apos; or the number of a character, found " +
           quoted(found));
    }
    p_ = semicolon + 1;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    source_.fail(static_cast<std::size_t>(p_ - source_.text().begin()), problem);
  }

  const SourceText& source_;
  const char* p_;
  const char* const end_;
  bool in_tag_ = false;
  char quote_ = 0;
};

}  // namespace

void checkXmlReferences(const SourceText& source) {
  ReferenceCheck(source).run();
}

}  // namespace formats
}  // namespace gslam
