// Images: who has which pixels, until when, and what is refused.
#include <gmock/gmock.h>
#include <gslam/core/frame.h>
#include <gslam/core/image.h>
#include <gtest/gtest.h>

#include <atomic>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "problem_when.h"

namespace {

using gslam::ArgumentError;
using gslam::Image;
using gslam::PixelType;
using testing::HasSubstr;

constexpr PixelType kAllTypes[] = {PixelType::u8,  PixelType::i8,  PixelType::u16, PixelType::i16,
                                   PixelType::i32, PixelType::f32, PixelType::f64, PixelType::f16,
                                   PixelType::u32, PixelType::i64, PixelType::u64};

template <class Function>
std::string imageProblem(Function function) {
  return problemWhen<ArgumentError>(function);
}

// Each byte tells where it is.
Image numbered(int width, int height, PixelType type, int channels) {
  Image image(width, height, type, channels);
  for (int y = 0; y < height; ++y) {
    for (std::size_t i = 0; i < image.rowBytes(); ++i) {
      image.bytes(y)[i] = static_cast<std::uint8_t>(31 * std::size_t(y) + i);
    }
  }
  return image;
}

TEST(Image, IsAHandleOf48Bytes) {
  static_assert(std::is_nothrow_copy_constructible<Image>::value, "");
  static_assert(std::is_nothrow_move_constructible<Image>::value, "");
  static_assert(std::is_nothrow_default_constructible<Image>::value, "");
  if (sizeof(void*) == 8) {
    EXPECT_EQ(sizeof(Image), 48U);
  }
}

TEST(Image, NoImage) {
  const Image none;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.width(), 0);
  EXPECT_EQ(none.height(), 0);
  EXPECT_EQ(none.byteCount(), 0U);
  EXPECT_EQ(none.bytes(), nullptr);
  EXPECT_TRUE(none.isDense());
  EXPECT_EQ(none.owner(), nullptr);
  EXPECT_EQ(none.text(), "no image");
  EXPECT_TRUE(none.clone().empty());
  EXPECT_EQ(none, Image(0, 0, PixelType::f64, 3));
  EXPECT_EQ(none.span<std::uint8_t>().height, 0);
}

TEST(Image, HasPixelsOfItsOwnThatAreZeroAndAligned) {
  for (const PixelType type : kAllTypes) {
    for (const int channels : {1, 3, 1000}) {
      const Image image(7, 5, type, channels);
      ASSERT_EQ(reinterpret_cast<std::uintptr_t>(image.bytes()) % 64, 0U);
      ASSERT_EQ(image.rowBytes(), 7 * std::size_t(channels) * gslam::pixelTypeSize(type));
      ASSERT_EQ(image.stride(), image.rowBytes());
      ASSERT_EQ(image.byteCount(), 5 * image.rowBytes());
      ASSERT_TRUE(image.isDense());
      ASSERT_EQ(image.owner().use_count(), 1);
      for (std::size_t i = 0; i < image.byteCount(); ++i) ASSERT_EQ(image.bytes()[i], 0);
    }
  }
}

TEST(Image, PixelsAreFoundByColumnRowAndChannel) {
  Image image(4, 3, PixelType::u16, 2);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      for (int c = 0; c < 2; ++c)
        image.at<std::uint16_t>(x, y, c) = std::uint16_t(100 * y + 10 * x + c);
    }
  }
  const Image& same = image;
  EXPECT_EQ(same.row<std::uint16_t>(2)[7], 231);
  EXPECT_EQ(same.at<std::uint16_t>(3, 2, 1), 231);
  const gslam::ImageSpan<const std::uint16_t> span = same.span<std::uint16_t>();
  EXPECT_EQ(span.data[2 * span.stride + 3 * span.channels + 1], 231);
  EXPECT_EQ(span.width, 4);
  EXPECT_EQ(span.height, 3);
  EXPECT_EQ(image.span<std::uint16_t>().data, span.data);
  static_assert(std::is_same<decltype(same.row<std::uint16_t>(0)), const std::uint16_t*>::value,
                "");
  static_assert(std::is_same<decltype(same.bytes()), const std::uint8_t*>::value, "");
  static_assert(std::is_same<decltype(image.row<std::uint16_t>(0)), std::uint16_t*>::value, "");
}

