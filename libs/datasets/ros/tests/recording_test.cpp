// Recordings of all kinds: those of the test data, and those written here.
#include <gslam/datasets_ros/recording.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <cstdlib>
#include <thread>
#include <tuple>

#include "bag_writer.h"
#include "bytes/byte_source.h"
#include "content.h"
#include "db3_writer.h"
#include "mcap_writer.h"
#include "storage/storage.h"
#include "test_data.h"

namespace {

using gslam::MessageRef;
using gslam::Recording;
using mcap_writer::Shape;

std::string bags() {
  return test_data::folder() + "bags/";
}

std::vector<Recorded> someMessages() {
  std::vector<Recorded> messages;
  for (int i = 0; i < 20; ++i) {
    const std::int64_t stamp = 1000000000LL * (i + 5);
    messages.push_back({"/imu", "sensor_msgs/Imu", stamp, imuBytes(Coding::little_cdr, stamp, i)});
    if (i % 3 != 0) continue;
    messages.push_back({"/noise", "std_msgs/String", stamp + 7,
                        noise(std::size_t(40 + 100 * i), std::uint32_t(i))});
  }
  return messages;
}

std::shared_ptr<const Recording> openBytes(const std::string& name,
                                           const std::vector<std::uint8_t>& bytes) {
  const std::string path = folderOfTests() + name;
  writeFile(path, bytes);
  return Recording::open(path);
}

std::vector<Recorded> asWritten() {
  std::vector<Recorded> messages = someMessages();
  for (Recorded& one : messages) one.type = ros2Type(one.type);
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Recorded& a, const Recorded& b) { return a.topic < b.topic; });
  return messages;
}

TEST(recording, a_compressed_bag_has_the_messages_of_the_uncompressed_one) {
  NEEDS_TEST_DATA();
  const auto plain = Recording::open(bags() + "ros1/example.bag");
  const auto packed = Recording::open(bags() + "ros1/example-bz2.bag");
  EXPECT_EQ(plain->messages().size(), 8647U);
  EXPECT_TRUE(plain->remarks().empty());
  EXPECT_TRUE(packed->remarks().empty());
  // Twelve connections are nine topics: several nodes write to /rosout and /tf.
  EXPECT_EQ(plain->topics().size(), 9U);
  const gslam::RecordedTopic& transforms = plain->topics()[plain->topic("/tf")];
  EXPECT_EQ(transforms.type, "tf/tfMessage");
  EXPECT_EQ(transforms.count, 2688U);
  EXPECT_EQ(transforms.first_stamp, 1396293888056251251);
  EXPECT_EQ(transforms.last_stamp, 1396293909544779879);
  // Messages of two writers at the same time may change places.
  const auto sorted = [](std::vector<Recorded> all) {
    std::sort(all.begin(), all.end(), [](const Recorded& a, const Recorded& b) {
      return std::tie(a.topic, a.received, a.bytes) < std::tie(b.topic, b.received, b.bytes);
    });
    return all;
  };
  expectSame(sorted(contentOf(*plain)), sorted(contentOf(*packed)));
}

TEST(recording, bags_without_messages_and_without_bytes) {
  NEEDS_TEST_DATA();
  const auto none = Recording::open(bags() + "ros1/no-messages.bag");
  EXPECT_TRUE(none->topics().empty());
  EXPECT_TRUE(none->messages().empty());
  const std::string path = bags() + "ros1/empty-file.bag";
  EXPECT_EQ(errorOf([&] { Recording::open(path); }), path + ": is empty, expected a ROS bag");
}

TEST(recording, mcap_and_sqlite_of_the_same_recording_agree) {
  NEEDS_TEST_DATA();
  for (const std::string name : {"talker", "wbag"}) {
    const auto sqlite = Recording::open(bags() + "ros2/" + name);
    const auto mcap = Recording::open(bags() + "ros2_mcap/" + name);
    EXPECT_TRUE(sqlite->remarks().empty());
    EXPECT_TRUE(mcap->remarks().empty());
    EXPECT_EQ(sqlite->messages().size(), name == "wbag" ? 6074U : 20U);
    expectSame(contentOf(*sqlite), contentOf(*mcap));
  }
}

