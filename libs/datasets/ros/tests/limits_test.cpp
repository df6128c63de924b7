// Small files that ask for much: each is read, or refused, in a moment and without much memory.
#include <gslam/datasets_ros/recording.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>

#include "bag_writer.h"
#include "bytes/block_cache.h"
#include "bytes/byte_source.h"
#include "db3_writer.h"
#include "mcap_writer.h"
#include "storage/storage.h"

namespace {

using gslam::ros::openMemory;
using mcap_writer::Out;

constexpr double kSeconds = 5;  // far more than it takes, also under AddressSanitizer

class Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::unique_ptr<gslam::ros::Storage> openMcap(const RawBytes& bytes) {
  return gslam::ros::openMcap(openMemory(bytes, "small.mcap"));
}

RawBytes endOfMcap() {
  Out out;
  out.raw(mcap_writer::record(0x02, Out().u64(0).u64(0).u32(0).bytes)).raw(mcap_writer::magic());
  return out.bytes;
}

// --- databases -----------------------------------------------------------------------------------

constexpr std::size_t kPage = 1024;

void put(RawBytes& page, std::size_t at, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) {
    page[at + std::size_t(i)] = static_cast<std::uint8_t>(value >> (8 * (size - 1 - i)));
  }
}

// An interior page of a table that names one page many times. (SQLite's file format, 1.6.)
RawBytes pageOf(std::uint32_t child) {
  constexpr std::uint32_t kCells = 140;
  RawBytes page(kPage);
  std::size_t at = kPage;
  for (std::uint32_t i = 0; i < kCells; ++i) {
    at -= 5;
    put(page, at, child, 4);
    page[at + 4] = 1;
    put(page, 12 + 2 * i, std::uint32_t(at), 2);
  }
  page[0] = 5;
  put(page, 3, kCells, 2);
  put(page, 5, std::uint32_t(at), 2);
  put(page, 8, child, 4);
  return page;
}

std::uint32_t rootOf(const std::string& path, const std::string& table) {
  sqlite3* database = nullptr;
  db3_writer::check(sqlite3_open(path.c_str(), &database), database);
  sqlite3_stmt* statement = nullptr;
  const std::string sql = "SELECT rootpage FROM sqlite_master WHERE name = '" + table + "'";
  db3_writer::check(sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr), database);
  sqlite3_step(statement);
  const int root = sqlite3_column_int(statement, 0);
  sqlite3_finalize(statement);
  sqlite3_close(database);
  return std::uint32_t(root);
}

TEST(limits_db3, a_table_whose_pages_are_named_many_times_is_refused) {
  for (const std::string table : {"topics", "messages", "sqlite_master"}) {
    const std::string path = folderOfTests() + "circle.db3";
    db3_writer::write(path, {{"/a", "a/B", 5, {1, 2, 3}}});
    const std::uint32_t root = table == "sqlite_master" ? 1 : rootOf(path, table);
    RawBytes file = readFile(path);
    const std::size_t at = (root - 1) * kPage;
    std::uint32_t last = std::uint32_t(file.size() / kPage);
    const auto append = [&](const RawBytes& page) {
      file.insert(file.end(), page.begin(), page.end());
      ++last;
    };
    // 140^5 rows. Page 1 has the head of the file before its own, which makes it no good copy.
    append(RawBytes(file.begin() + std::ptrdiff_t(at), file.begin() + std::ptrdiff_t(at + kPage)));
    for (int level = 0; level < 4; ++level) append(pageOf(last));
    const std::size_t head = root == 1 ? 100 : 0;
    const RawBytes top = pageOf(last);
    std::copy(top.begin(), top.end() - std::ptrdiff_t(head),
              file.begin() + std::ptrdiff_t(at + head));
    put(file, 28, last, 4);
    writeFile(path, file);
    const Clock clock;
    EXPECT_TRUE(has(errorOf([&] { gslam::ros::openDb3(path); }), path)) << table;
    EXPECT_LT(clock.seconds(), kSeconds) << table;
  }
}

void runSql(const std::string& path, const std::string& sql) {
  std::remove(path.c_str());
  sqlite3* database = nullptr;
  db3_writer::check(sqlite3_open(path.c_str(), &database), database);
  db3_writer::run(database, sql);
  sqlite3_close(database);
}

constexpr const char* kTopics =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
    "INSERT INTO topics VALUES(1, '/a', 'a/msg/B', 'cdr');";

