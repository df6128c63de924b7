// Depth, poses and images agree.
#include "synthetic_frames.h"

namespace {

using namespace synthetic_frames;

TEST(SyntheticGeometry, PixelsReprojectToTheSameSurface) {
  for (const char* world : {"room", "corridor", "street", "aerial"}) {
    SyntheticOptions options = clean(world);
    options.seed = 3;
    const auto dataset = gslam::openSynthetic(options);
    for (const std::size_t first : {20U, 310U}) {
      const auto a = frameAt(*dataset, first), b = frameAt(*dataset, first + 8);
      const ThereAndBack result =
          thereAndBack(DepthView(*dataset, *a, 1), DepthView(*dataset, *b, 1), 0.05);
      EXPECT_GT(result.seen, 1500) << world;
      EXPECT_EQ(result.wrong, 0) << world << " of " << result.seen;
      EXPECT_LT(result.hidden, result.seen / 10) << world;
    }
  }
}

TEST(SyntheticGeometry, EveryCameraModelSeesTheSameSurfaces) {
  for (const std::string& model : Camera::modelNames()) {
    SyntheticOptions options = clean();
    options.model = model;
    options.width = 480;
    options.height = 320;
    if (model == "equirectangular") options.width = 640;
    const auto dataset = gslam::openSynthetic(options);
    const auto a = frameAt(*dataset, 100), b = frameAt(*dataset, 106);
    const ThereAndBack result =
        thereAndBack(DepthView(*dataset, *a, 1), DepthView(*dataset, *b, 1), 0.05);
    EXPECT_GT(result.seen, 500) << model;
    EXPECT_LE(result.wrong, result.seen / 200) << model << " of " << result.seen;
    EXPECT_LT(result.hidden, result.seen / 10) << model;
  }
}

TEST(SyntheticGeometry, DisparityAgreesWithDepth) {
  SyntheticOptions options = clean();
  const Camera camera = Camera::fromParameters("pinhole", 640, 480, {400, 400, 319.5, 239.5});
  const double baseline = 0.12;
  const SE3d left(forward(), {{0, 0, 0}}), right(forward(), {{0, -baseline, 0}});
  options.cameras = {sensor("left", ImageKind::grey, camera, left),
                     sensor("right", ImageKind::grey, camera, right),
                     sensor("left_depth", ImageKind::depth, camera, left),
                     sensor("right_depth", ImageKind::depth, camera, right)};
  const auto dataset = gslam::openSynthetic(options);
  const auto frame = frameAt(*dataset, 200);
  const DepthView other(*dataset, *frame, 3);
  const gslam::Image& l = frame->images[0].image;
  const gslam::Image& r = frame->images[1].image;
  int seen = 0, agree = 0;
  std::vector<double> right_place, wrong_place;
  for (int v = 5; v < 475; v += 3) {
    for (int u = 5; u < 635; u += 3) {
      const double depth = double(frame->images[2].image.at<float>(u, v));
      const double to = u - 400 * baseline / depth;
      double found = 0;
      if (!(depth > 0) || to < 4 || !other.interpolate({{to, double(v)}}, found)) continue;
      ++seen;
      if (std::fabs(400 * baseline * (1 / found - 1 / depth)) > 0.05) continue;
      ++agree;
      const auto brightness = [&](double x) {
        const int i = int(x);
        return (1 - (x - i)) * r.at<std::uint8_t>(i, v) + (x - i) * r.at<std::uint8_t>(i + 1, v);
      };
      right_place.push_back(std::fabs(brightness(to) - l.at<std::uint8_t>(u, v)));
      wrong_place.push_back(std::fabs(brightness(to - 3) - l.at<std::uint8_t>(u, v)));
    }
  }
  EXPECT_GT(seen, 15000);
  EXPECT_GT(agree, seen * 0.95);
  const auto mean = [](const std::vector<double>& x) {
    double sum = 0;
    for (const double one : x) sum += one;
    return sum / double(x.size());
  };
  EXPECT_LT(mean(right_place), 3);
  EXPECT_GT(mean(wrong_place), 3 * mean(right_place));
}

TEST(SyntheticGeometry, WholeNumbersOfDepthAreThatDepth) {
  SyntheticOptions options = clean("street");
  const auto exact = frameAt(*gslam::openSynthetic(options), 50);
  options.depth_float = false;
  options.depth_max = 10;
  const auto whole = frameAt(*gslam::openSynthetic(options), 50);
  const double scale = whole->images[1].depth_scale;
  EXPECT_EQ(scale, 0.002);
  int beyond = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const double depth = double(exact->images[1].image.at<float>(u, v));
      const double found = whole->images[1].image.at<std::uint16_t>(u, v) * scale;
      if (depth > 10) {
        ++beyond;
        EXPECT_EQ(found, 0);
      } else {
        EXPECT_NEAR(found, depth, 0.51 * scale);
      }
    }
  }
  EXPECT_GT(beyond, 0);
}

}  // namespace
