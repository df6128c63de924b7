#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_WINDOW_SEARCH_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_WINDOW_SEARCH_H

#include <opencv2/core/mat.hpp>

namespace visual {

constexpr int kWindow = 5;  ///< pixels around the middle one: 11 x 11
constexpr int kShifts = 5;  ///< pixels to the left and to the right that are tried

/// Where along a row of another image the pixels around one are found again.
struct WindowMatch {
  double shift;    ///< pixels from where it was looked for, between two pixels
  int difference;  ///< sum of absolute differences at the best pixel
};

/// Differences in brightness of the two images as a whole do not count.
/// @param left, right  8 bits, 1 channel
/// @param u, v         pixel of the left image
/// @param right_u      pixel of the right image, in the same row, about which it is looked for
/// @return whether all pixels are inside the images and there is a least difference that is not
///   the last one
bool searchWindow(const cv::Mat& left, int u, int v, const cv::Mat& right, int right_u,
                  WindowMatch& match);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_WINDOW_SEARCH_H
