#ifndef GSLAM_ESTIMATOR_SOLVERS_H
#define GSLAM_ESTIMATOR_SOLVERS_H

/// @file
/// All solvers at once: each is a header and a function of its own, without any search for
/// outliers.
///
/// What holds for all of them: they return the number of solutions, or say so where it is another
/// number. A single solution is written only where there is one: at 0 it is as it was. Of an array
/// of solutions the first so many are written, and the elements beyond are unspecified. No number
/// of a solution is NaN or infinite. Wrong sizes of spans throw; nothing else does.

#include <gslam/estimator/solvers/affine_2d.h>
#include <gslam/estimator/solvers/affine_3d.h>
#include <gslam/estimator/solvers/decompose_essential.h>
#include <gslam/estimator/solvers/decompose_homography.h>
#include <gslam/estimator/solvers/epnp.h>
#include <gslam/estimator/solvers/essential_5pt.h>
#include <gslam/estimator/solvers/essential_5pt_nister.h>
#include <gslam/estimator/solvers/essential_5pt_stewenius.h>
#include <gslam/estimator/solvers/essential_8pt.h>
#include <gslam/estimator/solvers/fundamental_7pt.h>
#include <gslam/estimator/solvers/fundamental_8pt.h>
#include <gslam/estimator/solvers/gp3p.h>
#include <gslam/estimator/solvers/gpnp.h>
#include <gslam/estimator/solvers/homography_4pt.h>
#include <gslam/estimator/solvers/homography_dlt.h>
#include <gslam/estimator/solvers/p2p_known_rotation.h>
#include <gslam/estimator/solvers/p2p_known_vertical.h>
#include <gslam/estimator/solvers/p3p.h>
#include <gslam/estimator/solvers/p3p_gao.h>
#include <gslam/estimator/solvers/p3p_kneip.h>
#include <gslam/estimator/solvers/plane.h>
#include <gslam/estimator/solvers/plane_frame.h>
#include <gslam/estimator/solvers/relative_pose_3pt_vertical.h>
#include <gslam/estimator/solvers/relative_pose_from_essential.h>
#include <gslam/estimator/solvers/relative_poses_from_homography.h>
#include <gslam/estimator/solvers/rigid_3d.h>
#include <gslam/estimator/solvers/rotation_2pt.h>
#include <gslam/estimator/solvers/rotation_5pt_kneip.h>
#include <gslam/estimator/solvers/similarity_3d.h>
#include <gslam/estimator/solvers/sqpnp.h>
#include <gslam/estimator/solvers/triangulate_linear.h>
#include <gslam/estimator/solvers/triangulate_midpoint.h>
#include <gslam/estimator/solvers/triangulate_optimal.h>
#include <gslam/estimator/solvers/triangulate_views.h>

#endif  // GSLAM_ESTIMATOR_SOLVERS_H
