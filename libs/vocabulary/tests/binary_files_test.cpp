#include <gslam/base/error.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/load.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "toy_tree.h"

namespace {

using Bytes = std::vector<std::uint8_t>;
using gslam::Vocabulary;
using toy::errorOf;
using toy::load;

template <class Number>
Bytes replaced(Bytes bytes, std::size_t offset, Number number) {
  std::memcpy(&bytes[offset], &number, sizeof(number));
  return bytes;
}

// Every part of a file is refused, and with every bit another, it does no harm.
void expectSturdy(const Bytes& bytes) {
  ASSERT_EQ(errorOf(bytes), "");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // On the heap, so that reading behind it is seen.
    EXPECT_NE(errorOf(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))), "")
        << size;
  }
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_NE(errorOf(longer), "");
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    Bytes damaged = bytes;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1U << (bit % 8)));
    refused += errorOf(damaged).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, bytes.size());
  for (std::size_t at = 0; at + 4 <= bytes.size(); ++at) {
    for (const std::uint32_t absurd : {0xFFFFFFFFU, 0x7FFFFFFFU, 0U, 0x10000U}) {
      errorOf(replaced(bytes, at, absurd));
    }
  }
}

TEST(dbow3_binary, trees_of_every_shape_are_read) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const toy::Tree tree =
        toy::makeTree(seed, 2 + seed % 7, 1 + seed % 4, 1 + seed * 3, seed % 3 != 0);
    const Vocabulary vocabulary = load(toy::dbow3(tree));
    toy::expectSame(vocabulary, tree);
    EXPECT_EQ(static_cast<unsigned>(vocabulary.scoring()), tree.scoring);
    EXPECT_EQ(static_cast<unsigned>(vocabulary.weighting()), tree.weighting);
  }
}

TEST(dbow3_binary, damaged_files_are_refused) {
  expectSturdy(toy::dbow3(toy::makeTree(1, 3, 2, 5, true)));
  expectSturdy(toy::dbow3(toy::makeTree(2, 2, 2, 3, false)));
}

TEST(dbow3_binary, compressed_files_are_answered_with_what_to_do) {
  const std::string error = errorOf(toy::dbow3(toy::makeTree(1, 3, 2, 32, true), true));
  EXPECT_NE(error.find("quicklz"), std::string::npos) << error;
  EXPECT_NE(error.find("binary_compressed = false"), std::string::npos) << error;
}

TEST(dbow3_binary, errors_name_the_byte) {
  const toy::Tree tree = toy::makeTree(1, 3, 2, 32, true);
  const Bytes bytes = toy::dbow3(tree);
  const std::size_t record = 28 + 32;
  const std::size_t words = 29 + tree.nodes.size() * record;
  EXPECT_EQ(errorOf(replaced(bytes, 29 + 2 * record, 0U)),
            "toy: byte 149: the node has the id 0, expected 1 to " +
                std::to_string(tree.nodes.size()) + ", as there are nodes");
  EXPECT_EQ(errorOf(replaced(bytes, 29 + record, 1U)),
            "toy: byte 89: the node has the id 1, which another has, too");
  EXPECT_EQ(errorOf(replaced(bytes, 29 + record + 16, 31U)),
            "toy: byte 105: the descriptor has another shape or type than the first");
  EXPECT_EQ(errorOf(replaced(bytes, 13, 65U)), "toy: byte 13: K is 65, expected 2 to 64");
  EXPECT_EQ(errorOf(replaced(bytes, 17, 0U)), "toy: byte 17: L is 0, expected 1 to 64");
  EXPECT_EQ(errorOf(replaced(bytes, 21, 6U)), "toy: byte 21: the scoring is 6, expected 0 to 5");
  EXPECT_EQ(errorOf(replaced(bytes, 9, 0U)), "toy: byte 9: the vocabulary is empty");
  EXPECT_EQ(errorOf(replaced(bytes, 9, 0xFFFFFFFFU)),
            "toy: byte 29: expected nodes, 4294967294 times 60 bytes, got " +
                std::to_string(bytes.size() - 29) + " bytes up to the end of the file");
  EXPECT_EQ(errorOf(replaced(bytes, words, 0x10000000U)),
            "toy: byte " + std::to_string(words + 4) +
                ": expected words, 268435456 times 8 bytes, "
                "got " +
                std::to_string(bytes.size() - words - 4) + " bytes up to the end of the file");
  EXPECT_NE(errorOf(replaced(bytes, 29 + 4, 2U)), "");  // a circle
}

