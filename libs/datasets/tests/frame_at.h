// One frame of a dataset.
#ifndef GSLAM_DATASETS_TESTS_FRAME_AT_H
#define GSLAM_DATASETS_TESTS_FRAME_AT_H

#include <gslam/core/dataset.h>

#include <cstddef>
#include <memory>

/// The frame, whatever was read before.
inline std::shared_ptr<const gslam::Frame> frameAt(gslam::Dataset& dataset, std::size_t index) {
  dataset.seek(index);
  return dataset.next();
}

#endif  // GSLAM_DATASETS_TESTS_FRAME_AT_H
