// Trees from lists of nodes, and what no tree can be made of.
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/tree_file.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "random_tree.h"

namespace {

using gslam::Vocabulary;
using gslam::detail::buildVocabulary;
using gslam::detail::TreeData;
using gslam::detail::treeDataOf;

// 1 2 under the root; 3 4 5 under 1; 6 under 4.
TreeData smallData() {
  TreeData data;
  data.format.size = 2;
  data.branching = 3;
  data.depth = 3;
  data.parents = {0, 0, 1, 1, 1, 4};
  data.weights = {0, 0.5, 1, 0, 2, 0.25};
  data.descriptors = {1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6};
  return data;
}

TEST(build_tree, OrdersNodesBreadthFirst) {
  const Vocabulary vocabulary = buildVocabulary(smallData(), "small");
  EXPECT_EQ(vocabulary.nodeCount(), 7U);
  EXPECT_EQ(vocabulary.wordCount(), 4U);
  EXPECT_EQ(vocabulary.branching(), 3U);
  EXPECT_EQ(vocabulary.depth(), 3U);
  EXPECT_EQ(vocabulary.tree().node_ids, nullptr);
  // Leaves in the order of the list: nodes 2, 3, 5, 6.
  EXPECT_EQ(vocabulary.weight(0), 0.5);
  EXPECT_EQ(vocabulary.weight(1), 1);
  EXPECT_EQ(vocabulary.weight(2), 2);
  EXPECT_EQ(vocabulary.weight(3), 0.25);
  EXPECT_THROW(vocabulary.weight(4), gslam::ArgumentError);
  for (std::uint32_t node = 1; node < 7; ++node) {
    EXPECT_EQ(gslam::detail::descriptorOf(vocabulary.tree(), node)[1], node);
  }
  EXPECT_NO_THROW(gslam::detail::TreeChecker(vocabulary.tree(), "small").check());
}

// The same tree, whatever order its nodes are listed in, as long as siblings keep theirs.
TEST(build_tree, KeepsIdsAndWords) {
  TreeData data = smallData();
  data.ids = {6, 5, 1, 2, 3, 4};
  data.parents = {0, 0, 6, 6, 6, 2};
  data.words = {gslam::detail::kNone, 3, 2, gslam::detail::kNone, 1, 0};
  const Vocabulary vocabulary = buildVocabulary(data, "small");
  const gslam::detail::TreeView& tree = vocabulary.tree();
  ASSERT_NE(tree.node_ids, nullptr);
  const std::vector<std::uint32_t> ids(tree.node_ids, tree.node_ids + 7);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0, 6, 5, 1, 2, 3, 4}));
  EXPECT_EQ(vocabulary.weight(3), 0.5);
  EXPECT_EQ(vocabulary.weight(0), 0.25);
  const TreeData back = treeDataOf(vocabulary);
  EXPECT_EQ(back.ids, data.ids);
  EXPECT_EQ(back.parents, data.parents);
  EXPECT_EQ(back.words, data.words);
  EXPECT_EQ(back.descriptors, data.descriptors);
}

TEST(build_tree, GoesThereAndBack) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const auto format = random_tree::formatOf(gslam::DescriptorType::binary, 5);
    TreeData data = random_tree::dataOf(format, 2 + seed, 4, true, seed);
    // Any order of the nodes, with ids that say who is who.
    std::vector<std::size_t> order(data.parents.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    TreeData shuffled = data;
    shuffled.descriptors.clear();
    for (std::size_t i = 0; i < order.size(); ++i) {
      shuffled.ids.push_back(static_cast<std::uint32_t>(order[i] + 1));
      shuffled.parents[i] = data.parents[order[i]];
      shuffled.weights[i] = data.weights[order[i]];
      const auto row = data.descriptors.begin() + std::ptrdiff_t(order[i]) * 5;
      shuffled.descriptors.insert(shuffled.descriptors.end(), row, row + 5);
    }
    const Vocabulary vocabulary = buildVocabulary(shuffled, "shuffled");
    ASSERT_NO_THROW(gslam::detail::TreeChecker(vocabulary.tree(), "shuffled").check());
    const TreeData back = treeDataOf(vocabulary);
    const Vocabulary again = buildVocabulary(back, "again");
    EXPECT_EQ(treeDataOf(again).ids, back.ids);
    for (std::size_t i = 0; i < back.ids.size(); ++i) {
      const std::size_t node = back.ids[i] - 1;
      ASSERT_EQ(back.parents[i], data.parents[node]);
      ASSERT_TRUE(std::equal(back.descriptors.begin() + std::ptrdiff_t(i) * 5,
                             back.descriptors.begin() + std::ptrdiff_t(i) * 5 + 5,
                             data.descriptors.begin() + std::ptrdiff_t(node) * 5));
      if (back.words[i] != gslam::detail::kNone) {
        ASSERT_EQ(back.weights[i], data.weights[node]);
      }
    }
  }
}