TEST(recording, topics_of_several_files_are_put_together) {
  NEEDS_TEST_DATA();
  const auto recording = Recording::open(bags() + "ros2/wbag");
  ASSERT_EQ(recording->topics().size(), 8U);
  // Numbers of metadata.yaml.
  EXPECT_EQ(recording->topics()[recording->topic("HHH")].count, 726U);
  EXPECT_EQ(recording->topics()[recording->topic("AAA")].count, 804U);
  const std::vector<MessageRef> all = recording->messages();
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const MessageRef& a, const MessageRef& b) {
    return a.stamp < b.stamp;
  }));
  EXPECT_EQ(all.front().stamp, 1000);
  EXPECT_EQ(all.back().stamp, 2998);
  const auto one_topic = recording->messages({recording->topic("GGG")});
  EXPECT_EQ(one_topic.size(), 731U);
}

TEST(recording, every_shape_of_mcap_gives_the_same_messages) {
  for (const std::string compression : {"", "lz4", "zstd"}) {
    for (const int features : {0, 1, 2, 3, 4, 5, 6, 7, 8, 15}) {
      Shape shape;
      shape.compression = compression;
      shape.has_chunks = (features & 1) == 0;
      shape.has_index = (features & 2) == 0;
      shape.has_crc = (features & 4) == 0;
      shape.has_strangers = (features & 8) != 0;
      SCOPED_TRACE(compression + " " + std::to_string(features));
      const auto recording = openBytes("shape.mcap", mcap_writer::write(someMessages(), shape));
      expectSame(contentOf(*recording), asWritten());
      const bool is_indexed = shape.has_chunks && shape.has_index;
      EXPECT_EQ(recording->remarks().empty(), is_indexed);
      EXPECT_EQ(hasAny(recording->remarks(), "looked through"), !is_indexed);
    }
  }
}

TEST(recording, an_mcap_file_that_was_not_closed_is_looked_through) {
  Shape shape;
  shape.is_closed = false;
  const auto recording = openBytes("open.mcap", mcap_writer::write(someMessages(), shape));
  expectSame(contentOf(*recording), asWritten());
  EXPECT_TRUE(hasAny(recording->remarks(), "it was not closed"));
}

TEST(recording, the_head_of_a_message_is_its_beginning) {
  for (const std::string compression : {"", "lz4"}) {
    Shape shape;
    shape.compression = compression;
    const auto recording = openBytes("head.mcap", mcap_writer::write(someMessages(), shape));
    for (const MessageRef& ref : recording->messages()) {
      const auto all = recording->read(ref), head = recording->readHead(ref, 30);
      ASSERT_GE(head.size(), std::min<std::size_t>(30, all.size()));
      ASSERT_LE(head.size(), all.size());
      ASSERT_TRUE(std::equal(head.begin(), head.end(), all.begin()));
    }
  }
}

TEST(recording, damaged_bytes_of_a_chunk_are_seen_by_its_crc) {
  Shape shape;
  std::vector<std::uint8_t> bytes = mcap_writer::write(someMessages(), shape);
  const auto whole = openBytes("crc.mcap", bytes);
  const MessageRef first = whole->messages().front();
  // A byte within the data of the first message: behind schema, channel and its fields.
  bytes[first.block + 400] ^= 1U;
  const auto damaged = openBytes("crc.mcap", bytes);
  const std::string error = errorOf([&] { damaged->read(first); });
  EXPECT_TRUE(has(error, "at byte " + std::to_string(first.block))) << error;
  EXPECT_TRUE(has(error, "CRC")) << error;
}

