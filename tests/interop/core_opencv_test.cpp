// Image and cv::Mat have the same pixels, and keep them alive for one another.
#include <gmock/gmock.h>
#include <gslam/core/opencv.h>
#include <gslam/geometry/opencv.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <numeric>
#include <opencv2/core.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using gslam::ArgumentError;
using gslam::fromOpenCv;
using gslam::Image;
using gslam::PixelType;
using gslam::toOpenCv;
using testing::HasSubstr;

// Memory that is freed when it is given back, so that the address sanitizer sees what comes later.
struct Pixels {
  Pixels(int width, int height, int channels, std::size_t stride)
      : bytes(new std::uint8_t[stride * std::size_t(height)]) {
    std::iota(bytes, bytes + stride * std::size_t(height), std::uint8_t(1));
    image = Image::wrap(bytes, width, height, PixelType::u8, channels, stride, [this] {
      delete[] bytes;
      ++released;
    });
  }
  std::uint8_t* bytes;
  std::atomic<int> released{0};
  Image image;
};

template <class Function>
std::string problemOf(Function function) {
  try {
    function();
  } catch (const ArgumentError& error) {
    return error.what();
  }
  return "";
}

TEST(CoreOpenCv, AllTypesBothWays) {
  const std::pair<PixelType, int> types[] = {{PixelType::u8, CV_8U},   {PixelType::i8, CV_8S},
                                             {PixelType::u16, CV_16U}, {PixelType::i16, CV_16S},
                                             {PixelType::i32, CV_32S}, {PixelType::f32, CV_32F},
                                             {PixelType::f64, CV_64F},
#ifdef CV_16F
                                             {PixelType::f16, CV_16F}
#endif
  };
  for (const auto& type : types) {
    for (const int channels : {1, 2, 3, 4, 7, 512}) {
      const Image image(5, 3, type.first, channels);
      const cv::Mat mat = toOpenCv(image);
      ASSERT_EQ(mat.type(), CV_MAKETYPE(type.second, channels));
      ASSERT_EQ(mat.size(), cv::Size(5, 3));
      ASSERT_EQ(mat.data, image.bytes());
      ASSERT_EQ(mat.step[0], image.stride());
      ASSERT_TRUE(mat.isContinuous());
      const Image again = fromOpenCv(mat);
      ASSERT_EQ(again.bytes(), image.bytes());
      ASSERT_EQ(again, image);
      ASSERT_EQ(toOpenCv(again).data, mat.data);
      const cv::Mat made(3, 5, CV_MAKETYPE(type.second, channels));
      ASSERT_EQ(fromOpenCv(made).type(), type.first);
      ASSERT_EQ(fromOpenCv(made).channels(), channels);
      ASSERT_EQ(fromOpenCv(made).bytes(), made.data);
    }
  }
}

TEST(CoreOpenCv, PixelsAreWhereTheyWere) {
  Image image(4, 3, PixelType::u16, 3);
  image.at<std::uint16_t>(2, 1, 1) = 4711;
  const cv::Mat mat = toOpenCv(image);
  EXPECT_EQ(mat.at<cv::Vec3w>(1, 2)[1], 4711);
  const cv::Mat made(2, 2, CV_32FC2, cv::Scalar(1.5, 2.5));
  EXPECT_EQ(fromOpenCv(made).at<float>(1, 1, 1), 2.5F);
}

TEST(CoreOpenCv, WhatIsEmptyStaysEmpty) {
  EXPECT_TRUE(toOpenCv(Image()).empty());
  EXPECT_TRUE(fromOpenCv(cv::Mat()).empty());
  EXPECT_TRUE(fromOpenCv(cv::Mat(0, 5, CV_8U)).empty());
}

TEST(CoreOpenCv, TheMatrixKeepsTheImageAlive) {
  Pixels pixels(4, 3, 1, 16);
  cv::Mat mat = toOpenCv(std::move(pixels.image));
  pixels.image = Image();
  EXPECT_EQ(pixels.released, 0);
  cv::Mat copy = mat;
  cv::Mat part = mat(cv::Rect(1, 1, 2, 2));
  mat.release();
  EXPECT_EQ(pixels.released, 0);
  EXPECT_EQ(copy.at<std::uint8_t>(1, 1), 18);
  copy = cv::Mat();
  EXPECT_EQ(pixels.released, 0);
  EXPECT_EQ(part.at<std::uint8_t>(0, 0), 18);
  cv::Size whole;
  cv::Point offset;
  part.locateROI(whole, offset);
  EXPECT_EQ(offset, cv::Point(1, 1));
  part.adjustROI(1, 0, 1, 0);
  EXPECT_EQ(part.at<std::uint8_t>(0, 0), 1);
  part.release();
  EXPECT_EQ(pixels.released, 1);
}

