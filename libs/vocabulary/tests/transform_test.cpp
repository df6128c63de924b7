// Bags of words against a walk down the tree one by one, and the maps of DBoW.
#include <gslam/base/simd.h>
#include <gslam/vocabulary/transform.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "random_tree.h"

namespace {

using gslam::BowVector;
using gslam::Descriptors;
using gslam::DescriptorType;
using gslam::FeatureVector;
using gslam::Scoring;
using gslam::Vocabulary;
using gslam::Weighting;
using gslam::detail::TreeData;
using random_tree::formatOf;

// What DBoW2 does, from the list of nodes: children in its order, the first of the nearest.
class PlainTree {
 public:
  explicit PlainTree(const TreeData& data) : data_(data), children_(data.parents.size() + 1) {
    std::uint32_t word = 0;
    for (std::uint32_t i = 0; i < data.parents.size(); ++i) {
      children_[data.parents[i]].push_back(i + 1);
    }
    for (std::uint32_t node = 0; node < children_.size(); ++node) {
      words_.push_back(children_[node].empty() ? word++ : 0);
    }
  }

  // The leaf, and the node of a level, or the leaf above it.
  std::uint32_t leafOf(const std::uint8_t* query, std::uint32_t level,
                       std::uint32_t& passed) const {
    std::uint32_t node = 0;
    passed = 0;
    for (std::uint32_t now = 1; !children_[node].empty(); ++now) {
      std::uint32_t best = 0;
      long double least = std::numeric_limits<long double>::max();
      for (const std::uint32_t child : children_[node]) {
        const long double distance = distanceTo(query, child);
        if (distance < least) best = child;
        least = std::min(least, distance);
      }
      node = best;
      if (now <= level) passed = node;
    }
    return node;
  }
  std::uint32_t wordOf(std::uint32_t leaf) const { return words_[leaf]; }
  double weightOf(std::uint32_t leaf) const { return data_.weights[leaf - 1]; }

 private:
  long double distanceTo(const std::uint8_t* query, std::uint32_t node) const {
    const std::uint8_t* const row = &data_.descriptors[(node - 1) * bytesOf(data_.format)];
    long double sum = 0;
    for (std::size_t i = 0; i < data_.format.size; ++i) {
      if (data_.format.type == DescriptorType::binary) {
        for (int bit = 0; bit < 8; ++bit) sum += ((query[i] ^ row[i]) >> bit) & 1;
        continue;
      }
      float a = 0;
      float b = 0;
      std::memcpy(&a, query + i * 4, 4);
      std::memcpy(&b, row + i * 4, 4);
      sum += (static_cast<long double>(a) - b) * (static_cast<long double>(a) - b);
    }
    return sum;
  }

  const TreeData& data_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> words_;
};

struct PlainBags {
  std::map<std::uint32_t, double> bow;
  std::map<std::uint32_t, std::vector<std::uint32_t>> features;
};

PlainBags plainBags(const TreeData& data, const Descriptors& descriptors, std::uint32_t levels_up) {
  const PlainTree tree(data);
  PlainBags bags;
  const bool adds = data.weighting == Weighting::tf_idf || data.weighting == Weighting::tf;
  for (std::uint32_t i = 0; i < descriptors.count; ++i) {
    std::uint32_t passed = 0;
    const std::uint32_t level = data.depth > levels_up ? data.depth - levels_up : 0;
    const std::uint32_t leaf = tree.leafOf(descriptors.row(i), level, passed);
    const double weight = tree.weightOf(leaf);
    if (!(weight > 0)) continue;
    const auto at = bags.bow.insert({tree.wordOf(leaf), weight});
    if (adds && !at.second) at.first->second += weight;
    bags.features[passed].push_back(i);
  }
  double norm = 0;
  for (const auto& word : bags.bow) {
    norm += data.scoring == Scoring::l2 ? word.second * word.second : std::abs(word.second);
  }
  if (data.scoring == Scoring::l2) norm = std::sqrt(norm);
  if (data.scoring == Scoring::dot) norm = adds ? double(bags.bow.size()) : 1;
  for (auto& word : bags.bow) word.second /= norm;
  return bags;
}

void expectSame(const BowVector& bow, const FeatureVector& features, const PlainBags& bags) {
  ASSERT_EQ(bow.size(), bags.bow.size());
  std::size_t i = 0;
  for (const auto& word : bags.bow) {
    ASSERT_EQ(bow.words[i], word.first);
    ASSERT_EQ(bow.values[i], word.second);  // to the last bit
    ++i;
  }
  ASSERT_EQ(features.size(), bags.features.size());
  i = 0;
  for (const auto& node : bags.features) {
    ASSERT_EQ(features.nodes[i], node.first);
    const std::vector<std::uint32_t> of_node(features.features.begin() + features.begins[i],
                                             features.features.begin() + features.begins[i + 1]);
    ASSERT_EQ(of_node, node.second);
    ++i;
  }
}

class Transform : public testing::TestWithParam<gslam::Simd> {
 protected:
  Transform() : scope_(GetParam()) {}

