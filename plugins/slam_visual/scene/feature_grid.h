#ifndef GSLAM_PLUGINS_SLAM_VISUAL_SCENE_FEATURE_GRID_H
#define GSLAM_PLUGINS_SLAM_VISUAL_SCENE_FEATURE_GRID_H

#include <gslam/core.h>

#include <cstdint>
#include <vector>

namespace visual {

/// Features of an image by their place: who is near a pixel?
///
/// Immutable once built, so that threads may share it.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  /// @param features       whose pixels and octaves are copied
  /// @param width, height  of the image; features outside of it count to the cells at its border
  FeatureGrid(gslam::Span<const gslam::Feature> features, int width, int height);

  /// Appends the features in a square around a pixel, whose octave is one of those from `first` to
  /// `last`, in an order that depends on nothing else.
  void near(const gslam::Vec2d& pixel, double radius, int first, int last,
            std::vector<std::uint32_t>& found) const;

 private:
  struct Entry {
    float u, v;
    std::int32_t octave;
    std::uint32_t feature;
  };
  int columnOf(double u) const noexcept;
  int rowOf(double v) const noexcept;

  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> begin_;  // of each cell in entries_; one more than cells
  std::vector<Entry> entries_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_SCENE_FEATURE_GRID_H
