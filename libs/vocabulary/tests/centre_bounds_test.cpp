// Rows that are not looked at keep their nearest centre.
#include <gslam/base/simd.h>
#include <gslam/vocabulary/detail/centre_bounds.h>
#include <gslam/vocabulary/detail/nearest.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace {

using gslam::DescriptorFormat;
using gslam::DescriptorType;
using gslam::Simd;
using gslam::detail::CentreBounds;
using gslam::detail::nearestRows;
using gslam::detail::strideOf;

std::vector<std::uint8_t> bytesOfFloats(const std::vector<float>& numbers) {
  std::vector<std::uint8_t> bytes(numbers.size() * sizeof(float));
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

DescriptorFormat floats(std::uint32_t size) {
  DescriptorFormat format;
  format.type = DescriptorType::float32;
  format.size = size;
  return format;
}

// Centres that wander ever less far; some stay, some jump, two may meet.
void expectNearestOfMovingCentres(std::uint32_t size, std::uint32_t clusters) {
  const DescriptorFormat format = floats(size);
  const std::size_t numbers = strideOf(format) / sizeof(float);
  const std::size_t count = 200;
  std::mt19937 random(size + clusters);
  const auto noise = [&] { return static_cast<float>(random() % 2001) / 1000 - 1; };
  std::vector<float> rows(count * numbers, 0.0f);
  std::vector<float> centres(clusters * numbers, 0.0f);
  for (float& number : rows) number = noise();
  for (float& number : centres) number = noise();
  const std::vector<std::uint8_t> row_bytes = bytesOfFloats(rows);
  std::vector<std::uint8_t> now = bytesOfFloats(centres);
  CentreBounds bounds(format);
  bounds.begin(count, clusters);
  std::vector<std::uint32_t> labels(count, 0);
  for (int step = 0; step < 25; ++step) {
    std::vector<std::uint32_t> expected(count);
    nearestRows(format, row_bytes.data(), count, now.data(), clusters, expected.data(), nullptr);
    for (std::size_t i = 0; i < count; ++i) {
      labels[i] = bounds.nearest(i, &row_bytes[i * strideOf(format)], now.data(), labels[i]);
    }
    ASSERT_EQ(labels, expected) << "step " << step;
    const float reach = 0.5f / static_cast<float>((step + 1) * (step + 1));
    for (std::size_t i = 0; i < centres.size(); ++i) {
      if ((i / numbers + static_cast<std::size_t>(step)) % 3 != 0) centres[i] += noise() * reach;
    }
    if (step == 20) std::copy_n(centres.begin(), numbers, centres.end() - std::ptrdiff_t(numbers));
    const std::vector<std::uint8_t> before = now;
    now = bytesOfFloats(centres);
    bounds.moveCentres(before.data(), now.data());
  }
}

TEST(centre_bounds, give_the_nearest_of_moving_centres) {
  for (const Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd scope(variant);
    SCOPED_TRACE(gslam::simdName(variant));
    for (const std::uint32_t size : {1u, 7u, 65u}) {
      for (const std::uint32_t clusters : {2u, 10u, 64u}) {
        SCOPED_TRACE(std::to_string(size) + " numbers, " + std::to_string(clusters));
        expectNearestOfMovingCentres(size, clusters);
      }
    }
  }
}

// The point of it: centres that hardly move leave most rows alone. Rows at null would be read.
TEST(centre_bounds, do_not_look_at_rows_that_stay) {
  const DescriptorFormat format = floats(4);
  const std::vector<std::uint8_t> centres = bytesOfFloats({0, 0, 0, 0, 10, 0, 0, 0});
  const std::vector<std::uint8_t> moved = bytesOfFloats({1, 0, 0, 0, 10, 1, 0, 0});
  const std::vector<std::uint8_t> row = bytesOfFloats({2, 0, 0, 0});
  CentreBounds bounds(format);
  bounds.begin(1, 2);
  ASSERT_EQ(bounds.nearest(0, row.data(), centres.data(), 1), 0u);
  bounds.moveCentres(centres.data(), moved.data());
  EXPECT_EQ(bounds.nearest(0, nullptr, nullptr, 0), 0u);
}

}  // namespace
