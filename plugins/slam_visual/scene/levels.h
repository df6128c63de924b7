#ifndef GSLAM_PLUGINS_SLAM_VISUAL_SCENE_LEVELS_H
#define GSLAM_PLUGINS_SLAM_VISUAL_SCENE_LEVELS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace visual {

/// The levels of an image pyramid. A feature of level n has a standard deviation of scale^n pixels.
class Levels {
 public:
  static constexpr int kMost = 16;

  Levels() : Levels(1.2, 8) {}
  Levels(double scale, int count) : log_scale_(std::log(scale)), count_(std::min(count, kMost)) {
    for (int i = 0; i < kMost; ++i) factors_[std::size_t(i)] = std::pow(scale, i);
  }

  int count() const noexcept { return count_; }
  /// Pixels of the image that a pixel of the level has on a side.
  double factor(int level) const noexcept { return factors_[std::size_t(clamped(level))]; }
  /// Inverse variance of a pixel.
  double information(int level) const noexcept { return 1 / (factor(level) * factor(level)); }
  /// The level on which a thing has the same size as it had on level `seen`, when it is `ratio`
  /// times as far away as it was.
  int predicted(int seen, double ratio) const noexcept {
    const double shift = std::log(ratio) / log_scale_;
    return clamped(int(std::lround(double(seen) - std::clamp(shift, -100.0, 100.0))));
  }

 private:
  int clamped(int level) const noexcept { return std::clamp(level, 0, count_ - 1); }

  std::array<double, kMost> factors_{};
  double log_scale_;
  int count_;
};

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_SCENE_LEVELS_H