TEST(recording, a_wrong_crc_of_data_and_attachments_is_said) {
  Shape shape;
  shape.has_index = false;
  std::vector<std::uint8_t> bytes = mcap_writer::magic();
  const auto add = [&](const std::vector<std::uint8_t>& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  add(mcap_writer::record(0x01, mcap_writer::Out().text("").text("").bytes));
  add(mcap_writer::attachmentRecord(true));
  add(mcap_writer::record(0x0F, mcap_writer::Out().u32(12345).bytes));
  add(mcap_writer::record(0x02, mcap_writer::Out().u64(0).u64(0).u32(0).bytes));
  add(mcap_writer::magic());
  const auto recording = openBytes("wrong.mcap", bytes);
  EXPECT_TRUE(hasAny(recording->remarks(), "the attachment at byte 25 has the CRC"));
  EXPECT_TRUE(hasAny(recording->remarks(), "the data up to byte"));
}

TEST(recording, a_database_written_as_rosbag2_does_is_read) {
  const std::string path = folderOfTests() + "a 100%#?.db3";
  db3_writer::write(path, someMessages());
  const auto recording = Recording::open(path);
  expectSame(contentOf(*recording), asWritten());
  EXPECT_TRUE(recording->remarks().empty());
  EXPECT_EQ(recording->topics()[0].encoding, "cdr");
}

TEST(recording, strange_databases_are_refused) {
  const std::string path = folderOfTests() + "strange.db3";
  writeFile(path, {});
  EXPECT_TRUE(has(errorOf([&] { Recording::open(path); }), "is empty"));
  writeFile(path, noise(5000, 1));
  EXPECT_TRUE(has(errorOf([&] { Recording::open(path); }), path + ": is no database"));
  std::remove(path.c_str());
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  db3_writer::run(database,
                  "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
                  "serialization_format TEXT);"
                  "CREATE VIEW messages AS WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 "
                  "FROM n) SELECT x AS id, 1 AS topic_id, x AS timestamp, 'a' AS data FROM n");
  sqlite3_close(database);
  EXPECT_TRUE(has(errorOf([&] { Recording::open(path); }), "it has no table 'messages'"));
}

void writeMetadata(const std::string& folder, const std::string& files,
                   const std::string& compression) {
  const std::string text = "rosbag2_bagfile_information:\n  version: 4\n  relative_file_paths: [" +
                           files + "]\n  message_count: 27\n" + compression;
  writeFile(folder + "/metadata.yaml", std::vector<std::uint8_t>(text.begin(), text.end()));
}

std::string makeFolder(const std::string& name) {
  const std::string folder = folderOfTests() + name;
  EXPECT_EQ(std::system(("rm -rf '" + folder + "' && mkdir -p '" + folder + "'").c_str()), 0);
  return folder;
}

TEST(recording, messages_that_are_compressed_one_by_one_are_unpacked) {
  const std::string folder = makeFolder("packed");
  std::vector<Recorded> packed = someMessages();
  for (Recorded& one : packed) one.bytes = mcap_writer::packed(one.bytes, "zstd");
  db3_writer::write(folder + "/a.db3", packed);
  writeMetadata(folder, "packed/a.db3",
                "  compression_format: zstd\n  compression_mode: MESSAGE\n");
  const auto recording = Recording::open(folder);
  expectSame(contentOf(*recording), asWritten());
  EXPECT_TRUE(recording->remarks().empty());
  EXPECT_TRUE(gslam::isRecording(folder));
}

TEST(recording, files_that_are_compressed_as_a_whole_are_refused_with_what_helps) {
  const std::string folder = makeFolder("file_mode");
  writeMetadata(folder, "a.db3.zstd", "  compression_format: zstd\n  compression_mode: FILE\n");
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "unpack them"));
  writeMetadata(folder, "a.db3.zstd", "");
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "zstd -d"));
  writeMetadata(folder, "a.db3", "  compression_format: lzo\n  compression_mode: message\n");
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "expected messages by zstd"));
}

TEST(recording, folders_without_metadata_with_wrong_ones_and_with_missing_files) {
  const std::string folder = makeFolder("bare");
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "expected metadata.yaml"));
  EXPECT_FALSE(gslam::isRecording(folder));
  writeFile(folder + "/b.mcap", mcap_writer::write(someMessages()));
  EXPECT_TRUE(gslam::isRecording(folder));
  const auto recording = Recording::open(folder + "/");
  expectSame(contentOf(*recording), asWritten());
  EXPECT_TRUE(hasAny(recording->remarks(), "all recordings in the folder were taken"));
  writeMetadata(folder, "b.mcap, c.mcap", "");
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "/c.mcap: cannot be opened"));
  writeMetadata(folder, "", "");
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "names no file"));
  writeFile(folder + "/metadata.yaml", {'a', ':', ' ', '1', '\n'});
  EXPECT_FALSE(gslam::isRecording(folder));
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "is no metadata of ROS 2"));
}

