#ifndef GSLAM_PLUGINS_EXAMPLE_CAROUSEL_H
#define GSLAM_PLUGINS_EXAMPLE_CAROUSEL_H

#include <gslam/core.h>

namespace example {

/// A dataset that reads no file: a vehicle goes once around a circle above a floor of tiles, from
/// rest to rest. It has a camera, an inertial unit without errors, and exact ground truth.
///
/// World: x is where the vehicle heads first, z is up, the floor is z = 0. Body: x forward, y left,
/// z up, at the place of the camera.
gslam::DatasetFactory carouselFactory();

}  // namespace example

#endif  // GSLAM_PLUGINS_EXAMPLE_CAROUSEL_H
