// Images that tests look at.
#ifndef GSLAM_PLUGINS_SLAM_VISUAL_TESTS_IMAGES_H
#define GSLAM_PLUGINS_SLAM_VISUAL_TESTS_IMAGES_H

#include <gslam/core.h>
#include <gslam/datasets/synthetic.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>

namespace images {

/// A synthetic world, which is made once.
inline gslam::Dataset& worldOf(const std::string& name) {
  static std::map<std::string, std::unique_ptr<gslam::Dataset>> worlds;
  std::unique_ptr<gslam::Dataset>& world = worlds[name];
  if (world == nullptr) world = gslam::openSynthetic(gslam::syntheticOptions(name));
  return *world;
}

/// A frame of a synthetic world, which is rendered once.
inline std::shared_ptr<const gslam::Frame> frameOf(const std::string& name, std::size_t index) {
  static std::map<std::pair<std::string, std::size_t>, std::shared_ptr<const gslam::Frame>> frames;
  std::shared_ptr<const gslam::Frame>& frame = frames[{name, index}];
  if (frame == nullptr) {
    worldOf(name).seek(index);
    frame = worldOf(name).next();
  }
  return frame;
}

/// The pixels, without a share in them.
inline cv::Mat matOf(const gslam::Image& image) {
  return cv::Mat(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.bytes()),
                 image.stride());
}

/// A room with some noise.
inline cv::Mat room(std::size_t frame = 0) {
  return matOf(frameOf("synthetic://room?sensors=mono", frame)->images[0].image).clone();
}

}  // namespace images

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_TESTS_IMAGES_H
