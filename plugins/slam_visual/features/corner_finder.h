#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_CORNER_FINDER_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_CORNER_FINDER_H

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "features/even_choice.h"
#include "features/pyramid.h"
#include "options.h"

namespace visual {

/// Finds FAST corners on a sheet of a pyramid: those above a threshold, and in cells that have none
/// those above a lower one. Keeps its memory from one image to the next.
///
/// E. Rosten, T. Drummond, "Machine learning for high-speed corner detection", ECCV 2006. OpenCV is
/// called once for the sheet and once for all empty cells, which are copied side by side.
class CornerFinder {
 public:
  /// @param border  pixels at the border of each level where none is wanted, 4 or more
  CornerFinder(const FeatureOptions& options, int border)
      : threshold_(options.threshold), least_threshold_(options.least_threshold), border_(border) {}

  void find(const Pyramid& pyramid, std::size_t sheet);
  /// Corners of a level of the sheet, in pixels of the level.
  const std::vector<Spot>& cornersOf(int level) const noexcept {
    return levels_[std::size_t(level)].spots;
  }
  /// The part of a level where corners are looked for; empty where it is too small.
  cv::Rect areaOf(const Pyramid& pyramid, int level) const noexcept;

 private:
  struct Level {
    std::vector<Spot> spots;
    std::size_t strong = 0;                // those above the higher threshold come first
    std::vector<std::uint8_t> has_corner;  // each cell
    int columns = 0, rows = 0;             // of cells
  };
  struct Tile {
    int level;
    cv::Rect cell;  // of the level
  };
  void keep(const Pyramid& pyramid, std::size_t sheet);
  void collectEmpty(const Pyramid& pyramid, int level);
  void copyTiles(const Pyramid& pyramid);
  void findInTiles();
  void sortFaint(int level);

  int threshold_, least_threshold_, border_;
  std::array<Level, Levels::kMost> levels_;
  std::vector<cv::KeyPoint> keys_;
  std::vector<Tile> tiles_;
  cv::Mat tile_sheet_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_CORNER_FINDER_H
