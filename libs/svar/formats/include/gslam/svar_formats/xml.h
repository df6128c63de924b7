#ifndef GSLAM_SVAR_FORMATS_XML_H
#define GSLAM_SVAR_FORMATS_XML_H

#include <gslam/svar.h>
#include <gslam/svar_formats/export.h>

#include <cstddef>
#include <string>

/// @file
/// XML 1.0 by a convention for values: parsing, printing, loading and saving.

namespace gslam {
inline namespace v1 {

/// What parseXml() and loadXml() accept.
struct XmlOptions {
  /// How many elements may stand inside one another, the root among them.
  std::size_t max_depth = 1000;
};

/// The value of an XML text. The name of the root element does not count; then
///
/// * an element with nothing in it, or only white space, is null;
/// * an element with text only is a scalar: its text, without the white space around it, is read as
///   parseYaml() reads a plain scalar, so that `<fps>30</fps>` is the int 30;
/// * an element with elements inside is an object, in which a name that is repeated is an array at
///   the place of the first;
/// * an attribute is a member of the object that its element then is: `unit="m"` has the name
///   "@unit"; its value is read as text is, white space and all;
/// * text beside attributes or elements is the member "#text", a CDATA section is text;
/// * comments, processing instructions and DOCTYPE are nothing.
///
/// What would not come back by that is marked by attributes of the namespace `urn:gslam:svar`,
/// which the root declares as `xmlns:svar`: `svar:type` is `string` (all of the text, white space
/// and all), `binary` (base64), `array` (of the elements inside, whatever their names) or `object`;
/// `svar:name` is the name of a member that can be no name in XML.
///
/// **OpenCV.** Inside a root `<opencv_storage>` the rules of its FileStorage hold: text with
/// several words is an array, text in quotes a string, elements `<_>` are those of an array;
/// `type_id="opencv-matrix"` and `"opencv-nd-matrix"` give the same checked object as in YAML, and
/// `type_id` is no member.
///
/// Text is UTF-8, and checked to be; so are the characters that XML admits, and references: there
/// are those to numbers and the five that XML has by itself.
/// @param text     need not end in a zero byte
/// @param source   what errors call it, such as the name of the file
/// @param options  limits
/// @throws ParseError with line and column (in bytes, from 1, after the byte order mark)
GSLAM_SVAR_FORMATS_EXPORT Svar parseXml(detail::Text text, const std::string& source = "XML",
                                        const XmlOptions& options = XmlOptions());

/// The value of an XML file, by the rules of parseXml().
/// @param path     the file
/// @param options  limits
/// @throws FileError when the file cannot be read; ParseError when its content is no XML
GSLAM_SVAR_FORMATS_EXPORT Svar loadXml(const std::string& path,
                                       const XmlOptions& options = XmlOptions());

/// XML text, without a line end after it, that parseXml() reads as an equal value where it is no
/// deeper than that admits. The root element is `<svar>`, elements of arrays that need a name of
/// their own are `<item>`. NaN and infinities are `.nan`, `.inf` and `-.inf`.
/// @param value  what to print; its depth is bounded by memory, not by the stack
/// @throws SvarError with the path of a string or name that is not UTF-8 or has a character that
///         XML cannot hold: control characters but tab and line ends, U+FFFE, U+FFFF; of a function
///         or a native object
GSLAM_SVAR_FORMATS_EXPORT std::string printXml(const Svar& value);

/// Writes printXml() and a line end to a file. The text goes to a new file beside it, which then
/// takes its place: whatever fails, the old file is still whole.
/// @param path   the file; a link there is replaced, not followed
/// @param value  what to write
/// @throws FileError when it cannot be written, and what printXml() throws
GSLAM_SVAR_FORMATS_EXPORT void saveXml(const std::string& path, const Svar& value);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_XML_H
