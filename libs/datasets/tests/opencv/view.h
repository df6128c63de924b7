// Images as OpenCV's, for its detectors.
#ifndef GSLAM_DATASETS_TESTS_OPENCV_VIEW_H
#define GSLAM_DATASETS_TESTS_OPENCV_VIEW_H

#include <gslam/core/image.h>

#include <cstdint>
#include <opencv2/core.hpp>

/// The pixels of 8 bits that an image has, not copied.
inline cv::Mat view(const gslam::Image& image) {
  return cv::Mat(image.height(), image.width(), CV_8UC(image.channels()),
                 const_cast<std::uint8_t*>(image.bytes()), image.stride());
}

#endif  // GSLAM_DATASETS_TESTS_OPENCV_VIEW_H
