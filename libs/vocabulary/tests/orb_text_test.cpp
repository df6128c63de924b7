#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/orb_slam_text.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "toy_tree.h"

namespace {

using gslam::Vocabulary;
using toy::errorOf;
using toy::load;

std::string fileText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

std::string save(const Vocabulary& vocabulary) {
  const std::string path = testing::TempDir() + std::to_string(getpid()) + "_orb_text_test.txt";
  gslam::saveOrbSlamText(vocabulary, path);
  std::string text = fileText(path);
  std::remove(path.c_str());
  return text;
}

// What the loader of ORB-SLAM makes of a text, step by step as it does: a stream for each line,
// and a node more where something follows the last end of a line, be it nothing.
struct OrbSlamNode {
  int parent = 0;
  std::vector<int> children;
  std::vector<int> bytes;
  double weight = 0;
  int word = -1;
};

std::vector<OrbSlamNode> loadAsOrbSlam(const std::string& text, int size) {
  std::istringstream file(text);
  std::string line;
  std::getline(file, line);
  std::vector<OrbSlamNode> nodes(1);
  int words = 0;
  while (!file.eof()) {
    std::getline(file, line);
    std::istringstream words_of_line(line);
    OrbSlamNode node;
    int is_leaf = 0;
    words_of_line >> node.parent >> is_leaf;
    for (int i = 0; i < size; ++i) {
      int byte = -1;
      words_of_line >> byte;
      node.bytes.push_back(byte);
    }
    words_of_line >> node.weight;
    if (is_leaf > 0) node.word = words++;
    nodes[static_cast<std::size_t>(node.parent)].children.push_back(static_cast<int>(nodes.size()));
    nodes.push_back(node);
  }
  return nodes;
}

// Same children in the same order, descriptors, words and weights, from the root down.
void expectSameAsOrbSlam(const Vocabulary& vocabulary, const std::vector<OrbSlamNode>& nodes) {
  const gslam::detail::TreeView& tree = vocabulary.tree();
  ASSERT_EQ(vocabulary.nodeCount(), nodes.size());
  std::vector<std::size_t> number_of(nodes.size(), 0);  // of nodes of the vocabulary
  for (std::uint32_t at = 0; at < tree.node_count; ++at) {
    const OrbSlamNode& node = nodes[number_of[at]];
    const gslam::detail::Children children = gslam::detail::childrenOf(tree, at);
    ASSERT_EQ(children.count, node.children.size());
    for (std::uint32_t i = 0; i < children.count; ++i) {
      number_of[children.first + i] = static_cast<std::size_t>(node.children[i]);
    }
    if (at == 0) continue;
    const std::uint8_t* const row = gslam::detail::descriptorOf(tree, at);
    for (std::size_t i = 0; i < node.bytes.size(); ++i) ASSERT_EQ(row[i], node.bytes[i]);
    if (children.count != 0) continue;
    ASSERT_EQ(gslam::detail::wordOf(tree, at), static_cast<std::uint32_t>(node.word));
    ASSERT_EQ(gslam::detail::weightOf(tree, static_cast<std::uint32_t>(node.word)), node.weight);
  }
}

const char kSmallOrbText[] =
    "2 2 0 0\n"
    "0 0 1 2 3 0\n"
    "0 1 4 5 6 0.5\n"
    "1 1 7 8 9 1.5\n"
    "1 1 10 11 12 2.5\n";

std::string orbTextWith(const std::string& from, const std::string& to) {
  std::string text = kSmallOrbText;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST(orb_text, trees_of_every_shape_are_read) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const toy::Tree tree = toy::makeTree(seed, 2 + seed % 7, 1 + seed % 4, 1 + seed * 3, true);
    const Vocabulary vocabulary = load(toy::orbText(tree));
    toy::expectSame(vocabulary, tree);
    EXPECT_EQ(static_cast<unsigned>(vocabulary.scoring()), tree.scoring);
    EXPECT_EQ(static_cast<unsigned>(vocabulary.weighting()), tree.weighting);
  }
}

TEST(orb_text, last_newline_makes_no_node) {
  const toy::Tree tree = toy::makeTree(1, 3, 3, 32, true);
  const std::string text = toy::orbText(tree);
  ASSERT_EQ(text.back(), '\n');
  EXPECT_EQ(loadAsOrbSlam(text, 32).size(), tree.nodes.size() + 2);  // the fault of ORB-SLAM
  for (const char* const end : {"", "\n", "\n\n\n", "\r\n", " \t\n "}) {
    toy::expectSame(load(text.substr(0, text.size() - 1) + end), tree);
  }
}

TEST(orb_text, windows_line_ends_and_many_blanks_are_no_matter) {
  const toy::Tree tree = toy::makeTree(2, 4, 3, 8, true);
  std::string text;
  for (const char c : toy::orbText(tree)) {
    text += c == '\n' ? "\r\n" : c == ' ' ? " \t" : std::string(1, c);
  }
  toy::expectSame(load(text), tree);
}

