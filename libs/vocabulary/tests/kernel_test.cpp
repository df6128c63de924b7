// The nearest of a few rows, by every variant of SIMD, against plain loops.

// Compiled with -O3 (CMakeLists.txt), with which compilers fuse products and sums across functions;
// so what is included is renamed, or the linker would take the kernels of other tests.
#define v1 optimised
#include <gslam/base/simd.h>
#include <gslam/vocabulary/detail/exact_sum.h>
#include <gslam/vocabulary/detail/nearest.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "random_tree.h"

namespace {

using gslam::DescriptorFormat;
using gslam::DescriptorType;
using gslam::Simd;
using gslam::detail::Choice;
using gslam::detail::Visit;
using random_tree::formatOf;

// Bytes that begin at an odd address and end where their memory ends, so that who reads more is
// seen by a sanitizer.
class Bytes {
 public:
  explicit Bytes(std::size_t size, std::size_t shift = 1)
      : memory_(new std::uint8_t[size + shift]()), shift_(shift) {}
  std::uint8_t* data() { return memory_.get() + shift_; }

 private:
  std::unique_ptr<std::uint8_t[]> memory_;
  std::size_t shift_;
};

std::uint32_t hamming(const std::uint8_t* a, const std::uint8_t* b, std::size_t size) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < size * 8; ++i) {
    bits += ((a[i / 8] ^ b[i / 8]) >> (i % 8)) & 1U;
  }
  return bits;
}

