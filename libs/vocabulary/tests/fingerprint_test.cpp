// Fingerprints: the same for the same vocabulary, however it came, and others for all others.
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/fingerprint.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "random_tree.h"

namespace {

using gslam::DescriptorType;
using gslam::Vocabulary;
using gslam::detail::TreeData;

TreeData someTree(std::uint32_t seed = 1) {
  return random_tree::dataOf(random_tree::formatOf(DescriptorType::binary, 32), 5, 4, true, seed);
}

std::uint64_t fingerprintOf(const TreeData& data) {
  return gslam::fingerprint(gslam::detail::buildVocabulary(data, "test"));
}

}  // namespace

TEST(fingerprint, is_the_same_for_copies_files_and_ways_to_compare) {
  const Vocabulary vocabulary = gslam::detail::buildVocabulary(someTree(), "test");
  const std::uint64_t expected = gslam::fingerprint(vocabulary);
  EXPECT_NE(expected, 0u);
  EXPECT_EQ(fingerprintOf(gslam::detail::treeDataOf(vocabulary)), expected);
  EXPECT_EQ(gslam::fingerprint(vocabulary.withScoring(gslam::Scoring::kl)), expected);
  const std::string path =
      testing::TempDir() + std::to_string(getpid()) + "_gslam_fingerprint_test.voc";
  saveVocabulary(vocabulary, path);
  EXPECT_EQ(gslam::fingerprint(gslam::openVocabulary(path)), expected);
  std::remove(path.c_str());
}

TEST(fingerprint, is_another_for_everything_that_changes_bags) {
  const TreeData original = someTree();
  std::set<std::uint64_t> seen = {fingerprintOf(original), fingerprintOf(someTree(2)),
                                  gslam::fingerprint(Vocabulary())};
  const std::size_t before = seen.size();
  TreeData other = original;
  other.weighting = gslam::Weighting::binary;
  seen.insert(fingerprintOf(other));
  for (const std::size_t node : {std::size_t(0), original.parents.size() - 1}) {
    other = original;
    other.descriptors[32 * node + 31] ^= 1;
    seen.insert(fingerprintOf(other));
  }
  other = original;
  for (double& weight : other.weights) weight += 0.5;
  seen.insert(fingerprintOf(other));
  EXPECT_EQ(before, 3u);
  EXPECT_EQ(seen.size(), 7u);
}

// Six nodes of one byte, of which two are below another.
TEST(fingerprint, is_another_for_trees_of_other_shape_and_depth) {
  TreeData data;
  data.format.size = 1;
  data.branching = 4;
  data.depth = 2;
  data.parents = {0, 0, 1, 1, 2, 2};
  data.descriptors = {0x0F, 0xF0, 0x0F, 0x0E, 0xF0, 0x70};
  data.weights.assign(6, 1);
  std::set<std::uint64_t> seen = {fingerprintOf(data)};
  data.depth = 6;  // features lie under other nodes, where they are counted from the leaves
  seen.insert(fingerprintOf(data));
  data.parents = {0, 0, 1, 2, 2, 2};  // as many words
  seen.insert(fingerprintOf(data));
  data.parents = {0, 0, 0, 0, 1, 1};
  seen.insert(fingerprintOf(data));
  EXPECT_EQ(seen.size(), 4u);
}

TEST(fingerprint, knows_the_ids_of_nodes_which_the_direct_index_has) {
  TreeData data = someTree();
  const std::uint64_t expected = fingerprintOf(data);
  const auto count = static_cast<std::uint32_t>(data.parents.size());
  data.ids.clear();
  for (std::uint32_t i = 0; i < count; ++i) data.ids.push_back(count - i);
  for (std::uint32_t& parent : data.parents) {
    if (parent != 0) parent = count + 1 - parent;
  }
  EXPECT_NE(fingerprintOf(data), expected);
}

TEST(fingerprint, is_there_for_descriptors_of_every_type) {
  std::set<std::uint64_t> seen;
  for (const DescriptorType type : {DescriptorType::binary, DescriptorType::float32,
                                    DescriptorType::float16, DescriptorType::int8}) {
    seen.insert(fingerprintOf(random_tree::dataOf(random_tree::formatOf(type, 16), 3, 3)));
  }
  EXPECT_EQ(seen.size(), 4u);
}
