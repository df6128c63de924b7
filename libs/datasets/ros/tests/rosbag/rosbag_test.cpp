// Bags against rosbag_storage: what it writes is read, and what it reads is read the same.
#include <gslam/core/frame.h>
#include <gslam/datasets_ros/recording.h>
#include <gslam/datasets_ros/ros_dataset.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "../content.h"
#include "bytes/byte_source.h"
#include "rosbag_files.h"
#include "storage/storage.h"
#include "test_data.h"

namespace {

using gslam::MessageRef;
using gslam::Recording;
using gslam::Svar;
using rosbag_files::BagShape;

// Messages received at the same time may change places.
void expectSameInAnyOrder(std::vector<Recorded> a, std::vector<Recorded> b) {
  const auto earlier = [](const Recorded& x, const Recorded& y) {
    return std::tie(x.received, x.topic, x.bytes) < std::tie(y.received, y.topic, y.bytes);
  };
  std::sort(a.begin(), a.end(), earlier);
  std::sort(b.begin(), b.end(), earlier);
  expectSame(a, b);
}

std::vector<Recorded> noiseMessages(int count) {
  std::vector<Recorded> messages;
  for (int i = 0; i < count; ++i) {
    const std::int64_t stamp = 1000000000LL * (i + 5) + i;
    messages.push_back({i % 3 == 0 ? "/a" : "/b", "std_msgs/ByteMultiArray", stamp,
                        noise(std::size_t(50 + 13 * i), std::uint32_t(i))});
  }
  return messages;
}

TEST(rosbag, given_bags_are_read_as_rosbag_reads_them) {
  NEEDS_TEST_DATA();
  for (const char* name : {"example", "example-bz2", "no-messages", "test2_jackal_imu_odom"}) {
    SCOPED_TRACE(name);
    const std::string path = test_data::folder() + "bags/ros1/" + name + ".bag";
    const auto recording = Recording::open(path);
    EXPECT_TRUE(recording->remarks().empty());
    expectSameInAnyOrder(contentOf(*recording), rosbag_files::read(path));
  }
}

TEST(rosbag, every_compression_and_size_of_chunks) {
  const std::vector<Recorded> messages = noiseMessages(60);
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    for (const std::uint32_t chunk : {1U, 2000U, 1U << 20}) {
      BagShape shape;
      shape.compression = compression;
      shape.chunk_size = chunk;
      const std::string path = folderOfTests() + "shape.bag";
      rosbag_files::write(path, messages, shape);
      const auto recording = Recording::open(path);
      EXPECT_TRUE(recording->remarks().empty());
      EXPECT_EQ(recording->topics().size(), 2U);
      EXPECT_EQ(recording->topics()[0].encoding, "ros1");
      expectSameInAnyOrder(contentOf(*recording), messages);
      const MessageRef last = recording->messages().back();
      const auto head = recording->readHead(last, 20);
      EXPECT_TRUE(std::equal(head.begin(), head.begin() + 20, messages.back().bytes.begin()));
    }
  }
}

TEST(rosbag, a_bag_that_was_not_closed_keeps_its_whole_chunks) {
  for (const std::string compression : {"none", "lz4"}) {
    BagShape shape;
    shape.compression = compression;
    shape.chunk_size = 500;
    shape.is_closed = false;
    const std::string path = folderOfTests() + "open.bag";
    rosbag_files::write(path, noiseMessages(60), shape);
    const auto recording = Recording::open(path);
    EXPECT_GT(recording->messages().size(), 40U);
    EXPECT_TRUE(hasAny(recording->remarks(), "rosbag reindex"));
    std::vector<Recorded> found = contentOf(*recording), all = noiseMessages(60);
    all.resize(found.size());
    expectSameInAnyOrder(found, all);
  }
}

// What rosbag record leaves, whose chunks have 768 KB: all is in one that was not closed.
TEST(rosbag, a_bag_that_was_not_closed_keeps_messages_of_its_open_chunk) {
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    BagShape shape;
    shape.compression = compression;
    shape.chunk_size = 768 * 1024;
    shape.is_closed = false;
    const std::string path = folderOfTests() + "killed.bag";
    std::vector<Recorded> all = noiseMessages(200);  // 270 KB
    rosbag_files::write(path, all, shape);
    const auto recording = Recording::open(path);
    std::vector<Recorded> found = contentOf(*recording);
    if (compression == "none") {
      EXPECT_GT(found.size(), 190U);  // some KB were still in memory
    } else {
      EXPECT_TRUE(found.empty());
      EXPECT_TRUE(hasAny(recording->remarks(), "was not closed, and what is compressed in it"));
    }
    all.resize(found.size());
    expectSameInAnyOrder(found, all);
  }
}

