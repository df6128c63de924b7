// Files that somebody cut, or changed: an error or fewer messages, and never more than that. These
// tests say most when they run under AddressSanitizer.
#include <gslam/datasets_ros/recording.h>
#include <gtest/gtest.h>

#include <random>

#include "bytes/byte_source.h"
#include "bytes/decompress.h"
#include "db3_writer.h"
#include "mcap_writer.h"
#include "storage/storage.h"
#include "test_data.h"

namespace {

std::vector<Recorded> fewMessages() {
  std::vector<Recorded> messages;
  for (int i = 0; i < 4; ++i) {
    messages.push_back({"/pose", "geometry_msgs/PoseStamped", 100 + i,
                        poseBytes(Coding::little_cdr, 100 + i, {1, 2, 3, 0, 0, 0, 1})});
  }
  return messages;
}

// Opens and reads all; gives the number of messages that came, or -1 for an error.
template <class Open>
int readAll(const Open& open) {
  int count = 0;
  try {
    const std::unique_ptr<gslam::ros::Storage> storage = open();
    for (const gslam::MessageRef& ref : storage->messages) {
      try {
        storage->readHead(ref, 40);
        storage->read(ref);
        ++count;
      } catch (const gslam::Error& error) {
        EXPECT_TRUE(has(error.what(), "hostile")) << error.what();
      }
    }
  } catch (const gslam::Error& error) {
    EXPECT_TRUE(has(error.what(), "hostile")) << error.what();  // the file's name
    return -1;
  }
  return count;
}

int readMcap(const RawBytes& bytes) {
  return readAll([&] { return gslam::ros::openMcap(gslam::ros::openMemory(bytes, "hostile")); });
}
int readBag(const RawBytes& bytes) {
  return readAll([&] { return gslam::ros::openBag(gslam::ros::openMemory(bytes, "hostile")); });
}

template <class Read>
void cutEverywhere(const RawBytes& bytes, int whole, const Read& read) {
  ASSERT_EQ(read(bytes), whole);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const int count = read(RawBytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size)));
    ASSERT_LE(count, whole) << size;
  }
}

template <class Read>
void changeBytes(const RawBytes& bytes, int times, const Read& read) {
  std::mt19937 random(7);
  for (int i = 0; i < times; ++i) {
    RawBytes changed = bytes;
    const std::size_t changes = 1 + random() % 2;
    for (std::size_t k = 0; k < changes; ++k) {
      changed[random() % changed.size()] = static_cast<std::uint8_t>(random());
    }
    read(changed);
  }
}

std::vector<RawBytes> mcaps() {
  std::vector<RawBytes> files;
  for (const std::string compression : {"", "lz4", "zstd"}) {
    for (const bool has_index : {true, false}) {
      mcap_writer::Shape shape;
      shape.compression = compression;
      shape.has_index = has_index;
      shape.has_crc = has_index;
      shape.chunk_messages = 2;
      files.push_back(mcap_writer::write(fewMessages(), shape));
    }
  }
  return files;
}

TEST(hostile_mcap, every_prefix_is_an_error_or_a_shorter_recording) {
  for (const RawBytes& file : mcaps()) cutEverywhere(file, 4, readMcap);
}

TEST(hostile_mcap, changed_bytes_do_no_harm) {
  for (const RawBytes& file : mcaps()) changeBytes(file, 1500, readMcap);
}

TEST(hostile_mcap, a_cut_file_keeps_its_whole_chunks) {
  const RawBytes file = mcaps()[0];
  RawBytes cut(file.begin(), file.begin() + std::ptrdiff_t(file.size() * 6 / 10));
  const auto storage = gslam::ros::openMcap(gslam::ros::openMemory(cut, "cut.mcap"));
  EXPECT_EQ(storage->messages.size(), 2U);
  EXPECT_TRUE(hasAny(storage->remarks, "it ends early: cut.mcap: at byte"));
}

TEST(hostile_mcap, a_size_beyond_the_file_takes_no_memory) {
  // A message of 2^62 bytes, and a chunk that promises to unpack to as many.
  mcap_writer::Out out;
  out.raw(mcap_writer::magic()).u8(0x05).u64(std::uint64_t(1) << 62);
  const auto cut = gslam::ros::openMcap(gslam::ros::openMemory(out.bytes, "huge.mcap"));
  EXPECT_TRUE(hasAny(cut->remarks, "huge.mcap: at byte 8: a record of kind 5 should have"));
  mcap_writer::Out chunk;
  const RawBytes packed = mcap_writer::packed(RawBytes(10), "zstd");
  chunk.u64(0).u64(0).u64(std::uint64_t(1) << 62).u32(0).text("zstd").u64(packed.size());
  chunk.raw(packed);
  mcap_writer::Out file;
  file.raw(mcap_writer::magic()).raw(mcap_writer::record(0x06, chunk.bytes));
  const auto big = gslam::ros::openMcap(gslam::ros::openMemory(file.bytes, "big.mcap"));
  EXPECT_TRUE(hasAny(big->remarks, "big.mcap: at byte 8: the chunk should unpack to"));
}

