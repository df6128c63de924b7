#ifndef GSLAM_BASE_H
#define GSLAM_BASE_H

/// @file
/// All of GSLAM::base.

#include <gslam/base/error.h>
#include <gslam/base/log.h>
#include <gslam/base/parallel.h>
#include <gslam/base/platform.h>
#include <gslam/base/simd.h>
#include <gslam/base/span.h>
#include <gslam/base/thread_pool.h>
#include <gslam/base/version.h>

#endif  // GSLAM_BASE_H
