// One function a layout.
#ifndef GSLAM_DATASETS_SRC_EXPORT_LAYOUTS_H
#define GSLAM_DATASETS_SRC_EXPORT_LAYOUTS_H

#include <memory>

#include "source.h"

namespace gslam {
inline namespace v1 {
namespace exporting {

/// @{
/// @throws ArgumentError when the dataset does not fit
std::unique_ptr<Layout> makeTum(Source& source);
std::unique_ptr<Layout> makeEuroc(Source& source);
std::unique_ptr<Layout> makeKitti(Source& source);
std::unique_ptr<Layout> makeIcl(Source& source);
std::unique_ptr<Layout> makeTummono(Source& source);
std::unique_ptr<Layout> makeTumvi(Source& source);
/// @}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_LAYOUTS_H
