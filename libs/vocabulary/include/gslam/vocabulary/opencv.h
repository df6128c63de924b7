#ifndef GSLAM_VOCABULARY_OPENCV_H
#define GSLAM_VOCABULARY_OPENCV_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/descriptors.h>

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

/// @file
/// Descriptors of OpenCV, for those who have it. No other header of GSLAM includes this one.

namespace gslam {
inline namespace v1 {

/// Views the descriptors of OpenCV's features, which are not copied: the Mat must outlive the view.
/// @param descriptors  a row each, CV_8U (bits) or CV_32F; may be empty
/// @throws ArgumentError for another type, or more dimensions
inline Descriptors viewDescriptors(const cv::Mat& descriptors) {
  if (descriptors.empty()) return Descriptors();
  if (descriptors.dims != 2) {
    throw ArgumentError("descriptors", "have " + std::to_string(descriptors.dims) +
                                           " dimensions, expected rows and columns");
  }
  const auto count = static_cast<std::size_t>(descriptors.rows);
  const auto size = static_cast<std::uint32_t>(descriptors.cols);
  const std::size_t stride = descriptors.step[0];
  if (descriptors.type() == CV_8UC1) {
    return binaryDescriptors(descriptors.ptr<std::uint8_t>(), count, size, stride);
  }
  if (descriptors.type() == CV_32FC1) {
    return floatDescriptors(descriptors.ptr<float>(), count, size, stride);
  }
  throw ArgumentError("descriptors", "are of the type " + cv::typeToString(descriptors.type()) +
                                         ", expected CV_8UC1 or CV_32FC1");
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_OPENCV_H