TEST(CoreOpenCv, TheImageKeepsTheMatrixAlive) {
  Image image, part;
  {
    cv::Mat mat(6, 5, CV_8UC3, cv::Scalar(1, 2, 3));
    image = fromOpenCv(mat);
    part = fromOpenCv(mat(cv::Rect(1, 2, 3, 3)));
    EXPECT_EQ(mat.u->refcount, 3);
  }
  EXPECT_EQ(image.at<std::uint8_t>(4, 5, 2), 3);
  image = Image();
  EXPECT_EQ(part.at<std::uint8_t>(2, 2, 1), 2);
  EXPECT_FALSE(part.isDense());
  const Image view = part.view(1, 1, 1, 1);
  part = Image();
  EXPECT_EQ(view.at<std::uint8_t>(0, 0, 2), 3);
}

TEST(CoreOpenCv, ViewsAndStridesGoBothWays) {
  Pixels pixels(4, 3, 2, 20);
  const Image view = pixels.image.view(1, 1, 2, 2);
  const cv::Mat mat = toOpenCv(view);
  EXPECT_EQ(mat.step[0], 20U);
  EXPECT_FALSE(mat.isContinuous());
  EXPECT_EQ(mat.at<cv::Vec2b>(1, 1), cv::Vec2b(45, 46));
  const Image back = fromOpenCv(mat(cv::Rect(1, 0, 1, 2)));
  EXPECT_EQ(back.bytes(), view.bytes() + 2);
  EXPECT_EQ(back.stride(), 20U);
  EXPECT_EQ(fromOpenCv(mat.row(1)).bytes(), view.bytes(1));
  EXPECT_EQ(fromOpenCv(mat.col(1)).bytes(1), view.bytes(1) + 2);
}

TEST(CoreOpenCv, NewMemoryIsOpenCvsOwn) {
  Pixels pixels(4, 3, 1, 4);
  cv::Mat mat = toOpenCv(pixels.image);
  cv::Mat clone = mat.clone();
  EXPECT_NE(clone.data, mat.data);
  EXPECT_NE(clone.u->currAllocator, mat.u->currAllocator);
  const cv::Mat again = mat;
  mat.create(3, 4, CV_8U);  // the same size and type: the same pixels
  EXPECT_EQ(mat.data, pixels.image.bytes());
  mat.create(8, 8, CV_8U);
  EXPECT_NE(mat.data, pixels.image.bytes());
  mat.setTo(1);
  cv::Mat grown = again;
  grown.resize(9);
  grown.setTo(2);
  EXPECT_EQ(grown.rows, 9);
  cv::Mat sum;
  cv::add(again, again, sum);
  EXPECT_EQ(sum.at<std::uint8_t>(0, 1), 4);
  cv::Mat converted = again;
  converted.convertTo(converted, CV_32F);
  EXPECT_EQ(converted.at<float>(0, 1), 2.F);
  EXPECT_EQ(pixels.image.at<std::uint8_t>(1, 0), 2);  // none of it wrote to the image
  cv::Mat in_place = again;
  in_place = 7;
  EXPECT_EQ(pixels.image.at<std::uint8_t>(1, 0), 7);  // but this did
}

TEST(CoreOpenCv, RoundTripsDoNotPileUp) {
  Pixels pixels(4, 3, 1, 4);
  std::weak_ptr<void> owner = pixels.image.owner();
  Image image = std::move(pixels.image);
  pixels.image = Image();
  for (int i = 0; i < 1000; ++i) image = fromOpenCv(toOpenCv(image));
  EXPECT_EQ(image.owner(), owner.lock());
  EXPECT_EQ(image.bytes(), pixels.bytes);
  cv::Mat mat = toOpenCv(std::move(image));
  image = Image();
  for (int i = 0; i < 1000; ++i) mat = toOpenCv(fromOpenCv(mat));
  EXPECT_EQ(pixels.released, 0);
  mat.release();
  EXPECT_EQ(pixels.released, 1);
}

