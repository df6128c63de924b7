// Undistorter: values against a plain evaluation, every SIMD variant and number of threads alike.
#include <gmock/gmock.h>
#include <gslam/geometry/undistort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "refusal.h"

namespace {

using gslam::Camera;
using gslam::ImageSpan;
using gslam::Mat3d;
using gslam::ParallelOptions;
using gslam::Undistorter;
using gslam::Vec2d;
using gslam::Vec3d;
using testing::HasSubstr;

Camera euroc() {
  return Camera::fromParameters(
      "radtan", 752, 480,
      {458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
}

// A width that no number of lanes divides; it sees more than the source, so that all kinds of
// blocks are there.
Camera widePinhole() {
  return Camera::fromParameters("pinhole", 749, 481, {330, 331, 370.3, 241.2});
}

Mat3d smallRotation() {
  const double c = std::cos(0.03), s = std::sin(0.03);
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

// An image with rows apart and nothing behind its last pixel, so that a sanitizer sees reads there.
template <class T>
struct Image {
  Image(int width_, int height_, int channels_, int gap)
      : width(width_),
        height(height_),
        channels(channels_),
        stride(width * channels + gap),
        values(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height - 1) +
               static_cast<std::size_t>(width * channels)) {}

  T& at(int u, int v, int c) {
    return values[static_cast<std::size_t>(v) * static_cast<std::size_t>(stride) +
                  static_cast<std::size_t>(u * channels + c)];
  }
  ImageSpan<T> span() { return {values.data(), width, height, channels, stride}; }
  ImageSpan<const T> view() const { return {values.data(), width, height, channels, stride}; }

  int width, height, channels, stride;
  std::vector<T> values;
};

template <class T>
Image<T> randomImage(const Camera& camera, int channels, int gap = 5) {
  Image<T> image(camera.width(), camera.height(), channels, gap);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(
      0, std::is_same<T, std::uint8_t>::value ? 255.99 : 65535.99);
  for (T& v : image.values) v = static_cast<T>(value(random));
  return image;
}

template <class T>
class UndistortType : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::uint16_t, float>;
TYPED_TEST_SUITE(UndistortType, Types, );

TYPED_TEST(UndistortType, ValuesAreBilinear) {
  using T = TypeParam;
  const Camera source = euroc(), target = widePinhole();
  const Undistorter undistorter(source, target, smallRotation());
  for (const int channels : {1, 3, 4}) {
    Image<T> in = randomImage<T>(source, channels);
    Image<T> out(target.width(), target.height(), channels, 3);
    undistorter.apply(in.view(), out.span(), T(77));
    int seen = 0;
    for (int v = 0; v < target.height(); v += 3) {
      for (int u = 0; u < target.width(); ++u) {
        Vec3d bearing;
        Vec2d at{};
        ASSERT_TRUE(target.unproject({double(u), double(v)}, bearing));
        const bool is_seen = source.project(smallRotation() * bearing, at);
        const double x = std::round(at[0] * 64) / 64, y = std::round(at[1] * 64) / 64;
        const bool is_inside =
            is_seen && x >= 0 && y >= 0 && x <= source.width() - 1 && y <= source.height() - 1;
        ASSERT_EQ(undistorter.mask()[static_cast<std::size_t>(v * target.width() + u)],
                  is_inside ? 1 : 0);
        seen += is_inside ? 1 : 0;
        const int x0 = std::min(static_cast<int>(x), source.width() - 2);
        const int y0 = std::min(static_cast<int>(y), source.height() - 2);
        for (int c = 0; c < channels; ++c) {
          if (!is_inside) {
            ASSERT_EQ(out.at(u, v, c), T(77));
            continue;
          }
          const double fx = x - x0, fy = y - y0;
          const double expected =
              (double(in.at(x0, y0, c)) * (1 - fx) + double(in.at(x0 + 1, y0, c)) * fx) * (1 - fy) +
              (double(in.at(x0, y0 + 1, c)) * (1 - fx) + double(in.at(x0 + 1, y0 + 1, c)) * fx) *
                  fy;
          const double tolerance = std::is_same<T, float>::value ? 0.02 : 0.5;
          ASSERT_NEAR(double(out.at(u, v, c)), expected, tolerance) << u << " " << v;
        }
      }
    }
    EXPECT_GT(seen, 20000);
    EXPECT_LT(seen, 749 * 161);
  }
}

TYPED_TEST(UndistortType, TheSameCameraGivesTheSameImage) {
  using T = TypeParam;
  const Camera camera = Camera::fromParameters("pinhole", 100, 37, {80, 80, 50, 20});
  const Undistorter undistorter(camera, camera);
  for (const int channels : {1, 3, 4}) {
    Image<T> in = randomImage<T>(camera, channels, 0), out = randomImage<T>(camera, channels, 0);
    std::fill(out.values.begin(), out.values.end(), T(0));
    undistorter.apply(in.view(), out.span());
    EXPECT_EQ(in.values, out.values);
  }
}

TYPED_TEST(UndistortType, VariantsAndThreadsAreAlike) {
  using T = TypeParam;
  const Camera source = euroc(), target = widePinhole();
  ParallelOptions one, many;
  one.threads = 1;
  many.threads = 4;
  many.grain = 7;
  const Undistorter first(source, target, smallRotation(), one);
  const Undistorter second(source, target, smallRotation(), many);
  for (const int channels : {1, 3, 4}) {
    const Image<T> in = randomImage<T>(source, channels, 1);
    Image<T> expected(target.width(), target.height(), channels, 2);
    {
      const gslam::ScopedSimd scalar(gslam::Simd::scalar);
      first.apply(in.view(), expected.span(), T(9), one);
    }
    for (const gslam::Simd variant : gslam::availableSimd()) {
      const gslam::ScopedSimd forced(variant);
      for (const ParallelOptions& options : {one, many}) {
        Image<T> out(target.width(), target.height(), channels, 2);
        second.apply(in.view(), out.span(), T(9), options);
        ASSERT_EQ(out.values, expected.values) << gslam::simdName(variant) << " " << channels;
      }
    }
  }
}

// The smallest source there can be, and targets that look at its last pixels only.
TEST(Undistort, LastPixelsOfTheSource) {
  for (const int width : {2, 3, 4, 5, 9}) {
    const Camera source = Camera::fromParameters("pinhole", width, 3, {10, 10, 0, 0});
    const Camera target =
        Camera::fromParameters("pinhole", 24, 24, {200, 200, -20. * (width - 2), -20});
    const Undistorter undistorter(source, target);
    for (const int channels : {1, 3, 4}) {
      Image<std::uint8_t> in = randomImage<std::uint8_t>(source, channels, 0);
      Image<std::uint8_t> expected(24, 24, channels, 0);
      {
        const gslam::ScopedSimd scalar(gslam::Simd::scalar);
        undistorter.apply(in.view(), expected.span());
      }
      EXPECT_EQ(expected.at(0, 0, 0), in.at(width - 2, 1, 0));
      EXPECT_EQ(expected.at(20, 20, 0), in.at(width - 1, 2, 0));
      for (const gslam::Simd variant : gslam::availableSimd()) {
        const gslam::ScopedSimd forced(variant);
        Image<std::uint8_t> out(24, 24, channels, 0);
        undistorter.apply(in.view(), out.span());
        ASSERT_EQ(out.values, expected.values) << gslam::simdName(variant);
      }
    }
  }
}

TEST(Undistort, BetweenModelsAndBack) {
  const Camera fisheye =
      Camera::fromParameters("kannala_brandt", 200, 200, {70, 70, 99.5, 99.5, 0.01, -0.001, 0, 0});
  const Camera panorama = Camera::fromParameters("equirectangular", 400, 200, {});
  Image<float> smooth(200, 200, 1, 0);
  for (int v = 0; v < 200; ++v) {
    for (int u = 0; u < 200; ++u) smooth.at(u, v, 0) = float(u) + 2 * float(v);
  }
  Image<float> there(400, 200, 1, 0), back(200, 200, 1, 0);
  Undistorter(fisheye, panorama).apply(smooth.view(), there.span(), -1.F);
  Undistorter(panorama, fisheye).apply(there.view(), back.span(), -1.F);
  for (int v = 60; v < 140; ++v) {
    for (int u = 60; u < 140; ++u) ASSERT_NEAR(back.at(u, v, 0), smooth.at(u, v, 0), 0.06);
  }
  EXPECT_EQ(there.at(0, 100, 0), -1.F);  // behind
}

TEST(Undistort, CopiesShareTheTable) {
  const Undistorter a(euroc(), widePinhole());
  const Undistorter b = a;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_EQ(a.mask().data(), b.mask().data());
  EXPECT_EQ(b.target(), widePinhole());
  EXPECT_EQ(b.source(), euroc());
}

TEST(Undistort, WhatIsRefused) {
  const Camera small = Camera::fromParameters("pinhole", 1, 5, {1, 1, 0, 0});
  const Camera large = Camera::fromParameters("pinhole", 32768, 5, {1, 1, 0, 0});
  const Camera camera = Camera::fromParameters("pinhole", 8, 6, {1, 1, 0, 0});
  EXPECT_THAT(refusal([&] { Undistorter(Camera(), camera); }), HasSubstr("source is no camera"));
  EXPECT_THAT(refusal([&] { Undistorter(camera, Camera()); }), HasSubstr("target is no camera"));
  EXPECT_THAT(refusal([&] { Undistorter(small, camera); }),
              HasSubstr("source is 1 x 5 pixels, expected 2 to 32767 each way"));
  EXPECT_THAT(refusal([&] { Undistorter(large, camera); }), HasSubstr("source is 32768 x 5"));
  const Undistorter undistorter(camera, camera);
  std::vector<std::uint8_t> in(400), out(400);
  const auto apply = [&](const ImageSpan<const std::uint8_t>& from,
                         const ImageSpan<std::uint8_t>& to) {
    return refusal([&] { undistorter.apply(from, to); });
  };
  EXPECT_EQ(apply({in.data(), 8, 6, 1, 8}, {out.data(), 8, 6, 1, 8}), "taken");
  EXPECT_EQ(apply({in.data(), 8, 5, 1, 8}, {out.data(), 8, 6, 1, 8}),
            "source is 8 x 5 pixels, expected 8 x 6 as its camera has");
  EXPECT_EQ(apply({in.data(), 8, 6, 2, 16}, {out.data(), 8, 6, 2, 16}),
            "source has 2 channels, expected 1, 3 or 4");
  EXPECT_EQ(apply({in.data(), 8, 6, 3, 24}, {out.data(), 8, 6, 1, 24}),
            "target has 1 channels, expected 3 as the source has");
  EXPECT_THAT(apply({in.data(), 8, 6, 1, 7}, {out.data(), 8, 6, 1, 8}),
              HasSubstr("source has a stride of 7, expected 8 or more"));
}

TEST(Undistort, TargetsBeyondMemoryAreRefused) {
  const auto source = gslam::Camera::fromParameters("pinhole", 640, 480, {200, 200, 320, 240});
  const auto target =
      gslam::Camera::fromParameters("pinhole", 2000000000, 2000000000, {200, 200, 320, 240});
  EXPECT_THROW(gslam::Undistorter(source, target), gslam::ArgumentError);
}

}  // namespace
