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

/// The path of the part that is printed; of one around it where `depth` says so.
template <class Open>
std::string pathOf(const std::vector<Open>& open, std::size_t depth) {
  std::string path;
  for (std::size_t i = 0; i < depth; ++i) {
    const OpenPart& outer = open[i].part;
    if (i != 0) path += '.';
    path += outer.members != nullptr ? outer.members[outer.next - 1].first
                                     : std::to_string(outer.next - 1);
  }
  return path;
}

[[noreturn]] inline void failPrint(const std::string& path, const char* format,
                                   const std::string& expected, const std::string& found) {
  throw SvarError(path, std::string("cannot be printed as ") + format + ": expected " + expected +
                            ", found " + found);
}

/// For a wrong character in a string, or in a name.
/// @param format  such as "YAML"
template <class Open>
[[noreturn]] void failCharacter(const std::vector<Open>& open, const char* format, bool in_name,
                                const WrongCharacter& wrong) {
  std::string found = wrong.found + " at " + std::to_string(wrong.offset);
  if (in_name) found += " of the name of member " + std::to_string(open.back().part.next - 1);
  failPrint(pathOf(open, open.size() - (in_name ? 1 : 0)), format, wrong.expected, found);
}

/// For a function or native object.
template <class Open>
[[noreturn]] void failType(const std::vector<Open>& open, const char* format, const Svar& value) {
  failPrint(pathOf(open, open.size()), format, std::string("a value that ") + format + " has",
            detail::SvarParts::describe(value));
}

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_PRINT_PATH_H
