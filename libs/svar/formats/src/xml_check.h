// What pugixml does not check.
#ifndef GSLAM_SVAR_FORMATS_SRC_XML_CHECK_H
#define GSLAM_SVAR_FORMATS_SRC_XML_CHECK_H

#include "source_text.h"

namespace gslam {
namespace formats {

/// Throws ParseError where a reference stands for no character, or for something that a DTD would
/// have to define, and for '<' in the value of an attribute. Comments, CDATA sections and
/// processing instructions have no references.
void checkXmlReferences(const SourceText& source);

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_XML_CHECK_H