 private:
  gslam::ScopedSimd scope_;
};

std::string variantName(const testing::TestParamInfo<gslam::Simd>& info) {
  return gslam::simdName(info.param);
}

TEST_P(Transform, OfBitsIsThatOfDBoW) {
  for (const std::uint32_t size : {32U, 61U, 5U}) {
    for (const bool is_ragged : {false, true}) {
      const TreeData data =
          random_tree::dataOf(formatOf(DescriptorType::binary, size), 10, 3, is_ragged, size);
      const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "made");
      const std::vector<std::uint8_t> queries = random_tree::queriesLike(vocabulary, 700);
      const Descriptors descriptors = gslam::binaryDescriptors(queries.data(), 700, size);
      for (std::uint32_t levels_up = 0; levels_up <= 4; ++levels_up) {
        BowVector bow;
        FeatureVector features;
        transform(vocabulary, descriptors, levels_up, bow, features);
        expectSame(bow, features, plainBags(data, descriptors, levels_up));
      }
    }
  }
}

TEST_P(Transform, OfFloatsIsExact) {
  for (const std::uint32_t size : {128U, 61U, 3U}) {
    const TreeData data =
        random_tree::dataOf(formatOf(DescriptorType::float32, size), 7, 3, true, size);
    const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "made");
    const std::vector<float> queries = random_tree::floats(300UL * size);
    const Descriptors descriptors = gslam::floatDescriptors(queries.data(), 300, size);
    BowVector bow;
    FeatureVector features;
    transform(vocabulary, descriptors, 1, bow, features);
    expectSame(bow, features, plainBags(data, descriptors, 1));
  }
}

// Small numbers, as SIFT scaled by 1/512 has: who compares integers finds nothing (a fault of
// DBoW3 and of the first GSLAM).
TEST_P(Transform, DoesNotTruncateDistances) {
  TreeData data = random_tree::dataOf(formatOf(DescriptorType::float32, 128), 10, 3);
  std::vector<float> queries = random_tree::floats(128 * 300);
  for (std::size_t i = 0; i < data.descriptors.size(); i += 4) {
    float value = 0;
    std::memcpy(&value, &data.descriptors[i], 4);
    value /= 512;
    std::memcpy(&data.descriptors[i], &value, 4);
  }
  for (float& value : queries) value /= 512;
  const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "made");
  const Descriptors descriptors = gslam::floatDescriptors(queries.data(), 300, 128);
  BowVector bow;
  FeatureVector features;
  transform(vocabulary, descriptors, 1, bow, features);
  EXPECT_GT(bow.size(), 100U);
  expectSame(bow, features, plainBags(data, descriptors, 1));
}

INSTANTIATE_TEST_SUITE_P(simd, Transform, testing::ValuesIn(gslam::availableSimd()), variantName);

