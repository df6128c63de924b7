// A YAML text as yaml-cpp gets it.
#ifndef GSLAM_SVAR_FORMATS_SRC_YAML_TEXT_H
#define GSLAM_SVAR_FORMATS_SRC_YAML_TEXT_H

#include <cstddef>
#include <string>
#include <vector>

#include "source_text.h"

namespace gslam {
namespace formats {

/// The text of a source; where that begins with %YAML:1.0 or %YAML 1.0, as for OpenCV, with a
/// comment in its place and a space after each colon that ends a name. Offsets are those in this
/// text.
class YamlText {
 public:
  explicit YamlText(const SourceText& source);

  const std::string& text() const noexcept { return text_; }

  /// What a node begins with after its tag and anchor; an offset.
  std::size_t skipProperties(std::size_t offset) const;

  /// The character there; a zero byte at the end.
  char at(std::size_t offset) const noexcept {
    return offset < text_.size() ? text_[offset] : '\0';
  }

  bool hasMarkAt(std::size_t offset, const char* mark) const;

  /// Whether only spaces and comments lie between a line `...` (or the beginning) and the offset.
  bool isAfterDocumentEnd(std::size_t offset) const;

  /// Whether as many brackets are closed as are opened from there on, wherever they stand: good
  /// enough to say what is wrong with a text that is.
  bool hasClosedBrackets(std::size_t offset) const;

  [[noreturn]] void fail(std::size_t offset, const std::string& problem) const;
  std::string placeName(std::size_t offset) const;

 private:
  std::size_t sourceOffset(std::size_t offset) const;

  const SourceText& source_;
  std::string text_;
  std::vector<std::size_t> inserted_;  // offsets of the spaces that the source lacks
};

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_YAML_TEXT_H
