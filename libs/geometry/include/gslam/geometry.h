#ifndef GSLAM_GEOMETRY_H
#define GSLAM_GEOMETRY_H

/// @file
/// All of GSLAM::geometry but what brings the processor's SIMD headers along,
/// gslam/geometry/batch.h and gslam/geometry/undistort.h, and what speaks to other libraries,
/// gslam/geometry/eigen.h and its sisters.

#include <gslam/geometry/camera.h>
#include <gslam/geometry/distance.h>
#include <gslam/geometry/euler.h>
#include <gslam/geometry/interpolate.h>
#include <gslam/geometry/layout.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/mean.h>
#include <gslam/geometry/nearest_rotation.h>
#include <gslam/geometry/pose_with_covariance.h>
#include <gslam/geometry/random.h>
#include <gslam/geometry/rectify.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/spline.h>
#include <gslam/geometry/text.h>
#include <gslam/geometry/vec.h>
#include <gslam/geometry/version.h>

#endif  // GSLAM_GEOMETRY_H
