// What the options of a synthetic world come to.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_OPTIONS_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_OPTIONS_H

#include <gslam/datasets/synthetic.h>

#include <vector>

#include "world.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// @throws ArgumentError that names the first option that is out of its range
void checkOptions(const SyntheticOptions& options);

/// The options' own cameras, or those of the rig.
std::vector<CameraSensor> camerasOf(const SyntheticOptions& options, const WorldFacts& world);

/// The edge of texels that fits the cameras, 1 for 640 pixels of a usual lens.
float textureDetail(const std::vector<CameraSensor>& cameras);

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_OPTIONS_H