TEST(transform, WeighsAndNormalisesAsDBoW) {
  TreeData data = random_tree::dataOf(formatOf(DescriptorType::binary, 32), 6, 3, true);
  for (const Weighting weighting :
       {Weighting::tf_idf, Weighting::tf, Weighting::idf, Weighting::binary}) {
    for (const Scoring scoring : {Scoring::l1, Scoring::l2, Scoring::chi_square, Scoring::kl,
                                  Scoring::bhattacharyya, Scoring::dot}) {
      data.weighting = weighting;
      data.scoring = scoring;
      const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "made");
      const std::vector<std::uint8_t> queries = random_tree::queriesLike(vocabulary, 400);
      const Descriptors descriptors = gslam::binaryDescriptors(queries.data(), 400, 32);
      BowVector bow;
      FeatureVector features;
      transform(vocabulary, descriptors, 2, bow, features);
      expectSame(bow, features, plainBags(data, descriptors, 2));
    }
  }
}

TEST(transform, ReportsTheIdsOfTheFile) {
  TreeData data = random_tree::dataOf(formatOf(DescriptorType::binary, 32), 4, 3);
  const Vocabulary plain = gslam::detail::buildVocabulary(data, "made");
  const auto count = static_cast<std::uint32_t>(data.parents.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    data.ids.push_back(count - i);
    if (data.parents[i] != 0) data.parents[i] = count + 1 - data.parents[i];
  }
  const Vocabulary renamed = gslam::detail::buildVocabulary(data, "made");
  const std::vector<std::uint8_t> queries = random_tree::queriesLike(plain, 500);
  const Descriptors descriptors = gslam::binaryDescriptors(queries.data(), 500, 32);
  BowVector bow[2];
  FeatureVector features[2];
  transform(plain, descriptors, 1, bow[0], features[0]);
  transform(renamed, descriptors, 1, bow[1], features[1]);
  EXPECT_EQ(bow[0], bow[1]);
  ASSERT_EQ(features[0].size(), features[1].size());
  for (std::size_t i = 0; i < features[0].size(); ++i) {
    const std::size_t other = features[0].size() - 1 - i;
    EXPECT_EQ(features[1].nodes[other], count + 1 - features[0].nodes[i]);
    EXPECT_EQ(features[1].features[features[1].begins[other]],
              features[0].features[features[0].begins[i]]);
  }
}

TEST(transform, ReadsRowsWithGaps) {
  const Vocabulary bits = random_tree::treeOf(formatOf(DescriptorType::binary, 32), 5, 3);
  const std::vector<std::uint8_t> queries = random_tree::queriesLike(bits, 300);
  std::vector<std::uint8_t> apart(300 * 45, 255);
  for (std::size_t i = 0; i < 300; ++i) std::memcpy(&apart[i * 45], &queries[i * 32], 32);
  BowVector bow;
  BowVector of_apart;
  transform(bits, gslam::binaryDescriptors(queries.data(), 300, 32), bow);
  transform(bits, gslam::binaryDescriptors(apart.data(), 300, 32, 45), of_apart);
  EXPECT_EQ(bow, of_apart);
  const Vocabulary numbers = random_tree::treeOf(formatOf(DescriptorType::float32, 10), 5, 3);
  const std::vector<float> floats = random_tree::floats(3000);
  std::vector<float> floats_apart(300 * 13, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < 300; ++i) std::memcpy(&floats_apart[i * 13], &floats[i * 10], 40);
  transform(numbers, gslam::floatDescriptors(floats.data(), 300, 10), bow);
  transform(numbers, gslam::floatDescriptors(floats_apart.data(), 300, 10, 52), of_apart);
  EXPECT_EQ(bow, of_apart);
}