long double valueOf(const DescriptorFormat& format, const std::uint8_t* row, std::size_t i) {
  if (format.type == DescriptorType::float32) {
    float value = 0;
    std::memcpy(&value, row + i * 4, 4);
    return value;
  }
  if (format.type == DescriptorType::int8) {
    const long double step = static_cast<std::int8_t>(row[i]);
    return float(format.offset + format.scale * step);
  }
  std::uint16_t half = 0;
  std::memcpy(&half, row + i * 2, 2);
  const int exponent = (half >> 10) & 31;
  const long double fraction = half & 1023;
  const long double magnitude =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

long double squaredDistance(const DescriptorFormat& format, const float* query,
                            const std::uint8_t* row) {
  long double sum = 0;
  for (std::size_t i = 0; i < format.size; ++i) {
    const long double difference = query[i] - valueOf(format, row, i);
    sum += difference * difference;
  }
  return sum;
}

std::string nameOf(const testing::TestParamInfo<Simd>& info) {
  return gslam::simdName(info.param);
}

class BinaryKernel : public testing::TestWithParam<Simd> {
 protected:
  // One call for all rows, and what plain loops choose.
  static void check(std::uint32_t size, std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const DescriptorFormat format = formatOf(DescriptorType::binary, size);
    const std::size_t stride = gslam::detail::strideOf(format);
    Bytes rows(count * stride);
    Bytes query(stride, 3);
    random_tree::fillRow(random, format, query.data());
    for (std::uint32_t c = 0; c < count; ++c) {
      std::memcpy(rows.data() + c * stride, query.data(), stride);
      random_tree::vary(random, format, size, rows.data() + c * stride);
    }
    std::uint32_t expected = 0;
    for (std::uint32_t c = 1; c < count; ++c) {
      if (hamming(query.data(), rows.data() + c * stride, size) <
          hamming(query.data(), rows.data() + expected * stride, size)) {
        expected = c;
      }
    }
    const Visit visit = {query.data(), rows.data(), count, 0};
    Choice choice = {999, -1};
    gslam::detail::binaryKernel().exact(GetParam())(format, stride, &visit, 1, &choice);
    ASSERT_EQ(choice.index, expected) << size << " bytes, " << count << " rows";
    ASSERT_EQ(choice.distance, float(hamming(query.data(), rows.data() + expected * stride, size)));
  }
};

TEST_P(BinaryKernel, ChoosesTheNearestOfAnyLength) {
  for (std::uint32_t size = 1; size <= 513; ++size) check(size, 10, size);
}

TEST_P(BinaryKernel, ChoosesTheNearestOfAnyNumber) {
  for (const std::uint32_t size : {32U, 31U, 64U, 61U}) {
    for (std::uint32_t count = 1; count <= 64; ++count) {
      for (std::uint32_t seed = 0; seed < 20; ++seed) check(size, count, seed);
    }
  }
}

TEST_P(BinaryKernel, TakesTheFirstOfEquals) {
  const DescriptorFormat format = formatOf(DescriptorType::binary, 32);
  for (std::uint32_t count = 1; count <= 64; ++count) {
    for (std::uint32_t first = 0; first < count; ++first) {
      Bytes rows(count * 32UL);
      Bytes query(32);
      // Before the first of the nearest all are a bit worse, and behind it as good.
      for (std::uint32_t c = 0; c < first; ++c) rows.data()[c * 32 + c % 32] = 1;
      const Visit visit = {query.data(), rows.data(), count, 0};
      Choice choice = {999, -1};
      gslam::detail::binaryKernel().exact(GetParam())(format, 32, &visit, 1, &choice);
      ASSERT_EQ(choice.index, first) << count;
    }
  }
}

TEST_P(BinaryKernel, KnowsTheLargestDistance) {
  for (const std::uint32_t size : {8U, 32U, 64U, 513U, 4096U}) {
    const DescriptorFormat format = formatOf(DescriptorType::binary, size);
    const std::size_t stride = gslam::detail::strideOf(format);
    Bytes rows(64 * stride);
    Bytes query(stride);
    std::memset(query.data(), 255, size);
    const Visit visit = {query.data(), rows.data(), 64, 0};
    Choice choice = {999, -1};
    gslam::detail::binaryKernel().exact(GetParam())(format, stride, &visit, 1, &choice);
    EXPECT_EQ(choice.index, 0U);
    EXPECT_EQ(choice.distance, float(size * 8));
  }
}

INSTANTIATE_TEST_SUITE_P(simd, BinaryKernel,
                         testing::ValuesIn(gslam::detail::binaryKernel().variants()), nameOf);

#if GSLAM_X86
TEST(binary_kernel, WithoutTheInstructionThatCountsIsTheSame) {
  if (!gslam::detail::detectCpu().avx512) GTEST_SKIP() << "this machine has no AVX-512";
  std::mt19937 random(5);
  for (std::uint32_t size = 1; size <= 80; ++size) {
    const DescriptorFormat format = formatOf(DescriptorType::binary, size);
    const std::size_t stride = gslam::detail::strideOf(format);
    for (std::uint32_t count = 1; count <= 64; ++count) {
      Bytes rows(count * stride);
      Bytes query(stride);
      for (std::uint32_t c = 0; c < count; ++c) {
        random_tree::fillRow(random, format, rows.data() + c * stride);
      }
      const Visit visit = {query.data(), rows.data(), count, 0};
      Choice choice = {999, -1};
      Choice expected = {999, -1};
      gslam::detail::chooseBinaryAvx512(format, stride, &visit, 1, &choice);
      gslam::detail::chooseBinaryScalar(format, stride, &visit, 1, &expected);
      ASSERT_EQ(choice.index, expected.index);
      ASSERT_EQ(choice.distance, expected.distance);
    }
  }
}
#endif

class FloatKernel : public testing::TestWithParam<Simd> {
 protected:
  static Choice choose(const DescriptorFormat& format, const std::vector<float>& query,
                       const std::uint8_t* rows, std::uint32_t count) {
    // A query of its own size: who reads more is seen.
    const Visit visit = {reinterpret_cast<const std::uint8_t*>(query.data()), rows, count, 0};
    Choice choice = {999, -1};
    gslam::detail::floatKernel().exact(GetParam())(format, gslam::detail::strideOf(format), &visit,
                                                   1, &choice);
    return choice;
  }

  static void check(const DescriptorFormat& format, std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const std::size_t stride = gslam::detail::strideOf(format);
    Bytes rows(count * stride, 4);
    for (std::uint32_t c = 0; c < count; ++c) {
      random_tree::fillRow(random, format, rows.data() + c * stride);
    }
    const std::vector<float> query = random_tree::floats(format.size, seed + 1);
    std::uint32_t expected = 0;
    for (std::uint32_t c = 1; c < count; ++c) {
      if (squaredDistance(format, query.data(), rows.data() + c * stride) <
          squaredDistance(format, query.data(), rows.data() + expected * stride)) {
        expected = c;
      }
    }
    const Choice choice = choose(format, query, rows.data(), count);
    ASSERT_EQ(choice.index, expected) << format.size << " numbers, " << count << " rows";
    const long double distance =
        squaredDistance(format, query.data(), rows.data() + expected * stride);
    ASSERT_NEAR(choice.distance, double(distance), double(distance) * 1e-6 * (format.size + 8));
  }
};

TEST_P(FloatKernel, ChoosesTheNearestOfAnyLength) {
  for (const DescriptorType type :
       {DescriptorType::float32, DescriptorType::float16, DescriptorType::int8}) {
    for (std::uint32_t size = 1; size <= 513; ++size) check(formatOf(type, size), 10, size);
  }
}

TEST_P(FloatKernel, ChoosesTheNearestOfAnyNumber) {
  for (const DescriptorType type :
       {DescriptorType::float32, DescriptorType::float16, DescriptorType::int8}) {
    for (std::uint32_t count = 1; count <= 64; ++count) check(formatOf(type, 61), count, count);
  }
}

// All rows are nearly as far, and the sums of floats are in any order.
TEST_P(FloatKernel, IsNotDeceivedByRounding) {
  const DescriptorFormat format = formatOf(DescriptorType::float32, 128);
  std::mt19937 random(7);
  int deceived = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<float> query = random_tree::floats(128, static_cast<std::uint32_t>(trial));
    std::vector<float> differences =
        random_tree::floats(128, static_cast<std::uint32_t>(trial + 9));
    std::vector<float> rows(640, 0);
    for (std::size_t c = 0; c < 5; ++c) {
      // The same differences in another order.
      std::shuffle(differences.begin(), differences.end(), random);
      for (std::size_t i = 0; i < 128; ++i) rows[c * 128 + i] = query[i] + differences[i];
    }
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(rows.data());
    std::uint32_t expected = 0;
    std::uint32_t rounded = 0;
    float least = std::numeric_limits<float>::max();
    for (std::uint32_t c = 0; c < 5; ++c) {
      if (squaredDistance(format, query.data(), bytes + c * 512) <
          squaredDistance(format, query.data(), bytes + expected * 512)) {
        expected = c;
      }
      float sum = 0;
      for (std::size_t i = 0; i < 128; ++i) {
        const float difference = query[i] - rows[c * 128 + i];
        sum += difference * difference;
      }
      if (sum < least) rounded = c;
      least = std::min(least, sum);
    }
    deceived += rounded != expected ? 1 : 0;
    ASSERT_EQ(choose(format, query, bytes, 5).index, expected) << trial;
  }
  EXPECT_GT(deceived, 10) << "the rows are too easy to tell apart";
}

