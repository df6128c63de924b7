#include "yaml_text.h"

#include <algorithm>

namespace gslam {
namespace formats {

using detail::Text;

namespace {

bool isOfOpenCvName(char c) {
  const char lower = static_cast<char>(c | 0x20);
  return (lower >= 'a' && lower <= 'z') || detail::isDigit(c) || c == '_' || c == '-' || c == '.';
}

/// Goes through the text of OpenCV's FileStorage, and puts a space after each name's colon.
class OpenCvSpacer {
 public:
  OpenCvSpacer(Text text, std::string& out, std::vector<std::size_t>& inserted)
      : p_(text.begin()), end_(text.end()), out_(out), inserted_(inserted) {}

  void run() {
    bool at_line_begin = true;
    while (p_ != end_) {
      if (at_line_begin && flow_.empty()) copyName();
      at_line_begin = false;
      if (p_ == end_) return;
      const char c = *p_;
      if (c == '"' || c == '\'') {
        copyQuoted();
      } else if (c == '#' && isSpace(out_.back())) {
        copyComment();
      } else {
        copy();
        at_line_begin = c == '\n';
        follow(c);
      }
    }
  }

 private:
  void copy() { out_ += *p_++; }

  void copySpaces() {
    while (p_ != end_ && isSpace(*p_)) copy();
  }

  void follow(char c) {
    if (c == '[' || c == '{') flow_ += c;
    if ((c == ']' || c == '}') && !flow_.empty()) flow_.pop_back();
    if ((c == '{' || c == ',') && !flow_.empty() && flow_.back() == '{') {
      copySpaces();
      copyName();
    }
  }

  // Indentation and dashes, a name and its colon, where these stand here.
  void copyName() {
    while (p_ != end_ && (*p_ == ' ' || (*p_ == '-' && end_ - p_ > 1 && p_[1] == ' '))) copy();
    const char* colon = p_;
    while (colon != end_ && isOfOpenCvName(*colon)) ++colon;
    if (colon == p_ || end_ - colon < 2 || *colon != ':') return;
    out_.append(p_, colon + 1);
    p_ = colon + 1;
    if (isSpace(*p_) || *p_ == '/' || *p_ == '\\') return;  // there is one, or it is an address
    inserted_.push_back(out_.size());
    out_ += ' ';
  }

  void copyQuoted() {
    const char quote = *p_;
    copy();
    while (p_ != end_ && *p_ != quote) {
      if (*p_ == '\\' && quote == '"' && end_ - p_ > 1) copy();
      copy();
    }
    if (p_ != end_) copy();
  }

  void copyComment() {
    while (p_ != end_ && *p_ != '\n') copy();
  }

  const char* p_;
  const char* const end_;
  std::string& out_;
  std::vector<std::size_t>& inserted_;
  std::string flow_;  // the brackets that are open
};

// YAML itself has a space there, and nobody but OpenCV says that it is version 1.0.
bool isOpenCv(Text text) {
  for (const Text head : {Text("%YAML:"), Text("%YAML 1.0")}) {
    if (text.size() > head.size() && Text(text.data(), head.size()) == head) return true;
  }
  return false;
}

}  // namespace

YamlText::YamlText(const SourceText& source) : source_(source) {
  source.checkCharacters();
  const Text text = source.text();
  if (!isOpenCv(text)) {
    text_ = text.str();
    return;
  }
  text_.reserve(text.size());
  text_ = "#";
  OpenCvSpacer(Text(text.data() + 1, text.size() - 1), text_, inserted_).run();
}

std::size_t YamlText::skipProperties(std::size_t offset) const {
  for (;;) {
    const char c = at(offset);
    const bool is_comment = c == '#';
    if (!isSpace(c) && c != '!' && c != '&' && !is_comment) return offset;
    if (isSpace(c)) {
      ++offset;
    } else if (is_comment) {
      while (at(offset) != '\n' && offset < text_.size()) ++offset;
    } else {
      while (!isSpace(at(offset)) && offset < text_.size()) ++offset;
    }
  }
}

bool YamlText::hasMarkAt(std::size_t offset, const char* mark) const {
  if (text_.compare(std::min(offset, text_.size()), 3, mark) != 0) return false;
  return offset + 3 == text_.size() || isSpace(at(offset + 3));
}

bool YamlText::isAfterDocumentEnd(std::size_t offset) const {
  for (std::size_t end = std::min(offset, text_.size());;) {
    const std::size_t begin = end == 0 ? 0 : text_.rfind('\n', end - 1) + 1;
    if (hasMarkAt(begin, "...")) return true;
    const Text line = trimmed(Text(text_.data() + begin, end - begin));
    if (!line.empty() && *line.begin() != '#') return false;
    if (begin == 0) return true;
    end = begin - 1;
  }
}

bool YamlText::hasClosedBrackets(std::size_t offset) const {
  std::size_t depth = 0;
  for (; offset < text_.size(); ++offset) {
    const char c = text_[offset];
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth-- <= 1) return true;
  }
  return depth == 0;
}

void YamlText::fail(std::size_t offset, const std::string& problem) const {
  source_.fail(sourceOffset(offset), problem);
}

std::string YamlText::placeName(std::size_t offset) const {
  return source_.placeName(sourceOffset(offset));
}

std::size_t YamlText::sourceOffset(std::size_t offset) const {
  const auto after = std::upper_bound(inserted_.begin(), inserted_.end(), offset);
  return offset - static_cast<std::size_t>(after - inserted_.begin());
}

}  // namespace formats
}  // namespace gslam
