#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_GREY_IMAGE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_GREY_IMAGE_H

#include <gslam/core.h>

#include <opencv2/core/mat.hpp>
#include <string>

namespace visual {

/// What is white, in numbers of pixels: the least of 255, 1023, 4095, 16383 and 65535 (for floats
/// also 1) that no more than one number in a thousand is above, so that the bits of a 10-bit camera
/// are used and a dead pixel does not darken the image. It never falls, so that a dark frame stays
/// dark, and cameras of a pair share it. Of 8 bits white is 255.
class GreyRange {
 public:
  /// Looks at the numbers of an image, and raises white where it must.
  void widen(const gslam::Image& image);
  double white() const noexcept { return white_; }

 private:
  double white_ = 0;
};

/// Makes images of one camera grey: 8 bits, 1 channel. Keeps its memory from one image to the next.
class GreyImage {
 public:
  /// @param width, height  that images must have
  GreyImage(int width, int height) : width_(width), height_(height) {}

  /// Whether an image can be made grey.
  /// @param problem  result where it cannot: a sentence that names the camera
  bool accepts(const gslam::CameraImage& image, std::string& problem) const;
  /// @param image  an image that is accepted
  /// @param range  what is white, widened by all images of the frame
  /// @return of 8 bits and 1 channel the image's own pixels, which must outlive the use of it; else
  ///   good until the next call. Mosaics of colours are smoothed until they show none.
  const cv::Mat& make(const gslam::CameraImage& image, const GreyRange& range);

 private:
  int width_, height_;
  cv::Mat bytes_, single_, grey_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_GREY_IMAGE_H
