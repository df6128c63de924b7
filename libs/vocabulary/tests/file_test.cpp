// GSLAM's own files: there and back, and damaged in every way.
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/orb_slam_text.h>
#include <gslam/vocabulary/transform.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "random_tree.h"

namespace {

using gslam::DescriptorType;
using gslam::Vocabulary;
using random_tree::formatOf;
using random_tree::treeOf;

std::string bytesOfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

// A folder that goes with the test.
class VocabularyFile : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/vocabulary_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    std::remove(path().c_str());
    EXPECT_EQ(rmdir(folder_.c_str()), 0) << "something was left behind";
  }
  std::string path() const { return folder_ + "/tree.gvoc"; }

  void write(const std::string& bytes) const { std::ofstream(path(), std::ios::binary) << bytes; }
  // What opening, or verifying, says of these bytes; empty: nothing.
  std::string complaintAbout(const std::string& bytes, bool verifies = true) const {
    write(bytes);
    try {
      const Vocabulary vocabulary = gslam::openVocabulary(path());
      if (verifies) verifyVocabulary(vocabulary, path());
    } catch (const gslam::Error& error) {
      return error.what();
    }
    return std::string();
  }

 private:
  std::string folder_;
};

// The header after a change, with a checksum that fits.
template <class T>
std::string withField(std::string bytes, std::size_t offset, T value) {
  std::memcpy(&bytes[offset], &value, sizeof value);
  const auto* const header = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const std::uint64_t sum = gslam::detail::Xxh64::of(header, 248);
  std::memcpy(&bytes[248], &sum, 8);
  return bytes;
}

TEST_F(VocabularyFile, GoesThereAndBack) {
  for (const DescriptorType type : {DescriptorType::binary, DescriptorType::float32,
                                    DescriptorType::float16, DescriptorType::int8}) {
    for (const std::uint32_t size : {1U, 30U, 32U, 61U}) {
      const Vocabulary vocabulary = treeOf(formatOf(type, size), 5, 4, true, size)
                                        .withScoring(gslam::Scoring::kl)
                                        .withWeighting(gslam::Weighting::idf);
      saveVocabulary(vocabulary, path());
      const Vocabulary opened = gslam::openVocabulary(path());
      EXPECT_TRUE(opened.isMapped());
      EXPECT_EQ(opened.bytes(), bytesOfFile(path()).size());
      EXPECT_NO_THROW(verifyVocabulary(opened, path()));
      EXPECT_EQ(opened.format().type, type);
      EXPECT_EQ(opened.format().size, size);
      EXPECT_EQ(opened.format().scale, vocabulary.format().scale);
      EXPECT_EQ(opened.format().offset, vocabulary.format().offset);
      EXPECT_EQ(opened.branching(), 5U);
      EXPECT_EQ(opened.depth(), 4U);
      EXPECT_EQ(opened.scoring(), gslam::Scoring::kl);
      EXPECT_EQ(opened.weighting(), gslam::Weighting::idf);
      const gslam::detail::TreeData before = gslam::detail::treeDataOf(vocabulary);
      const gslam::detail::TreeData after = gslam::detail::treeDataOf(opened);
      EXPECT_EQ(after.ids, before.ids);
      EXPECT_EQ(after.parents, before.parents);
      EXPECT_EQ(after.words, before.words);
      EXPECT_EQ(after.weights, before.weights);
      EXPECT_EQ(after.descriptors, before.descriptors);
    }
  }
}

TEST_F(VocabularyFile, OfAMappedOneIsTheSameFile) {
  gslam::detail::TreeData data = random_tree::dataOf(formatOf(DescriptorType::binary, 32), 4, 3);
  for (std::size_t i = 0; i < data.parents.size(); ++i) {  // ids from the other end
    data.ids.push_back(static_cast<std::uint32_t>(data.parents.size() - i));
    if (data.parents[i] != 0) {
      data.parents[i] = static_cast<std::uint32_t>(data.parents.size() + 1 - data.parents[i]);
    }
  }
  saveVocabulary(gslam::detail::buildVocabulary(data, "made"), path());
  const std::string bytes = bytesOfFile(path());
  saveVocabulary(gslam::openVocabulary(path()), path());
  EXPECT_EQ(bytesOfFile(path()), bytes);
}

