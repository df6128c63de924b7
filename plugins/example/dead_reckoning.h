#ifndef GSLAM_PLUGINS_EXAMPLE_DEAD_RECKONING_H
#define GSLAM_PLUGINS_EXAMPLE_DEAD_RECKONING_H

#include <gslam/core.h>

namespace example {

/// The least that can call itself a SLAM system: adds up what the inertial unit measures, from rest
/// on. Its world begins at the unit, level, z up. It drifts without bound, as all do that never
/// look.
gslam::SlamFactory deadReckoningFactory();

}  // namespace example

#endif  // GSLAM_PLUGINS_EXAMPLE_DEAD_RECKONING_H
