#include "matching/descriptors.h"

#include <gslam/base/error.h>
#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using gslam::Image;
using gslam::PixelType;
using visual::distanceOf;
using visual::distancesTo;

Image randomBits(int bytes, int rows, unsigned seed) {
  std::mt19937 random(seed);
  Image image(bytes, rows, PixelType::u8);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < bytes; ++x) image.at<std::uint8_t>(x, y) = std::uint8_t(random());
  }
  return image;
}

float countedBits(const Image& table, int a, int b) {
  int bits = 0;
  for (int x = 0; x < table.width(); ++x) {
    for (int bit = 0; bit < 8; ++bit) {
      bits += ((table.at<std::uint8_t>(x, a) ^ table.at<std::uint8_t>(x, b)) >> bit) & 1;
    }
  }
  return float(bits) / float(8 * table.width());
}

TEST(Descriptors, BitsOfAnyLengthAreCountedByAllVariants) {
  for (int bytes : {1, 7, 8, 16, 31, 32, 33, 61, 64}) {
    const Image table = randomBits(bytes, 20, unsigned(bytes));
    const std::vector<std::uint32_t> rows = {3, 0, 19, 3, 7};
    for (gslam::Simd variant : gslam::availableSimd()) {
      const gslam::ScopedSimd forced(variant);
      std::vector<float> distances;
      distancesTo(table.bytes(5), table, rows, distances);
      ASSERT_EQ(distances.size(), rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_NEAR(distances[i], countedBits(table, 5, int(rows[i])), 1e-6) << bytes;
        EXPECT_EQ(distances[i], distanceOf(table.bytes(5), table.bytes(int(rows[i])), table));
      }
    }
  }
}

TEST(Descriptors, RowsMayHaveGaps) {
  const Image wide = randomBits(40, 6, 1);
  const Image table = wide.view(4, 0, 32, 6);
  std::vector<float> distances;
  const std::vector<std::uint32_t> rows = {0, 5};
  distancesTo(table.bytes(2), table, rows, distances);
  EXPECT_NEAR(distances[0], countedBits(table, 2, 0), 1e-6);
  EXPECT_NEAR(distances[1], countedBits(table, 2, 5), 1e-6);
}

TEST(Descriptors, AllBitsOrNoneAreOneAndZero) {
  Image table(32, 2, PixelType::u8);
  std::fill_n(table.bytes(1), 32, std::uint8_t(255));
  EXPECT_EQ(distanceOf(table.bytes(0), table.bytes(1), table), 1);
  EXPECT_EQ(distanceOf(table.bytes(1), table.bytes(1), table), 0);
}

TEST(Descriptors, FloatsAreComparedWithTheirLengths) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (int size : {1, 3, 64, 127, 128}) {
    Image table(size, 4, PixelType::f32);
    for (int y = 1; y < 4; ++y) {  // the first one is zero
      for (int x = 0; x < size; ++x) table.at<float>(x, y) = 100 * normal(random);
    }
    const std::vector<std::uint32_t> rows = {0, 1, 2, 3};
    for (int query = 0; query < 4; ++query) {
      std::vector<float> distances;
      distancesTo(table.bytes(query), table, rows, distances);
      for (int row = 0; row < 4; ++row) {
        double difference = 0, a = 0, b = 0;
        for (int x = 0; x < size; ++x) {
          const double p = double(table.at<float>(x, query)), q = double(table.at<float>(x, row));
          difference += (p - q) * (p - q);
          a += p * p;
          b += q * q;
        }
        const double most = std::sqrt(a) + std::sqrt(b);
        const double expected = most > 0 ? std::sqrt(difference) / most : 0;
        EXPECT_NEAR(double(distances[std::size_t(row)]), expected, 1e-5);
        EXPECT_EQ(distances[std::size_t(row)],
                  distanceOf(table.bytes(query), table.bytes(row), table));
      }
    }
  }
}

TEST(Descriptors, OtherNumbersAreRefused) {
  const Image table(8, 2, PixelType::f64);
  EXPECT_THROW(distanceOf(table.bytes(0), table.bytes(1), table), gslam::ArgumentError);
}

TEST(Descriptors, NearestKeepsTwo) {
  visual::Nearest nearest;
  EXPECT_FALSE(nearest.isFound());
  nearest.offer(7, 0.5F);
  nearest.offer(8, 0.2F);
  nearest.offer(9, 0.3F);
  EXPECT_EQ(nearest.row, 8U);
  EXPECT_EQ(nearest.second_row, 9U);
  EXPECT_EQ(nearest.second, 0.3F);
}

}  // namespace