TEST_F(VocabularyFile, StaysOpenWhenItIsReplaced) {
  saveVocabulary(treeOf(formatOf(DescriptorType::binary, 32), 3, 3), path());
  const Vocabulary opened = gslam::openVocabulary(path());
  saveVocabulary(treeOf(formatOf(DescriptorType::binary, 8), 2, 2), path());
  EXPECT_NO_THROW(verifyVocabulary(opened));
  EXPECT_EQ(gslam::openVocabulary(path()).wordCount(), 4U);
  EXPECT_EQ(opened.wordCount(), 27U);
}

TEST_F(VocabularyFile, OfNothingIsRefused) {
  EXPECT_THROW(saveVocabulary(Vocabulary(), path()), gslam::ArgumentError);
  EXPECT_THROW(gslam::openVocabulary(path()), gslam::FileError);
  EXPECT_THROW(gslam::openVocabulary("/tmp"), gslam::FileError);
  EXPECT_NE(complaintAbout("").find("no vocabulary of GSLAM"), std::string::npos);
}

// Without anybody who writes into it, which would take for ever.
TEST_F(VocabularyFile, OfAPipeIsRefused) {
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  EXPECT_THROW(gslam::openVocabulary(path()), gslam::FileError);
  EXPECT_THROW(gslam::loadVocabulary(path()), gslam::FileError);
}

TEST_F(VocabularyFile, CutOffAnywhereIsRefused) {
  saveVocabulary(treeOf(formatOf(DescriptorType::binary, 4), 2, 2), path());
  const std::string bytes = bytesOfFile(path());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string complaint = complaintAbout(bytes.substr(0, size), false);
    ASSERT_NE(complaint, "") << size;
    ASSERT_EQ(complaint.find(path()), 0U) << complaint;
  }
  EXPECT_NE(complaintAbout(bytes + "x").find("something was added"), std::string::npos);
  EXPECT_EQ(complaintAbout(bytes), "");
}

TEST_F(VocabularyFile, WithABitFlippedAnywhereIsRefused) {
  saveVocabulary(treeOf(formatOf(DescriptorType::binary, 4), 2, 2), path());
  const std::string bytes = bytesOfFile(path());
  std::mt19937 random(6);
  for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
    const std::size_t bit = byte * 8 + random() % 8;
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    ASSERT_NE(complaintAbout(damaged), "") << "bit " << bit;
  }
}

// A copy of a file has its checksum, too; and what is damaged gets none that fits.
TEST_F(VocabularyFile, DamagedIsSeenInMemoryAndNotWrittenAnew) {
  saveVocabulary(treeOf(formatOf(DescriptorType::binary, 4), 2, 2), path());
  std::string bytes = bytesOfFile(path());
  const auto inMemory = [&bytes] {
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    return gslam::loadVocabulary(gslam::Span<const std::uint8_t>(data, bytes.size()), "bytes");
  };
  EXPECT_NO_THROW(verifyVocabulary(inMemory()));
  bytes[bytes.size() - 8] = static_cast<char>(bytes[bytes.size() - 8] ^ 1);
  EXPECT_THROW(verifyVocabulary(inMemory()), gslam::ParseError);
  write(bytes);
  EXPECT_THROW(saveVocabulary(gslam::openVocabulary(path()), path()), gslam::ParseError);
  EXPECT_THROW(saveVocabulary(inMemory().withScoring(gslam::Scoring::l2), path()),
               gslam::ParseError);
  EXPECT_EQ(bytesOfFile(path()), bytes);
}

