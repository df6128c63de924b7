// Every seed gives a sequence that can be used.
#include "synthetic_frames.h"

namespace {

using namespace synthetic_frames;

// The whole sphere, coarsely: one depth camera looks forward, one back.
SyntheticOptions lookingAround(const std::string& world, std::uint64_t seed) {
  SyntheticOptions options = clean(world);
  options.seed = seed;
  options.rate = 2;
  options.frames = 60;
  options.imu = false;
  options.movers = 3;
  const Camera camera = Camera::fromParameters("equirectangular", 48, 24, {});
  const SO3d back = SO3d::exp({{0, 0, 3.14159265358979}});
  options.cameras = {sensor("front", ImageKind::depth, camera, SE3d(forward(), Vec3d{})),
                     sensor("back", ImageKind::depth, camera, SE3d(back * forward(), Vec3d{}))};
  return options;
}

class SyntheticWorld : public testing::TestWithParam<const char*> {};

TEST_P(SyntheticWorld, TheCameraKeepsAwayFromThings) {
  const std::string world = GetParam();
  const bool is_inside = world == "room" || world == "corridor";
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto dataset = gslam::openSynthetic(lookingAround(world, seed));
    double nearest = 1e9;
    int unseen = 0, seen = 0;
    while (const auto frame = dataset->next()) {
      for (const CameraImage& image : frame->images) {
        for (int v = 0; v < 24; ++v) {
          for (int u = 0; u < 48; ++u) {
            Vec3d bearing{};
            ASSERT_TRUE(image.camera.unproject({{double(u), double(v)}}, bearing));
            if (bearing[2] < 0.1) continue;
            const double depth = double(image.image.at<float>(u, v));
            ++(depth > 0 ? seen : unseen);
            if (depth > 0) nearest = std::min(nearest, depth / bearing[2]);
          }
        }
      }
    }
    EXPECT_GT(nearest, is_inside ? 0.35 : 1.0) << world << " " << seed;
    EXPECT_TRUE(unseen == 0 || !is_inside) << unseen << world << " " << seed;
    EXPECT_GT(seen, unseen / 2) << world << " " << seed;
  }
}

TEST_P(SyntheticWorld, TheLoopCloses) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SyntheticOptions options = clean(GetParam());
    options.seed = seed;
    options.width = options.height = 2;
    const auto dataset = gslam::openSynthetic(options);
    const gslam::Trajectory& truth = dataset->info().ground_truth;
    EXPECT_GE(truth.length(), 20) << seed;
    const SE3d way = truth.front().pose.inverse() * truth.back().pose;
    EXPECT_LT(way.translation().norm(), 0.02 + 1e-3 * truth.length()) << seed;
    EXPECT_LT(way.rotation().angle(), 0.02) << seed;
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const SE3d step = truth[i - 1].pose.inverse() * truth[i].pose;
      ASSERT_LT(step.rotation().angle() * options.rate, 1.6) << seed << " " << i;
    }
  }
}

// Part of the blocks of 20 x 20 pixels in which something is to be seen.
double texturedPart(const CameraImage& image, const CameraImage& depth) {
  int textured = 0, all = 0;
  for (int v = 0; v + 20 <= image.image.height(); v += 20) {
    for (int u = 0; u + 20 <= image.image.width(); u += 20) {
      double sum = 0, squares = 0;
      bool is_sky = false;
      for (int y = v; y < v + 20; ++y) {
        for (int x = u; x < u + 20; ++x) {
          const double b = image.image.at<std::uint8_t>(x, y);
          sum += b / 400;
          squares += b * b / 400;
          is_sky = is_sky || !(depth.image.at<float>(x, y) > 0);
        }
      }
      if (is_sky || sum > 225) continue;  // or a lamp
      ++all;
      textured += squares - sum * sum > 9;
    }
  }
  EXPECT_GT(all, 12);
  return double(textured) / all;
}

TEST_P(SyntheticWorld, TextureIsEverywhere) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SyntheticOptions options = clean(GetParam());
    options.seed = seed;
    options.width = 200;
    options.height = 160;
    options.frames = 300;
    const auto dataset = gslam::openSynthetic(options);
    for (std::size_t i = 0; i < 300; i += 60) {
      const auto frame = frameAt(*dataset, i);
      EXPECT_GT(texturedPart(frame->images[0], frame->images[1]), 0.9) << seed << " " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SyntheticWorld,
                         testing::Values("room", "corridor", "street", "aerial"));

TEST(SyntheticWorld, RoomsAreLarge) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto dataset = gslam::openSynthetic(lookingAround("room", seed));
    Vec3d low = {{1e9, 1e9, 1e9}}, high = -low;
    while (const auto frame = dataset->next()) {
      for (std::size_t image = 0; image < 2; ++image) {
        const DepthView view(*dataset, *frame, image);
        for (int v = 2; v < 22; ++v) {
          for (int u = 13; u < 35; ++u) {
            Vec3d place{};
            if (!view.point({{double(u), double(v)}}, view.depthAt(u, v), place)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
              low[k] = std::min(low[k], place[k]);
              high[k] = std::max(high[k], place[k]);
            }
          }
        }
      }
    }
    EXPECT_GE(high[0] - low[0], 6) << seed;
    EXPECT_GE(high[1] - low[1], 8) << seed;
    EXPECT_NEAR(low[2], 0, 0.01) << seed;
  }
}

}  // namespace