TEST(limits_db3, virtual_tables_are_no_tables) {
  const std::string path = folderOfTests() + "virtual.db3";
  runSql(path, std::string(kTopics) +
                   "CREATE VIRTUAL TABLE messages USING fts5(topic_id, timestamp, data)");
  EXPECT_TRUE(has(errorOf([&] { gslam::ros::openDb3(path); }), "it has no table 'messages'"));
}

TEST(limits_db3, stamps_and_topics_that_are_no_numbers_are_errors_with_the_row) {
  const std::string path = folderOfTests() + "words.db3";
  const auto error = [&](const std::string& values) {
    runSql(path,
           std::string(kTopics) +
               "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data BLOB);"
               "INSERT INTO messages VALUES(1, 1, 5, x'00'), (2, " +
               values + ", x'00')");
    return errorOf([&] { gslam::ros::openDb3(path); });
  };
  EXPECT_EQ(error("1, 6"), "");
  EXPECT_EQ(error("1, NULL"), path + ": row 2: timestamp is no whole number");
  EXPECT_EQ(error("1, 'now'"), path + ": row 2: timestamp is no whole number");
  EXPECT_EQ(error("1.5, 6"), path + ": row 2: topic_id is no whole number");
}

// Files that a process leaves that dies while it writes.
std::string whatIsLeft(const std::string& name, const std::string& mode, const char* beside) {
  const std::string path = folderOfTests() + "writing_" + name, copy = folderOfTests() + name;
  for (const char* end : {"", "-wal", "-shm", "-journal"}) {
    std::remove((path + end).c_str());
    std::remove((copy + end).c_str());
  }
  std::vector<Recorded> messages;
  for (int i = 0; i < 200; ++i) messages.push_back({"/a", "a/B", i, noise(300, unsigned(i))});
  db3_writer::write(path, messages);
  sqlite3* database = nullptr;
  db3_writer::check(sqlite3_open(path.c_str(), &database), database);
  db3_writer::run(database, "PRAGMA journal_mode = " + mode + "; PRAGMA cache_size = 5; BEGIN");
  db3_writer::run(database, "DELETE FROM messages WHERE id % 2 = 0");
  if (mode == "WAL") db3_writer::run(database, "COMMIT");
  writeFile(copy, readFile(path));
  writeFile(copy + beside, readFile(path + beside));
  sqlite3_close(database);
  return copy;
}

TEST(limits_db3, a_database_whose_journal_is_needed_is_refused) {
  const std::string path = whatIsLeft("hot.db3", "DELETE", "-journal");
  const std::string error = errorOf([&] { gslam::ros::openDb3(path); });
  EXPECT_TRUE(has(error, "was not closed: what it held before is in " + path + "-journal"))
      << error;
  // What SQLite leaves where it does not remove journals: the head is zeros.
  RawBytes journal = readFile(path + "-journal");
  std::fill(journal.begin(), journal.begin() + 28, std::uint8_t(0));
  writeFile(path + "-journal", journal);
  EXPECT_FALSE(has(errorOf([&] { gslam::ros::openDb3(path); }), "-journal"));
}

std::string listOf(const std::string& folder) {
  const std::string list = folderOfTests() + "list.txt";
  EXPECT_EQ(std::system(("ls -la --time-style=full-iso '" + folder + "' > " + list).c_str()), 0);
  const RawBytes bytes = readFile(list);
  return std::string(bytes.begin(), bytes.end());
}

TEST(limits_db3, nothing_is_written_beside_a_database_and_what_is_in_its_wal_is_said) {
  const std::string left = whatIsLeft("wal.db3", "WAL", "-wal");
  const std::string folder = folderOfTests() + "wal_folder";
  const std::string path = folder + "/wal.db3";
  ASSERT_EQ(std::system(("chmod -R u+w '" + folder + "' 2> /dev/null; rm -rf '" + folder +
                         "' && mkdir '" + folder + "' && cp '" + left + "' '" + left + "-wal' '" +
                         folder + "'")
                            .c_str()),
            0);
  for (const bool is_writable : {true, false}) {
    ASSERT_EQ(std::system(("chmod " + std::string(is_writable ? "u+w" : "a-w") + " '" + folder +
                           "' '" + path + "'")
                              .c_str()),
              0);
    const std::string before = listOf(folder);
    {
      const auto storage = gslam::ros::openDb3(path);
      ASSERT_EQ(storage->messages.size(), 200U);  // as it was before what is in the -wal
      for (const auto& ref : storage->messages) storage->read(ref);
      EXPECT_TRUE(hasAny(storage->remarks, path + "-wal was not read"));
      EXPECT_EQ(listOf(folder), before);
    }
    EXPECT_EQ(listOf(folder), before);
  }
  EXPECT_EQ(std::system(("chmod -R u+w '" + folder + "'").c_str()), 0);
}