// Who makes the checksum fit must say something possible, too.
TEST_F(VocabularyFile, WithAnImpossibleHeaderIsRefused) {
  saveVocabulary(treeOf(formatOf(DescriptorType::binary, 32), 3, 3), path());
  const std::string bytes = bytesOfFile(path());
  ASSERT_EQ(complaintAbout(withField<std::uint32_t>(bytes, 36, 3)), "");
  const auto expect = [&](const std::string& damaged, const std::string& said) {
    const std::string complaint = complaintAbout(damaged);
    EXPECT_NE(complaint.find(said), std::string::npos) << complaint;
  };
  expect(withField<std::uint32_t>(bytes, 8, 0x04030202), "order of bytes");
  expect(withField<std::uint32_t>(bytes, 12, 2), "version 2 at byte 12");
  expect(withField<std::uint8_t>(bytes, 16, 4), "type of descriptors 4 at byte 16");
  expect(withField<std::uint8_t>(bytes, 17, 4), "weighting 4");
  expect(withField<std::uint8_t>(bytes, 18, 6), "scoring 6");
  expect(withField<std::uint32_t>(bytes, 24, 0), "size of descriptors 0");
  expect(withField<std::uint32_t>(bytes, 24, 0xFFFFFFFF), "size of descriptors 4294967295");
  expect(withField<std::uint32_t>(bytes, 36, 65), "number of children 65");
  expect(withField<std::uint32_t>(bytes, 40, 0), "depth 0");
  expect(withField<std::uint32_t>(bytes, 44, 0), "number of nodes 0");
  expect(withField<std::uint32_t>(bytes, 44, 0xFFFFFFFF), "header asks for");
  expect(withField<std::uint32_t>(bytes, 48, 40), "number of words 40");
  expect(withField<std::uint32_t>(bytes, 52, 0), "number of weights 0");
  expect(withField<std::uint64_t>(bytes, 64, ~std::uint64_t(0)), "header asks for");
  saveVocabulary(treeOf(formatOf(DescriptorType::int8, 32), 3, 3), path());
  const std::string steps = bytesOfFile(path());
  ASSERT_EQ(complaintAbout(withField<float>(steps, 28, -0.5F)), "");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float scale : {nan, infinity, 0.0F, 3e38F}) {
    expect(withField<float>(steps, 28, scale), "the scale");
  }
  for (const float offset : {nan, -infinity}) {
    expect(withField<float>(steps, 32, offset), "the offset");
  }
}

// Kernels read zeros behind a descriptor, and numbers in it.
TEST_F(VocabularyFile, WithDescriptorsThatKernelsCannotCompareIsRefused) {
  const auto expect = [this](DescriptorType type, std::size_t at, const std::string& written,
                             const std::string& said) {
    const Vocabulary vocabulary = treeOf(formatOf(type, 30), 3, 3);
    saveVocabulary(vocabulary, path());
    std::string bytes = bytesOfFile(path());
    const gslam::detail::TreeView& tree = vocabulary.tree();
    bytes.replace(bytes.size() - (tree.node_count - 7UL) * tree.stride + at, written.size(),
                  written);
    const auto* const body = reinterpret_cast<const std::uint8_t*>(bytes.data()) + 256;
    bytes = withField(bytes, 240, gslam::detail::Xxh64::of(body, bytes.size() - 256));
    EXPECT_EQ(complaintAbout(bytes, false), "");
    EXPECT_EQ(complaintAbout(bytes), path() + ": node 7 has " + said);
  };
  expect(DescriptorType::binary, 30, "\x01", "bytes other than 0 behind its descriptor");
  expect(DescriptorType::int8, 31, "\x80", "bytes other than 0 behind its descriptor");
  expect(DescriptorType::float32, 29 * 4 + 2, "\x80\xFF", "a descriptor that is not finite");
  expect(DescriptorType::float16, 29 * 2, {0, 0x7C}, "a descriptor that is not finite");
}

// As a machine with another order of bytes writes it, by docs/formats/vocabulary.md.
std::string turnedRound(std::string bytes, const std::vector<std::size_t>& list_sizes,
                        const std::vector<std::size_t>& number_sizes) {
  const auto turn = [&bytes](std::size_t begin, std::size_t count, std::size_t size) {
    for (std::size_t i = 0; i < count; ++i) {
      std::reverse(bytes.begin() + std::ptrdiff_t(begin + i * size),
                   bytes.begin() + std::ptrdiff_t(begin + (i + 1) * size));
    }
  };
  for (const std::size_t at : {8U, 12U, 24U, 28U, 32U, 36U, 40U, 44U, 48U, 52U}) turn(at, 1, 4);
  turn(64, 1, 8);
  std::size_t end = 256;
  for (std::size_t i = 0; i < list_sizes.size(); ++i) {
    end = (end + 63) / 64 * 64;
    turn(end, list_sizes[i] / number_sizes[i], number_sizes[i]);
    end += list_sizes[i];
  }
  const auto sum = [&bytes](std::size_t begin, std::size_t end_at, std::size_t to) {
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const std::uint64_t value = gslam::detail::Xxh64::of(data + begin, end_at - begin);
    std::memcpy(&bytes[to], &value, 8);
  };
  sum(256, bytes.size(), 240);
  turn(240, 1, 8);
  sum(0, 248, 248);
  turn(248, 1, 8);
  return bytes;
}

