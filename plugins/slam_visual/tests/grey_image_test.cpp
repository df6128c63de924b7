#include "features/grey_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using gslam::CameraImage;
using gslam::Image;
using gslam::ImageKind;
using gslam::PixelType;
using visual::GreyImage;
using visual::GreyRange;

CameraImage imageOf(Image pixels, ImageKind kind) {
  CameraImage image;
  image.image = std::move(pixels);
  image.kind = kind;
  image.name = "left";
  return image;
}

cv::Mat greyOf(const CameraImage& image, GreyRange& range) {
  GreyImage maker(image.image.width(), image.image.height());
  std::string problem;
  EXPECT_TRUE(maker.accepts(image, problem)) << problem;
  range.widen(image.image);
  return maker.make(image, range).clone();
}

TEST(GreyImage, EightBitsAreNotCopied) {
  const CameraImage image = imageOf(Image(5, 4, PixelType::u8), ImageKind::grey);
  GreyRange range;
  range.widen(image.image);
  GreyImage maker(5, 4);
  EXPECT_EQ(maker.make(image, range).data, image.image.bytes());
}

TEST(GreyImage, ColoursHaveTheirOrderAndWeight) {
  const double weights[] = {0.299, 0.587, 0.114};
  for (PixelType type : {PixelType::u8, PixelType::u16, PixelType::f32}) {
    for (ImageKind kind : {ImageKind::rgb, ImageKind::bgr, ImageKind::rgba, ImageKind::bgra}) {
      const int channels = kind == ImageKind::rgb || kind == ImageKind::bgr ? 3 : 4;
      const bool is_turned = kind == ImageKind::bgr || kind == ImageKind::bgra;
      Image pixels(1, 3, type, channels);
      for (int i = 0; i < 3; ++i) {  // red, green, blue
        const int channel = is_turned ? 2 - i : i;
        if (type == PixelType::u8) pixels.at<std::uint8_t>(0, i, channel) = 255;
        if (type == PixelType::u16) pixels.at<std::uint16_t>(0, i, channel) = 65535;
        if (type == PixelType::f32) pixels.at<float>(0, i, channel) = 1;
      }
      GreyRange range;
      const cv::Mat grey = greyOf(imageOf(pixels, kind), range);
      ASSERT_EQ(grey.type(), CV_8UC1);
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(grey.at<std::uint8_t>(i, 0), 255 * weights[i], 1) << int(type);
      }
    }
  }
}

TEST(GreyImage, WhiteFitsTheBitsThatAreUsed) {
  for (int bits : {8, 9, 10, 12, 14, 16}) {
    Image pixels(40, 30, PixelType::u16);
    for (int i = 0; i < 40 * 30; ++i) {
      pixels.at<std::uint16_t>(i % 40, i / 40) =
          std::uint16_t(((1 << bits) - 1) * i / (40 * 30 - 1));
    }
    GreyRange range;
    const cv::Mat grey = greyOf(imageOf(pixels, ImageKind::grey), range);
    EXPECT_EQ(range.white(), (1 << (bits + 1) / 2 * 2) - 1);
    EXPECT_NEAR(grey.at<std::uint8_t>(29, 39), bits == 9 ? 127 : 255, 1);
    EXPECT_EQ(grey.at<std::uint8_t>(0, 0), 0);
  }
}

TEST(GreyImage, ADeadPixelDoesNotDarkenTheImage) {
  Image pixels(40, 30, PixelType::u16);
  for (int i = 0; i < 40 * 30; ++i) pixels.at<std::uint16_t>(i % 40, i / 40) = 900;
  pixels.at<std::uint16_t>(3, 3) = 65535;
  GreyRange range;
  const cv::Mat grey = greyOf(imageOf(pixels, ImageKind::grey), range);
  EXPECT_EQ(range.white(), 1023);
  EXPECT_NEAR(grey.at<std::uint8_t>(10, 10), 900 * 255 / 1023, 1);
  EXPECT_EQ(grey.at<std::uint8_t>(3, 3), 255);
}

TEST(GreyImage, WhiteNeverFalls) {
  GreyRange range;
  Image bright(4, 4, PixelType::f32), dark(4, 4, PixelType::f32);
  for (int i = 0; i < 16; ++i) bright.at<float>(i % 4, i / 4) = 200;
  range.widen(dark);
  EXPECT_EQ(range.white(), 1);
  range.widen(bright);
  range.widen(dark);
  EXPECT_EQ(range.white(), 255);
}

TEST(GreyImage, NaNIsBlack) {
  Image pixels(2, 2, PixelType::f32);
  pixels.at<float>(0, 0) = std::numeric_limits<float>::quiet_NaN();
  pixels.at<float>(1, 1) = 0.5F;
  GreyRange range;
  const cv::Mat grey = greyOf(imageOf(pixels, ImageKind::grey), range);
  EXPECT_EQ(grey.at<std::uint8_t>(0, 0), 0);
  EXPECT_NEAR(grey.at<std::uint8_t>(1, 1), 128, 1);
}

// Of a surface of one colour nothing of the mosaic is left, whatever it is.
TEST(GreyImage, AMosaicIsSmooth) {
  for (int phase = 0; phase < 4; ++phase) {
    Image pixels(16, 12, PixelType::u8);
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 16; ++x) {
        const int a = (x + phase) % 2, b = (y + phase / 2) % 2;
        pixels.at<std::uint8_t>(x, y) = a == b ? 120 : a == 0 ? 200 : 40;
      }
    }
    GreyRange range;
    const cv::Mat grey = greyOf(imageOf(pixels, ImageKind::bayer), range);
    for (int i = 0; i < 16 * 12; ++i) {
      EXPECT_NEAR(grey.at<std::uint8_t>(i / 16, i % 16), 120, 1) << i << " " << phase;
    }
  }
}

TEST(GreyImage, WhatCannotBeUsedIsNamed) {
  GreyImage maker(5, 4);
  std::string problem;
  EXPECT_FALSE(maker.accepts(imageOf(Image(4, 4, PixelType::u8), ImageKind::grey), problem));
  EXPECT_EQ(problem, "the image of camera 'left' has 4 x 4 pixels, expected 5 x 4 as before");
  EXPECT_FALSE(maker.accepts(imageOf(Image(), ImageKind::grey), problem));
  EXPECT_EQ(problem, "the image of camera 'left' is missing");
  EXPECT_FALSE(maker.accepts(imageOf(Image(5, 4, PixelType::u8), ImageKind::rgb), problem));
  EXPECT_EQ(problem, "the image of camera 'left' has 1 channels, expected 3 for kind rgb");
  EXPECT_FALSE(maker.accepts(imageOf(Image(5, 4, PixelType::f64), ImageKind::grey), problem));
  EXPECT_EQ(problem, "the image of camera 'left' has pixels of f64, expected u8, u16 or f32");
  EXPECT_FALSE(maker.accepts(imageOf(Image(5, 4, PixelType::u16), ImageKind::depth), problem));
  EXPECT_EQ(problem, "the image of camera 'left' is of kind depth, expected brightness");
}

}  // namespace
