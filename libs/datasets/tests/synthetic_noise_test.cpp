// Errors of the sensors are as large as the options say, and nothing but the seed makes them.
#include <cstring>

#include "synthetic_frames.h"

namespace {

using namespace synthetic_frames;

struct Moments {
  double mean = 0, deviation = 0;
};

Moments momentsOf(const std::vector<double>& x) {
  Moments m;
  for (const double one : x) m.mean += one / double(x.size());
  for (const double one : x) m.deviation += (one - m.mean) * (one - m.mean) / double(x.size());
  m.deviation = std::sqrt(m.deviation);
  return m;
}

TEST(SyntheticNoise, OfImagesAndDepthIsAsStated) {
  SyntheticOptions options = clean();
  options.colour = true;
  const auto without = frameAt(*gslam::openSynthetic(options), 40);
  options.noise = 1;
  const auto dataset = gslam::openSynthetic(options);
  const auto with = frameAt(*dataset, 40), later = frameAt(*dataset, 41);
  std::vector<double> of_channel[3], of_depth, products;
  double last = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      for (int c = 0; c < 3; ++c) {
        const double is = with->images[0].image.at<std::uint8_t>(u, v, c);
        const double was = without->images[0].image.at<std::uint8_t>(u, v, c);
        if (was < 12 || was > 243) continue;
        of_channel[c].push_back(is - was);
        if (c == 0) products.push_back((is - was) * last);
        last = c == 0 ? is - was : last;
      }
      const double depth = double(without->images[1].image.at<float>(u, v));
      if (!(depth > 0)) continue;
      of_depth.push_back((double(with->images[1].image.at<float>(u, v)) - depth) / (depth * depth));
    }
  }
  for (const std::vector<double>& differences : of_channel) {
    const Moments m = momentsOf(differences);
    EXPECT_NEAR(m.mean, 0, 0.08);  // what is painted in one grey is rounded to one side
    EXPECT_NEAR(m.deviation, std::sqrt(4 + 2 / 12.0), 0.03);  // both were rounded
  }
  EXPECT_NEAR(momentsOf(products).mean, 0, 0.05);  // neighbours are independent
  EXPECT_NEAR(momentsOf(of_depth).mean, 0, 2e-5);
  EXPECT_NEAR(momentsOf(of_depth).deviation, 0.0015, 2e-5);
}

std::vector<gslam::ImuSample> imuOf(const SyntheticOptions& options) {
  std::vector<gslam::ImuSample> samples;
  const auto dataset = gslam::openSynthetic(options);
  while (const auto frame = dataset->next()) {
    samples.insert(samples.end(), frame->imu.begin(), frame->imu.end());
  }
  return samples;
}

TEST(SyntheticNoise, OfTheInertialUnitIsAsStated) {
  SyntheticOptions options = clean();
  options.sensors = "mono";
  options.width = options.height = 2;
  options.frames = 2000;
  options.rate = 10;
  options.speed = 1;
  const std::vector<gslam::ImuSample> without = imuOf(options);
  options.noise = 1;
  const std::vector<gslam::ImuSample> with = imuOf(options);
  ASSERT_EQ(with.size(), without.size());
  std::vector<double> gyro, accel, gyro_walk, accel_walk;
  const std::size_t second = 200;
  for (std::size_t i = 1; i < with.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto error = [&](std::size_t j) { return with[j].gyro[k] - without[j].gyro[k]; };
      const auto force = [&](std::size_t j) { return with[j].accel[k] - without[j].accel[k]; };
      gyro.push_back((error(i) - error(i - 1)) / std::sqrt(2.0));
      accel.push_back((force(i) - force(i - 1)) / std::sqrt(2.0));
    }
  }
  // Means over a second, whose noise is known, walk away.
  for (std::size_t i = 0; i + 20 * second <= with.size(); i += second) {
    for (std::size_t k = 0; k < 3; ++k) {
      double gyro_change = 0, accel_change = 0;
      for (std::size_t j = 0; j < second; ++j) {
        const std::size_t late = i + 19 * second + j, early = i + j;
        gyro_change += (with[late].gyro[k] - without[late].gyro[k] - with[early].gyro[k] +
                        without[early].gyro[k]) /
                       double(second);
        accel_change += (with[late].accel[k] - without[late].accel[k] - with[early].accel[k] +
                         without[early].accel[k]) /
                        double(second);
      }
      gyro_walk.push_back(gyro_change);
      accel_walk.push_back(accel_change);
    }
  }
  EXPECT_NEAR(momentsOf(gyro).deviation, 1.7e-4 * std::sqrt(200), 3e-5);
  EXPECT_NEAR(momentsOf(accel).deviation, 2e-3 * std::sqrt(200), 3e-4);
  const auto square = [](double x) { return x * x; };
  EXPECT_NEAR(momentsOf(gyro_walk).deviation, std::sqrt(19 * square(2e-5) + 2 * square(1.7e-4)),
              6e-5);
  EXPECT_NEAR(momentsOf(accel_walk).deviation, std::sqrt(19 * square(3e-3) + 2 * square(2e-3)),
              4e-3);
  const gslam::ImuCalibration told = gslam::openSynthetic(options)->info().sensors.imu;
  EXPECT_EQ(told.gyro_noise, 1.7e-4);
  EXPECT_EQ(told.rate, 200);
}

bool isSame(const Frame& a, const Frame& b) {
  if (a.images.size() != b.images.size() || a.imu.size() != b.imu.size()) return false;
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    if (a.images[i].image != b.images[i].image) return false;
  }
  return a.imu.empty() ||
         std::memcmp(a.imu.data(), b.imu.data(), a.imu.size() * sizeof(a.imu[0])) == 0;
}

TEST(SyntheticNoise, EqualOptionsMakeEqualBytesOnAnyNumberOfThreads) {
  for (const char* world : {"room", "aerial"}) {
    SyntheticOptions options;
    options.world = world;
    options.width = 321;  // not whole tiles
    options.height = 203;
    options.movers = 2;
    options.colour = true;
    options.threads = 1;
    const auto one = gslam::openSynthetic(options);
    const auto third = frameAt(*one, 3), far = frameAt(*one, 200);
    for (const int threads : {2, 5}) {
      options.threads = threads;
      const auto several = gslam::openSynthetic(options);
      EXPECT_TRUE(isSame(*far, *frameAt(*several, 200))) << world;  // in another order
      EXPECT_TRUE(isSame(*third, *frameAt(*several, 3))) << world;
    }
    options.seed = 2;
    const auto other = frameAt(*gslam::openSynthetic(options), 3);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NE(third->images[i].image, other->images[i].image);
    EXPECT_FALSE(isSame(*third, *far));
  }
}

}  // namespace