TEST(dbow3_binary, weights_of_inner_nodes_may_be_anything) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  toy::Tree tree = toy::makeTree(1, 3, 2, 32, true);
  for (toy::Node& node : tree.nodes) {
    if (!node.is_leaf) node.weight = nan;
  }
  toy::expectSame(load(toy::dbow3(tree)), tree);
  for (toy::Node& node : tree.nodes) node.weight = nan;
  EXPECT_NE(errorOf(toy::dbow3(tree)), "");
}

// Nodes that are there, in the order of their places: the ids that ours has.
TEST(gbow, trees_of_every_shape_are_read) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const toy::Tree tree =
        toy::makeTree(seed, 2 + seed % 5, 1 + seed % 4, 1 + seed * 3, seed % 3 != 0);
    const Vocabulary vocabulary = load(toy::gbow(tree));
    toy::expectSame(vocabulary, tree);  // whose ids and words are breadth first, too
    EXPECT_EQ(static_cast<unsigned>(vocabulary.scoring()), tree.scoring);
    EXPECT_EQ(static_cast<unsigned>(vocabulary.weighting()), tree.weighting);
  }
}

TEST(gbow, is_told_from_dbow3_which_has_the_same_signature) {
  const toy::Tree tree = toy::makeTree(1, 3, 2, 32, true);
  const Bytes ours = toy::gbow(tree);
  const Bytes theirs = toy::dbow3(tree);
  EXPECT_TRUE(std::equal(ours.begin(), ours.begin() + 9, theirs.begin()));
  toy::expectSame(load(ours), tree);
  toy::expectSame(load(theirs), tree);
}

TEST(gbow, damaged_files_are_refused) {
  expectSturdy(toy::gbow(toy::makeTree(1, 3, 2, 5, true)));
  expectSturdy(toy::gbow(toy::makeTree(2, 2, 2, 3, false)));
}

TEST(gbow, errors_name_the_byte) {
  const Bytes bytes = toy::gbow(toy::makeTree(1, 3, 2, 32, true));
  EXPECT_EQ(errorOf(replaced(bytes, 41, 4U)), "toy: byte 41: a node has 4 children, but K is 3");
  EXPECT_EQ(errorOf(replaced(bytes, 41 + 4 * 8, 1U)),
            "toy: byte 73: the children of a node would be behind the last, which is 12");
  EXPECT_EQ(errorOf(replaced(bytes, 37, 7U)),
            "toy: byte 37: a descriptor is of type 7, expected bytes, which are 0, or floats, "
            "which are 5");
}

TEST(fbow, trees_of_every_shape_are_read) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const toy::Tree tree =
        toy::makeTree(seed, 2 + seed % 7, 1 + seed % 4, 1 + seed * 3, seed % 3 != 0);
    const Vocabulary vocabulary = load(toy::fbow(tree));
    toy::expectSame(vocabulary, tree);
    EXPECT_EQ(vocabulary.scoring(), gslam::Scoring::l2);
    EXPECT_EQ(vocabulary.weighting(), gslam::Weighting::tf_idf);
  }
}

TEST(fbow, words_keep_numbers_in_any_order) {
  toy::Tree tree = toy::makeTree(3, 3, 3, 32, true);
  std::vector<toy::Node*> leaves;
  for (toy::Node& node : tree.nodes) {
    if (node.is_leaf) leaves.push_back(&node);
  }
  for (toy::Node* const leaf : leaves) {
    leaf->word = static_cast<std::uint32_t>(leaves.size() - 1 - leaf->word);
  }
  toy::expectSame(load(toy::fbow(tree)), tree);
}

// What FBoW's own training writes: numbers of features, which are those of other words, too.
TEST(fbow, colliding_words_are_numbered_anew) {
  const toy::Tree tree = toy::makeTree(3, 3, 3, 32, true);
  std::map<std::uint32_t, std::uint32_t> words;
  for (const toy::Node& node : tree.nodes) {
    if (node.is_leaf) words[node.id] = node.word % 3 == 0 ? 571 : node.word / 2;
  }
  toy::expectSame(load(toy::fbow(tree, words)), tree);  // whose words are breadth first
  for (const std::uint32_t other : {0x7FFFFFFFU, 100000U, 0U}) {
    for (auto& word : words) word.second = other;
    toy::expectSame(load(toy::fbow(tree, words)), tree);
  }
}