TEST(recording, a_count_of_metadata_that_is_not_that_of_the_files_is_said) {
  const std::string folder = makeFolder("count");
  std::vector<Recorded> fewer = someMessages();
  fewer.pop_back();
  writeFile(folder + "/a.mcap", mcap_writer::write(fewer));
  writeMetadata(folder, "a.mcap", "");
  EXPECT_TRUE(hasAny(Recording::open(folder)->remarks(), "counts 27 messages, but there are 26"));
}

TEST(recording, a_file_that_metadata_names_twice_is_refused) {
  const std::string folder = makeFolder("twice");
  writeFile(folder + "/a.mcap", mcap_writer::write(someMessages()));
  writeMetadata(folder, "a.mcap, twice/a.mcap", "");
  EXPECT_TRUE(has(errorOf([&] { Recording::open(folder); }), "/a.mcap twice"));
}

// Each file has its own numbers of topics.
TEST(recording, files_whose_topics_are_in_another_order) {
  const std::string folder = makeFolder("orders");
  std::vector<Recorded> first = someMessages();
  std::vector<Recorded> second(first.begin() + 10, first.end());
  first.resize(10);
  std::reverse(second.begin(), second.end());
  std::swap(second[0], second[1]);
  ASSERT_NE(first[0].topic, second[0].topic);
  writeFile(folder + "/a.mcap", mcap_writer::write(first));
  writeFile(folder + "/c.mcap", mcap_writer::write(second));
  writeMetadata(folder, "a.mcap, c.mcap", "");
  expectSame(contentOf(*Recording::open(folder)), asWritten());
}

TEST(recording, a_bag_that_is_still_called_active_is_a_bag) {
  const std::string path = folderOfTests() + "run.bag.active";
  bag_writer::Shape shape;
  shape.is_chunk_closed = false;
  writeFile(path, bag_writer::write(shape).bytes);
  EXPECT_TRUE(gslam::isRecording(path));
  const auto recording = Recording::open(path);
  EXPECT_EQ(recording->messages().size(), 10U);
  EXPECT_TRUE(hasAny(recording->remarks(), "it was not closed"));
}

TEST(recording, what_is_no_recording_is_no_recording) {
  const std::string path = folderOfTests() + "notes.txt";
  writeFile(path, {'x'});
  EXPECT_FALSE(gslam::isRecording(path));
  EXPECT_FALSE(gslam::isRecording(folderOfTests() + "missing.bag"));
  EXPECT_TRUE(has(errorOf([&] { Recording::open(path); }), "expected a file that ends in .bag"));
  EXPECT_TRUE(
      has(errorOf([&] { Recording::open(folderOfTests() + "missing.bag"); }), "cannot be opened"));
  writeFile(folderOfTests() + "old.bag",
            {'#', 'R', 'O', 'S', 'B', 'A', 'G', ' ', 'V', '1', '.', '2', '\n'});
  EXPECT_TRUE(has(errorOf([] { Recording::open(folderOfTests() + "old.bag"); }),
                  "another version ('#ROSBAG V1.2')"));
}

TEST(recording, an_unknown_topic_is_an_error_that_lists_them) {
  const auto recording = openBytes("topics.mcap", mcap_writer::write(someMessages()));
  const std::string error = errorOf([&] { recording->topic("/gps"); });
  EXPECT_TRUE(has(error, "has no topic '/gps'")) << error;
  EXPECT_TRUE(has(error, "/imu (sensor_msgs/msg/Imu), /noise (std_msgs/msg/String)")) << error;
}

TEST(recording, threads_may_read_at_once) {
  Shape shape;
  shape.compression = "zstd";
  writeFile(folderOfTests() + "threads.mcap", mcap_writer::write(someMessages(), shape));
  db3_writer::write(folderOfTests() + "threads.db3", someMessages());
  for (const char* name : {"threads.mcap", "threads.db3"}) {
    const auto recording = Recording::open(folderOfTests() + name);
    const std::vector<MessageRef> all = recording->messages();
    std::vector<std::vector<std::uint8_t>> alone;
    for (const MessageRef& ref : all) alone.push_back(recording->read(ref));
    std::vector<int> wrong(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t) {
      threads.emplace_back([&, t] {
        for (std::size_t i = 0; i < 20 * all.size(); ++i) {
          const std::size_t k = (i * (2 * t + 1) * 5) % all.size();
          if (recording->read(all[k]) != alone[k]) ++wrong[t];
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(4));
  }
}

}  // namespace
