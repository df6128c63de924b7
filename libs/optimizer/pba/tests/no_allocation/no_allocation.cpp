// A program of its own, since it counts what all of a program allocates.
#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "pose_scene.h"
#include "pose_tools.h"
#include "solvers.h"

namespace {
std::atomic<std::size_t> pose_test_allocations(0);

void* countedAllocation(std::size_t size) {
  pose_test_allocations.fetch_add(1, std::memory_order_relaxed);
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

// Out of line, or g++ takes free() and operator new for a pair that does not match.
GSLAM_COLD void* operator new(std::size_t size) {
  return countedAllocation(size);
}
GSLAM_COLD void* operator new[](std::size_t size) {
  return countedAllocation(size);
}
GSLAM_COLD void operator delete(void* memory) noexcept {
  std::free(memory);
}
GSLAM_COLD void operator delete[](void* memory) noexcept {
  std::free(memory);
}
GSLAM_COLD void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
GSLAM_COLD void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

using pose_tools::withLoss;

TEST(pose_no_allocation, in_any_path) {
  pose_scene::PoseScene scene =
      pose_scene::makeScene({pose_scene::pinhole(), pose_scene::radtan(5),
                             pose_scene::camerasOfAllModels()[6], pose_scene::radtan(14)},
                            1500, 1.0, 0.2);
  pose_scene::addRight(scene, 1.0);
  pose_scene::addInformation(scene);
  gslam::PosePrior prior{scene.start, gslam::Mat<double, 6, 6>::identity()};
  gslam::PoseProblem problem = scene.problem();
  problem.prior = &prior;
  for (const gslam::LossKind kind : pose_tools::kLosses) {
    const gslam::OptimizerOptions options = withLoss(kind, 20);
    (void)gslam::activeSimd();
    const std::size_t before = pose_test_allocations.load();
    const gslam::OptimizedPose result =
        gslam::detail::pba::solvePose(problem, scene.start, options);
    EXPECT_EQ(pose_test_allocations.load(), before);
    EXPECT_TRUE(result.is_usable);
  }
}

}  // namespace
