#ifndef GSLAM_SVAR_FORMATS_FILES_H
#define GSLAM_SVAR_FORMATS_FILES_H

#include <gslam/svar_formats/export.h>

/// @file
/// Makes YAML and XML known to Svar::load() and Svar::save() by the suffixes of files.

namespace gslam {
inline namespace v1 {

/// Makes .yaml, .yml and .xml known to Svar::load(), Svar::save() and Config in this program. It
/// need not be called where this header is included: that does so before main(). Thread-safe.
GSLAM_SVAR_FORMATS_EXPORT void addFileFormats();

namespace detail {

/// As std::ios_base::Init does for streams.
struct FileFormatsAdded {
  FileFormatsAdded() { addFileFormats(); }
};
static const FileFormatsAdded kFileFormatsAdded;

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_FORMATS_FILES_H