// --- MCAP ----------------------------------------------------------------------------------------

TEST(limits_mcap, the_end_of_the_data_counts_once) {
  Out file;
  file.raw(mcap_writer::magic());
  for (int i = 0; i < 100000; ++i) file.raw(mcap_writer::record(0x0F, Out().u32(1).bytes));
  file.raw(endOfMcap());
  const Clock clock;
  const auto storage = openMcap(file.bytes);
  EXPECT_TRUE(hasAny(storage->remarks, "the data up to byte 8 have the CRC"));
  EXPECT_FALSE(hasAny(storage->remarks, "the data up to byte 21 "));
  EXPECT_LT(clock.seconds(), kSeconds);
}

TEST(limits_mcap, remarks_are_counted_where_there_are_many) {
  Out file;
  file.raw(mcap_writer::magic());
  for (int i = 0; i < 100000; ++i) file.raw(mcap_writer::record(0x06, {}));
  file.raw(endOfMcap());
  const auto storage = openMcap(file.bytes);
  EXPECT_LT(storage->remarks.size(), 15U);
  EXPECT_TRUE(hasAny(storage->remarks, "damaged: 99990 more of the same kind"));
}

TEST(limits_mcap, many_topics) {
  const auto fileOf = [](int count) {
    Out file;
    file.raw(mcap_writer::magic());
    for (int i = 0; i < count; ++i) {
      Out channel;
      channel.u16(std::uint64_t(i) & 0xFFFFU).u16(0).text("/t" + std::to_string(i)).text("cdr");
      file.raw(mcap_writer::record(0x04, channel.u32(0).bytes));
    }
    return file.raw(endOfMcap()).bytes;
  };
  const Clock clock;
  EXPECT_EQ(openMcap(fileOf(60000))->list.topics.size(), 60000U);
  const auto storage = openMcap(fileOf(70000));
  EXPECT_EQ(storage->list.topics.size(), 65536U);
  EXPECT_TRUE(hasAny(storage->remarks, "small.mcap: has more than 65536 topics"));
  EXPECT_LT(clock.seconds(), kSeconds);
}

std::vector<Recorded> tenMessages() {
  std::vector<Recorded> messages;
  for (int i = 0; i < 10; ++i) messages.push_back({"/a", "a/B", 100 + i, noise(50, unsigned(i))});
  return messages;
}

std::size_t find(const RawBytes& in, const RawBytes& what) {
  const auto found = std::search(in.begin(), in.end(), what.begin(), what.end());
  EXPECT_NE(found, in.end());
  return std::size_t(found - in.begin());
}

TEST(limits_mcap, a_message_that_the_index_names_twice_comes_once) {
  mcap_writer::Shape shape;
  shape.has_crc = false;
  shape.chunk_messages = 20;
  RawBytes file = mcap_writer::write(tenMessages(), shape);
  // The offset of the second message becomes that of the first one.
  const std::size_t entry = find(file, Out().u32(160).u64(100).bytes) + 4;
  std::copy_n(file.begin() + std::ptrdiff_t(entry), 16, file.begin() + std::ptrdiff_t(entry + 16));
  const auto storage = openMcap(file);
  EXPECT_TRUE(hasAny(storage->remarks, "names a message twice"));
  ASSERT_EQ(storage->messages.size(), 10U);
  for (const auto& ref : storage->messages) EXPECT_NO_THROW(storage->read(ref));
}

TEST(limits_mcap, a_message_of_another_topic_than_the_index_says_is_an_error) {
  mcap_writer::Shape shape;
  shape.has_crc = false;
  shape.chunk_messages = 20;
  std::vector<Recorded> messages = tenMessages();
  for (std::size_t i = 1; i < 10; i += 2) messages[i].topic = "/b";
  RawBytes file = mcap_writer::write(messages, shape);
  // The index of channel 2 becomes one of channel 1.
  file[find(file, Out().u16(2).u32(80).u64(101).bytes)] = 1;
  const auto storage = openMcap(file);
  ASSERT_EQ(storage->messages.size(), 10U);
  int wrong = 0;
  for (const auto& ref : storage->messages) {
    const std::string error = errorOf([&] { storage->read(ref); });
    if (has(error, "is of channel 2, which is not that of the index")) ++wrong;
  }
  EXPECT_EQ(wrong, 5);
}

