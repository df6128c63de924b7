#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_FEATURE_EXTRACTOR_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_FEATURE_EXTRACTOR_H

#include <gslam/core.h>

#include <memory>
#include <vector>

#include "features/pyramid.h"
#include "options.h"

namespace visual {

/// Finds features in images, one after the other. Keeps its memory from one image to the next.
class FeatureExtractor {
 public:
  virtual ~FeatureExtractor() = default;

  /// The same image gives the same bits, whatever came before and on any number of threads.
  /// @param grey         8 bits, 1 channel; its pixels stay in use until the next call, see
  ///                     pyramid()
  /// @param features     results, spread over the image; pixels have their centres at whole numbers
  /// @param descriptors  results, one row a feature, in memory of its own; no image for no feature
  virtual void extract(const cv::Mat& grey, std::vector<gslam::Feature>& features,
                       gslam::Image& descriptors) = 0;

  /// The pyramid of the last image; for as long as its pixels live.
  virtual const Pyramid& pyramid() = 0;
};

/// @param options  say which detector, and how many features
/// @param workers  threads that may share the work; 0: all
/// @throws ArgumentError when there is no such detector
std::unique_ptr<FeatureExtractor> makeFeatureExtractor(const FeatureOptions& options, int workers);

/// A cv::Feature2D that finds and describes by itself.
/// @throws ArgumentError when there is no such detector
std::unique_ptr<FeatureExtractor> makeAnyFeature(const FeatureOptions& options);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_FEATURE_EXTRACTOR_H
