#ifndef GSLAM_DATASETS_H
#define GSLAM_DATASETS_H

/// @file
/// All of GSLAM::datasets.

#include <gslam/datasets/calibration_file.h>
#include <gslam/datasets/check_dataset.h>
#include <gslam/datasets/contact_sheet.h>
#include <gslam/datasets/export_dataset.h>
#include <gslam/datasets/formats.h>
#include <gslam/datasets/synthetic.h>
#include <gslam/datasets/version.h>

#endif  // GSLAM_DATASETS_H