TEST(rosbag, messages_that_ros_itself_serialized) {
  const std::string path = folderOfTests() + "true.bag";
  rosbag_files::writeTrueMessages(path);
  const auto dataset = gslam::rosFactory().open(path, Svar::object({{"odometry", "/estimate"}}));
  const gslam::DatasetInfo& info = dataset->info();
  ASSERT_EQ(info.frame_count, 1U);
  EXPECT_EQ(info.first_stamp, 99999999999);
  ASSERT_EQ(info.sensors.cameras.size(), 1U);
  EXPECT_EQ(info.sensors.cameras[0].name, "camera");
  EXPECT_EQ(info.sensors.cameras[0].kind, gslam::ImageKind::bgr);
  EXPECT_EQ(info.sensors.cameras[0].camera,
            gslam::Camera::fromParameters("radtan", 3, 2,
                                          {100, 101, 1, 2, 0.25, -0.125, 0.0625, 0.03125, 0.5}));
  ASSERT_EQ(info.ground_truth.size(), 1U);
  EXPECT_EQ(info.ground_truth[0].pose.translation()[0], 5);
  EXPECT_EQ(info.ground_truth[0].pose.rotation().z(), 1);
  const auto frame = dataset->next();
  ASSERT_EQ(frame->images.size(), 1U);
  for (int y = 0; y < 2; ++y) {
    for (int i = 0; i < 9; ++i) EXPECT_EQ(frame->images[0].image.bytes(y)[i], 10 * (10 * y + i));
  }
  ASSERT_EQ(frame->imu.size(), 1U);
  EXPECT_EQ(frame->imu[0].gyro, (gslam::Vec3d{1, 0, 3}));
  EXPECT_EQ(frame->imu[0].accel, (gslam::Vec3d{0, 9.75, 0}));
  ASSERT_EQ(frame->gnss.size(), 1U);
  EXPECT_NEAR(frame->gnss[0].position.longitude, -1.5707963267948966, 1e-15);
  EXPECT_EQ(frame->gnss[0].position.altitude, 123);
  EXPECT_EQ(frame->gnss[0].covariance(2, 2), 4);
  EXPECT_EQ(frame->gnss[0].fix, gslam::GnssFix::augmented);
  ASSERT_TRUE(frame->has_prior);
  EXPECT_EQ(frame->prior.pose().translation()[1], 6);
  EXPECT_NEAR(frame->prior.covariance()(4, 4), 0.5, 1e-12);
}

TEST(rosbag, images_come_back_pixel_for_pixel) {
  constexpr int kWidth = 160, kHeight = 120;
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    std::vector<Recorded> messages;
    for (int i = 0; i < 5; ++i) {
      const std::int64_t stamp = 1500000000LL * 1000000000 + i * 33000000;
      messages.push_back({"/cam0/image_raw", "sensor_msgs/Image", stamp + 1000,
                          imageBytes(Coding::ros1, stamp, "cam", kWidth, kHeight, "mono16",
                                     2 * kWidth, true, noise(2 * kWidth * kHeight, unsigned(i)))});
    }
    BagShape shape;
    shape.compression = compression;
    shape.chunk_size = 60000;
    const std::string path = folderOfTests() + "images.bag";
    rosbag_files::write(path, messages, shape);
    const auto dataset = gslam::rosFactory().open(path, Svar::object({{"threads", 3}}));
    ASSERT_EQ(dataset->info().frame_count, 5U);
    for (int i = 0; i < 5; ++i) {
      const auto frame = dataset->next();
      const auto bytes = noise(2 * kWidth * kHeight, unsigned(i));
      for (int y = 0; y < kHeight; ++y) {
        const std::uint16_t* const row = frame->images[0].image.row<std::uint16_t>(y);
        for (int x = 0; x < kWidth; ++x) {
          const std::size_t at = 2 * std::size_t(y * kWidth + x);
          ASSERT_EQ(row[x], bytes[at] * 256 + bytes[at + 1]);
        }
      }
    }
  }
}

// --- hostile bags --------------------------------------------------------------------------------

void readHostile(const std::vector<std::uint8_t>& bytes, std::size_t most) {
  std::size_t count = 0;
  try {
    const auto storage = gslam::ros::openBag(gslam::ros::openMemory(bytes, "hostile"));
    for (const MessageRef& ref : storage->messages) {
      try {
        storage->readHead(ref, 10);
        storage->read(ref);
        ++count;
      } catch (const gslam::Error& error) {
        EXPECT_TRUE(has(error.what(), "hostile")) << error.what();
      }
    }
  } catch (const gslam::Error& error) {
    EXPECT_TRUE(has(error.what(), "hostile")) << error.what();
  }
  EXPECT_LE(count, most);
}

std::vector<std::uint8_t> smallBag(const std::string& compression) {
  BagShape shape;
  shape.compression = compression;
  shape.chunk_size = 150;
  const std::string path = folderOfTests() + "small.bag";
  rosbag_files::write(path, noiseMessages(5), shape);
  return readFile(path);
}

TEST(hostile_rosbag, every_prefix_is_an_error_or_a_shorter_recording) {
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    const auto bytes = smallBag(compression);
    // Within the padding of the header all prefixes are alike; every one of packed data is not
    // tried.
    const std::size_t step = compression == "none" ? 1 : 7;
    for (std::size_t size = 0; size<bytes.size(); size += size> 100 && size < 4000 ? 100 : step) {
      readHostile(std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + std::ptrdiff_t(size)),
                  5);
    }
  }
}

TEST(hostile_rosbag, changed_bytes_do_no_harm) {
  std::mt19937 random(3);
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    const auto bytes = smallBag(compression);
    for (int i = 0; i < 1000; ++i) {
      auto changed = bytes;
      // Most of the first 4 kB is padding.
      const std::size_t at = i % 10 == 0 ? random() % 100 : 4000 + random() % (bytes.size() - 4000);
      changed[at] = static_cast<std::uint8_t>(random());
      readHostile(changed, 1000);
    }
  }
}

}  // namespace
