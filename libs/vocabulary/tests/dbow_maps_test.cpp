// Bags and features as the maps of DBoW, and back.
#include <gslam/vocabulary/dbow_maps.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "random_bags.h"

namespace {

using gslam::BowVector;
using gslam::FeatureVector;

// As DBoW2 and DBoW3 have them.
class DerivedBow : public std::map<unsigned int, double> {};
class DerivedFeatures : public std::map<unsigned int, std::vector<unsigned int>> {};

const FeatureVector kFeatures = {{2, 3, 9}, {0, 2, 2, 5}, {4, 6, 0, 1, 7}};

}  // namespace

TEST(dbow_maps, of_bags_go_there_and_back) {
  std::mt19937 generator(1);
  for (const std::size_t size : {0u, 1u, 500u}) {
    const BowVector bow = random_bags::bag(generator, size, 100000);
    const auto map = gslam::toMap<std::map<unsigned, double>>(bow);
    ASSERT_EQ(map.size(), size);
    for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(map.at(bow.words[i]), bow.values[i]);
    EXPECT_EQ(gslam::bowFromMap(map), bow);
    EXPECT_EQ(gslam::bowFromMap(gslam::toMap<DerivedBow>(bow)), bow);
  }
}

TEST(dbow_maps, of_features_go_there_and_back) {
  const auto map = gslam::toMap<std::map<unsigned, std::vector<unsigned>>>(kFeatures);
  const std::map<unsigned, std::vector<unsigned>> expected = {{2, {4, 6}}, {3, {}}, {9, {0, 1, 7}}};
  EXPECT_EQ(map, expected);
  EXPECT_EQ(gslam::featuresFromMap(map), kFeatures);
  EXPECT_EQ(gslam::featuresFromMap(gslam::toMap<DerivedFeatures>(kFeatures)), kFeatures);
  EXPECT_TRUE(gslam::toMap<DerivedFeatures>(FeatureVector()).empty());
  EXPECT_EQ(gslam::featuresFromMap(DerivedFeatures()), FeatureVector());
}

TEST(dbow_maps, are_read_into_memory_that_is_there) {
  BowVector bow = {{5, 6, 7}, {1, 1, 1}};
  gslam::bowFromMap(std::map<int, float>{{3, 0.5F}}, bow);
  EXPECT_EQ(bow, (BowVector{{3}, {0.5}}));
  FeatureVector features = kFeatures;
  gslam::featuresFromMap(std::map<long, std::vector<int>>{{1, {8}}}, features);
  EXPECT_EQ(features, (FeatureVector{{1}, {0, 1}, {8}}));
}

TEST(dbow_maps, with_numbers_that_do_not_fit_are_refused) {
  using Big = std::map<std::int64_t, double>;
  EXPECT_EQ(gslam::bowFromMap(Big{{0xFFFFFFFF, 1}}).words[0], 0xFFFFFFFF);
  EXPECT_THROW(gslam::bowFromMap(Big{{0x100000000, 1}}), gslam::ArgumentError);
  EXPECT_THROW(gslam::bowFromMap(Big{{-1, 1}}), gslam::ArgumentError);
  using Features = std::map<unsigned, std::vector<std::int64_t>>;
  EXPECT_THROW(gslam::featuresFromMap(Features{{1, {-1}}}), gslam::ArgumentError);
  EXPECT_THROW(gslam::featuresFromMap(Features{{1, {0x100000000}}}), gslam::ArgumentError);
}

TEST(dbow_maps, that_are_not_in_order_are_refused) {
  using Twice = std::multimap<unsigned, double>;
  EXPECT_THROW(gslam::bowFromMap(Twice{{5, 1}, {5, 1}}), gslam::ArgumentError);
  using Down = std::map<unsigned, double, std::greater<unsigned>>;
  EXPECT_THROW(gslam::bowFromMap(Down{{5, 1}, {6, 1}}), gslam::ArgumentError);
  using Features = std::multimap<unsigned, std::vector<unsigned>>;
  EXPECT_THROW(gslam::featuresFromMap(Features{{5, {1}}, {5, {2}}}), gslam::ArgumentError);
}

TEST(dbow_maps, are_not_made_of_lists_that_do_not_fit) {
  using Bow = std::map<unsigned, double>;
  EXPECT_THROW(gslam::toMap<Bow>(BowVector{{1, 2, 3}, {}}), gslam::ArgumentError);
  for (const FeatureVector& bad : {FeatureVector{{1}, {}, {7}}, FeatureVector{{1}, {0, 2}, {7}},
                                   FeatureVector{{1, 2}, {0, 9, 1}, {7}}}) {
    EXPECT_THROW(gslam::toMap<DerivedFeatures>(bad), gslam::ArgumentError);
  }
}
