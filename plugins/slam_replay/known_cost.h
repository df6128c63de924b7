#ifndef GSLAM_PLUGINS_SLAM_REPLAY_KNOWN_COST_H
#define GSLAM_PLUGINS_SLAM_REPLAY_KNOWN_COST_H

#include <memory>
#include <vector>

#include "options.h"

namespace replay {

/// Costs what it is told, a frame. What it keeps it gives back at its end.
class KnownCost {
 public:
  explicit KnownCost(const CostOptions& options);

  /// Does the work of one frame.
  /// @throws std::bad_alloc
  void spend();

 private:
  void allocate();
  void burn() const;
  void grow();

  CostOptions options_;
  std::vector<void*> blocks_;  // of the frame in work
  std::vector<std::unique_ptr<char[]>> kept_;
};

}  // namespace replay

#endif  // GSLAM_PLUGINS_SLAM_REPLAY_KNOWN_COST_H
