// Hashes: equal values have equal ones, others almost never.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "random_value.h"

namespace {

using gslam::Svar;

// The same value with the members of all objects in reverse order.
Svar reversed(const Svar& value) {
  if (value.type() == gslam::SvarType::array) {
    Svar copy = Svar::array();
    for (const Svar& element : value) copy.push_back(reversed(element));
    return copy;
  }
  if (value.type() != gslam::SvarType::object) return value;
  Svar copy = Svar::object();
  for (std::size_t i = value.size(); i > 0; --i) {
    const Svar::Member& member = value.members()[i - 1];
    copy.set("/" + gslam::detail::escapeName(member.first), reversed(member.second));
  }
  return copy;
}

TEST(Hash, OfEqualValuesIsEqual) {
  EXPECT_EQ(Svar(0.0).hash(), Svar(-0.0).hash());
  EXPECT_EQ(Svar::array({0.0}).hash(), Svar::array({-0.0}).hash());
  EXPECT_EQ(Svar("abc").hash(), Svar(std::string("abc")).hash());
  EXPECT_EQ(Svar::object({{"a", 1}, {"b", 2}}).hash(), Svar::object({{"b", 2}, {"a", 1}}).hash());
  RandomValues random(4);
  for (int i = 0; i < 5000; ++i) {
    const Svar value = random.value(4);
    const Svar other = reversed(value);
    ASSERT_EQ(value, other);
    ASSERT_EQ(value.hash(), other.hash()) << printJson(value);
    ASSERT_EQ(value.hash(), value.clone().hash());
    ASSERT_EQ(value.hash(), value.frozen().hash());
  }
}

TEST(Hash, TellsWhatLooksAlike) {
  const std::vector<Svar> values = {
      Svar(),
      false,
      true,
      0,
      1,
      -1,
      0.0,
      1.0,
      -1.0,
      "",
      "0",
      "1",
      std::string(1, '\0'),
      std::numeric_limits<std::int64_t>::min(),
      std::numeric_limits<std::int64_t>::max(),
      Svar::binary("", 0),
      Svar::binary("0", 1),
      Svar::array(),
      Svar::object(),
      Svar::array({1, 2}),
      Svar::array({2, 1}),
      Svar::array({1}),
      Svar::array({1, 1}),
      Svar::array({Svar::array({1})}),
      Svar::array({Svar::array()}),
      Svar::array({Svar::array(), Svar::array()}),
      Svar::array({Svar::array({Svar::array()})}),
      Svar::object({{"", nullptr}}),
      Svar::object({{"a", 1}, {"b", 2}}),
      Svar::object({{"a", 2}, {"b", 1}}),
      Svar::object({{"a", "b"}}),
      Svar::object({{"b", "a"}}),
      Svar::object({{"0", 1}}),
      Svar::object({{"a", Svar::object({{"b", 1}})}, {"c", Svar::object()}}),
      Svar::object({{"a", Svar::object()}, {"c", Svar::object({{"b", 1}})}}),
      Svar::array({Svar::array({1}), Svar::array({2})}),
      Svar::array({Svar::array({2}), Svar::array({1})})};
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      ASSERT_NE(values[i], values[k]);
      EXPECT_NE(values[i].hash(), values[k].hash()) << i << " " << k;
    }
  }
}

// How often a hash stands there twice.
std::size_t countCollisions(std::vector<std::size_t> hashes) {
  const std::size_t count = hashes.size();
  std::sort(hashes.begin(), hashes.end());
  return count -
         static_cast<std::size_t>(std::unique(hashes.begin(), hashes.end()) - hashes.begin());
}

// A quarter of a million values: 64 bits leave 2e-9 collisions to chance, 32 bits leave 7.
void expectSpread(const std::vector<std::size_t>& hashes) {
  EXPECT_EQ(countCollisions(hashes), 0u);
  if (sizeof(std::size_t) < 8) return;
  for (const int shift : {0, 32}) {
    std::vector<std::size_t> half;
    for (const std::size_t hash : hashes) half.push_back(hash >> shift & 0xFFFFFFFFu);
    EXPECT_LT(countCollisions(half), 30u) << shift;
  }
  std::vector<int> buckets(256);
  for (const std::size_t hash : hashes) ++buckets[hash % 256];
  EXPECT_GT(*std::min_element(buckets.begin(), buckets.end()), 800);
  EXPECT_LT(*std::max_element(buckets.begin(), buckets.end()), 1200);
}

constexpr int kMany = 250000;

TEST(Hash, SpreadsIntegers) {
  std::vector<std::size_t> hashes;
  for (int i = 0; i < kMany; ++i) hashes.push_back(Svar(i - kMany / 2).hash());
  expectSpread(hashes);
}

TEST(Hash, SpreadsDoubles) {
  std::vector<std::size_t> hashes;
  for (int i = 0; i < kMany; ++i) hashes.push_back(Svar(i * 0.25).hash());
  expectSpread(hashes);
}

TEST(Hash, SpreadsStrings) {
  std::vector<std::size_t> hashes;
  for (int i = 0; i < kMany; ++i) {
    hashes.push_back(
        Svar(std::string(static_cast<std::size_t>(i % 20), 'x') + std::to_string(i)).hash());
  }
  expectSpread(hashes);
}

TEST(Hash, TellsShortStringsOfOtherLengths) {
  std::vector<std::size_t> hashes;
  for (int i = 0; i < 64 * 64 * 64; ++i) {
    std::string text;
    for (int left = i; left != 0; left /= 64) text.push_back(static_cast<char>(left % 64 + 48));
    hashes.push_back(Svar(text).hash());
  }
  EXPECT_EQ(countCollisions(hashes), 0u);
  EXPECT_NE(Svar("11").hash(), Svar("110").hash());
}

TEST(Hash, SpreadsPairs) {
  std::vector<std::size_t> hashes;
  for (int i = 0; i < 500; ++i) {
    for (int k = 0; k < 500; ++k) hashes.push_back(Svar::array({i, k}).hash());
  }
  expectSpread(hashes);
}

TEST(Hash, SpreadsObjects) {
  std::vector<std::size_t> hashes;
  for (int i = 0; i < 500; ++i) {
    for (int k = 0; k < 500; ++k) hashes.push_back(Svar::object({{"x", i}, {"y", k}}).hash());
  }
  expectSpread(hashes);
}

TEST(Hash, OfRandomValuesDiffersWhereTheyDo) {
  RandomValues random(5);
  std::unordered_map<std::size_t, Svar> seen;
  for (int i = 0; i < 100000; ++i) {
    const Svar value = random.value(3);
    const auto found = seen.emplace(value.hash(), value).first;
    ASSERT_EQ(found->second, value) << printJson(found->second) << printJson(value);
  }
}

TEST(Hash, MakesValuesKeys) {
  std::unordered_set<Svar> set = {1, 1.0, "1", Svar::array({1}), Svar::array({1}), nullptr, 1};
  EXPECT_EQ(set.size(), 5u);
  EXPECT_EQ(set.count(Svar::array({1})), 1u);
  EXPECT_EQ(set.count(true), 0u);
}

}  // namespace