TEST_P(FloatKernel, TakesTheFirstOfEquals) {
  const DescriptorFormat format = formatOf(DescriptorType::float32, 30);
  const std::size_t stride = gslam::detail::strideOf(format);
  const std::vector<float> row = random_tree::floats(30);
  for (std::uint32_t count = 1; count <= 20; ++count) {
    Bytes rows(count * stride, 4);
    for (std::uint32_t c = 0; c < count; ++c)
      std::memcpy(rows.data() + c * stride, row.data(), 120);
    EXPECT_EQ(choose(format, random_tree::floats(30, 9), rows.data(), count).index, 0U);
  }
}

// The same numbers in another order are as far from a query of equal numbers, whatever their sizes.
TEST_P(FloatKernel, TakesTheFirstOfThoseThatAreEqualWhenNothingIsRounded) {
  const DescriptorFormat format = formatOf(DescriptorType::float32, 128);
  std::mt19937 random(8);
  const std::vector<float> query(128, 0.25F);
  std::vector<float> rows(512);
  for (int trial = 0; trial < 1000; ++trial) {
    const int range = 1 + trial % 40;
    for (std::size_t i = 0; i < 128; ++i) {
      rows[i] = std::ldexp(float(random()), -32 - static_cast<int>(random() % unsigned(range)));
    }
    for (std::size_t c = 1; c < 4; ++c) {
      std::copy(rows.begin(), rows.begin() + 128, rows.begin() + std::ptrdiff_t(c * 128));
      std::shuffle(rows.begin() + std::ptrdiff_t(c * 128),
                   rows.begin() + std::ptrdiff_t(c * 128 + 128), random);
    }
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(rows.data());
    ASSERT_EQ(choose(format, query, bytes, 4).index, 0U) << trial;
    // One bit nearer.
    float& last = *std::min_element(rows.begin() + 384, rows.end());
    last = std::nextafter(last, 0.25F);
    ASSERT_EQ(choose(format, query, bytes, 4).index, 3U) << trial;
  }
}

