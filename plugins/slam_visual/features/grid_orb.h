#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_GRID_ORB_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_GRID_ORB_H

#include <opencv2/core/types.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

#include "features/corner_finder.h"
#include "features/even_choice.h"
#include "features/feature_extractor.h"

namespace visual {

/// Corners all over the image and on all levels of its pyramid, each with its orientation and a
/// description by bits.
///
/// E. Rublee, V. Rabaud, K. Konolige, G. Bradski, "ORB: an efficient alternative to SIFT or SURF",
/// ICCV 2011; that corners are asked of each part of the image, and with a lower threshold where
/// there is none, is from R. Mur-Artal, J. M. M. Montiel, J. D. Tardos, "ORB-SLAM", T-RO 2015.
class GridOrb : public FeatureExtractor {
 public:
  GridOrb(const FeatureOptions& options, int workers);

  void extract(const cv::Mat& grey, std::vector<gslam::Feature>& features,
               gslam::Image& descriptors) override;
  const Pyramid& pyramid() override { return pyramid_; }

 private:
  // What one thread does with a sheet of the pyramid.
  struct Sheet {
    CornerFinder corners;
    EvenChoice choice;
    std::vector<cv::KeyPoint> keys;  // chosen, level by level, in pixels of the sheet
    std::vector<std::size_t> ends;   // of each level's in keys
    std::size_t first = 0;           // of its features in the result
    cv::Ptr<cv::ORB> orb;
  };
  void detect(std::size_t sheet);
  void describe(std::size_t sheet, std::vector<gslam::Feature>& features,
                gslam::Image& descriptors);

  unsigned workers_;
  Pyramid pyramid_;
  std::vector<std::size_t> wanted_;  // features of each level
  std::vector<Sheet> sheets_;
};

/// Pixels at the border of a level in which OpenCV describes nothing.
constexpr int kOrbBorder = 19;

/// The direction from the middle of a disc around a pixel to its centre of brightness, radians.
/// @param image  8 bits; the disc, 15 pixels around, is inside
float brightnessAngle(const cv::Mat& image, int u, int v);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_GRID_ORB_H
