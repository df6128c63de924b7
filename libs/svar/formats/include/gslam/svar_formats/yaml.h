#ifndef GSLAM_SVAR_FORMATS_YAML_H
#define GSLAM_SVAR_FORMATS_YAML_H

#include <gslam/svar.h>
#include <gslam/svar_formats/export.h>

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// YAML 1.2: parsing, printing, loading and saving; also the dialect that OpenCV writes.

namespace gslam {
inline namespace v1 {

/// What parseYaml() and its kin accept.
struct YamlOptions {
  /// Let an object have a name twice. The last value counts, at the place of the first; else it is
  /// an error.
  bool allow_duplicate_names = false;
  /// How many arrays and objects may stand inside one another, aliases expanded. Beyond 490 of
  /// them in the text itself nothing can be read.
  std::size_t max_depth = 400;
  /// How many values there may be in a text after its aliases are expanded.
  std::size_t max_values = 10000000;
};

/// The value of a YAML text with one document.
///
/// **Scalars** follow the core schema of YAML 1.2: `null`, `~` and nothing are null; `true` and
/// `false` bools; `12`, `0o17`, `0xFF` int64; `1.5`, `.5`, `5.`, `1e3`, `.inf`, `.nan` doubles
/// (each word also as `True` and `TRUE`; `.Nan`, as OpenCV writes it, too). An integer beyond int64
/// is a double where that is exact, else an error. All else, and what is quoted or a block (`|`,
/// `>`), is a string: `yes`, `on`, `2001-12-14` and `1:30` are. The tags `!!str`, `!!int`,
/// `!!float`,
/// `!!bool` and `!!null` are checked; a tag that is not known changes nothing.
///
/// **Aliases** are independent copies of what their anchor marks. `<<` merges an object, or an
/// array of objects, into the one it stands in: its own names win, then those of the first; merged
/// members come after its own.
///
/// **Names** are scalars, taken as text: `1: a` has the name "1".
///
/// **OpenCV.** After `%YAML:1.0` or `%YAML 1.0` the dialect of its FileStorage is read, where no
/// space needs to stand after a colon. `!!opencv-matrix` and `!!opencv-nd-matrix` anywhere are the
/// object that stands there, {"rows", "cols", "dt", "data"} or {"sizes", "dt", "data"}; that these
/// fit together is checked.
///
/// Text is UTF-8 without control characters but tab and line ends, and checked to be.
/// @param text     need not end in a zero byte
/// @param source   what errors call it, such as the name of the file
/// @param options  limits, and what to accept
/// @throws ParseError with line and column (in bytes, from 1, after the byte order mark), also
///         where there is no document or a second one
GSLAM_SVAR_FORMATS_EXPORT Svar parseYaml(detail::Text text, const std::string& source = "YAML",
                                         const YamlOptions& options = YamlOptions());

/// The values of all documents of a YAML text, by the rules of parseYaml(); none of an empty text.
/// @param text     need not end in a zero byte
/// @param source   what errors call it
/// @param options  limits, each for all documents together, and what to accept
/// @throws ParseError as parseYaml() does
GSLAM_SVAR_FORMATS_EXPORT std::vector<Svar> parseYamlDocuments(
    detail::Text text, const std::string& source = "YAML",
    const YamlOptions& options = YamlOptions());

/// The value of a YAML file with one document, by the rules of parseYaml().
/// @param path     the file
/// @param options  limits, and what to accept
/// @throws FileError when the file cannot be read; ParseError as parseYaml() does
GSLAM_SVAR_FORMATS_EXPORT Svar loadYaml(const std::string& path,
                                        const YamlOptions& options = YamlOptions());

/// The values of all documents of a YAML file.
/// @param path     the file
/// @param options  limits, and what to accept
/// @throws FileError when the file cannot be read; ParseError as parseYaml() does
GSLAM_SVAR_FORMATS_EXPORT std::vector<Svar> loadYamlDocuments(
    const std::string& path, const YamlOptions& options = YamlOptions());

/// YAML text, without a line end after it, that parseYaml() reads as an equal value where it is no
/// deeper than that admits. Each member stands on a line of its own, arrays of numbers and short
/// ones of other scalars are `[1, 2, 3]`. Strings that a reader of YAML 1.1 would take for
/// something else are quoted, too; doubles have a point and as many digits as say which
/// double it is.
/// @param value  what to print; its depth is bounded by memory, not by the stack
/// @throws SvarError with the path of a string that is not UTF-8, a function or a native object
GSLAM_SVAR_FORMATS_EXPORT std::string printYaml(const Svar& value);

/// Writes printYaml() and a line end to a file. The text goes to a new file beside it, which then
/// takes its place: whatever fails, the old file is still whole.
/// @param path   the file; a link there is replaced, not followed
/// @param value  what to write
/// @throws FileError when it cannot be written, and what printYaml() throws
GSLAM_SVAR_FORMATS_EXPORT void saveYaml(const std::string& path, const Svar& value);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_YAML_H