TEST(orb_text, pieces_of_any_size_give_the_same) {
  const toy::Tree tree = toy::makeTree(3, 5, 3, 16, true);
  const std::string name = "toy.txt";
  const std::string lines = toy::orbText(tree);
  for (const std::string& text : {lines, lines.substr(0, lines.size() - 1)}) {
    const std::vector<std::uint8_t> bytes = toy::bytesOfText(text);
    const gslam::detail::VocabularyText view(bytes.data(), bytes.size(), name);
    for (std::size_t piece = 1; piece < 300; piece = piece * 3 / 2 + 1) {
      const gslam::detail::TreeData data = gslam::detail::OrbTextReader(view, piece).read();
      toy::expectSame(gslam::detail::buildVocabulary(data, name), tree);
    }
  }
}

TEST(orb_text, errors_name_the_line_and_the_column) {
  EXPECT_EQ(errorOf(kSmallOrbText), "");
  EXPECT_EQ(errorOf(orbTextWith("8 9", "8 256")),
            "toy:4:9: expected a byte of 0 to 255, got '256'");
  EXPECT_EQ(errorOf(orbTextWith("8 9", "8 -9")), "toy:4:9: expected a byte of 0 to 255, got '-9'");
  EXPECT_EQ(errorOf(orbTextWith("8 9", "8 .9")), "toy:4:9: expected a byte of 0 to 255, got '.9'");
  EXPECT_EQ(errorOf(orbTextWith(" 0.5", "")),
            "toy:3:10: expected a weight, got the end of the line");
  EXPECT_EQ(errorOf(orbTextWith("0.5", "0.5 1")),
            "toy:3:15: expected the end of the line, got '1'");
  EXPECT_EQ(errorOf(orbTextWith("1 1 7", "3 1 7")),
            "toy:4:1: the parent 3 of node 3 does not come before it");
  EXPECT_EQ(errorOf(orbTextWith("1 1 7", "1 2 7")),
            "toy:4:3: expected the mark of a leaf of 0 to 1, got '2'");
  EXPECT_EQ(errorOf(orbTextWith("1 1 7", "1 0 7")),
            "toy:4: node 3 is not marked as a leaf, but has no children");
  EXPECT_EQ(errorOf(orbTextWith("0 0 1", "0 1 1")),
            "toy:2: node 1 is marked as a leaf, but has children");
  EXPECT_EQ(errorOf(orbTextWith("2 2 0 0", "65 2 0 0")),
            "toy:1:1: expected the branching K of 2 to 64, got '65'");
  EXPECT_EQ(errorOf(orbTextWith("2 2 0 0", "2 0 0 0")),
            "toy:1:3: expected the depth L of 1 to 64, got '0'");
  EXPECT_EQ(errorOf(orbTextWith("2 2 0 0", "2 2 6 0")),
            "toy:1:5: expected the number of a scoring of 0 to 5, got '6'");
  EXPECT_EQ(errorOf(orbTextWith("2 2 0 0", "2 2 0 4")),
            "toy:1:7: expected the number of a weighting of 0 to 3, got '4'");
  EXPECT_EQ(errorOf(orbTextWith("2 2 0 0\n", "2 2 0\n")),
            "toy:1:6: expected the number of a weighting of 0 to 3, got the end of the line");
}

TEST(orb_text, other_wrong_files_are_refused) {
  for (const std::string& text :
       {std::string("2 2 0 0"), std::string("2 2 0 0\n"), std::string("2 2 0 0\n\n\n"),
        std::string("2 2 0 0\n0 1 5\n"), orbTextWith("2 2 0 0", "1 2 0 0"),
        orbTextWith("2 2 0 0", "65 2 0 0"), orbTextWith("2 2 0 0", "2 1 0 0"),
        orbTextWith("2 2 0 0", "2 999999999999 0 0"), orbTextWith("0.5", "nan"),
        orbTextWith("0.5", "-1"), orbTextWith("0.5", "1e999"), orbTextWith("4 5 6", "4 5"),
        orbTextWith("4 5 6", "4 5 6 7"), orbTextWith("0 1 4", "-1 1 4"),
        orbTextWith("0 1 4", "99999999999 1 4"), orbTextWith("0.5\n", "0.5\n\n"),
        orbTextWith("0 1 4 5 6 0.5\n", "0 1 4 5 6 0.5 "), orbTextWith("1 1 10", "0 1 10"),
        std::string("2 2 0 0\n") + std::string(200000, '\n') + "0"}) {
    EXPECT_NE(errorOf(text), "") << text.substr(0, 100);
  }
}

// The format does not say how many nodes there are: what is left of a file may be a smaller tree.
TEST(orb_text, truncated_files_are_refused_or_hold_the_first_nodes) {
  const toy::Tree tree = toy::makeTree(4, 3, 2, 4, true);
  const std::string text = toy::orbText(tree);
  int refused = 0;
  for (std::size_t size = 0; size < text.size(); ++size) {
    Vocabulary vocabulary;
    try {
      vocabulary = load(text.substr(0, size));
    } catch (const gslam::ParseError&) {
      ++refused;
      continue;
    }
    const gslam::detail::TreeView& view = vocabulary.tree();
    for (std::uint32_t node = 1; node < view.node_count; ++node) {
      const toy::Node& expected = tree.nodes[gslam::detail::nodeId(view, node) - 1];
      const std::uint8_t* const row = gslam::detail::descriptorOf(view, node);
      EXPECT_EQ(std::vector<std::uint8_t>(row, row + 4), expected.bytes);
    }
  }
  EXPECT_GT(refused, static_cast<int>(text.size() * 3 / 4));
}