TEST(Image, CopiesShareAndClonesDoNot) {
  Image image = numbered(5, 4, PixelType::f32, 3);
  Image copy = image;
  EXPECT_EQ(copy.bytes(), image.bytes());
  EXPECT_GT(image.owner().use_count(), 1);
  const Image clone = image.clone();
  EXPECT_EQ(clone.owner().use_count(), 1);
  EXPECT_NE(clone.bytes(), image.bytes());
  EXPECT_EQ(clone, image);
  image.bytes()[7] ^= 1;
  EXPECT_EQ(copy, image);
  EXPECT_NE(clone, image);
  copy = Image();
  EXPECT_EQ(image.owner().use_count(), 1);
}

// Looks at what was moved from: that is what these tests are about.
// NOLINTBEGIN(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
TEST(Image, WhatWasMovedFromIsNoImage) {
  Image image = numbered(5, 4, PixelType::f32, 3);
  const std::uint8_t* const pixels = image.bytes();
  Image moved(std::move(image));
  EXPECT_EQ(moved.bytes(), pixels);
  EXPECT_TRUE(image.empty());
  EXPECT_EQ(image.bytes(), nullptr);
  EXPECT_EQ(image.width(), 0);
  EXPECT_EQ(image.byteCount(), 0U);
  EXPECT_EQ(image.owner(), nullptr);
  EXPECT_EQ(image, Image());
  image = numbered(1, 1, PixelType::u8, 1);
  image = std::move(moved);
  EXPECT_EQ(image.bytes(), pixels);
  EXPECT_TRUE(moved.empty());
  Image& itself = image;
  image = std::move(itself);
  EXPECT_EQ(image.bytes(), pixels);
  EXPECT_EQ(image.owner().use_count(), 1);
  moved.swap(image);
  EXPECT_EQ(moved.bytes(), pixels);
  EXPECT_TRUE(image.empty());
}

TEST(Image, WhatHoldsAnImageMovesIt) {
  static_assert(std::is_nothrow_move_constructible<gslam::CameraImage>::value, "");
  static_assert(std::is_nothrow_move_constructible<gslam::Frame>::value, "");
  gslam::CameraImage first;
  first.image = numbered(5, 4, PixelType::u8, 1);
  const std::uint8_t* const pixels = first.image.bytes();
  gslam::CameraImage second(std::move(first));
  EXPECT_TRUE(first.image.empty());
  EXPECT_EQ(first.image.bytes(), nullptr);
  gslam::Frame frame;
  frame.images.push_back(std::move(second));
  EXPECT_TRUE(second.image.empty());
  const gslam::Frame moved(std::move(frame));
  EXPECT_TRUE(frame.images.empty());
  EXPECT_EQ(moved.images[0].image.bytes(), pixels);
  EXPECT_EQ(moved.images[0].image.owner().use_count(), 1);
}
// NOLINTEND(bugprone-use-after-move,clang-analyzer-cplusplus.Move)

TEST(Image, AViewIsAPartWithTheSamePixels) {
  for (const PixelType type : kAllTypes) {
    for (const int channels : {1, 3}) {
      const Image image = numbered(9, 8, type, channels);
      const std::size_t pixel = std::size_t(channels) * gslam::pixelTypeSize(type);
      for (int y = 0; y < 8; y += 3) {
        for (int x = 0; x < 9; x += 2) {
          const Image part = image.view(x, y, 9 - x, 8 - y);
          ASSERT_EQ(part.bytes(), image.bytes(y) + std::size_t(x) * pixel);
          ASSERT_EQ(part.bytes(7 - y), image.bytes(7) + std::size_t(x) * pixel);
          ASSERT_EQ(part.stride(), image.stride());
          ASSERT_EQ(part.bytes() + part.byteCount(), image.bytes() + image.byteCount());
          ASSERT_EQ(part.isDense(), x == 0 || y == 7);
          ASSERT_EQ(part.owner(), image.owner());
        }
      }
      const Image inner = image.view(1, 1, 7, 6).view(2, 3, 2, 2);
      ASSERT_EQ(inner.bytes(), image.view(3, 4, 2, 2).bytes());
    }
  }
}

