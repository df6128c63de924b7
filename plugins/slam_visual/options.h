#ifndef GSLAM_PLUGINS_SLAM_VISUAL_OPTIONS_H
#define GSLAM_PLUGINS_SLAM_VISUAL_OPTIONS_H

#include <gslam/core.h>

#include <cstdint>
#include <string>

namespace visual {

/// What is taken from a frame.
enum class SensorKind { mono, stereo, rgbd };

/// Where features come from.
struct FeatureOptions {
  std::string detector = "orb";  ///< orb, or a cv::Feature2D: sift, akaze, brisk, kaze
  int count = 1000;              ///< wanted in an image
  double scale = 1.2;            ///< from one level of the pyramid to the next
  int levels = 8;                ///< of the pyramid
  int threshold = 20;            ///< of a corner against its circle, grey levels
  int least_threshold = 7;       ///< where there is no corner otherwise
};

/// How frames are followed.
struct TrackingOptions {
  double window = 15;            ///< around the predicted pixel, on the finest level
  int least_inliers = 25;        ///< of a pose that counts
  double keyframe_ratio = 0.75;  ///< a keyframe is due below this part of the points it had
  int keyframe_gap = 0;          ///< frames between two keyframes at least
  int most_gap = 30;             ///< and at most
};

/// How the map grows.
struct MappingOptions {
  std::string backend;        ///< of the optimizer; empty: its choice
  int neighbours = 10;        ///< keyframes in which points are searched
  int window = 20;            ///< keyframes that a local bundle adjustment moves at most
  double far_baselines = 40;  ///< depth beyond so many baselines is no position
};

/// How places are found again.
struct LoopOptions {
  bool enabled = true;     ///< whether loops are closed
  bool adjust_all = true;  ///< all of the map after a loop is closed
  std::string vocabulary;  ///< file; empty: trained on the first keyframes
  int least_matches = 40;  ///< of a loop
  int consistent = 2;      ///< keyframes in a row that see the place
};

/// All parameters of the system.
struct Options {
  std::string sensor = "auto";  ///< mono, stereo, rgbd, or what the dataset has
  bool threaded = false;        ///< tracking, mapping and loops in threads of their own
  int workers = 1;              ///< threads that share the work of one frame; 0: all
  std::uint64_t seed = 1;       ///< of samples
  double depth_baseline = 0.3;  ///< of the stereo pair that a depth image stands for, metres
  FeatureOptions features;
  TrackingOptions tracking;
  MappingOptions mapping;
  LoopOptions loop;
};

/// What the user may set, with what holds unless he does.
gslam::Svar defaultParameters();
/// What each of them means.
gslam::Svar parameterHelp();

/// @throws ArgumentError that names the parameter, what is wrong and what is expected
Options readOptions(const gslam::Svar& parameters);

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_OPTIONS_H