TEST(transform, AllocatesNothingOnceItHasGrown) {
  const Vocabulary vocabulary = random_tree::treeOf(formatOf(DescriptorType::binary, 61), 8, 3);
  const std::vector<std::uint8_t> queries = random_tree::queriesLike(vocabulary, 1000);
  gslam::TransformMemory memory;
  BowVector bow;
  FeatureVector features;
  const auto run = [&](std::size_t count) {
    transform(vocabulary, gslam::binaryDescriptors(queries.data(), count, 61), 1, bow, features,
              memory);
  };
  // Two of the lists change places as they are sorted.
  run(1000);
  run(1000);
  const auto places = [&] {
    std::vector<const void*> all = {bow.words.data(),         bow.values.data(),
                                    features.nodes.data(),    features.begins.data(),
                                    features.features.data(), memory.nodes.data(),
                                    memory.passed.data(),     memory.rows.data()};
    std::vector<const void*> sorted = {memory.by_word.data(), memory.by_node.data(),
                                       memory.spare.data()};
    std::sort(sorted.begin(), sorted.end());
    all.insert(all.end(), sorted.begin(), sorted.end());
    return all;
  };
  const std::vector<const void*> before = places();
  for (const std::size_t count : {1000U, 10U, 0U, 999U, 1000U}) run(count);
  EXPECT_EQ(places(), before);
}

TEST(transform, OfManyImagesIsThatOfEach) {
  const Vocabulary vocabulary = random_tree::treeOf(formatOf(DescriptorType::binary, 32), 6, 4);
  const std::vector<std::uint8_t> queries = random_tree::queriesLike(vocabulary, 3000);
  std::vector<Descriptors> images;
  for (std::size_t i = 0; i < 30; ++i) {
    images.push_back(gslam::binaryDescriptors(&queries[i * 3200], i * 3, 32));
  }
  for (const unsigned threads : {1U, 2U, 8U}) {
    gslam::ParallelOptions options;
    options.threads = threads;
    std::vector<BowVector> bows(30);
    std::vector<BowVector> bows_alone(30);
    std::vector<FeatureVector> features(30);
    transformAll(vocabulary, images, 2, bows, features, options);
    transformAll(vocabulary, images, bows_alone, options);
    for (std::size_t i = 0; i < 30; ++i) {
      BowVector bow;
      FeatureVector of_image;
      transform(vocabulary, images[i], 2, bow, of_image);
      EXPECT_EQ(bows[i], bow);
      EXPECT_EQ(bows_alone[i], bow);
      EXPECT_EQ(features[i], of_image);
    }
  }
  std::vector<BowVector> few(29);
  EXPECT_THROW(transformAll(vocabulary, images, few), gslam::ArgumentError);
}

TEST(transform, FindsWords) {
  const TreeData data = random_tree::dataOf(formatOf(DescriptorType::binary, 32), 6, 3, true);
  const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "made");
  const std::vector<std::uint8_t> queries = random_tree::queriesLike(vocabulary, 300);
  const Descriptors descriptors = gslam::binaryDescriptors(queries.data(), 300, 32);
  std::vector<std::uint32_t> words(300);
  findWords(vocabulary, descriptors, words);
  const PlainTree tree(data);
  for (std::uint32_t i = 0; i < 300; ++i) {
    std::uint32_t passed = 0;
    EXPECT_EQ(words[i], tree.wordOf(tree.leafOf(descriptors.row(i), 0, passed)));
  }
  std::vector<std::uint32_t> few(299);
  EXPECT_THROW(findWords(vocabulary, descriptors, few), gslam::ArgumentError);
  EXPECT_THROW(findWords(Vocabulary(), descriptors, words), gslam::ArgumentError);
}