TEST(Image, AViewKeepsThePixelsAlive) {
  Image part;
  {
    const Image image = numbered(5, 4, PixelType::u8, 1);
    part = image.view(2, 1, 2, 2);
  }
  EXPECT_EQ(part.owner().use_count(), 1);
  EXPECT_EQ(part.at<std::uint8_t>(1, 1), 31 * 2 + 3);
}

TEST(Image, AViewOutsideIsRefused) {
  const Image image(5, 4, PixelType::u8);
  const int bad[][4] = {{-1, 0, 2, 2}, {0, -1, 2, 2},      {4, 0, 2, 1},       {0, 3, 1, 2},
                        {0, 0, 6, 1},  {0, 0, 1, 5},       {0, 0, 0, 1},       {0, 0, 1, 0},
                        {5, 4, 0, 0},  {INT_MAX, 0, 1, 1}, {1, 1, INT_MAX, 1}, {INT_MIN, 0, 1, 1},
                        {0, 0, -1, -1}};
  for (const auto& part : bad) {
    EXPECT_THAT(imageProblem([&] { image.view(part[0], part[1], part[2], part[3]); }),
                HasSubstr("inside of 5 x 4 u8"));
  }
  EXPECT_THROW(Image().view(0, 0, 1, 1), ArgumentError);
}

TEST(Image, ACloneOfAViewIsDense) {
  const Image image = numbered(9, 8, PixelType::i16, 3);
  const Image part = image.view(2, 1, 5, 6);
  const Image clone = part.clone();
  EXPECT_FALSE(part.isDense());
  EXPECT_TRUE(clone.isDense());
  EXPECT_EQ(clone.stride(), clone.rowBytes());
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(clone.bytes()) % 64, 0U);
  EXPECT_EQ(clone, part);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 5; ++x) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(clone.at<std::int16_t>(x, y, c), image.at<std::int16_t>(x + 2, y + 1, c));
      }
    }
  }
}

TEST(Image, EqualityIsOfSizeTypeAndPixelsOnly) {
  const Image image = numbered(4, 4, PixelType::u8, 1);
  EXPECT_NE(image, Image());
  EXPECT_NE(image, image.view(0, 0, 4, 3));
  EXPECT_NE(image, image.view(0, 0, 3, 4));
  Image as_signed = Image::wrap(const_cast<std::uint8_t*>(image.bytes()), 4, 4, PixelType::i8, 1, 0,
                                image.owner());
  EXPECT_NE(image, as_signed);
  Image pairs(2, 4, PixelType::u8, 2), singles(4, 4, PixelType::u8, 1);
  EXPECT_NE(pairs, singles);
  // What stands in the gaps between rows does not count.
  std::vector<std::uint8_t> memory(64, 1);
  const Image wide = Image::wrap(memory.data(), 4, 4, PixelType::u8, 1, 16, nullptr);
  const Image clone = wide.clone();
  memory[5] = 2;
  EXPECT_EQ(wide, clone);
  memory[3] = 2;
  EXPECT_NE(wide, clone);
}

TEST(Image, ForeignPixelsAreReleasedOnceByTheLastHandle) {
  int released = 0;
  std::vector<std::uint8_t> memory(100);
  {
    Image part;
    {
      const Image image =
          Image::wrap(memory.data(), 10, 10, PixelType::u8, 1, 10, [&released] { ++released; });
      EXPECT_EQ(image.bytes(), memory.data());
      EXPECT_EQ(image.owner().get(), memory.data());
      part = image.view(1, 1, 3, 3);
      const Image moved = Image(image);
    }
    EXPECT_EQ(released, 0);
    part = part.view(1, 1, 1, 1);
    EXPECT_EQ(released, 0);
  }
  EXPECT_EQ(released, 1);
}

TEST(Image, ReleaseIsCalledWhenAnExceptionPassesTheImage) {
  int released = 0;
  std::uint8_t memory[4] = {};
  try {
    const Image image = Image::wrap(memory, 2, 2, PixelType::u8, 1, 0, [&released] { ++released; });
    const std::vector<Image> copies(3, image);
    throw std::runtime_error("on the way");
  } catch (const std::runtime_error&) {
    EXPECT_EQ(released, 1);
  }
  EXPECT_EQ(released, 1);
}

