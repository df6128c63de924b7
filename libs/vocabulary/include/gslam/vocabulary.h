#ifndef GSLAM_VOCABULARY_H
#define GSLAM_VOCABULARY_H

/// @file
/// All of GSLAM::vocabulary but what speaks to other libraries: gslam/vocabulary/gzip.h (zlib) and
/// gslam/vocabulary/opencv.h.

#include <gslam/vocabulary/bow_vector.h>
#include <gslam/vocabulary/database.h>
#include <gslam/vocabulary/dbow_maps.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/fingerprint.h>
#include <gslam/vocabulary/image_source.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/orb_slam_text.h>
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/reweight.h>
#include <gslam/vocabulary/score.h>
#include <gslam/vocabulary/train.h>
#include <gslam/vocabulary/training_options.h>
#include <gslam/vocabulary/transform.h>
#include <gslam/vocabulary/version.h>
#include <gslam/vocabulary/vocabulary.h>
#include <gslam/vocabulary/weighting.h>

#endif  // GSLAM_VOCABULARY_H
