// Files of databases: what was written comes back, and what is damaged is refused.
#include <gslam/base/detail/checksum.h>
#include <gslam/base/detail/little_endian.h>
#include <gslam/vocabulary/database.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "random_bags.h"

namespace {

using gslam::BowDatabase;
using gslam::BowVector;
using gslam::FeatureVector;
using gslam::Scoring;
using Bytes = std::vector<std::uint8_t>;

// A file that goes when the test is over.
class TestFile {
 public:
  explicit TestFile(const std::string& name)
      : path_(testing::TempDir() + std::to_string(getpid()) + "_gslam_database_file_" + name) {}
  ~TestFile() { std::remove(path_.c_str()); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;

  const std::string& path() const { return path_; }
  Bytes bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }

 private:
  std::string path_;
};

BowDatabase smallDatabase() {
  BowDatabase database(Scoring::chi_square);
  database.add({{7, 9}, {0.25, 0.75}}, {{2, 5}, {0, 1, 3}, {4, 0, 6}});
  database.add({{1}, {1}});
  database.add(BowVector());
  database.add({{9, 0xFFFFFFFF}, {0.5, 0.5}}, {{3}, {0, 0}, {}});
  database.erase(1);
  return database;
}

Bytes bytesOf(const BowDatabase& database, std::uint64_t fingerprint = 0) {
  const TestFile file("bytes");
  database.save(file.path(), fingerprint);
  return file.bytes();
}

BowDatabase fromBytes(const Bytes& bytes, std::uint64_t fingerprint = 0) {
  return gslam::detail::databaseFromBytes(bytes.data(), bytes.size(), "test", fingerprint);
}

// What a ParseError says; empty: it was read.
std::string problemOf(const Bytes& bytes) {
  try {
    fromBytes(bytes);
    return std::string();
  } catch (const gslam::ParseError& error) {
    return error.what();
  }
}

// Makes checksums right, as somebody would who means harm. The small database has entries at bytes
// 56 (24 + 24 + 8 + 12 + 12 bytes and the checksum), 144 (24) and 176.
void sign(Bytes& bytes) {
  using gslam::detail::Xxh64;
  const std::size_t begins[] = {0, 56, 144, 176}, ends[] = {48, 136, 168, bytes.size() - 8};
  for (std::size_t i = 0; i < 4; ++i) {
    gslam::detail::storeLittle(&bytes[ends[i]], Xxh64::of(&bytes[begins[i]], ends[i] - begins[i]));
  }
}

template <class Unsigned>
std::string problemWith(std::size_t place, Unsigned value) {
  Bytes bytes = bytesOf(smallDatabase());
  gslam::detail::storeLittle(&bytes[place], value);
  sign(bytes);
  return problemOf(bytes);
}

void expectSame(const BowDatabase& a, const BowDatabase& b) {
  EXPECT_EQ(a.scoring(), b.scoring());
  EXPECT_EQ(a.size(), b.size());
  EXPECT_EQ(a.nextId(), b.nextId());
  ASSERT_EQ(a.ids(), b.ids());
  for (const std::uint64_t id : a.ids()) {
    ASSERT_EQ(a.bow(id), b.bow(id));
    ASSERT_EQ(a.features(id), b.features(id));
    ASSERT_TRUE(a.query(a.bow(id)) == b.query(a.bow(id)));
  }
}

}  // namespace

TEST(database_file, gives_back_what_was_saved) {
  std::mt19937 generator(1);
  for (const Scoring scoring : random_bags::scorings()) {
    BowDatabase database(scoring);
    for (std::uint32_t i = 0; i < 300; ++i) {
      const BowVector bow = random_bags::bag(generator, generator() % 90, 2000);
      database.add(random_bags::normalized(bow, scoring), {{i}, {0, 2}, {i, i + 1}});
      if (generator() % 3 == 0) database.erase(generator() % database.nextId());
    }
    const TestFile file("round_trip");
    database.save(file.path(), 5);
    expectSame(gslam::loadDatabase(file.path()), database);
    expectSame(gslam::loadDatabase(file.path(), 5), database);
  }
  expectSame(fromBytes(bytesOf(BowDatabase())), BowDatabase());
  expectSame(fromBytes(bytesOf(smallDatabase())), smallDatabase());
}

TEST(database_file, goes_on_with_ids_where_it_was) {
  BowDatabase database;
  for (int i = 0; i < 3; ++i) database.add({{1}, {1}});
  database.erase(2);
  BowDatabase loaded = fromBytes(bytesOf(database));
  EXPECT_EQ(loaded.add(BowVector()), 3u);
}

TEST(database_file, has_the_same_bytes_as_in_version_1) {
  const Bytes bytes = bytesOf(smallDatabase(), 0x1122334455667788);
  ASSERT_EQ(bytes.size(), 244u);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 8), "GSLAMBOW");
  EXPECT_EQ(bytes[8], 1);      // version
  EXPECT_EQ(bytes[12], 2);     // chi-square
  EXPECT_EQ(bytes[16], 0x88);  // fingerprint
  EXPECT_EQ(bytes[24], 4);     // next id
  EXPECT_EQ(bytes[32], 3);     // entries
  EXPECT_EQ(gslam::detail::Xxh64::of(bytes.data(), bytes.size()), 12908842279464973914u);
}

