#ifndef GSLAM_EVALUATION_H
#define GSLAM_EVALUATION_H

/// @file
/// All of GSLAM::evaluation.

#include <gslam/evaluation/align.h>
#include <gslam/evaluation/allocation_counts.h>
#include <gslam/evaluation/ape.h>
#include <gslam/evaluation/cloud.h>
#include <gslam/evaluation/cost.h>
#include <gslam/evaluation/coverage.h>
#include <gslam/evaluation/evaluate.h>
#include <gslam/evaluation/frame_times.h>
#include <gslam/evaluation/kitti.h>
#include <gslam/evaluation/limits.h>
#include <gslam/evaluation/nees.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/evaluation/process_usage.h>
#include <gslam/evaluation/resource_monitor.h>
#include <gslam/evaluation/rpe.h>
#include <gslam/evaluation/score.h>
#include <gslam/evaluation/segments.h>
#include <gslam/evaluation/statistics.h>
#include <gslam/evaluation/version.h>

#endif  // GSLAM_EVALUATION_H
