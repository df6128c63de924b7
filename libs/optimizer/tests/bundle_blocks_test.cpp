#include "factors/bundle_blocks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace gslam {
namespace {

using detail::FreeIntrinsics;
using detail::freeIntrinsics;
using Columns = std::vector<std::uint32_t>;

TEST(bundle_blocks, let_fy_follow_fx) {
  const Camera camera = Camera::fromParameters("pinhole", 640, 480, {500, 510, 320, 240});
  const FreeIntrinsics apart = freeIntrinsics(camera, {0x7, false});
  EXPECT_EQ(apart.parameters, (Columns{0, 1, 2}));
  EXPECT_EQ(apart.aspect, 0);
  const FreeIntrinsics together = freeIntrinsics(camera, {0x7, true});
  EXPECT_EQ(together.parameters, (Columns{0, 2}));
  EXPECT_DOUBLE_EQ(together.aspect, 1.02);
  const FreeIntrinsics without_fx = freeIntrinsics(camera, {0x6, true});
  EXPECT_EQ(without_fx.parameters, (Columns{2}));
  EXPECT_EQ(without_fx.aspect, 0);
}

TEST(bundle_blocks, keep_no_aspect_of_a_model_without_focal_lengths) {
  const Camera camera = Camera::fromParameters(
      "ocam", 640, 480, {320, 240, 1.01, 0.01, -0.02, -250, 0.02, 8e-4, -1e-7, 1e-10});
  const FreeIntrinsics both = freeIntrinsics(camera, {0x3, true});  // cx and cy
  EXPECT_EQ(both.parameters, (Columns{0, 1}));
  EXPECT_EQ(both.aspect, 0);
  const Camera sphere = Camera::fromParameters("equirectangular", 640, 320, {});
  EXPECT_TRUE(freeIntrinsics(sphere, {0, true}).parameters.empty());
}

}  // namespace
}  // namespace gslam