TEST(limits_mcap, one_changed_byte_of_the_summary_loses_no_message) {
  for (const bool has_crc : {true, false}) {
    mcap_writer::Shape shape;
    shape.has_crc = has_crc;
    shape.chunk_messages = 4;
    const RawBytes file = mcap_writer::write(tenMessages(), shape);
    const std::size_t summary = find(file, Out().u8(0x0F).u64(4).bytes) + 13;
    for (std::size_t at = summary; at < file.size(); ++at) {
      for (const int bits : {0x01, 0x40, 0xFF}) {
        RawBytes changed = file;
        changed[at] ^= static_cast<std::uint8_t>(bits);
        const auto storage = openMcap(changed);
        ASSERT_EQ(storage->messages.size(), 10U) << at;
        for (const auto& ref : storage->messages) ASSERT_EQ(storage->read(ref).size(), 50U) << at;
      }
    }
  }
}

TEST(limits_mcap, a_summary_that_would_be_all_of_a_large_file_is_not_read) {
  constexpr std::uint64_t kSize = std::uint64_t(600) << 20;
  const std::string path = folderOfTests() + "sparse.mcap";
  Out head, footer;
  footer.raw(mcap_writer::record(0x02, Out().u64(8).u64(0).u32(0).bytes));
  footer.raw(mcap_writer::magic());
  head.raw(mcap_writer::magic()).u8(0x80).u64(kSize - 17 - footer.bytes.size());
  writeFile(path, head.bytes);
  ASSERT_EQ(::truncate(path.c_str(), off_t(kSize - footer.bytes.size())), 0);
  std::ofstream(path, std::ios::binary | std::ios::app)
      .write(reinterpret_cast<const char*>(footer.bytes.data()),
             std::streamsize(footer.bytes.size()));
  const auto recording = gslam::Recording::open(path);
  EXPECT_TRUE(hasAny(recording->remarks(), "which is too far from the end of the file"));
  std::remove(path.c_str());
}

// A message of a chunk without compression and CRC is read alone: damage elsewhere in the chunk is
// not in the way, as it is where there is a CRC.
TEST(limits_mcap, messages_of_plain_chunks_are_read_in_place) {
  for (const bool has_crc : {false, true}) {
    mcap_writer::Shape shape;
    shape.has_crc = has_crc;
    shape.chunk_messages = 20;
    RawBytes file = mcap_writer::write(tenMessages(), shape);
    file[find(file, tenMessages()[9].bytes)] ^= 1U;
    const auto storage = openMcap(file);
    const std::string error =
        errorOf([&] { EXPECT_EQ(storage->read(storage->messages[0]), tenMessages()[0].bytes); });
    EXPECT_EQ(has(error, "CRC"), has_crc) << error;
    EXPECT_EQ(storage->readHead(storage->messages[3], SIZE_MAX), tenMessages()[3].bytes);
    EXPECT_EQ(storage->readHead(storage->messages[3], 7).size(), 7U);
  }
}

TEST(limits_mcap, stamps_beyond_2262_and_channels_that_are_not_described) {
  for (const bool has_index : {true, false}) {
    std::vector<Recorded> messages = tenMessages();
    messages[9].received = -1;  // as 64 bits without a sign, the year 2554
    mcap_writer::Shape shape;
    shape.has_index = has_index;
    const auto storage = openMcap(mcap_writer::write(messages, shape));
    EXPECT_EQ(storage->messages.size(), 9U);
    EXPECT_TRUE(hasAny(storage->remarks, "1 messages were skipped whose stamps are beyond"));
  }
  Out file;
  file.raw(mcap_writer::magic());
  Out message;
  message.u16(7).u32(0).u64(5).u64(5).raw({1, 2, 3});
  file.raw(mcap_writer::record(0x05, message.bytes)).raw(endOfMcap());
  const auto storage = openMcap(file.bytes);
  EXPECT_TRUE(storage->messages.empty());
  EXPECT_TRUE(hasAny(storage->remarks, "1 messages of channels that are not described were skip"));
}

// --- bags ----------------------------------------------------------------------------------------

std::unique_ptr<gslam::ros::Storage> openBag(const RawBytes& bytes) {
  return gslam::ros::openBag(openMemory(bytes, "small.bag"));
}

