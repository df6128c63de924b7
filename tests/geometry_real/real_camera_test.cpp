// Every pixel of every real calibration, there and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "calibrations.h"
#include "test_data.h"

namespace {

using gslam::Camera;
using gslam::Vec2d;
using gslam::Vec3d;

struct RoundTrip {
  std::size_t seen = 0;
  double largest_error = 0;  // pixels
};

RoundTrip roundTrip(const Camera& camera) {
  RoundTrip result;
  const std::size_t width = static_cast<std::size_t>(camera.width());
  std::vector<Vec2d> pixels(width), back(width);
  std::vector<Vec3d> bearings(width);
  std::vector<std::uint8_t> is_valid(width), is_back(width);
  for (int v = 0; v < camera.height(); ++v) {
    for (std::size_t u = 0; u < width; ++u) pixels[u] = {double(u), double(v)};
    result.seen += camera.unprojectMany(pixels, bearings, is_valid);
    (void)camera.projectMany(bearings, back, is_back);
    for (std::size_t u = 0; u < width; ++u) {
      if (is_valid[u] == 0) continue;
      const double error = is_back[u] == 0 ? 1e9 : (back[u] - pixels[u]).norm();
      result.largest_error = std::max(result.largest_error, error);
    }
  }
  return result;
}

TEST(RealCameras, EveryPixelComesBack) {
  NEEDS_TEST_DATA();
  std::map<std::string, int> models;
  for (const auto& named : calibrations::all()) {
    const Camera& camera = named.second;
    const RoundTrip result = roundTrip(camera);
    EXPECT_EQ(result.seen, std::size_t(camera.width()) * std::size_t(camera.height()))
        << named.first << "\n"
        << camera;
    EXPECT_LE(result.largest_error, 1e-12) << named.first << "\n" << camera;
    ++models[camera.modelName()];
  }
  const std::map<std::string, int> expected = {{"double_sphere", 4},  {"equirectangular", 1},
                                               {"eucm", 4},           {"fov", 1},
                                               {"kannala_brandt", 9}, {"ocam", 1},
                                               {"pinhole", 14},       {"radtan", 12}};
  EXPECT_EQ(models, expected);
}

// Largest angle between the bearings of two calibrations of one camera, and their mean, in degrees.
std::pair<double, double> angles(const Camera& a, const Camera& b, int margin) {
  double largest = 0, sum = 0;
  int count = 0;
  for (int v = margin; v < a.height() - margin; v += 8) {
    for (int u = margin; u < a.width() - margin; u += 8) {
      Vec3d p, q;
      EXPECT_TRUE(a.unproject({double(u), double(v)}, p));
      EXPECT_TRUE(b.unproject({double(u), double(v)}, q));
      const double angle = std::atan2(p.cross(q).norm(), p.dot(q)) * 57.29577951308232;
      largest = std::max(largest, angle);
      sum += angle;
      ++count;
    }
  }
  return {largest, sum / count};
}

// Two teams, three models, one lens: conventions that differ would be pixels apart.
TEST(RealCameras, ModelsOfOneLensAgree) {
  NEEDS_TEST_DATA();
  const std::string folder = test_data::folder() + "calibrations/";
  const auto kalibr = calibrations::read(folder + "kalibr/tum_vi/kalibr_imucam_chain.yaml");
  const auto ds = calibrations::read(folder + "basalt/tumvi_512_ds_calib.json");
  const auto eucm = calibrations::read(folder + "basalt/tumvi_512_eucm_calib.json");
  for (std::size_t i = 0; i < 2; ++i) {
    for (const Camera& other : {ds[i].second, eucm[i].second}) {
      const auto found = angles(kalibr[i].second, other, 96);
      EXPECT_LE(found.first, 0.15) << other;  // half a pixel
      EXPECT_LE(found.second, 0.06) << other;
    }
  }
}

}  // namespace