TEST(Image, WhatIsRefusedIsNotReleased) {
  int released = 0;
  std::uint8_t memory[64] = {};
  const std::function<void()> release = [&released] { ++released; };
  EXPECT_THROW(Image::wrap(memory, -1, 2, PixelType::u8, 1, 0, release), ArgumentError);
  EXPECT_THROW(Image::wrap(nullptr, 2, 2, PixelType::u8, 1, 0, release), ArgumentError);
  EXPECT_THROW(Image::wrap(memory, 4, 2, PixelType::u8, 1, 3, release), ArgumentError);
  EXPECT_EQ(released, 0);
  Image::wrap(nullptr, 0, 0, PixelType::u8, 1, 0, release);  // no image has nothing to keep
  EXPECT_EQ(released, 1);
  const Image kept = Image::wrap(memory, 2, 2, PixelType::u8, 1, 0, std::function<void()>());
  EXPECT_FALSE(kept.empty());
}

TEST(Image, AnOwnerIsKept) {
  const auto owner = std::make_shared<std::vector<float>>(12, 1.5F);
  const std::weak_ptr<std::vector<float>> seen = owner;
  Image image =
      Image::wrap(owner->data(), 4, 3, PixelType::f32, 1, 0, std::shared_ptr<void>(owner));
  EXPECT_EQ(seen.use_count(), 2);
  const Image part = image.view(0, 0, 1, 1);
  EXPECT_EQ(seen.use_count(), 3);
  EXPECT_GT(image.owner().use_count(), 1);
  std::uint8_t memory[4] = {};
  EXPECT_EQ(Image::wrap(memory, 2, 2, PixelType::u8, 1, 0, nullptr).owner(), nullptr);
}

TEST(Image, ThreadsLetGoOfForeignPixelsOnce) {
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> released{0};
    std::vector<std::uint8_t> memory(64);
    {
      const Image image =
          Image::wrap(memory.data(), 8, 8, PixelType::u8, 1, 0, [&released] { ++released; });
      std::vector<std::thread> threads;
      for (int t = 0; t < 4; ++t) {
        threads.emplace_back(
            [t](Image mine) {
              for (int i = 0; i < 100; ++i) mine = mine.view(0, 0, mine.width(), mine.height());
              mine = Image(t + 1, 1, PixelType::u8);
            },
            image);
      }
      for (std::thread& thread : threads) thread.join();
      EXPECT_EQ(released, 0);
    }
    ASSERT_EQ(released, 1);
  }
}

TEST(Image, SizesThatCannotBeAreRefused) {
  EXPECT_THAT(imageProblem([] { Image(-1, 5, PixelType::u8); }), HasSubstr("-1 x 5"));
  EXPECT_THAT(imageProblem([] { Image(0, 5, PixelType::u8); }), HasSubstr("0 x 5"));
  EXPECT_THAT(imageProblem([] { Image(5, 0, PixelType::u8); }), HasSubstr("5 x 0"));
  EXPECT_THAT(imageProblem([] { Image(5, 5, PixelType::u8, 0); }), HasSubstr("channels is 0"));
  EXPECT_THAT(imageProblem([] { Image(5, 5, PixelType::u8, 65536); }), HasSubstr("65536"));
  EXPECT_THAT(imageProblem([] { Image(5, 5, static_cast<PixelType>(11)); }), HasSubstr("no type"));
  EXPECT_THAT(imageProblem([] { Image(INT_MAX, INT_MAX, PixelType::u8); }), HasSubstr("memory"));
  EXPECT_THAT(imageProblem([] { Image(INT_MAX, 1, PixelType::f64, 65535); }), HasSubstr("memory"));
  EXPECT_THAT(imageProblem([] { Image(INT_MAX, INT_MAX, PixelType::u64, 65535); }),
              HasSubstr("memory"));
  // 2^64 bytes and a few more, which a product of 64 bits would take for a few.
  EXPECT_THAT(imageProblem([] { Image(1 << 30, 1 << 30, PixelType::u8, 16); }),
              HasSubstr("memory"));
}