// Numbers of these formats are multiples of 2^-24 when they are decoded, so that the sums of
// squares are integers; and there are many ties and near-ties, as the queries are such numbers,
// too.
TEST_P(FloatKernel, KnowsTheNumbersOfStepsToTheLastBit) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 20000; ++trial) {
    DescriptorFormat format = formatOf(DescriptorType::int8, 8);
    format.scale = std::ldexp(0.002F + std::ldexp(float(random()), -40), -(trial % 12));
    format.offset = 0.9F + std::ldexp(float(random()), -33);
    const auto stepped = [&] { return static_cast<std::uint8_t>(90 + random() % 3); };
    std::vector<std::uint8_t> steps(8);
    for (std::uint8_t& step : steps) step = stepped();
    std::vector<float> query(8);
    for (std::size_t i = 0; i < 8; ++i) query[i] = float(valueOf(format, steps.data(), i));
    Bytes rows(80, 4);
    std::uint32_t expected = 0;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (std::uint32_t c = 0; c < 10; ++c) {
      std::uint8_t* const row = rows.data() + c * 8UL;
      std::int64_t sum = 0;
      for (std::size_t i = 0; i < 8; ++i) {
        row[i] = stepped();
        const auto difference =
            static_cast<std::int64_t>(std::ldexp(query[i] - valueOf(format, row, i), 24));
        sum += difference * difference;
      }
      if (sum < least) expected = c;
      least = std::min(least, sum);
    }
    ASSERT_EQ(choose(format, query, rows.data(), 10).index, expected) << trial;
  }
}