TEST(limits_bag, one_changed_byte_of_the_index_loses_no_message) {
  const bag_writer::Bag bag = bag_writer::write();
  ASSERT_TRUE(openBag(bag.bytes)->remarks.empty());
  for (std::size_t at = bag.index; at < bag.bytes.size(); ++at) {
    for (const int bits : {0x01, 0x40, 0xFF}) {
      RawBytes changed = bag.bytes;
      changed[at] ^= static_cast<std::uint8_t>(bits);
      const auto storage = openBag(changed);
      ASSERT_EQ(storage->messages.size(), 10U) << at;
      for (const auto& ref : storage->messages) ASSERT_EQ(storage->read(ref).size(), 30U) << at;
    }
  }
}

TEST(limits_bag, a_message_that_the_index_names_twice_comes_once) {
  bag_writer::Shape shape;
  shape.times_named = 50;
  const auto storage = openBag(bag_writer::write(shape).bytes);
  EXPECT_EQ(storage->messages.size(), 10U);
  EXPECT_TRUE(hasAny(storage->remarks, "names a message twice"));
}

TEST(limits_bag, messages_of_a_chunk_that_was_not_closed_are_read) {
  bag_writer::Shape shape;
  shape.is_chunk_closed = false;
  RawBytes bytes = bag_writer::write(shape).bytes;
  bytes.resize(bytes.size() - 5);  // within the last message
  const auto storage = openBag(bytes);
  ASSERT_EQ(storage->messages.size(), 9U);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(storage->read(storage->messages[i]), RawBytes(30, std::uint8_t(i)));
    EXPECT_EQ(storage->messages[i].stamp, std::int64_t(10 + i) * 1000000000);
  }
  EXPECT_TRUE(hasAny(storage->remarks, "it ends early: small.bag: at byte"));
}

TEST(limits_bag, encrypted_ones_and_headers_that_are_too_long_are_refused) {
  bag_writer::Shape shape;
  shape.is_encrypted = true;
  EXPECT_EQ(errorOf([&] { openBag(bag_writer::write(shape).bytes); }),
            "small.bag: is encrypted, which cannot be read");
  RawBytes bytes = bag_writer::text("#ROSBAG V2.0\n");
  const RawBytes record = Out().u32(3U << 20).raw(RawBytes(4U << 20)).bytes;
  bytes.insert(bytes.end(), record.begin(), record.end());
  EXPECT_TRUE(hasAny(openBag(bytes)->remarks, "the header of a record should have 3145728 bytes"));
}

TEST(limits_bag, a_message_of_another_connection_than_the_index_says_is_an_error) {
  RawBytes bytes = bag_writer::write().bytes;
  // Connection 1 of the first message, in its own record.
  const RawBytes first = bag_writer::fields({{"op", {2}}, {"conn", bag_writer::u32(0)}});
  bytes[find(bytes, first) + first.size() - 4] = 1;
  const auto storage = openBag(bytes);
  ASSERT_EQ(storage->messages.size(), 10U);
  EXPECT_TRUE(has(errorOf([&] { storage->read(storage->messages[0]); }),
                  "expected a message of /imu with the stamp 10000000000 ns"));
  EXPECT_EQ(storage->read(storage->messages[1]).size(), 30U);
}

// --- unpacked blocks -----------------------------------------------------------------------------

TEST(limits_cache, blocks_are_kept_up_to_a_number_of_bytes) {
  gslam::ros::BlockCache cache(1000);
  int unpacked = 0;
  const auto get = [&](std::uint64_t offset, std::size_t size) {
    const auto unpack = [&] {
      ++unpacked;
      return RawBytes(size, std::uint8_t(offset));
    };
    EXPECT_EQ(cache.get(offset, unpack)->size(), size);
  };
  get(1, 400);
  get(2, 400);
  get(1, 400);
  EXPECT_EQ(unpacked, 2);
  EXPECT_EQ(cache.size(), 800U);
  get(3, 400);  // 2 goes, which was not asked for longest
  get(1, 400);
  EXPECT_EQ(unpacked, 3);
  EXPECT_EQ(cache.size(), 800U);
  get(4, 5000);  // alone, though it is too large
  get(4, 5000);
  EXPECT_EQ(unpacked, 4);
  EXPECT_EQ(cache.size(), 5000U);
  EXPECT_THROW(cache.get(5, []() -> RawBytes { throw gslam::Error("damaged"); }), gslam::Error);
  for (std::uint64_t i = 10; i < 30; ++i) get(i, 10);
  EXPECT_EQ(cache.size(), 60U);
}

}  // namespace
