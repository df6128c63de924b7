// The attributes by which a value says what XML does not.
#ifndef GSLAM_SVAR_FORMATS_SRC_XML_MARKS_H
#define GSLAM_SVAR_FORMATS_SRC_XML_MARKS_H

namespace gslam {
namespace formats {
namespace xml_marks {

constexpr char kDeclaration[] = "xmlns:svar";
constexpr char kNamespace[] = "urn:gslam:svar";
constexpr char kPrefix[] = "svar:";
constexpr char kType[] = "svar:type";
constexpr char kName[] = "svar:name";
constexpr char kText[] = "#text";
constexpr char kRoot[] = "svar";
constexpr char kItem[] = "item";

}  // namespace xml_marks
}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_XML_MARKS_H
