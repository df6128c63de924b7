#ifndef GSLAM_OPTIMIZER_OPTIMIZER_H
#define GSLAM_OPTIMIZER_OPTIMIZER_H

#include <gslam/optimizer/align_trajectories.h>
#include <gslam/optimizer/alignment_problem.h>
#include <gslam/optimizer/backend.h>
#include <gslam/optimizer/bundle.h>
#include <gslam/optimizer/bundle_problem.h>
#include <gslam/optimizer/check.h>
#include <gslam/optimizer/covariance.h>
#include <gslam/optimizer/id_map.h>
#include <gslam/optimizer/initialize_poses.h>
#include <gslam/optimizer/marginalize.h>
#include <gslam/optimizer/options.h>
#include <gslam/optimizer/pose_graph.h>
#include <gslam/optimizer/pose_graph_problem.h>
#include <gslam/optimizer/pose_problem.h>
#include <gslam/optimizer/summary.h>
#include <gslam/optimizer/two_view_problem.h>
#include <gslam/optimizer/version.h>

/// @file
/// The nonlinear problems of SLAM behind one interface. File formats: gslam/optimizer/files.h.

#endif  // GSLAM_OPTIMIZER_OPTIMIZER_H