TEST(hostile_mcap, chunks_that_the_summary_names_many_times_are_scanned_once) {
  const auto messages = fewMessages();
  mcap_writer::Shape shape;
  shape.chunk_messages = 4;
  shape.has_crc = false;
  RawBytes file = mcap_writer::write(messages, shape);
  // Twice the same chunk index, with the counts of statistics as they would be.
  const std::size_t footer = file.size() - 8 - 29;
  std::size_t index = footer;
  while (!(file[index] == 0x08 && file[index + 2] == 0 && file[index + 3] == 0)) --index;
  const RawBytes record(file.begin() + std::ptrdiff_t(index),
                        file.begin() + std::ptrdiff_t(footer));
  file.insert(file.begin() + std::ptrdiff_t(footer), record.begin(), record.end());
  const auto storage = gslam::ros::openMcap(gslam::ros::openMemory(file, "twice.mcap"));
  EXPECT_EQ(storage->messages.size(), 4U);
  EXPECT_TRUE(hasAny(storage->remarks, "names chunks that overlap"));
}

TEST(hostile_bag, prefixes_of_a_real_bag) {
  NEEDS_TEST_DATA();
  const RawBytes file = readFile(test_data::folder() + "bags/ros1/no-messages.bag");
  cutEverywhere(file, 0, readBag);
  const RawBytes messages = readFile(test_data::folder() + "bags/ros1/example-bz2.bag");
  for (std::size_t i = 1; i < 60; ++i) {
    const std::size_t size = messages.size() * i / 60;
    EXPECT_LE(readBag(RawBytes(messages.begin(), messages.begin() + std::ptrdiff_t(size))), 8647);
  }
}

TEST(hostile_db3, prefixes_and_changed_bytes) {
  const std::string path = folderOfTests() + "hostile.db3";
  db3_writer::write(path, fewMessages());
  const RawBytes file = readFile(path);
  const auto read = [&](const RawBytes& bytes) {
    writeFile(path, bytes);
    return readAll([&] { return gslam::ros::openDb3(path); });
  };
  ASSERT_EQ(read(file), 4);
  for (std::size_t size = 0; size < file.size(); size += 97) {
    EXPECT_LE(read(RawBytes(file.begin(), file.begin() + std::ptrdiff_t(size))), 4) << size;
  }
  changeBytes(file, 2000, read);
}

TEST(hostile_blocks, what_does_not_unpack_to_what_it_should_is_an_error) {
  using namespace gslam::ros;  // NOLINT(google-build-using-namespace): one function
  const RawBytes data(1000, 7);
  const RawBytes zstd = mcap_writer::packed(data, "zstd"), lz4 = mcap_writer::packed(data, "lz4");
  EXPECT_EQ(unpackZstd(gslam::ros::Bytes(zstd), 1000), data);
  EXPECT_EQ(unpackLz4(gslam::ros::Bytes(lz4), 1000), data);
  for (const std::uint64_t size : {std::uint64_t(0), std::uint64_t(999), std::uint64_t(1001)}) {
    EXPECT_TRUE(has(errorOf([&] { unpackZstd(gslam::ros::Bytes(zstd), size); }), "unpacks to"));
    EXPECT_TRUE(has(errorOf([&] { unpackLz4(gslam::ros::Bytes(lz4), size); }), "unpacks to"));
  }
  const RawBytes cut_zstd(zstd.begin(), zstd.end() - 1), cut_lz4(lz4.begin(), lz4.end() - 5);
  EXPECT_NE(errorOf([&] { unpackZstd(gslam::ros::Bytes(cut_zstd), 1000); }), "");
  EXPECT_NE(errorOf([&] { unpackLz4(gslam::ros::Bytes(cut_lz4), 1000); }), "");
  EXPECT_NE(errorOf([&] { unpackBzip2(gslam::ros::Bytes(lz4), 1000); }), "");
  EXPECT_NE(errorOf([&] { unpackBzip2(gslam::ros::Bytes(), 1000); }), "");
}

}  // namespace
