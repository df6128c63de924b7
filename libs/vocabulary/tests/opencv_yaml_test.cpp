// What cv::FileStorage writes today, by the calls with which DBoW2 and DBoW3 save.
#ifdef GSLAM_HAS_OPENCV

#include <gslam/vocabulary/load.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <opencv2/core/persistence.hpp>
#include <string>

#include "toy_tree.h"

namespace {

using toy::load;

std::string saveAsDbow(const toy::Tree& tree, const std::string& prefix) {
  cv::FileStorage file(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "vocabulary"
       << "{";
  file << "k" << static_cast<int>(tree.branching) << "L" << static_cast<int>(tree.depth);
  file << "scoringType" << static_cast<int>(tree.scoring);
  file << "weightingType" << static_cast<int>(tree.weighting);
  file << "nodes"
       << "[";
  for (const toy::Node* const node : toy::stackOrder(tree)) {
    file << "{:"
         << "nodeId" << static_cast<int>(node->id);
    file << "parentId" << static_cast<int>(node->parent);
    file << "weight" << node->weight << "descriptor" << prefix + toy::numbers(*node) << "}";
  }
  file << "]"
       << "words"
       << "[";
  for (const toy::Node& node : tree.nodes) {
    if (!node.is_leaf) continue;
    file << "{:"
         << "wordId" << static_cast<int>(node.word);
    file << "nodeId" << static_cast<int>(node.id) << "}";
  }
  file << "]"
       << "}";
  return file.releaseAndGetString();
}

TEST(opencv_yaml, files_are_read) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const bool is_binary = seed % 3 != 0;
    const std::uint32_t size = is_binary ? 8 + seed * 8 : 4 + seed * 10;
    toy::Tree tree = toy::makeTree(seed, 2 + seed % 7, 1 + seed % 3, size, is_binary);
    for (toy::Node& node : tree.nodes) {  // all digits of a double, and exponents
      if (node.is_leaf) node.weight = node.weight / 3 * (node.id % 5 == 0 ? 1e-7 : 1);
    }
    const std::string shape = (is_binary ? "0 " : "5 ") + std::to_string(size) + " ";
    for (const std::string& prefix : {std::string(), shape, "dbw3 " + shape}) {
      toy::expectSame(load(saveAsDbow(tree, prefix)), tree);
    }
  }
}

TEST(opencv_yaml, weights_that_are_no_numbers_are_refused_in_leaves_alone) {
  toy::Tree tree = toy::makeTree(1, 3, 2, 32, true);
  for (toy::Node& node : tree.nodes) {
    if (!node.is_leaf) node.weight = std::numeric_limits<double>::quiet_NaN();
  }
  toy::expectSame(load(saveAsDbow(tree, "")), tree);
  tree.nodes.back().weight = -std::numeric_limits<double>::infinity();
  EXPECT_THROW(load(saveAsDbow(tree, "")), gslam::ParseError);
}

}  // namespace

#endif  // GSLAM_HAS_OPENCV