TEST(fbow, damaged_files_are_refused) {
  expectSturdy(toy::fbow(toy::makeTree(1, 3, 2, 5, true)));
  expectSturdy(toy::fbow(toy::makeTree(2, 2, 2, 3, false)));
}

TEST(fbow, errors_name_the_byte) {
  const toy::Tree tree = toy::makeTree(1, 3, 2, 32, true);
  const Bytes bytes = toy::fbow(tree);
  const std::size_t infos = 128 + 8 + 3 * 32;
  std::size_t inner = infos;  // the first child that has children
  while ((bytes[inner + 3] & 0x80) != 0) inner += 8;
  const std::string place = "toy: byte " + std::to_string(inner);
  EXPECT_EQ(errorOf(replaced(bytes, inner, 0U)), place + ": the block 0 has two parents");
  EXPECT_EQ(errorOf(replaced(bytes, inner, 1000U)), place + ": the block 1000 is not there");
  EXPECT_EQ(errorOf(replaced(bytes, inner, 0x80000000U)).substr(0, 15), "toy: byte 128: ");
  EXPECT_EQ(errorOf(replaced(bytes, 128, std::uint16_t(4))),
            "toy: byte 128: a block has 4 nodes, expected 1 to 3");
  EXPECT_EQ(errorOf(replaced(bytes, 96, std::uint64_t(103))),
            "toy: byte 96: 103 as the place of the children in a block does not fit the other "
            "sizes");
}

TEST(load, our_own_files_are_recognised) {
  const toy::Tree tree = toy::makeTree(4, 4, 3, 32, true);
  const std::string path = testing::TempDir() + std::to_string(getpid()) + "_load_test.gvoc";
  gslam::saveVocabulary(load(toy::dbow3(tree)), path);
  const Vocabulary mapped = gslam::loadVocabulary(path);
  EXPECT_TRUE(mapped.isMapped());
  toy::expectSame(mapped, tree);
  std::ifstream file(path, std::ios::binary);
  const Bytes bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const Vocabulary copied = load(bytes);
  EXPECT_FALSE(copied.isMapped());
  toy::expectSame(copied, tree);
  std::remove(path.c_str());
}

TEST(load, files_are_told_apart_by_what_is_in_them) {
  const toy::Tree tree = toy::makeTree(5, 4, 3, 32, true);
  const std::string path = testing::TempDir() + std::to_string(getpid()) + "_load_test.any";
  for (const Bytes& bytes :
       {toy::dbow3(tree), toy::gbow(tree), toy::fbow(tree), toy::bytesOfText(toy::orbText(tree)),
        toy::bytesOfText(toy::yaml(tree, "")), toy::bytesOfText(toy::yaml(tree, "0 32 "))}) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    toy::expectSame(gslam::loadVocabulary(path), tree);
  }
  std::remove(path.c_str());
  EXPECT_THROW(gslam::loadVocabulary(path), gslam::FileError);
  EXPECT_THROW(gslam::loadVocabulary(testing::TempDir()), gslam::FileError);
}

TEST(load, what_is_no_vocabulary_is_answered_with_what_to_do) {
  const auto error = [](std::string text) {
    return errorOf(toy::bytesOfText(text.append(300, ' ')));
  };
  EXPECT_EQ(errorOf(Bytes()), "toy: is empty");
  EXPECT_NE(error("\x1F\x8B").find("gslam/vocabulary/gzip.h"), std::string::npos);
  EXPECT_NE(error("PK\x03\x04").find("zip archive"), std::string::npos);
  EXPECT_NE(error("<?xml version").find("XML"), std::string::npos);
  EXPECT_NE(error("{ \"vocabulary\"").find("JSON"), std::string::npos);
  EXPECT_NE(error("ORBvoc.txt" + std::string(247, '\0') + "ustar").find("tar archive"),
            std::string::npos);
  EXPECT_NE(error("GIF89a").find("no vocabulary"), std::string::npos);
  EXPECT_NE(error("").find("no vocabulary"), std::string::npos);
}

}  // namespace
