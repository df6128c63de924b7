#ifndef GSLAM_OPTIMIZER_PBA_H
#define GSLAM_OPTIMIZER_PBA_H

#include <gslam/optimizer/backend.h>
#include <gslam/optimizer_pba/export.h>
#include <gslam/optimizer_pba/version.h>

/// @file
/// The back end "pba" of GSLAM::optimizer. To include this and to link GSLAM::optimizer_pba is all
/// that is needed for it to be known.

namespace gslam {
inline namespace v1 {

/// The back end itself.
GSLAM_OPTIMIZER_PBA_EXPORT const OptimizerBackend& pbaBackend();

namespace detail {

inline const bool pba_is_registered = registerOptimizerBackend(pbaBackend());

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_H