TEST(Image, StridesThatCannotBeAreRefused) {
  alignas(8) std::uint8_t memory[256] = {};
  const auto wrap = [&memory](int width, int height, PixelType type, std::size_t stride) {
    return imageProblem([&] { Image::wrap(memory, width, height, type, 1, stride, nullptr); });
  };
  EXPECT_THAT(wrap(5, 2, PixelType::u8, 4), HasSubstr("expected 5"));
  EXPECT_THAT(wrap(4, 2, PixelType::f32, 18), HasSubstr("multiple"));
  EXPECT_THAT(wrap(4, 2, PixelType::f32, SIZE_MAX - 3), HasSubstr("memory"));
  EXPECT_THAT(wrap(4, INT_MAX, PixelType::u8, std::size_t(1) << 40), HasSubstr("memory"));
  EXPECT_THAT(imageProblem([&] { Image::wrap(memory + 1, 2, 2, PixelType::u16, 1, 0, nullptr); }),
              HasSubstr("aligned for u16"));
  EXPECT_THAT(imageProblem([&] { Image::wrap(memory + 4, 2, 2, PixelType::f64, 1, 0, nullptr); }),
              HasSubstr("aligned for f64"));
  EXPECT_THAT(imageProblem([&] { Image::wrap(nullptr, 2, 2, PixelType::u8, 1, 0, nullptr); }),
              HasSubstr("null"));
}

TEST(Image, WrongTypesAndPlacesAreRefused) {
  Image image(4, 3, PixelType::u8, 2);
  const Image& same = image;
  EXPECT_THAT(imageProblem([&] { image.row<float>(0); }), HasSubstr("f32"));
  EXPECT_THAT(imageProblem([&] { same.row<std::int8_t>(0); }), HasSubstr("i8"));
  EXPECT_THROW(image.span<double>(), ArgumentError);
  EXPECT_THROW(same.span<double>(), ArgumentError);
  EXPECT_THROW(image.at<double>(0, 0), ArgumentError);
  const int bad[][3] = {{4, 0, 0}, {0, 3, 0}, {0, 0, 2}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (const auto& place : bad) {
    EXPECT_THAT(imageProblem([&] { image.at<std::uint8_t>(place[0], place[1], place[2]); }),
                HasSubstr("outside of 4 x 3 u8 x 2"));
    EXPECT_THROW(same.at<std::uint8_t>(place[0], place[1], place[2]), ArgumentError);
  }
  EXPECT_THROW(Image().at<std::uint8_t>(0, 0), ArgumentError);
}

TEST(PixelType, NamesAndSizesGoWithTheCppTypes) {
  const std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 2, 4, 8, 8};
  for (std::size_t i = 0; i < 11; ++i) EXPECT_EQ(gslam::pixelTypeSize(kAllTypes[i]), sizes[i]);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kAllTypes[i]), i);  // the numbers stand in files
    EXPECT_EQ(std::stoul(std::string(gslam::pixelTypeName(kAllTypes[i])).substr(1)), 8 * sizes[i]);
  }
  EXPECT_EQ(gslam::pixelTypeSize(static_cast<PixelType>(11)), 0U);
  EXPECT_STREQ(gslam::pixelTypeName(static_cast<PixelType>(255)), "unknown");
}

template <class T>
void expectType(PixelType type, char letter) {
  const PixelType found = gslam::PixelTypeOf<T>::value;
  EXPECT_EQ(found, type);
  EXPECT_EQ(gslam::pixelTypeSize(found), sizeof(T));
  EXPECT_EQ(gslam::pixelTypeName(found)[0], letter);
}

TEST(PixelType, OfCppTypes) {
  expectType<std::uint8_t>(PixelType::u8, 'u');
  expectType<std::int8_t>(PixelType::i8, 'i');
  expectType<std::uint16_t>(PixelType::u16, 'u');
  expectType<std::int16_t>(PixelType::i16, 'i');
  expectType<std::uint32_t>(PixelType::u32, 'u');
  expectType<std::int32_t>(PixelType::i32, 'i');
  expectType<std::uint64_t>(PixelType::u64, 'u');
  expectType<std::int64_t>(PixelType::i64, 'i');
  expectType<float>(PixelType::f32, 'f');
  expectType<double>(PixelType::f64, 'f');
}

}  // namespace
