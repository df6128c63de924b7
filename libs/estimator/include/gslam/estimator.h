#ifndef GSLAM_ESTIMATOR_H
#define GSLAM_ESTIMATOR_H

#include <gslam/estimator/estimate.h>
#include <gslam/estimator/estimate_absolute_pose.h>
#include <gslam/estimator/estimate_affine_2d.h>
#include <gslam/estimator/estimate_affine_3d.h>
#include <gslam/estimator/estimate_essential.h>
#include <gslam/estimator/estimate_fundamental.h>
#include <gslam/estimator/estimate_homography.h>
#include <gslam/estimator/estimate_plane.h>
#include <gslam/estimator/estimate_relative_pose.h>
#include <gslam/estimator/estimate_rig_pose.h>
#include <gslam/estimator/estimate_rigid_3d.h>
#include <gslam/estimator/estimate_similarity_3d.h>
#include <gslam/estimator/options.h>
#include <gslam/estimator/version.h>

/// @file
/// The robust functions of GSLAM::estimator. Solvers are in `gslam/estimator/solvers/`, a header
/// each.

#endif  // GSLAM_ESTIMATOR_H
