// The real files, and files that are compressed.
#ifdef GSLAM_HAS_ZLIB

#include <gslam/base/error.h>
#include <gslam/vocabulary/gzip.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/orb_slam_text.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "test_data.h"
#include "toy_tree.h"

namespace {

using gslam::Vocabulary;

std::string slambook() {
  return test_data::folder() + "vocabularies/slambook_vocabulary.yml.gz";
}
std::string kimera() {
  return test_data::folder() + "vocabularies/kimera_dbow2_small_voc.yml.gz";
}

// By zlib's own reader of files.
std::string unpacked(const std::string& path) {
  const gzFile file = gzopen(path.c_str(), "rb");
  std::string text;
  char piece[4096];
  int size = 0;
  while (file != nullptr && (size = gzread(file, piece, sizeof piece)) > 0) {
    text.append(piece, static_cast<std::size_t>(size));
  }
  if (file != nullptr) gzclose(file);
  return text;
}

// What is in the YAML, found by looking for names: numbers behind them, one node after the other.
struct Found {
  std::map<std::uint32_t, std::uint32_t> parent_of, node_of;  // of nodes, of words
  std::map<std::uint32_t, double> weight_of;
  std::map<std::uint32_t, std::string> descriptor_of;
};

Found find(const std::string& text) {
  Found found;
  const std::size_t words = text.find("words:");
  for (std::size_t at = text.find("nodeId:"); at < words; at = text.find("nodeId:", at + 1)) {
    unsigned id = 0;
    unsigned parent = 0;
    double weight = 0;
    char descriptor[400] = "";
    const int count =
        std::sscanf(text.c_str() + at, "nodeId:%u, parentId:%u, weight:%lf, descriptor:\"%399[^\"]",
                    &id, &parent, &weight, descriptor);
    EXPECT_EQ(count, 4);
    found.parent_of[id] = parent;
    found.weight_of[id] = weight;
    found.descriptor_of[id] = descriptor;
  }
  for (std::size_t at = text.find("wordId:"); at != std::string::npos;
       at = text.find("wordId:", at + 1)) {
    unsigned word = 0;
    unsigned id = 0;
    EXPECT_EQ(std::sscanf(text.c_str() + at, "wordId:%u, nodeId:%u", &word, &id), 2);
    found.node_of[word] = id;
  }
  return found;
}

void expectFound(const Vocabulary& vocabulary, const Found& found, const std::string& prefix) {
  const gslam::detail::TreeView& tree = vocabulary.tree();
  ASSERT_EQ(vocabulary.nodeCount(), found.parent_of.size() + 1);
  ASSERT_EQ(vocabulary.wordCount(), found.node_of.size());
  for (std::uint32_t node = 0; node < tree.node_count; ++node) {
    const std::uint32_t id = gslam::detail::nodeId(tree, node);
    const gslam::detail::Children children = gslam::detail::childrenOf(tree, node);
    for (std::uint32_t i = 0; i < children.count; ++i) {
      ASSERT_EQ(found.parent_of.at(gslam::detail::nodeId(tree, children.first + i)), id);
    }
    if (node == 0) continue;
    std::string text = prefix;
    const std::uint8_t* const row = gslam::detail::descriptorOf(tree, node);
    for (std::uint32_t i = 0; i < 32; ++i) text += std::to_string(unsigned(row[i])) + " ";
    ASSERT_EQ(text, found.descriptor_of.at(id));
    const std::uint32_t word = gslam::detail::wordOf(tree, node);
    if (word == gslam::detail::kNone) continue;
    ASSERT_EQ(found.node_of.at(word), id);
    ASSERT_EQ(vocabulary.weight(word), found.weight_of.at(id));
  }
}

TEST(gzip, slambook_vocabulary_is_read) {
  NEEDS_TEST_DATA();
  const Vocabulary vocabulary = gslam::loadGzippedVocabulary(slambook());
  EXPECT_EQ(vocabulary.branching(), 10u);
  EXPECT_EQ(vocabulary.depth(), 5u);
  EXPECT_EQ(vocabulary.wordCount(), 4983u);
  EXPECT_EQ(vocabulary.format().size, 32u);  // though "0 32" is in front of the bytes
  EXPECT_EQ(vocabulary.weighting(), gslam::Weighting::tf_idf);
  EXPECT_EQ(vocabulary.scoring(), gslam::Scoring::l1);
  const std::uint8_t* const first = gslam::detail::descriptorOf(vocabulary.tree(), 1);
  EXPECT_EQ(std::vector<int>(first, first + 4), (std::vector<int>{27, 159, 99, 205}));
  expectFound(vocabulary, find(unpacked(slambook())), "0 32 ");
}

TEST(gzip, kimera_vocabulary_is_read) {
  NEEDS_TEST_DATA();
  const Vocabulary vocabulary = gslam::loadGzippedVocabulary(kimera());
  EXPECT_EQ(vocabulary.branching(), 9u);
  EXPECT_EQ(vocabulary.depth(), 3u);
  EXPECT_EQ(vocabulary.format().size, 32u);
  const std::uint8_t* const first = gslam::detail::descriptorOf(vocabulary.tree(), 1);
  EXPECT_EQ(std::vector<int>(first, first + 4), (std::vector<int>{212, 176, 157, 246}));
  expectFound(vocabulary, find(unpacked(kimera())), "");
}

TEST(gzip, real_vocabularies_are_the_same_through_the_text_of_orb_slam) {
  NEEDS_TEST_DATA();
  const std::string path = testing::TempDir() + std::to_string(getpid()) + "_gzip_test.txt";
  for (const std::string& file : {slambook(), kimera()}) {
    gslam::saveOrbSlamText(gslam::loadGzippedVocabulary(file), path);
    const std::string prefix = file == kimera() ? "" : "0 32 ";
    expectFound(gslam::loadVocabulary(path), find(unpacked(file)), prefix);
  }
  std::remove(path.c_str());
}

TEST(gzip, without_its_header_the_answer_names_it) {
  NEEDS_TEST_DATA();
  try {
    gslam::loadVocabulary(slambook());
    FAIL() << "no error";
  } catch (const gslam::ParseError& error) {
    EXPECT_NE(std::string(error.what()).find("gslam/vocabulary/gzip.h"), std::string::npos);
  }
}

std::string fileOf(const std::string& bytes) {
  std::string path = testing::TempDir() + std::to_string(getpid()) + "_gzip_test.any";
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string zipped(const std::string& text) {
  const std::string path = testing::TempDir() + std::to_string(getpid()) + "_gzip_test.gz";
  const gzFile file = gzopen(path.c_str(), "wb");
  EXPECT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())),
            static_cast<int>(text.size()));
  gzclose(file);
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::remove(path.c_str());
  return bytes;
}

