// What TUM's mono and visual-inertial datasets say of brightness.
#ifndef GSLAM_DATASETS_SRC_EXPORT_PHOTOMETRIC_H
#define GSLAM_DATASETS_SRC_EXPORT_PHOTOMETRIC_H

#include <cstdint>
#include <string>

#include "export_folder.h"
#include "pixels.h"
#include "row.h"
#include "source.h"

namespace gslam {
inline namespace v1 {
namespace exporting {

inline void notePhotometric(Source& source) {
  source.notes.remark(
      "brightness: how the camera responds is not known; pcalib.txt is a straight line, "
      "vignette.png "
      "is white");
}

/// pcalib.txt: the inverse response, 256 values; vignette.png: 16-bit grey.
inline void writePhotometric(ExportFolder& folder, const std::string& below, const Camera& camera) {
  Row response(" ");
  for (int i = 0; i < 256; ++i) response.text(std::to_string(i) + ".0");
  folder.write(below + "pcalib.txt", response.str() + "\n");
  folder.write(below + "vignette.png", whitePng(camera.width(), camera.height()));
}

/// Milliseconds; "0" for unknown, which readers take for unknown, too.
inline std::string exposureText(std::int64_t nanoseconds, Notes& notes) {
  if (nanoseconds > 0) return numberText(double(nanoseconds) * 1e-6);
  notes.remark("exposures that are not known are written as 0");
  return "0";
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_PHOTOMETRIC_H
