// The path of what is being printed, for errors.
#ifndef GSLAM_SVAR_FORMATS_SRC_PRINT_PATH_H
#define GSLAM_SVAR_FORMATS_SRC_PRINT_PATH_H

#include <gslam/svar.h>

#include <cstddef>
#include <string>
#include <vector>

#include "source_text.h"

namespace gslam {
namespace formats {

/// An array or object that is printed up to the part before `next`.
struct OpenPart {
  const Svar* elements;         ///< of an array
  const Svar::Member* members;  ///< of an object
  std::size_t size;
  std::size_t next;
};

inline OpenPart openPart(const Svar& value) {
  if (value.type() == SvarType::object) {
    return {nullptr, detail::SvarParts::members(value).data(), value.size(), 0};
  }
  return {detail::SvarParts::elements(value).data(), nullptr, value.size(), 0};
}

inline bool isContainer(const Svar& value) {
  return value.type() == SvarType::array || value.type() == SvarType::object;
}

/// Throws SvarError for a wrong character in a string, or in a name, of the part that is printed.
/// @param format  such as "YAML"
template <class Open>
[[noreturn]] void failPrint(const std::vector<Open>& open, const char* format, bool in_name,
                            const WrongCharacter& wrong) {
  std::string path;
  const std::size_t depth = open.size() - (in_name ? 1 : 0);
  for (std::size_t i = 0; i < depth; ++i) {
    const OpenPart& outer = open[i].part;
    if (i != 0) path += '.';
    path += outer.members != nullptr ? outer.members[outer.next - 1].first
                                     : std::to_string(outer.next - 1);
  }
  std::string found = wrong.found + " at " + std::to_string(wrong.offset);
  if (in_name) found += " of the name of member " + std::to_string(open.back().part.next - 1);
  throw SvarError(path, std::string("cannot be printed as ") + format + ": expected " +
                            wrong.expected + ", found " + found);
}

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_PRINT_PATH_H
