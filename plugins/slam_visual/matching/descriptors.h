#ifndef GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_DESCRIPTORS_H
#define GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_DESCRIPTORS_H

#include <gslam/core.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace visual {

/// How far descriptors are from each other, as a part of what is possible: the part of the bits
/// that differ; for floats their distance over the sum of their lengths. 0: equal, about 0.5:
/// unrelated bits.
///
/// SIMD chosen at run time; whole numbers, so that all variants say the same of bits.
/// @param query  one descriptor, a row of `table` or of another image of the same kind
/// @param table  descriptors, one a row
/// @param rows   of the table
/// @param distances  results, one for each of `rows`
void distancesTo(const std::uint8_t* query, const gslam::Image& table,
                 gslam::Span<const std::uint32_t> rows, std::vector<float>& distances);

/// The distance of two descriptors of a kind.
float distanceOf(const std::uint8_t* a, const std::uint8_t* b, const gslam::Image& kind);

/// Of bits, at most so far: matches that nothing but the distance speaks for, and matches that a
/// place in the image speaks for, too.
constexpr float kStrictDistance = 50.0F / 256;
constexpr float kLooseDistance = 100.0F / 256;

/// The nearest and the second nearest.
struct Nearest {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t row = kNone;  ///< of the table
  float distance = 2;         ///< of the nearest
  float second = 2;           ///< of the next one
  std::uint32_t second_row = kNone;

  void offer(std::uint32_t candidate, float at) noexcept {
    if (at < distance) {
      second = distance;
      second_row = row;
      distance = at;
      row = candidate;
    } else if (at < second) {
      second = at;
      second_row = candidate;
    }
  }
  bool isFound() const noexcept { return row != kNone; }
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_MATCHING_DESCRIPTORS_H