TEST(transform, SaysWhatDoesNotFit) {
  const Vocabulary bits = random_tree::treeOf(formatOf(DescriptorType::binary, 32), 3, 2);
  const Vocabulary numbers = random_tree::treeOf(formatOf(DescriptorType::int8, 32), 3, 2);
  const std::vector<std::uint8_t> bytes(64);
  const std::vector<float> floats(64);
  BowVector bow;
  try {
    transform(bits, gslam::binaryDescriptors(bytes.data(), 1, 64), bow);
    FAIL();
  } catch (const gslam::ArgumentError& error) {
    EXPECT_STREQ(
        error.what(),
        "descriptors have 64 bytes of bits each, but the vocabulary is of 32 bytes of bits");
  }
  EXPECT_THROW(transform(bits, gslam::floatDescriptors(floats.data(), 2, 32), bow),
               gslam::ArgumentError);
  EXPECT_THROW(transform(numbers, gslam::binaryDescriptors(bytes.data(), 2, 32), bow),
               gslam::ArgumentError);
  EXPECT_NO_THROW(transform(numbers, gslam::floatDescriptors(floats.data(), 2, 32), bow));
  gslam::Descriptors by_hand = gslam::binaryDescriptors(bytes.data(), 2, 32);
  by_hand.stride = 0;
  EXPECT_THROW(transform(bits, by_hand, bow), gslam::ArgumentError);
  by_hand.stride = 32;
  by_hand.data = nullptr;
  EXPECT_THROW(transform(bits, by_hand, bow), gslam::ArgumentError);
  EXPECT_THROW(gslam::binaryDescriptors(bytes.data(), 2, 32, 31), gslam::ArgumentError);
  EXPECT_THROW(gslam::binaryDescriptors(bytes.data(), 2, 0), gslam::ArgumentError);
  EXPECT_THROW(gslam::floatDescriptors(floats.data(), 2, 16, 65), gslam::ArgumentError);
  EXPECT_THROW(gslam::floatDescriptors(floats.data(), 2, 16, 60), gslam::ArgumentError);
}

TEST(transform, OfNothingIsNothing) {
  const Vocabulary vocabulary = random_tree::treeOf(formatOf(DescriptorType::binary, 32), 3, 2);
  const std::vector<std::uint8_t> bytes(64);
  BowVector bow;
  bow.words = {1};
  bow.values = {1};
  FeatureVector features;
  transform(vocabulary, Descriptors(), 1, bow, features);
  EXPECT_TRUE(bow.empty());
  EXPECT_TRUE(features.empty());
  EXPECT_TRUE(features.begins.empty());
  transform(Vocabulary(), gslam::binaryDescriptors(bytes.data(), 2, 32), 1, bow, features);
  EXPECT_TRUE(bow.empty());
  EXPECT_TRUE(Vocabulary().empty());
  // All words without weight.
  TreeData data = random_tree::dataOf(formatOf(DescriptorType::binary, 32), 3, 2);
  data.weights.assign(data.weights.size(), 0);
  transform(gslam::detail::buildVocabulary(data, "made"),
            gslam::binaryDescriptors(bytes.data(), 2, 32), 1, bow, features);
  EXPECT_TRUE(bow.empty());
  EXPECT_TRUE(features.empty());
}

TEST(transform, SortsAnyNumberOfBits) {
  std::mt19937 random(2);
  for (unsigned bits = 1; bits <= 32; ++bits) {
    std::vector<std::uint64_t> items;
    std::vector<std::uint64_t> spare;
    for (std::uint32_t i = 0; i < 500; ++i) {
      items.push_back(gslam::detail::keyed(static_cast<std::uint32_t>(random()) >> (32 - bits), i));
    }
    std::vector<std::uint64_t> expected = items;
    std::sort(expected.begin(), expected.end());
    gslam::detail::orderByKey(items, spare, bits);
    EXPECT_EQ(items, expected) << bits;
  }
  EXPECT_EQ(gslam::detail::bitsBelow(1), 1U);
  EXPECT_EQ(gslam::detail::bitsBelow(2), 1U);
  EXPECT_EQ(gslam::detail::bitsBelow(3), 2U);
  EXPECT_EQ(gslam::detail::bitsBelow(1024), 10U);
  EXPECT_EQ(gslam::detail::bitsBelow(1025), 11U);
  EXPECT_EQ(gslam::detail::bitsBelow(0xFFFFFFFFU), 32U);
}

}  // namespace
