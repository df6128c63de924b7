#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_STEREO_MATCHER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_STEREO_MATCHER_H

#include <gslam/core.h>

#include <cstdint>
#include <vector>

#include "features/pyramid.h"

namespace visual {

/// What was found in one image of a pair; all of it lives as long as the call that gets it.
struct StereoSide {
  const std::vector<gslam::Feature>& features;
  const gslam::Image& descriptors;  ///< one row a feature
  const Pyramid& pyramid;           ///< in which they were found
};

/// Finds the features of the left image of a rectified pair in the right one: by descriptors among
/// the features of the same rows, then by the pixels around, to a part of a pixel. Keeps its memory
/// from one pair to the next.
///
/// After R. Mur-Artal, J. D. Tardos, "ORB-SLAM2", T-RO 2017, section III-A.
class StereoMatcher {
 public:
  /// @param focal     fx of the rectified camera, pixels
  /// @param baseline  metres, above 0
  StereoMatcher(double focal, double baseline) : focal_(focal), baseline_(baseline) {}

  /// @param left, right  images of the same size, pyramids of the same scale
  /// @param depth    results: of each feature of the left image, metres; 0: not found
  /// @param right_u  results: where the right image has it; NaN: not found
  void match(const StereoSide& left, const StereoSide& right, std::vector<float>& depth,
             std::vector<float>& right_u);

 private:
  struct Found {
    std::uint32_t feature;
    int difference;  // of the pixels around
    float disparity;
  };
  void sortIntoRows(const StereoSide& right);
  std::uint32_t nearestOf(const StereoSide& left, std::size_t feature, const StereoSide& right);
  bool refine(const StereoSide& left, std::size_t feature, const StereoSide& right,
              std::uint32_t partner, Found& found) const;
  void removeWorst();

  double focal_, baseline_;
  std::vector<std::uint32_t> begin_, by_row_;  // features of the right image
  std::vector<std::uint32_t> candidates_;
  std::vector<float> distances_;
  std::vector<Found> found_;
  std::vector<int> differences_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_STEREO_MATCHER_H
