#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_EVEN_CHOICE_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_EVEN_CHOICE_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace visual {

/// A place in an image and how good a feature it makes.
struct Spot {
  float u, v;
  float response;
};

/// A part of an image, pixels.
struct SpotArea {
  double left, top, width, height;
};

/// Chooses some of many places so that they lie all over the image: it has about as many cells as
/// are wanted, and the best of each cell come first, then the second ones, and so on. Keeps its
/// memory from one call to the next.
class EvenChoice {
 public:
  /// @param spots   the order of equal ones is theirs
  /// @param area    in which they are
  /// @param wanted  how many
  /// @return which ones, ascending; as many as wanted, or all
  const std::vector<std::uint32_t>& choose(const std::vector<Spot>& spots, const SpotArea& area,
                                           std::size_t wanted);

 private:
  void sortIntoCells(const std::vector<Spot>& spots, const SpotArea& area, std::size_t wanted);

  std::vector<std::uint32_t> begin_;    // of each cell in by_cell_; one more than cells
  std::vector<std::uint32_t> by_cell_;  // spots, the best of each cell first
  std::vector<std::uint32_t> cell_of_;  // each spot
  std::vector<std::uint32_t> round_;    // spots of one rank
  std::vector<std::uint32_t> chosen_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_EVEN_CHOICE_H