TEST_P(FloatKernel, BearsWhatIsNoNumber) {
  const DescriptorFormat format = formatOf(DescriptorType::float32, 20);
  std::vector<float> rows(200, 0);
  rows[7 * 20] = 1;
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(rows.data());
  std::vector<float> query(20, 0);
  query[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(choose(format, query, bytes, 10).index, 0U);
  query[3] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(choose(format, query, bytes, 10).index, 0U);
  // Too large for the square of a float; and the 1 of row 7 is nearer, which no double tells.
  query[3] = 0;
  query[0] = 1e25F;
  EXPECT_EQ(choose(format, query, bytes, 10).index, 7U);
  rows[7 * 20] = 1e25F;
  EXPECT_EQ(choose(format, query, bytes, 10).index, 7U);
  // Too small for it.
  rows[7 * 20] = 1e-30F;
  query[0] = 1e-30F;
  EXPECT_EQ(choose(format, query, bytes, 10).index, 7U);
  // Their squares are a few of the smallest floats.
  query[0] = 0;
  std::fill(rows.begin(), rows.end(), 1.0F);
  for (const std::size_t c : {3U, 7U}) std::fill_n(rows.begin() + std::ptrdiff_t(c * 20), 20, 0.0F);
  rows[3 * 20] = 4.3e-23F;
  rows[7 * 20] = rows[7 * 20 + 1] = 2.9e-23F;
  EXPECT_EQ(choose(format, query, bytes, 10).index, 7U);
}

// Sums of products of integers of any size, beside the largest and the smallest numbers there are.
TEST(exact_sum, HasTheSignOfIntegers) {
  const float smallest = std::numeric_limits<float>::denorm_min();
  const float largest = std::numeric_limits<float>::max();
  std::mt19937 random(10);
  for (int trial = 0; trial < 5000; ++trial) {
    gslam::detail::ExactSum sum;
    std::int64_t expected = 0;
    for (int i = 0; i < 6; ++i) {
      const std::int64_t a = std::int64_t(random() % 16777216U) >> (random() % 24);
      const std::int64_t b = std::int64_t(random() % 33554431U) - 16777215;
      const int factor = (random() % 2 == 0 ? 1 : 2) * (random() % 2 == 0 ? 1 : -1);
      // Of many sizes together, but the same for all.
      const int exponent = trial % 250 - 149;
      sum.addProduct(std::ldexp(float(a), exponent), std::ldexp(float(b), -exponent % 100), factor);
      expected += a * b * factor;
    }
    EXPECT_EQ(sum.isNegative(), expected < 0) << trial;
    // What is far larger decides, until it is taken away again.
    sum.addProduct(largest, largest, -2);
    EXPECT_TRUE(sum.isNegative());
    sum.addProduct(largest, largest, 2);
    EXPECT_EQ(sum.isNegative(), expected < 0);
    sum.addProduct(-smallest, smallest);
    EXPECT_EQ(sum.isNegative(), expected <= 0);
  }
}

INSTANTIATE_TEST_SUITE_P(simd, FloatKernel,
                         testing::ValuesIn(gslam::detail::floatKernel().variants()), nameOf);

TEST(nearest_rows, AreThoseOfEachRow) {
  const DescriptorFormat format = formatOf(DescriptorType::binary, 32);
  std::mt19937 random(1);
  std::vector<std::uint8_t> rows(1000 * 32);
  std::vector<std::uint8_t> centres(7 * 32);
  for (std::size_t i = 0; i < 1000; ++i) random_tree::fillRow(random, format, &rows[i * 32]);
  for (std::size_t i = 0; i < 7; ++i) random_tree::fillRow(random, format, &centres[i * 32]);
  std::vector<std::uint32_t> nearest(1000);
  std::vector<float> distances(1000);
  gslam::detail::nearestRows(format, rows.data(), 1000, centres.data(), 7, nearest.data(),
                             distances.data());
  for (std::size_t i = 0; i < 1000; ++i) {
    for (std::size_t c = 0; c < 7; ++c) {
      const std::uint32_t other = hamming(&rows[i * 32], &centres[c * 32], 32);
      ASSERT_TRUE(float(other) > distances[i] || (c >= nearest[i] && float(other) == distances[i]));
    }
  }
}

TEST(half, HoldsWhatItCan) {
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    if (((bits >> 10) & 31U) == 31) continue;  // infinite, or no number
    const auto half = static_cast<std::uint16_t>(bits);
    const float value = gslam::detail::floatOfHalf(half);
    std::uint8_t row[2];
    std::memcpy(row, &half, 2);
    ASSERT_EQ(value, float(valueOf(formatOf(DescriptorType::float16, 1), row, 0)));
    ASSERT_EQ(gslam::detail::halfOfFloat(value), half);
  }
}

TEST(half, RoundsToTheNearestAndTiesToEven) {
  std::mt19937 random(3);
  std::vector<float> values = {1e-8F,          2.9802322e-8F, 2.9802326e-8F, 65519.9F,
                               65503.9F,       70000.0F,      1e30F,         0.00006103F,
                               1.00048828125F, 1.00146484375F};
  for (int i = 0; i < 20000; ++i) {
    values.push_back(std::ldexp(float(random() % 16777216), int(random() % 44) - 50));
  }
  for (const float value : values) {
    const std::uint16_t half = gslam::detail::halfOfFloat(value);
    const double error = std::abs(double(gslam::detail::floatOfHalf(half)) - value);
    if (value > 65504) {
      EXPECT_EQ(half, 0x7BFF);
      continue;
    }
    for (const int step : {-1, 1}) {
      if (half == 0 && step < 0) continue;
      if (half == 0x7BFF && step > 0) continue;
      const auto other = static_cast<std::uint16_t>(half + step);
      const double other_error = std::abs(double(gslam::detail::floatOfHalf(other)) - value);
      ASSERT_TRUE(error < other_error || (error == other_error && half % 2 == 0)) << value;
    }
    EXPECT_EQ(gslam::detail::halfOfFloat(-value), half | 0x8000);
  }
}

}  // namespace