TEST(gzip, any_kind_of_file_may_be_inside_or_none) {
  const toy::Tree tree = toy::makeTree(1, 4, 3, 32, true);
  const std::string text = toy::orbText(tree);
  const std::vector<std::uint8_t> binary = toy::dbow3(tree);
  toy::expectSame(gslam::loadGzippedVocabulary(fileOf(zipped(text))), tree);
  toy::expectSame(gslam::loadGzippedVocabulary(fileOf(text)), tree);
  toy::expectSame(
      gslam::loadGzippedVocabulary(fileOf(zipped(std::string(binary.begin(), binary.end())))),
      tree);
  const std::size_t half = text.size() / 2;  // two members, as "cat a.gz b.gz" makes them
  toy::expectSame(gslam::loadGzippedVocabulary(
                      fileOf(zipped(text.substr(0, half)) + zipped(text.substr(half)))),
                  tree);
}

TEST(gzip, damaged_files_are_refused) {
  const std::string bytes = zipped(toy::orbText(toy::makeTree(2, 3, 2, 8, true)));
  EXPECT_NO_THROW(gslam::loadGzippedVocabulary(fileOf(bytes)));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(gslam::loadGzippedVocabulary(fileOf(bytes.substr(0, size))), gslam::ParseError);
  }
  // All but the header have a checksum, and the last byte before that may have bits to spare.
  for (std::size_t at = 10; at < bytes.size(); ++at) {
    if (at + 9 == bytes.size()) continue;
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_THROW(gslam::loadGzippedVocabulary(fileOf(damaged)), gslam::ParseError) << at;
  }
  EXPECT_THROW(gslam::loadGzippedVocabulary(fileOf(bytes + "more")), gslam::ParseError);
  const std::string padding(1000, '\0');
  EXPECT_NO_THROW(gslam::loadGzippedVocabulary(fileOf(bytes + padding)));
  EXPECT_THROW(gslam::loadGzippedVocabulary(fileOf(bytes + padding + "x")), gslam::ParseError);
  std::remove(fileOf("").c_str());
}

TEST(gzip, what_unpacks_to_too_much_is_refused) {
  const std::string bytes = zipped(std::string(3000000, '0'));
  EXPECT_LT(bytes.size(), 10000u);
  try {
    gslam::loadGzippedVocabulary(fileOf(bytes), 1000000);
    FAIL() << "no error";
  } catch (const gslam::ParseError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 1000000 bytes"), std::string::npos);
  }
  std::remove(fileOf("").c_str());
}

}  // namespace

#endif  // GSLAM_HAS_ZLIB
