#include <gslam/datasets.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

int main() {
  gslam::SyntheticOptions options = gslam::syntheticOptions("synthetic://room?seed=7&frames=60");
  options.width = 320;
  options.height = 240;
  const auto dataset = gslam::openSynthetic(options);
  double nearest = 1e9;
  while (const auto frame = dataset->next()) {
    const gslam::CameraImage* depth = gslam::findImage(*frame, gslam::ImageKind::depth);
    const int middle = depth->image.at<std::uint16_t>(160, 120);
    nearest = std::min(nearest, middle * depth->depth_scale);
  }
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  std::printf("%zu poses, %.1f m, nearest ahead %.2f m\n", truth.size(), truth.length(), nearest);
  return truth.size() == 60 && nearest > 0.3 ? 0 : 1;
}
