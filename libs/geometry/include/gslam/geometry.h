#ifndef GSLAM_GEOMETRY_H
#define GSLAM_GEOMETRY_H

/// @file
/// All of GSLAM::geometry.

#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>
#include <gslam/geometry/version.h>

#endif  // GSLAM_GEOMETRY_H