TEST(database_file, of_another_vocabulary_is_refused) {
  const Bytes bytes = bytesOf(smallDatabase(), 77);
  EXPECT_NO_THROW(fromBytes(bytes, 77));
  EXPECT_NO_THROW(fromBytes(bytes, 0));
  EXPECT_THROW(fromBytes(bytes, 78), gslam::ParseError);
}

TEST(database_file, that_is_cut_off_anywhere_is_refused) {
  const Bytes bytes = bytesOf(smallDatabase());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // Memory of its own, so that the address sanitizer sees what is read behind it.
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(problemOf(cut), "") << size;
  }
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_NE(problemOf(longer).find("at byte 244"), std::string::npos);
}

TEST(database_file, with_any_flipped_bit_is_refused) {
  const Bytes bytes = bytesOf(smallDatabase());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    Bytes damaged = bytes;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_NE(problemOf(damaged), "") << bit;
  }
}

// Every 32 bits that are something else, with checksums that fit: it is refused, or it is a
// database that can be used and saved.
TEST(database_file, with_false_numbers_and_right_checksums_does_no_harm) {
  const Bytes bytes = bytesOf(smallDatabase());
  for (std::size_t place = 0; place + 4 <= bytes.size(); place += 4) {
    for (const std::uint32_t value : {0u, 1u, 3u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
      Bytes forged = bytes;
      gslam::detail::storeLittle(&forged[place], value);
      sign(forged);
      if (!problemOf(forged).empty()) continue;
      const BowDatabase database = fromBytes(forged);
      database.query({{7, 9}, {1, 1}});
      EXPECT_EQ(bytesOf(database, gslam::detail::loadLittle<std::uint64_t>(&forged[16])), forged);
    }
  }
}

TEST(database_file, says_what_is_wrong_and_where) {
  const auto says = [](const std::string& problem, const std::string& part) {
    return problem.find(part) != std::string::npos ? std::string() : problem + " lacks " + part;
  };
  using U32 = std::uint32_t;
  using U64 = std::uint64_t;
  EXPECT_EQ(says(problemWith(0, U32(0)), "does not begin with GSLAMBOW, at byte 0"), "");
  EXPECT_EQ(says(problemWith(8, U32(2)), "version 2, expected 1"), "");
  EXPECT_EQ(says(problemWith(12, U32(6)), "scoring 6, expected 0 to 5"), "");
  EXPECT_EQ(says(problemWith(24, U64(3)), "id 3, expected 3 to below 3, at byte 176"), "");
  EXPECT_EQ(says(problemWith(32, U64(2)), "goes on behind its last entry, at byte 176"), "");
  EXPECT_EQ(says(problemWith(32, U64(4)), "ends inside an entry, at byte 244"), "");
  EXPECT_EQ(says(problemWith(32, ~U64(0)), "ends inside an entry, at byte 244"), "");
  EXPECT_EQ(says(problemWith(40, U32(1)), "zeros must be, at byte 40"), "");
  EXPECT_EQ(says(problemWith(64, U32(0xFFFFFFFF)), "ends inside an entry"), "");
  EXPECT_EQ(says(problemWith(72, ~U64(0)), "ends inside an entry"), "");
  EXPECT_EQ(says(problemWith(80, ~U64(0)), "has the value"), "");       // NaN
  EXPECT_EQ(says(problemWith(96, U32(9)), "word 9 behind 9"), "");      // the first word
  EXPECT_EQ(says(problemWith(104, U32(5)), "node 5 behind 5"), "");     // the first node
  EXPECT_EQ(says(problemWith(116, U32(9)), "that do not ascend"), "");  // where node 5 begins
  EXPECT_EQ(says(problemWith(144, U64(0)), "id 0, expected 1 to below 4"), "");
  Bytes damaged = bytesOf(smallDatabase());
  damaged[90] = 1;
  EXPECT_EQ(says(problemOf(damaged), "is damaged"), "");
  EXPECT_EQ(says(problemOf(damaged), "at byte 56"), "");
}

TEST(database_file, that_is_not_there_or_cannot_be_written) {
  EXPECT_THROW(gslam::loadDatabase(testing::TempDir() + "gslam_no_such_file"), gslam::FileError);
  EXPECT_THROW(gslam::loadDatabase(testing::TempDir()), gslam::FileError);
  EXPECT_THROW(BowDatabase().save(testing::TempDir() + "gslam_no_such_folder/x"), gslam::FileError);
  const TestFile empty("empty");
  std::ofstream(empty.path()).close();
  EXPECT_THROW(gslam::loadDatabase(empty.path()), gslam::ParseError);
}

TEST(database_file, replaces_one_that_was_there) {
  const TestFile file("replaced");
  smallDatabase().save(file.path());
  BowDatabase one;
  one.add({{1}, {1}});
  one.save(file.path());
  EXPECT_EQ(gslam::loadDatabase(file.path()).size(), 1u);
}
