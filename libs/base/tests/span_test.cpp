#include <gslam/base/span.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace {

using gslam::Span;

struct Base {};
struct Derived : Base {};

// Two words and nothing else: it crosses plugin borders.
static_assert(std::is_trivially_copyable<Span<int>>::value, "");
static_assert(std::is_standard_layout<Span<int>>::value, "");
static_assert(sizeof(Span<int>) == 2 * sizeof(void*), "");
// What must not convert: away from const, between types, from derived to base (other strides).
static_assert(!std::is_convertible<Span<const int>, Span<int>>::value, "");
static_assert(!std::is_convertible<const std::vector<int>&, Span<int>>::value, "");
static_assert(!std::is_convertible<std::vector<int>&, Span<double>>::value, "");
static_assert(!std::is_convertible<std::vector<Derived>&, Span<Base>>::value, "");
static_assert(!std::is_convertible<std::vector<int>, Span<int>>::value, "no mutable temporaries");
static_assert(std::is_convertible<Span<int>, Span<const int>>::value, "");

int sum(Span<const int> values) {
  int total = 0;
  for (int value : values) total += value;
  return total;
}

TEST(Span, ViewsEveryContiguousContainer) {
  std::vector<int> vector = {1, 2, 3};
  const std::vector<int> constant = {4, 5};
  std::array<int, 2> array = {{6, 7}};
  int plain[] = {8, 9};
  EXPECT_EQ(sum(vector), 6);
  EXPECT_EQ(sum(constant), 9);
  EXPECT_EQ(sum(array), 13);
  EXPECT_EQ(sum(plain), 17);
  EXPECT_EQ(sum(std::vector<int>{1, 1}), 2);
  EXPECT_EQ(sum(Span<int>(vector)), 6);
  EXPECT_EQ(Span<const char>(std::string("abc")).size(), 3u);
}

TEST(Span, WritesThrough) {
  std::vector<int> vector = {1, 2, 3};
  Span<int> span(vector);
  span[1] = 20;
  span.front() = 10;
  span.back() = 30;
  EXPECT_EQ(vector, (std::vector<int>{10, 20, 30}));
}

TEST(Span, DefaultIsEmpty) {
  const Span<int> empty;
  EXPECT_TRUE(empty.empty());
  EXPECT_EQ(empty.size(), 0u);
  EXPECT_EQ(empty.begin(), empty.end());
  EXPECT_EQ(sum(empty), 0);
  EXPECT_TRUE(empty.subspan(0).empty());
}

TEST(Span, CutsPieces) {
  std::vector<int> vector = {0, 1, 2, 3, 4};
  const Span<int> span(vector);
  EXPECT_EQ(span.first(2).data(), vector.data());
  EXPECT_EQ(span.first(2).size(), 2u);
  EXPECT_EQ(span.last(2)[0], 3);
  EXPECT_EQ(span.subspan(1, 3).back(), 3);
  EXPECT_EQ(span.subspan(5).size(), 0u);
}

TEST(Span, RefusesWhatIsOutside) {
  std::vector<int> vector = {0, 1, 2};
  const Span<int> span(vector);
  const std::size_t huge = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(span.at(2), 2);
  EXPECT_THROW(span.at(3), gslam::ArgumentError);
  EXPECT_THROW(span.subspan(4), gslam::ArgumentError);
  EXPECT_THROW(span.subspan(1, 3), gslam::ArgumentError);
  EXPECT_THROW(span.subspan(1, huge), gslam::ArgumentError);  // offset + count would wrap
  EXPECT_THROW(span.first(4), gslam::ArgumentError);
  EXPECT_THROW(span.last(4), gslam::ArgumentError);
  try {
    span.at(7);
    FAIL() << "at(7) of 3 elements must throw";
  } catch (const gslam::Error& error) {
    EXPECT_STREQ(error.what(), "index is 7, outside a span of 3 elements");
  }
}

}  // namespace