TEST_F(VocabularyFile, OfAnotherOrderOfBytesIsTheSame) {
  for (const DescriptorType type : {DescriptorType::binary, DescriptorType::float32,
                                    DescriptorType::float16, DescriptorType::int8}) {
    const Vocabulary vocabulary = treeOf(formatOf(type, 12), 3, 3);
    saveVocabulary(vocabulary, path());
    const std::size_t nodes = vocabulary.nodeCount();
    const std::size_t number = bytesOf(vocabulary.format()) / 12;
    const std::size_t row = type == DescriptorType::binary    ? 16
                            : type == DescriptorType::float16 ? 24
                                                              : 12 * number;
    const std::string turned = turnedRound(bytesOfFile(path()),
                                           {nodes * 4, nodes, vocabulary.wordCount() * 2UL,
                                            vocabulary.tree().weight_count * 8UL, nodes * row},
                                           {4, 1, 2, 8, number});
    write(turned);
    const Vocabulary opened = gslam::openVocabulary(path());
    EXPECT_FALSE(opened.isMapped());
    EXPECT_NO_THROW(verifyVocabulary(opened));
    const gslam::detail::TreeData before = gslam::detail::treeDataOf(vocabulary);
    const gslam::detail::TreeData after = gslam::detail::treeDataOf(opened);
    EXPECT_EQ(after.format.scale, before.format.scale);
    EXPECT_EQ(after.parents, before.parents);
    EXPECT_EQ(after.words, before.words);
    EXPECT_EQ(after.weights, before.weights);
    EXPECT_EQ(after.descriptors, before.descriptors);
    std::string damaged = turned;
    damaged[300] = static_cast<char>(damaged[300] ^ 1);
    EXPECT_NE(complaintAbout(damaged, false), "");
  }
}

// What was not verified may be wrong, but must not be read beyond, nor have kernels write beyond
// their room for the children of a node.
TEST_F(VocabularyFile, DamagedAndNotVerifiedStaysInItsMemory) {
  for (const int kind : {0, 1, 2, 3, 4}) {
    const auto type = static_cast<DescriptorType>(kind % 4);
    const bool has_ids = kind == 4;
    gslam::detail::TreeData data = random_tree::dataOf(formatOf(type, 32), 18, 3, true);
    if (has_ids) {
      for (std::size_t i = 0; i < data.parents.size(); ++i) {
        data.ids.push_back(static_cast<std::uint32_t>(data.parents.size() - i));
        if (data.parents[i] != 0) {
          data.parents[i] = static_cast<std::uint32_t>(data.parents.size() + 1 - data.parents[i]);
        }
      }
    }
    const Vocabulary whole = gslam::detail::buildVocabulary(data, "made");
    const std::vector<std::uint8_t> bits = random_tree::queriesLike(whole, 200);
    const std::vector<float> numbers = random_tree::floats(200 * 32);
    const gslam::Descriptors queries = type == DescriptorType::binary
                                           ? gslam::binaryDescriptors(bits.data(), 200, 32)
                                           : gslam::floatDescriptors(numbers.data(), 200, 32);
    saveVocabulary(whole, path());
    const std::string bytes = bytesOfFile(path());
    std::mt19937 random(4);
    for (int trial = 0; trial < 30; ++trial) {
      std::string damaged = bytes;
      for (int i = 0; i < 2000; ++i) {
        damaged[256 + random() % (damaged.size() - 256)] = static_cast<char>(random());
      }
      if (trial % 2 == 0) {  // the root has 255 children, and they are there
        damaged = bytes;
        damaged[256 + (whole.nodeCount() * 4UL + 63) / 64 * 64] = '\xFF';
      }
      write(damaged);
      const Vocabulary opened = gslam::openVocabulary(path());
      gslam::BowVector bow;
      gslam::FeatureVector features;
      transform(opened, queries, 2, bow, features);
      for (const std::uint32_t word : bow.words) ASSERT_LT(word, opened.wordCount());
      ASSERT_THROW(verifyVocabulary(opened), gslam::ParseError);
      if (type == DescriptorType::binary) {
        ASSERT_THROW(saveOrbSlamText(opened, path() + ".txt"), gslam::ParseError);
      }
    }
  }
}

