// Scripted degradations do what they say, and nothing before and after.
#include "synthetic_frames.h"

namespace {

using namespace synthetic_frames;
using gslam::FrameRanges;

double contrastOf(const gslam::Image& image) {
  double sum = 0, squares = 0;
  const double count = double(image.width()) * image.height();
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const double x = image.at<std::uint8_t>(u, v);
      sum += x / count;
      squares += x * x / count;
    }
  }
  return std::sqrt(squares - sum * sum);
}

SyntheticOptions small() {
  SyntheticOptions options = clean();
  options.width = 160;
  options.height = 120;
  options.frames = 400;
  return options;
}

TEST(SyntheticDegradation, PureRotationStaysInPlaceAndTurns) {
  SyntheticOptions options = small();
  options.pure_rotation = FrameRanges::fromText("100-160,250-300");
  const gslam::Trajectory truth = gslam::openSynthetic(options)->info().ground_truth;
  for (const auto& range : options.pure_rotation.ranges) {
    double turned = 0;
    for (int i = range.first; i <= range.last; ++i) {
      const SE3d& pose = truth[std::size_t(i)].pose;
      const SE3d& first = truth[std::size_t(range.first)].pose;
      EXPECT_LT((pose.translation() - first.translation()).norm(), 1e-9) << i;
      turned = std::max(turned, (first.rotation().inverse() * pose.rotation()).angle());
    }
    EXPECT_GT(turned, 0.15);
  }
  const auto speed = [&](std::size_t i) {
    return (truth[i + 1].pose.translation() - truth[i].pose.translation()).norm() * options.rate;
  };
  EXPECT_GT(speed(50), 0.3);
  EXPECT_GT(speed(200), 0.3);
  EXPECT_GT(truth.length(), 20);
  EXPECT_LT((truth.back().pose.translation() - truth.front().pose.translation()).norm(), 0.1);
}

TEST(SyntheticDegradation, LowTextureLacksContrast) {
  SyntheticOptions options = small();
  options.low_texture = FrameRanges::fromText("20-29");
  const auto dataset = gslam::openSynthetic(options);
  const double before = contrastOf(frameAt(*dataset, 19)->images[0].image);
  const double during = contrastOf(frameAt(*dataset, 25)->images[0].image);
  EXPECT_GT(before, 20);
  EXPECT_LT(during, 5);
  EXPECT_GT(contrastOf(frameAt(*dataset, 30)->images[0].image), 20);
}

TEST(SyntheticDegradation, DroppedFramesLeaveGapsInTime) {
  SyntheticOptions options = small();
  options.dropped = FrameRanges::fromText("0,10-19");
  const auto dataset = gslam::openSynthetic(options);
  ASSERT_EQ(dataset->info().frame_count, 389U);
  ASSERT_EQ(dataset->info().ground_truth.size(), 389U);
  const auto a = frameAt(*dataset, 8), b = dataset->next();
  EXPECT_EQ(a->id, 8U);
  EXPECT_EQ(b->id, 9U);
  EXPECT_EQ(b->stamp - a->stamp, 11 * 50000000);
  EXPECT_EQ(b->imu.size(), 110U);
  options.dropped = FrameRanges();
  EXPECT_EQ(frameAt(*gslam::openSynthetic(options), 20)->images[0].image, b->images[0].image);
}

TEST(SyntheticDegradation, OcclusionHidesHalfOfTheImage) {
  SyntheticOptions options = small();
  options.occlusion = FrameRanges::fromText("50");
  const auto dataset = gslam::openSynthetic(options);
  const auto hidden = frameAt(*dataset, 50);
  options.occlusion = FrameRanges();
  const auto free = frameAt(*gslam::openSynthetic(options), 50);
  int dark = 0, without_depth = 0, same = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const int is = hidden->images[0].image.at<std::uint8_t>(u, v);
      dark += is == 22;
      same += is == free->images[0].image.at<std::uint8_t>(u, v);
      without_depth += hidden->images[1].image.at<float>(u, v) == 0;
    }
  }
  EXPECT_GT(dark, 160 * 120 * 0.4);
  EXPECT_GT(same, 160 * 120 * 0.2);
  EXPECT_NEAR(without_depth, dark, 160 * 120 * 0.1);
}

TEST(SyntheticDegradation, ExposureChangesAndCornersAreDark) {
  SyntheticOptions options = small();
  options.sensors = "mono";
  const auto usual = gslam::openSynthetic(options);
  options.exposure_change = 0.5;
  options.vignette = 0.8;
  const auto changed = gslam::openSynthetic(options);
  const auto ratio = [&](std::size_t frame, int u, int v) {
    return double(frameAt(*changed, frame)->images[0].image.at<std::uint8_t>(u, v)) /
           double(frameAt(*usual, frame)->images[0].image.at<std::uint8_t>(u, v));
  };
  EXPECT_NEAR(ratio(105, 80, 60), 0.5, 0.05);  // three quarters of seven seconds
  EXPECT_NEAR(ratio(0, 0, 0), 0.2, 0.05);
  EXPECT_NEAR(ratio(0, 80, 60), 1, 0.02);
}

TEST(SyntheticDegradation, MoversMoveAndNothingElseDoes) {
  for (const char* world : {"room", "corridor", "street", "aerial"}) {
    SyntheticOptions options = small();
    options.world = world;
    const auto still = gslam::openSynthetic(options);
    options.movers = 12;
    const auto moving = gslam::openSynthetic(options);
    int changed = 0;
    for (std::size_t i = 0; i < 400; i += 40) {
      const auto a = frameAt(*still, i), b = frameAt(*moving, i);
      for (int v = 0; v < 120; ++v) {
        for (int u = 0; u < 160; ++u) {
          const float far = a->images[1].image.at<float>(u, v);
          const float near = b->images[1].image.at<float>(u, v);
          changed += near != far;
          ASSERT_TRUE(near == far || near < far || far == 0) << world;
        }
      }
    }
    EXPECT_GT(changed, 100) << world;
    EXPECT_LT(changed, 10 * 160 * 120 / 2) << world;
  }
}

}  // namespace