TEST(CoreOpenCv, EveryOrderOfReleaseIsRight) {
  for (int order = 0; order < 24; ++order) {
    Pixels pixels(4, 3, 1, 4);
    {
      Image image = std::move(pixels.image);
      pixels.image = Image();
      cv::Mat mat = toOpenCv(image);
      Image back = fromOpenCv(mat.rowRange(1, 3));
      cv::Mat part = toOpenCv(back)(cv::Rect(1, 0, 2, 1));
      std::vector<int> left = {0, 1, 2, 3};
      for (int i = 4, code = order; i > 0; code /= i--) {
        const int which = left[std::size_t(code % i)];
        left.erase(left.begin() + code % i);
        ASSERT_EQ(pixels.released, 0);
        if (which == 0) image = Image();
        if (which == 1) mat.release();
        if (which == 2) back = Image();
        if (which == 3) part.release();
      }
    }
    ASSERT_EQ(pixels.released, 1);
  }
}

TEST(CoreOpenCv, AUniversalMatrixKeepsThePixelsToo) {
  Pixels pixels(4, 3, 1, 4);
  {
    cv::UMat universal;
    {
      const cv::Mat mat = toOpenCv(std::move(pixels.image));
      pixels.image = Image();
      universal = mat.getUMat(cv::ACCESS_RW);
      EXPECT_EQ(mat.data[1], 2);
    }
    EXPECT_EQ(pixels.released, 0);
    const cv::Mat seen = universal.getMat(cv::ACCESS_READ);
    EXPECT_EQ(seen.at<std::uint8_t>(0, 1), 2);
  }
  EXPECT_EQ(pixels.released, 1);
  cv::UMat copy;
  toOpenCv(Image(4, 3, PixelType::u8)).copyTo(copy);
  EXPECT_EQ(copy.rows, 3);
}

TEST(CoreOpenCv, ThreadsMayLetGoAtTheSameTime) {
  for (int round = 0; round < 50; ++round) {
    Pixels pixels(64, 8, 1, 64);
    {
      const cv::Mat mat = toOpenCv(std::move(pixels.image));
      pixels.image = Image();
      std::vector<std::thread> threads;
      for (int t = 0; t < 4; ++t) {
        threads.emplace_back(
            [&pixels, t](cv::Mat mine) {
              for (int i = 0; i < 100; ++i) {
                Image image = fromOpenCv(mine.row(t));
                const cv::Mat part = toOpenCv(image);
                ASSERT_EQ(part.data, pixels.bytes + 64 * t);
                image = Image();
                ASSERT_EQ(part.at<std::uint8_t>(0, 1), std::uint8_t(64 * t + 2));
              }
            },
            mat);
      }
      for (std::thread& thread : threads) thread.join();
    }
    ASSERT_EQ(pixels.released, 1);
  }
}

TEST(CoreOpenCv, PixelsOfNobodyAreKeptByTheCaller) {
  std::uint8_t bytes[12] = {};
  const cv::Mat foreign(3, 4, CV_8U, bytes);
  const Image image = fromOpenCv(foreign);
  EXPECT_EQ(image.bytes(), bytes);
  EXPECT_EQ(image.owner(), nullptr);
  EXPECT_NE(image.clone().owner(), nullptr);
  const Image lent = Image::wrap(bytes, 4, 3, PixelType::u8, 1, 0, std::shared_ptr<void>());
  EXPECT_EQ(fromOpenCv(toOpenCv(lent)).owner(), nullptr);
}

TEST(CoreOpenCv, OneRowHasNoGap) {
  Pixels pixels(4, 1, 1, 16);
  EXPECT_EQ(fromOpenCv(toOpenCv(pixels.image)), pixels.image);
}

TEST(CoreOpenCv, WhatTheOtherSideLacksIsRefused) {
  for (const PixelType type : {PixelType::u32, PixelType::i64, PixelType::u64}) {
    EXPECT_THAT(problemOf([type] { toOpenCv(Image(2, 2, type)); }),
                HasSubstr(gslam::pixelTypeName(type)));
  }
  EXPECT_THAT(problemOf([] { toOpenCv(Image(2, 2, PixelType::u8, 513)); }), HasSubstr("513"));
  const int sizes[] = {2, 3, 4};
  EXPECT_THAT(problemOf([&sizes] { fromOpenCv(cv::Mat(3, sizes, CV_8U)); }), HasSubstr("3 dim"));
  alignas(8) std::uint8_t bytes[64] = {};
  const cv::Mat crooked(2, 2, CV_32F, bytes + 1);
  EXPECT_THAT(problemOf([&crooked] { fromOpenCv(crooked); }), HasSubstr("not aligned"));
}

}  // namespace
