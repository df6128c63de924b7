// Scalars without quotes, by the core schema of YAML 1.2 (section 10.3).
#ifndef GSLAM_SVAR_FORMATS_SRC_PLAIN_SCALAR_H
#define GSLAM_SVAR_FORMATS_SRC_PLAIN_SCALAR_H

#include <gslam/svar.h>

#include <string>

namespace gslam {
namespace formats {

/// Null, boolean, integer, real or, where it is none of these, string.
SvarType plainType(detail::Text text) noexcept;

struct PlainScalar {
  Svar value;
  std::string
      problem;  ///< "expected ..., found ..." where a number is beyond all types; else empty
};

/// The value of a text as what plainType() says it is.
PlainScalar plainScalar(detail::Text text);

/// The value of a text of the type `integer` or `real` as a double.
PlainScalar plainReal(detail::Text text);

/// Appends the text of a number, bool or null as plainScalar() reads it: doubles with a point, so
/// that YAML 1.1 sees doubles, too.
void appendPlain(const Svar& value, std::string& out);

}  // namespace formats
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_SRC_PLAIN_SCALAR_H