// Each node is the child of the one before: a way down is as long as there are nodes.
TEST_F(VocabularyFile, DamagedAndNotVerifiedIsNoDeeperThanItSays) {
  const Vocabulary whole = treeOf(formatOf(DescriptorType::binary, 32), 10, 3);
  saveVocabulary(whole, path());
  std::string bytes = bytesOfFile(path());
  const std::size_t counts = 256 + (whole.nodeCount() * 4UL + 63) / 64 * 64;
  for (std::uint32_t node = 0; node + 1 < whole.nodeCount(); ++node) {
    const std::uint32_t next = node + 1;
    std::memcpy(&bytes[256 + node * 4UL], &next, 4);
    bytes[counts + node] = 1;
  }
  write(bytes);
  const Vocabulary chain = gslam::openVocabulary(path());
  const std::vector<std::uint8_t> queries = random_tree::queriesLike(whole, 10);
  const gslam::Descriptors descriptors = gslam::binaryDescriptors(queries.data(), 10, 32);
  std::vector<std::uint32_t> words(10);
  findWords(chain, descriptors, words);
  EXPECT_EQ(words, std::vector<std::uint32_t>(10, gslam::detail::kNone));
  gslam::BowVector bow;
  gslam::FeatureVector features;
  transform(chain, descriptors, 1, bow, features);
  EXPECT_TRUE(bow.empty());
}

// Every number that a checksum does not protect.
TEST(tree_checker, SeesEveryFault) {
  const auto check = [](std::size_t field, std::size_t at, std::uint32_t value) -> std::string {
    gslam::detail::TreeData data =
        random_tree::dataOf(formatOf(DescriptorType::binary, 4), 3, 3, false);
    const Vocabulary vocabulary = gslam::detail::buildVocabulary(data, "made");
    gslam::detail::TreeView tree = vocabulary.tree();
    std::vector<std::uint32_t> links(tree.links, tree.links + tree.node_count);
    std::vector<std::uint8_t> counts(tree.child_counts, tree.child_counts + tree.node_count);
    std::vector<std::uint16_t> numbers(tree.weight_numbers, tree.weight_numbers + tree.word_count);
    std::vector<std::uint32_t> ids(tree.node_count);
    for (std::uint32_t i = 0; i < tree.node_count; ++i) ids[i] = i;
    if (field == 0) links[at] = value;
    if (field == 1) counts[at] = static_cast<std::uint8_t>(value);
    if (field == 2) numbers[at] = static_cast<std::uint16_t>(value);
    if (field == 3) ids[at] = value;
    if (field == 4) tree.depth = value;
    tree.links = links.data();
    tree.child_counts = counts.data();
    tree.weight_numbers = numbers.data();
    tree.node_ids = ids.data();
    try {
      gslam::detail::TreeChecker(tree, "tree").check();
    } catch (const gslam::ParseError& error) {
      return error.what();
    }
    return "sound";
  };
  EXPECT_EQ(check(5, 0, 0), "sound");
  EXPECT_EQ(check(0, 0, 2), "tree: node 0 has children from 2 on, expected 1");
  EXPECT_EQ(check(0, 39, 27), "tree: node 39 is word 27, but there are 27");
  EXPECT_EQ(check(0, 39, 0), "tree: word 0 is there twice");
  EXPECT_NE(check(1, 2, 0), "sound");
  EXPECT_NE(check(1, 12, 4), "sound");
  EXPECT_NE(check(1, 39, 1), "sound");
  EXPECT_NE(check(2, 5, 60000), "sound");
  EXPECT_NE(check(3, 7, 8), "sound");
  EXPECT_NE(check(3, 0, 1), "sound");
  EXPECT_NE(check(3, 7, 40), "sound");
  EXPECT_NE(check(4, 0, 2), "sound");
}

// Every node is some node's child, but the root is a leaf.
TEST(tree_checker, SeesThatTheRootIsNoParent) {
  const Vocabulary vocabulary = treeOf(formatOf(DescriptorType::binary, 4), 2, 1);
  gslam::detail::TreeView tree = vocabulary.tree();
  const std::uint32_t links[] = {0, 1, 1};
  const std::uint8_t counts[] = {0, 2, 0};
  tree.links = links;
  tree.child_counts = counts;
  EXPECT_THROW(gslam::detail::TreeChecker(tree, "tree").check(), gslam::ParseError);
}

}  // namespace