TEST(orb_text, flipped_bits_do_no_harm) {
  const std::string text = toy::orbText(toy::makeTree(5, 3, 2, 3, true));
  int refused = 0;
  for (std::size_t bit = 0; bit < text.size() * 8; ++bit) {
    std::string damaged = text;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    refused += errorOf(damaged).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, static_cast<int>(text.size() * 4));
}

TEST(orb_text, what_is_written_is_read_the_same_by_us_and_by_orb_slam) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const toy::Tree tree = toy::makeTree(seed, 2 + seed % 7, 1 + seed % 4, 32, true);
    const Vocabulary vocabulary = load(toy::orbText(tree));
    const std::string text = save(vocabulary);
    toy::expectSame(load(text), tree);  // with the ids
    expectSameAsOrbSlam(vocabulary, loadAsOrbSlam(text, 32));
    EXPECT_EQ(save(load(text)), text);
  }
}

gslam::detail::TreeData treeOfFour() {
  gslam::detail::TreeData data;
  data.format.size = 1;
  data.branching = 3;
  data.depth = 2;
  data.parents = {0, 0, 0, 1};
  data.weights = {0, 1, 2, 3};
  data.words = {gslam::detail::kNone, 0, 1, 2};
  data.descriptors = {10, 20, 30, 40};
  return data;
}

TEST(orb_text, nodes_are_numbered_anew_where_ids_do_not_ascend) {
  gslam::detail::TreeData data = treeOfFour();
  data.ids = {4, 3, 2, 1};
  data.parents = {0, 0, 0, 4};
  const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "four");
  const std::string text = save(vocabulary);
  EXPECT_EQ(text, "3 2 0 0\n0 0 10 0\n0 1 20 1\n0 1 30 2\n1 1 40 3");
  expectSameAsOrbSlam(vocabulary, loadAsOrbSlam(text, 1));
}

TEST(orb_text, words_and_the_order_of_siblings_decide_the_lines) {
  gslam::detail::TreeData data = treeOfFour();
  data.words = {gslam::detail::kNone, 1, 2, 0};  // the deeper leaf first
  const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "four");
  const std::string text = save(vocabulary);
  EXPECT_EQ(text, "3 2 0 0\n0 0 10 0\n1 1 40 3\n0 1 20 1\n0 1 30 2");
  expectSameAsOrbSlam(vocabulary, loadAsOrbSlam(text, 1));
}

TEST(orb_text, what_the_format_cannot_hold_is_refused) {
  const std::string path = testing::TempDir() + std::to_string(getpid()) + "_orb_text_refused.txt";
  const auto refused = [&path](const gslam::detail::TreeData& data) {
    EXPECT_THROW(gslam::saveOrbSlamText(gslam::detail::buildVocabulary(data, "four"), path),
                 gslam::ArgumentError);
    EXPECT_FALSE(std::ifstream(path).good());
  };
  gslam::detail::TreeData swapped = treeOfFour();
  swapped.words = {gslam::detail::kNone, 1, 0, 2};  // siblings whose words do not ascend
  refused(swapped);
  gslam::detail::TreeData wide = treeOfFour();
  wide.branching = 21;
  refused(wide);
  gslam::detail::TreeData deep = treeOfFour();
  deep.depth = 11;
  refused(deep);
  gslam::detail::TreeData other = treeOfFour();
  other.format.type = gslam::DescriptorType::int8;
  refused(other);
  EXPECT_THROW(gslam::saveOrbSlamText(Vocabulary(), path), gslam::ArgumentError);
  EXPECT_THROW(gslam::saveOrbSlamText(gslam::detail::buildVocabulary(treeOfFour(), "four"),
                                      testing::TempDir() + "not/there.txt"),
               gslam::FileError);
}

TEST(orb_text, weights_are_the_same_to_the_bit_in_any_locale) {
  gslam::detail::TreeData data = treeOfFour();
  const char* const old = std::setlocale(LC_ALL, nullptr);
  const std::string before = old == nullptr ? "C" : old;
  for (const char* const locale : {"C", "de_DE.UTF-8", "de_DE"}) {
    if (std::setlocale(LC_ALL, locale) == nullptr) continue;
    for (const double weight : {1.0 / 3, 0.1, 1e-300, 5e-324, 1.7976931348623157e308, 2.5, 0.0,
                                8.1234567890123456, 1e21}) {
      data.weights[3] = weight;
      const Vocabulary read = load(save(gslam::detail::buildVocabulary(data, "four")));
      EXPECT_EQ(read.weight(2), weight);
    }
  }
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
