#include <gslam/base/error.h>
#include <gslam/vocabulary/load.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "toy_tree.h"

namespace {

using gslam::Vocabulary;
using toy::errorOf;
using toy::load;

std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
  std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  for (; at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

const char kSmallYaml[] =
    "%YAML:1.0\n"
    "---\n"
    "vocabulary:\n"
    "   k: 2\n"
    "   L: 2\n"
    "   scoringType: 3\n"
    "   weightingType: 1\n"
    "   nodes:\n"
    "      - { nodeId:1, parentId:0, weight:0.,\n"
    "          descriptor:\"1 2 3 \" }\n"
    "      - { nodeId:2, parentId:0, weight:5.0000000000000000e-01,\n"
    "          descriptor:\"4 5 6 \" }\n"
    "      - { nodeId:4, parentId:1, weight:1.5,\n"
    "          descriptor:\"7 8 9 \" }\n"
    "      - { nodeId:3, parentId:1, weight:2.5,\n"
    "          descriptor:\"10 11 12 \" }\n"
    "   words:\n"
    "      - { wordId:0, nodeId:2 }\n"
    "      - { wordId:1, nodeId:3 }\n"
    "      - { wordId:2, nodeId:4 }\n";

std::string yamlWith(const std::string& from, const std::string& to) {
  std::string text = kSmallYaml;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(dbow_yaml, trees_of_every_shape_and_spelling_are_read) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const bool is_binary = seed % 3 != 0;
    const std::uint32_t size = 1 + seed * 3;
    const toy::Tree tree = toy::makeTree(seed, 2 + seed % 7, 1 + seed % 4, size, is_binary);
    const std::string shape = (is_binary ? "0 " : "5 ") + std::to_string(size) + " ";
    for (const std::string& prefix : {std::string(), shape, "dbw3 " + shape}) {
      const Vocabulary vocabulary = load(toy::yaml(tree, prefix));
      toy::expectSame(vocabulary, tree);
      EXPECT_EQ(static_cast<unsigned>(vocabulary.scoring()), tree.scoring);
      EXPECT_EQ(static_cast<unsigned>(vocabulary.weighting()), tree.weighting);
    }
  }
}

// Newer DBoW3 in newer OpenCV: without quotes, because it begins with a letter.
TEST(dbow_yaml, descriptors_need_no_quotes) {
  const toy::Tree tree = toy::makeTree(1, 3, 2, 32, true);
  const std::string text = toy::yaml(tree, "dbw3 0 32 ");
  toy::expectSame(load(replacedAll(text, "\"", "")), tree);
  toy::expectSame(load(replacedAll(text, "\"", "'")), tree);
}

TEST(dbow_yaml, layout_is_free_where_yaml_is) {
  const toy::Tree tree = toy::makeTree(2, 4, 3, 32, true);
  const std::string text = toy::yaml(tree, "");
  toy::expectSame(load(replacedAll(text, "---\n", "")), tree);
  toy::expectSame(load(replacedAll(text, "%YAML:1.0\n", "")), tree);
  toy::expectSame(load(replacedAll(text, "%YAML:1.0\n---\n", "")), tree);
  toy::expectSame(load(replacedAll(text, "%YAML:1.0", "%YAML 1.0")), tree);
  toy::expectSame(load("\xEF\xBB\xBF" + text), tree);
  toy::expectSame(load(replacedAll(text, "\n", "\r\n")), tree);
  toy::expectSame(load(replacedAll(text, ", ", ",\n           ")), tree);
  toy::expectSame(load(replacedAll(text, ",\n  ", ", ")), tree);
  toy::expectSame(load(replacedAll(replacedAll(text, "Id:", "Id: "), " }", "}")), tree);
  toy::expectSame(load(text + "\n\n"), tree);
  toy::expectSame(load(text.substr(0, text.size() - 1)), tree);
  toy::expectSame(load(text + "...\n"), tree);
  toy::expectSame(load(text + "database:\n   nEntries: 0\n"), tree);  // as DBoW saves databases
}

TEST(dbow_yaml, fields_may_be_in_any_order) {
  EXPECT_EQ(errorOf(kSmallYaml), "");
  const Vocabulary vocabulary = load(
      replacedAll(kSmallYaml, "nodeId:4, parentId:1, weight:1.5,\n          descriptor:\"7 8 9 \"",
                  "descriptor:\"7 8 9 \", weight:1.5, parentId:1, nodeId:4"));
  EXPECT_EQ(vocabulary.wordCount(), 3u);
  EXPECT_EQ(vocabulary.weight(2), 1.5);
  EXPECT_EQ(vocabulary.scoring(), gslam::Scoring::kl);
  EXPECT_EQ(vocabulary.weighting(), gslam::Weighting::tf);
}

// The first descriptor of DBoW2 looks like one of old DBoW3, which all must.
TEST(dbow_yaml, one_descriptor_that_looks_like_another_spelling_is_chance) {
  toy::Tree tree = toy::makeTree(3, 3, 2, 32, true);
  tree.nodes[0].bytes[0] = 0;
  tree.nodes[0].bytes[1] = 30;
  toy::expectSame(load(toy::yaml(tree, "")), tree);
  tree = toy::makeTree(4, 3, 2, 34, true);
  for (toy::Node& node : tree.nodes) node.bytes[1] = 33;
  tree.nodes[0].bytes[0] = 0;
  tree.nodes[0].bytes[1] = 32;
  toy::expectSame(load(toy::yaml(tree, "")), tree);
  toy::expectSame(load(toy::yaml(tree, "0 34 ")), tree);
}

// The fault of today's DBoW2 and DBoW3, which take "0 32" for two bytes.
TEST(dbow_yaml, old_dbow3_is_not_shifted) {
  const toy::Tree tree = toy::makeTree(5, 3, 2, 32, true);
  const Vocabulary vocabulary = load(toy::yaml(tree, "0 32 "));
  EXPECT_EQ(vocabulary.format().size, 32u);
  toy::expectSame(vocabulary, tree);
}

TEST(dbow_yaml, bits_of_fbrief_are_read_from_the_last) {
  std::string text = replacedAll(kSmallYaml, "1 2 3 ", "0000000110000000");
  text = replacedAll(text, "4 5 6 ", "1111111100000001");
  text = replacedAll(text, "7 8 9 ", "0000000000000000");
  text = replacedAll(text, "10 11 12 ", "1000000000000011");
  const Vocabulary vocabulary = load(text);
  EXPECT_EQ(vocabulary.format().size, 2u);
  const std::uint8_t* const first = gslam::detail::descriptorOf(vocabulary.tree(), 1);
  EXPECT_EQ(first[0], 0x80);  // bits 0 to 7
  EXPECT_EQ(first[1], 0x01);
  const std::uint8_t* const second = gslam::detail::descriptorOf(vocabulary.tree(), 2);
  EXPECT_EQ(second[0], 0x01);
  EXPECT_EQ(second[1], 0xFF);
  EXPECT_NE(errorOf(replacedAll(text, "1111111100000001", "111111110000000")), "");
  EXPECT_NE(errorOf(replacedAll(text, "1111111100000001", "11111111000000012")), "");
}

TEST(dbow_yaml, floats_are_exact) {
  std::string text = replacedAll(kSmallYaml, "1 2 3 ", "0.1 -1.5e-05 3 ");
  text = replacedAll(text, "4 5 6 ", "1 2 3 ");
  text = replacedAll(text, "7 8 9 ", "16777217 1e-40 -0 ");
  const Vocabulary vocabulary = load(text);
  EXPECT_EQ(vocabulary.format().type, gslam::DescriptorType::float32);
  std::vector<float> numbers(3);
  std::memcpy(numbers.data(), gslam::detail::descriptorOf(vocabulary.tree(), 1), 12);
  EXPECT_EQ(numbers, (std::vector<float>{0.1F, -1.5e-05F, 3.0F}));
  std::memcpy(numbers.data(), gslam::detail::descriptorOf(vocabulary.tree(), 3), 12);
  EXPECT_EQ(numbers, (std::vector<float>{16777216.0F, 1e-40F, -0.0F}));
}

TEST(dbow_yaml, floats_may_begin_with_integers) {
  const Vocabulary vocabulary = load(replacedAll(kSmallYaml, "7 8 9 ", "7 0.5 -9 "));
  EXPECT_EQ(vocabulary.format().type, gslam::DescriptorType::float32);
  std::vector<float> numbers(3);
  std::memcpy(numbers.data(), gslam::detail::descriptorOf(vocabulary.tree(), 1), 12);
  EXPECT_EQ(numbers, (std::vector<float>{1, 2, 3}));
  std::memcpy(numbers.data(), gslam::detail::descriptorOf(vocabulary.tree(), 3), 12);
  EXPECT_EQ(numbers, (std::vector<float>{7, 0.5F, -9}));
}

// Weights of inner nodes are what was in the memory.
TEST(dbow_yaml, weights_need_be_numbers_in_leaves_alone) {
  for (const char* const weight : {".Nan", ".Inf", "-.Inf", "-3."}) {
    EXPECT_EQ(errorOf(yamlWith("weight:0.", std::string("weight:") + weight)), "");
    EXPECT_NE(errorOf(yamlWith("weight:1.5", std::string("weight:") + weight)), "");
  }
}

TEST(dbow_yaml, errors_name_the_line_and_the_column) {
  EXPECT_EQ(errorOf(yamlWith("k: 2", "k: 65")), "toy:4:7: expected a number of 2 to 64, got '65'");
  EXPECT_EQ(errorOf(yamlWith("L: 2", "L: 0")), "toy:5:7: expected a number of 1 to 64, got '0'");
  EXPECT_EQ(errorOf(yamlWith("8 9", "8 256")),
            "toy:14:27: expected a byte of 0 to 255, of 3 as in the first descriptor, got "
            "'256'");
  EXPECT_EQ(errorOf(yamlWith("7 8 9 ", "7 8 9 10 ")),
            "toy:14:29: expected the end of a descriptor, got '10'");
  EXPECT_EQ(errorOf(yamlWith("weight:1.5", "weight:x")), "toy:13:40: expected a number, got 'x,'");
  EXPECT_EQ(errorOf(yamlWith("nodeId:4", "nodeId:5")),
            "toy:13:9: the node has the id 5, expected 1 to 4, as there are nodes");
  EXPECT_EQ(errorOf(yamlWith("nodeId:4", "nodeId:2")),
            "toy:13:9: the node has the id 2, which another has, too");
  EXPECT_EQ(errorOf(yamlWith("nodeId:4, parentId:1", "nodeId:4, parentId:4")),
            "toy:13:9: the node has the id 4 and the parent 4, which cannot be");
  EXPECT_EQ(errorOf(yamlWith("nodeId:4, parentId:1", "nodeId:4, parentId:5")),
            "toy:13:9: the node has the id 4 and the parent 5, which cannot be");
  EXPECT_EQ(errorOf(yamlWith("wordId:1, nodeId:3", "wordId:1, nodeId:2")),
            "toy:19:21: the node 2 has two words");
  EXPECT_EQ(errorOf(yamlWith("wordId:1, nodeId:3", "wordId:1, nodeId:5")),
            "toy:19:21: the node 5 is not there");
  EXPECT_EQ(errorOf(yamlWith("parentId:1, ", "")),
            "toy:14:31: expected nodeId, parentId, weight and descriptor, got '}'");
  EXPECT_EQ(errorOf(yamlWith("parentId:1", "nodeId:1")), "toy:13:21: this field is there twice");
  EXPECT_EQ(errorOf(yamlWith("   L: 2\n", "   k: 2\n")), "toy:5:4: this field is there twice");
  EXPECT_EQ(errorOf(yamlWith("   L: 2\n", "   M: 2\n")),
            "toy:5:4: expected k, L, scoringType, weightingType, nodes, words or the end of "
            "the file, got 'M:'");
  EXPECT_EQ(errorOf(yamlWith("   L: 2\n", "")),
            "toy:20:1: expected the field L, got the end "
            "of the file");
}

TEST(dbow_yaml, other_wrong_files_are_refused) {
  const std::string words =
      std::string(kSmallYaml).substr(std::string(kSmallYaml).find("   words"));
  for (const std::string& text :
       {yamlWith(words, ""),
        yamlWith("      - { wordId:1, nodeId:3 }\n", ""),
        yamlWith("wordId:1, nodeId:3", "wordId:0, nodeId:3"),
        yamlWith("wordId:1, nodeId:3", "wordId:1, nodeId:1"),
        yamlWith("wordId:1, nodeId:3", "wordId:99999999, nodeId:3"),
        yamlWith("wordId:1, nodeId:3", "wordId:1, nodeId:0"),
        yamlWith("wordId:1, nodeId:3", "wordId:1, wordId:3"),
        yamlWith("wordId:1", "wordId:-1"),
        yamlWith("nodeId:1, parentId:0", "nodeId:1, parentId:3"),  // a circle
        yamlWith("nodeId:1,", "nodeId:0,"),
        yamlWith("nodeId:1,", "nodeId:4294967297,"),
        yamlWith("k: 2", "k: 1"),
        yamlWith("k: 2", "k: 65"),
        yamlWith("L: 2", "L: 1"),
        yamlWith("L: 2", "L: 99999999999"),
        yamlWith("scoringType: 3", "scoringType: 6"),
        yamlWith("weightingType: 1", "weightingType: 4"),
        yamlWith("\"4 5 6 \"", "\"4 5 6 "),
        yamlWith("4 5 6 ", "4 5 "),
        yamlWith("4 5 6 ", ""),
        yamlWith("4 5 6 ", "4.5. 5 6 "),
        yamlWith("4 5 6 ", "dbw3 0 3 4 5 6 "),
        yamlWith("1 2 3 ", "dbw3 0 3 1 2 3 "),
        yamlWith("1 2 3 ", "dbw3"),
        yamlWith("1 2 3 ", "dbw3 0 0 "),
        yamlWith("1 2 3 ", ""),
        yamlWith("1 2 3 ", "dbw3 7 3 1 2 3 "),
        yamlWith("1 2 3 ", "dbw3 0 99999 1 2 3 "),
        yamlWith("vocabulary:", "vocabulary"),
        yamlWith("vocabulary:", "database:"),
        std::string("%YAML:1.0\n---\n"),
        std::string("%YAML:1.0"),
        std::string("vocabulary:"),
        std::string("---\nvocabulary:\n   k: 2\n   nodes:\n   words:\n"),
        std::string(kSmallYaml) + "and more",
        std::string(kSmallYaml) + std::string(1, '\0')}) {
    EXPECT_NE(errorOf(text), "") << text;
  }
}

TEST(dbow_yaml, descriptors_of_two_kinds_are_refused) {
  const toy::Tree tree = toy::makeTree(6, 3, 2, 8, true);
  const std::string text = toy::yaml(tree, "dbw3 0 8 ");
  const std::size_t last = text.rfind("dbw3 0 8");
  for (const char* const other : {"dbw3 5 8", "dbw3 0 7", "0 8", "dbw3 0", ""}) {
    std::string mixed = text;
    EXPECT_NE(errorOf(mixed.replace(last, 8, other)), "") << other;
  }
  std::string typed = toy::yaml(tree, "0 8 ");
  EXPECT_NE(errorOf(typed.replace(typed.rfind("\"0 8 "), 5, "\"")), "");
}

TEST(dbow_yaml, truncated_files_are_refused) {
  const std::string text = toy::yaml(toy::makeTree(7, 3, 2, 4, true), "dbw3 0 4 ");
  EXPECT_EQ(errorOf(text.substr(0, text.size() - 1)), "");  // the end of the last line
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {
    EXPECT_NE(errorOf(text.substr(0, size)), "") << size;
  }
}

TEST(dbow_yaml, flipped_bits_do_no_harm) {
  const std::string text = toy::yaml(toy::makeTree(8, 3, 2, 3, true), "0 3 ");
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < text.size() * 8; ++bit) {
    std::string damaged = text;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    refused += errorOf(damaged).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, text.size() * 6);
}

}  // namespace
