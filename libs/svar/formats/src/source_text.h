// A text and its places, for errors.
#ifndef GSLAM_SVAR_FORMATS_SRC_SOURCE_TEXT_H
#define GSLAM_SVAR_FORMATS_SRC_SOURCE_TEXT_H

#include <gslam/svar.h>

#include <cstddef>
#include <string>
#include <utility>

namespace gslam {
namespace formats {

/// Where the characters of a text are wrong, and how; nothing where none is.
struct WrongCharacter {
  std::size_t offset;
  std::string expected;  ///< empty where all are right
  std::string found;
};

/// The first character that is not UTF-8, or that neither YAML nor XML admits: a control character
/// but tab and line ends, U+FFFE or U+FFFF.
WrongCharacter findWrongCharacter(detail::Text text);

/// A text without its byte order mark. It and its name must outlive this.
class SourceText {
 public:
  SourceText(detail::Text text, const std::string& name);

  detail::Text text() const noexcept { return text_; }

  /// Throws ParseError for what findWrongCharacter() finds.
  void checkCharacters() const;

  [[noreturn]] void fail(std::size_t offset, const std::string& problem) const;

  /// "line 3, column 5"
  std::string placeName(std::size_t offset) const;

 private:
  std::pair<std::size_t, std::size_t> place(std::size_t offset) const;

  detail::Text text_;
  const std::string& name_;
};

/// Text in quotes for messages, cut where it is long.
std::string quoted(detail::Text text);

/// The text without the white space of XML at its ends.
detail::Text trimmed(detail::Text text) noexcept;

inline bool isSpace(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_SOURCE_TEXT_H
