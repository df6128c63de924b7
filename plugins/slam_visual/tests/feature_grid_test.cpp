#include "scene/feature_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using gslam::Feature;
using visual::FeatureGrid;

TEST(FeatureGrid, FindsWhatIsNearAndNothingElse) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> u(-20, 340), v(-20, 260);
  std::vector<Feature> features(500);
  for (Feature& feature : features) {
    feature.pixel = {u(random), v(random)};
    feature.octave = std::int16_t(random() % 8);
  }
  const FeatureGrid grid(features, 320, 240);
  for (int trial = 0; trial < 200; ++trial) {
    const double at_u = double(u(random)), at_v = double(v(random));
    const double radius = 1 + double(random() % 60);
    const int first = int(random() % 8), last = int(random() % 8);
    std::vector<std::uint32_t> found, expected;
    grid.near({at_u, at_v}, radius, first, last, found);
    for (std::size_t i = 0; i < features.size(); ++i) {
      const Feature& f = features[i];
      if (std::fabs(double(f.pixel[0]) - at_u) <= radius &&
          std::fabs(double(f.pixel[1]) - at_v) <= radius && f.octave >= first && f.octave <= last) {
        expected.push_back(std::uint32_t(i));
      }
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << at_u << " " << at_v << " " << radius;
  }
}

TEST(FeatureGrid, OfNothingHasNothing) {
  std::vector<std::uint32_t> found;
  FeatureGrid().near({1, 1}, 100, 0, 7, found);
  FeatureGrid(std::vector<Feature>(), 1, 1).near({1, 1}, 100, 0, 7, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
