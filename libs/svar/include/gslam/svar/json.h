#ifndef GSLAM_SVAR_JSON_H
#define GSLAM_SVAR_JSON_H

#include <gslam/svar/svar.h>

#include <cstddef>
#include <string>

/// @file
/// JSON (RFC 8259): parsing, printing, loading and saving.

namespace gslam {
inline namespace v1 {

/// What parseJson() and loadJson() accept.
struct JsonOptions {
  /// Skip `// ...` and `/* ... */` wherever a space may stand.
  bool comments = false;
  /// Let an object have a name twice. The last value counts, at the place of the first; else it is
  /// an error.
  bool allow_duplicate_names = false;
  /// How many arrays and objects may stand inside one another; 0 admits neither.
  std::size_t max_depth = 1000;
};

/// The value of a JSON text (RFC 8259), be it array, object, string, number or word.
///
/// **Numbers** without fraction and exponent are int64; beyond its range they are doubles where
/// these are exact (2^63, 10^20), else errors; -0 is the double -0.0. All others are the nearest
/// double; what is too large for one is an error, what is too small is 0.
///
/// **Text** is UTF-8 and checked to be. A byte order mark at its start is skipped. Strings hold
/// UTF-8, too: half of a surrogate pair is an error, `\u0000` is a zero byte.
///
/// Depth is bounded by memory and `max_depth`, not by the stack.
/// @param text     need not end in a zero byte
/// @param source   what errors call it, such as the name of the file
/// @param options  what to accept beyond RFC 8259
/// @throws ParseError with line and column (in bytes, from 1, after the byte order mark), what was
///         expected and what was found
Svar parseJson(detail::Text text, const std::string& source = "JSON",
               const JsonOptions& options = JsonOptions());

/// The value of a JSON file, by the rules of parseJson().
/// @param path     the file
/// @param options  what to accept beyond RFC 8259
/// @throws FileError when the file cannot be read; ParseError when its content, be it empty, is no
///         JSON
Svar loadJson(const std::string& path, const JsonOptions& options = JsonOptions());

/// JSON text that parseJson() reads as an equal value: doubles have as many digits as say which
/// double it is, and a `.0` where they would look like integers. Characters beyond ASCII stay as
/// they are.
/// @param value   what to print; its depth is bounded by memory, not by the stack
/// @param indent  spaces for each level, up to 16, one element or member a line; 0 for all in one
///                line without spaces. Levels from the 100th on are indented as that.
/// @throws SvarError with the path of a NaN, an infinity or a string that is not UTF-8: JSON has
///         none of them. ArgumentError for another indent
std::string printJson(const Svar& value, int indent = 0);

/// Writes printJson() and a line end to a file. The text goes to a new file beside it, which then
/// takes its place (std::rename): whatever fails, the old file is still whole.
/// @param path    the file; a link there is replaced, not followed
/// @param value   what to write
/// @param indent  as for printJson()
/// @throws FileError when it cannot be written, and what printJson() throws
void saveJson(const std::string& path, const Svar& value, int indent = 2);

}  // namespace v1
}  // namespace gslam

#include <gslam/svar/detail/file_formats.h>
#include <gslam/svar/detail/json_file.h>
#include <gslam/svar/detail/json_reader.h>
#include <gslam/svar/detail/json_writer.h>

#endif  // GSLAM_SVAR_JSON_H
