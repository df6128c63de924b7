#ifndef GSLAM_OPTIMIZER_CERES_H
#define GSLAM_OPTIMIZER_CERES_H

#include <gslam/optimizer/backend.h>
#include <gslam/optimizer_ceres/export.h>
#include <gslam/optimizer_ceres/version.h>

/// @file
/// The back end "ceres" of GSLAM::optimizer. To include this and to link GSLAM::optimizer_ceres is
/// all that is needed for it to be known.

namespace gslam {
inline namespace v1 {

/// The back end itself.
GSLAM_OPTIMIZER_CERES_EXPORT const OptimizerBackend& ceresBackend();

namespace detail {

inline const bool ceres_is_registered = registerOptimizerBackend(ceresBackend());

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_CERES_H