// There may be more weights than two bytes can number.
TEST(build_tree, KeepsAnyNumberOfWeights) {
  for (const std::size_t count : {65536U, 65537U}) {
    TreeData data;
    data.format.size = 1;
    data.branching = 64;
    data.depth = 3;
    for (std::uint32_t i = 0; i < 64; ++i) data.parents.push_back(0);
    for (std::uint32_t i = 0; i < 64 * 64; ++i) data.parents.push_back(1 + i / 64);
    for (std::uint32_t i = 0; i < count; ++i) data.parents.push_back(65 + i % (64 * 64));
    data.weights.assign(data.parents.size(), 0);
    for (std::size_t i = 0; i < count; ++i) data.weights[4160 + i] = 1.0 / double(i + 1);
    data.descriptors.assign(data.parents.size(), 0);
    const Vocabulary vocabulary = buildVocabulary(data, "many");
    EXPECT_EQ(vocabulary.tree().weight_numbers == nullptr, count > 65536);
    for (std::uint32_t word = 0; word < count; ++word) {
      ASSERT_EQ(vocabulary.weight(word), 1.0 / double(word + 1));
    }
  }
}

struct Fault {
  const char* name;
  const char* said;  // in the message
  std::function<void(TreeData&)> make;
};

std::string faultName(const testing::TestParamInfo<Fault>& info) {
  return info.param.name;
}

class BadTree : public testing::TestWithParam<Fault> {};

TEST_P(BadTree, IsRefusedWithAReason) {
  TreeData data = smallData();
  GetParam().make(data);
  try {
    buildVocabulary(data, "file.yml");
    FAIL() << "was taken";
  } catch (const gslam::ParseError& error) {
    EXPECT_EQ(error.source(), "file.yml");
    EXPECT_NE(std::string(error.what()).find(GetParam().said), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    faults, BadTree,
    testing::Values(
        Fault{"no_nodes", "no nodes", [](TreeData& data) { data = TreeData(); }},
        Fault{"circle", "node 1 does not hang on the root",
              [](TreeData& data) { data.parents[0] = 6; }},
        Fault{"own_parent", "node 2 does not hang", [](TreeData& data) { data.parents[1] = 2; }},
        Fault{"no_parent", "node 3 has the parent 9", [](TreeData& data) { data.parents[2] = 9; }},
        Fault{"too_many_children", "node 1 has more than 3",
              [](TreeData& data) { data.parents[1] = 1; }},
        Fault{"too_deep", "node 6 is deeper", [](TreeData& data) { data.depth = 2; }},
        Fault{"twice", "node 3 is there twice",
              [](TreeData& data) { data.ids = {1, 2, 3, 3, 5, 6}; }},
        Fault{"gap", "node 8 is none of the ids",
              [](TreeData& data) { data.ids = {1, 2, 3, 4, 5, 8}; }},
        Fault{"zero", "node 0 is none", [](TreeData& data) { data.ids = {0, 2, 3, 4, 5, 6}; }},
        Fault{"inner_word", "node 1 is a word, but has children",
              [](TreeData& data) { data.words = {0, 1, 2, gslam::detail::kNone, 3, 4}; }},
        Fault{"word_twice", "word 2 is there twice",
              [](TreeData& data) {
                data.words = {gslam::detail::kNone, 0, 2, gslam::detail::kNone, 2, 1};
              }},
        Fault{"word_too_large", "node 6 is word 4, but there are 4",
              [](TreeData& data) {
                data.words = {gslam::detail::kNone, 0, 1, gslam::detail::kNone, 2, 4};
              }},
        Fault{"leaf_without_word", "node 6 is a leaf, but no word",
              [](TreeData& data) {
                data.words = {gslam::detail::kNone, 0, 1,
                              gslam::detail::kNone, 2, gslam::detail::kNone};
              }},
        Fault{"negative_weight", "node 2 has the weight -0.5",
              [](TreeData& data) { data.weights[1] = -0.5; }},
        Fault{"weight_nan", "node 2 has the weight",
              [](TreeData& data) { data.weights[1] = std::numeric_limits<double>::quiet_NaN(); }},
        Fault{"weight_infinite", "node 2 has the weight",
              [](TreeData& data) { data.weights[1] = std::numeric_limits<double>::infinity(); }},
        Fault{"few_weights", "5 weights for 6 nodes",
              [](TreeData& data) { data.weights.pop_back(); }},
        Fault{"few_descriptors", "11 bytes, expected 2 for each of 6",
              [](TreeData& data) { data.descriptors.pop_back(); }},
        Fault{"branching", "up to 65 children", [](TreeData& data) { data.branching = 65; }},
        Fault{"depth", "depth is 0", [](TreeData& data) { data.depth = 0; }},
        Fault{"size", "size 5000", [](TreeData& data) { data.format.size = 5000; }},
        Fault{"not_finite", "descriptor of node 4 is not finite",
              [](TreeData& data) {
                data.format.type = gslam::DescriptorType::float16;
                data.format.size = 1;
                data.descriptors[6] = 0;
                data.descriptors[7] = 0xFC;
              }},
        Fault{"no_scale", "the scale is 0",
              [](TreeData& data) {
                data.format.type = gslam::DescriptorType::int8;
                data.format.scale = 0;
              }}),
    faultName);

// Weights of inner nodes mean nothing, whatever they are.
TEST(build_tree, IgnoresWeightsOfInnerNodes) {
  TreeData data = smallData();
  data.weights[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(buildVocabulary(data, "small"));
}

}  // namespace
