// The inertial unit, the satellites, motion blur: all of the same motion.
#include <gslam/core/trajectory.h>

#include "synthetic_frames.h"

namespace {

using namespace synthetic_frames;

SyntheticOptions fast(const std::string& world) {
  SyntheticOptions options = clean(world);
  options.sensors = "mono";
  options.width = options.height = 2;
  options.rate = 1000;
  options.imu_rate = 10000;
  options.frames = 8001;
  options.speed = world == "room" ? 1.2 : 12;
  options.exposure = 0;
  return options;
}

// Two steps of h at a time, by Simpson's rule.
struct Integrator {
  SO3d rotation;
  Vec3d velocity, place;

  void step(const gslam::ImuSample* s, double h) {
    const Vec3d gravity = {{0, 0, -9.81}};
    const double two = 2 * h;
    const SO3d start = rotation;
    const SO3d middle = start * SO3d::exp(h / 12 * (5 * s[0].gyro + 8 * s[1].gyro - s[2].gyro));
    rotation = start * SO3d::exp(two / 6 * (s[0].gyro + 4 * s[1].gyro + s[2].gyro) +
                                 two * two / 12 * s[0].gyro.cross(s[2].gyro));
    const Vec3d a0 = start * s[0].accel + gravity, a1 = middle * s[1].accel + gravity;
    const Vec3d a2 = rotation * s[2].accel + gravity;
    place += two * velocity + two * two / 6 * (a0 + 2 * a1);
    velocity += two / 6 * (a0 + 4 * a1 + a2);
  }
};

TEST(SyntheticMotion, TheIntegratedInertialUnitIsTheTrajectory) {
  for (const char* world : {"room", "aerial"}) {
    const auto dataset = gslam::openSynthetic(fast(world));
    const gslam::Trajectory& truth = dataset->info().ground_truth;
    std::vector<gslam::ImuSample> samples;
    while (const auto frame = dataset->next()) {
      samples.insert(samples.end(), frame->imu.begin(), frame->imu.end());
    }
    ASSERT_EQ(samples.size(), 10 * (truth.size() - 1) + 1);
    const double h = 1e-3, step = 1e-4;  // of the trajectory, and of the samples
    const auto place = [&](std::size_t i) { return truth[i].pose.translation(); };
    Integrator state = {truth[2].pose.rotation(),
                        (8 * (place(3) - place(1)) - (place(4) - place(0))) / (12 * h), place(2)};
    for (std::size_t i = 20; i + 2 < samples.size(); i += 2) {
      if (i % 1000 == 0) {
        const std::size_t k = i / 10;
        ASSERT_EQ(samples[i].stamp, truth[k].stamp);
        EXPECT_LT((state.place - place(k)).norm(), 1e-4) << world << " " << k;
        EXPECT_TRUE(state.rotation.isApprox(truth[k].pose.rotation(), 1e-4)) << world;
      }
      state.step(&samples[i], step);
    }
  }
}

TEST(SyntheticMotion, SamplesAreThoseSinceTheFrameBefore) {
  SyntheticOptions options = clean();
  options.width = options.height = 4;
  options.frames = 40;
  options.gnss = true;
  options.dropped = gslam::FrameRanges::fromText("10-14");
  const auto dataset = gslam::openSynthetic(options);
  std::int64_t before = -1, last_imu = -1;
  std::size_t count = 0, positions = 0;
  while (const auto frame = dataset->next()) {
    for (const gslam::ImuSample& sample : frame->imu) {
      EXPECT_GT(sample.stamp, before);
      EXPECT_LE(sample.stamp, frame->stamp);
      EXPECT_TRUE(last_imu < 0 || sample.stamp - last_imu == 5000000);
      last_imu = sample.stamp;
      ++count;
    }
    for (const gslam::GnssSample& sample : frame->gnss) {
      EXPECT_TRUE(sample.stamp > before && sample.stamp <= frame->stamp);
    }
    positions += frame->gnss.size();
    before = frame->stamp;
  }
  EXPECT_EQ(count, 391U);
  EXPECT_EQ(positions, 10U);
}

TEST(SyntheticMotion, SatellitesFollowTheTrajectory) {
  SyntheticOptions options = clean("aerial");
  options.width = options.height = 4;
  options.gnss = true;
  options.rate = options.gnss_rate = 5;
  options.frames = 100;
  const auto dataset = gslam::openSynthetic(options);
  const gslam::Trajectory& truth = dataset->info().ground_truth;
  const auto first = dataset->next();
  const gslam::Geodetic origin = first->gnss[0].position;
  while (const auto frame = dataset->next()) {
    ASSERT_EQ(frame->gnss.size(), 1U);
    const gslam::Geodetic& at = frame->gnss[0].position;
    const Vec3d way =
        truth[std::size_t(frame->id)].pose.translation() - truth[0].pose.translation();
    // Radii of curvature of WGS 84 at 47.4 degrees: 6370.2 and 6389.7 km.
    EXPECT_NEAR((at.latitude - origin.latitude) * 6370.7e3, way[1], 0.05);
    EXPECT_NEAR((at.longitude - origin.longitude) * 6390.2e3 * std::cos(0.82729), way[0], 0.05);
    EXPECT_NEAR(at.altitude - origin.altitude, way[2], 0.01);
  }
}

TEST(SyntheticMotion, BlurIsTheMeanOverTheExposure) {
  SyntheticOptions options = clean();
  options.sensors = "mono";
  options.speed = 1;
  options.frames = 60;
  const auto sharp = frameAt(*gslam::openSynthetic(options), 30);
  options.blur = true;
  options.exposure = 0.03;
  const auto blurred = frameAt(*gslam::openSynthetic(options), 30);
  options.blur = false;
  options.exposure = 0;
  options.rate = 1000;
  options.frames = 2000;
  const auto quick = gslam::openSynthetic(options);
  std::vector<double> mean(640 * 480, 0.0);
  for (std::size_t i = 1485; i <= 1515; ++i) {  // 31 times around 1.5 s
    const auto frame = frameAt(*quick, i);
    const double weight = i == 1485 || i == 1515 ? 1 / 60.0 : 1 / 30.0;
    const std::uint8_t* const pixels = frame->images[0].image.bytes();
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += weight * pixels[k];
  }
  double of_blurred = 0, of_sharp = 0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    of_blurred += std::fabs(blurred->images[0].image.bytes()[k] - mean[k]);
    of_sharp += std::fabs(sharp->images[0].image.bytes()[k] - mean[k]);
  }
  EXPECT_LT(of_blurred, 0.5 * of_sharp);
  EXPECT_LT(of_blurred / double(mean.size()), 1.5);
}

}  // namespace
