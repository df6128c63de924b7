#include "rosbag_files.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>

#include <cstring>

namespace rosbag_files {

/// Bytes that are a message already.
struct RawMessage {
  std::string type;
  std::vector<std::uint8_t> bytes;
};

}  // namespace rosbag_files

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<rosbag_files::RawMessage> {
  static const char* value(const rosbag_files::RawMessage&) {
    return "0123456789abcdef0123456789abcdef";
  }
};
template <>
struct DataType<rosbag_files::RawMessage> {
  static const char* value(const rosbag_files::RawMessage& message) { return message.type.c_str(); }
};
template <>
struct Definition<rosbag_files::RawMessage> {
  static const char* value(const rosbag_files::RawMessage&) { return "# not said"; }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<rosbag_files::RawMessage> {
  template <class Stream>
  static void write(Stream& stream, const rosbag_files::RawMessage& message) {
    std::memcpy(stream.advance(std::uint32_t(message.bytes.size())), message.bytes.data(),
                message.bytes.size());
  }
  static std::uint32_t serializedLength(const rosbag_files::RawMessage& message) {
    return std::uint32_t(message.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros

namespace rosbag_files {
namespace {

::ros::Time timeOf(std::int64_t stamp) {
  return ::ros::Time(std::uint32_t(stamp / 1000000000), std::uint32_t(stamp % 1000000000));
}

}  // namespace

void write(const std::string& path, const std::vector<Recorded>& messages, const BagShape& shape) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setChunkThreshold(shape.chunk_size);
  bag.setCompression(shape.compression == "bz2"   ? rosbag::compression::BZ2
                     : shape.compression == "lz4" ? rosbag::compression::LZ4
                                                  : rosbag::compression::Uncompressed);
  for (const Recorded& one : messages) {
    RawMessage message;
    message.type = one.type;
    message.bytes = one.bytes;
    bag.write(one.topic, timeOf(one.received), message);
  }
  if (shape.is_closed) {
    bag.close();
    return;
  }
  // What a recorder that was killed leaves: what was in the file before it was closed. The last
  // chunk of it is still in memory, but for its beginning.
  const std::vector<std::uint8_t> bytes = readFile(path);
  bag.close();
  writeFile(path, bytes);
}

std::vector<Recorded> read(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  rosbag::View view(bag);
  std::vector<Recorded> all;
  for (const rosbag::MessageInstance& one : view) {
    Recorded message = {one.getTopic(), one.getDataType(),
                        std::int64_t(one.getTime().sec) * 1000000000 + one.getTime().nsec,
                        std::vector<std::uint8_t>(one.size())};
    ::ros::serialization::OStream stream(message.bytes.data(), std::uint32_t(message.bytes.size()));
    one.write(stream);
    all.push_back(message);
  }
  return all;
}

void writeTrueMessages(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const ::ros::Time time(100, 5), stamp(99, 999999999);
  std_msgs::Header header;
  header.seq = 77;
  header.stamp = stamp;
  header.frame_id = "optical";
  sensor_msgs::Image image;
  image.header = header;
  image.width = 3;
  image.height = 2;
  image.encoding = "bgr8";
  image.step = 10;
  for (int i = 0; i < 20; ++i) image.data.push_back(std::uint8_t(10 * i));
  bag.write("/camera/image_raw", time, image);
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = 3;
  info.height = 2;
  info.distortion_model = "plumb_bob";
  info.D = {0.25, -0.125, 0.0625, 0.03125, 0.5};
  info.K = {100, 0, 1, 0, 101, 2, 0, 0, 1};
  bag.write("/camera/camera_info", time, info);
  sensor_msgs::Imu imu;
  imu.header = header;
  imu.angular_velocity.x = 1;
  imu.angular_velocity.z = 3;
  imu.linear_acceleration.y = 9.75;
  bag.write("/imu", time, imu);
  sensor_msgs::NavSatFix fix;
  fix.header = header;
  fix.status.status = 2;
  fix.latitude = 45;
  fix.longitude = -90;
  fix.altitude = 123;
  fix.position_covariance[8] = 4;
  fix.position_covariance_type = 3;
  bag.write("/fix", time, fix);
  geometry_msgs::TransformStamped pose;
  pose.header = header;
  pose.child_frame_id = "optical";
  pose.transform.translation.x = 5;
  pose.transform.rotation.z = 1;
  bag.write("/vicon/body", time, pose);
  geometry_msgs::PoseWithCovarianceStamped odometry;
  odometry.header = header;
  odometry.pose.pose.position.y = 6;
  odometry.pose.pose.orientation.w = 1;
  for (std::size_t i = 0; i < 6; ++i) odometry.pose.covariance[7 * i] = 0.5;
  bag.write("/estimate", time, odometry);
  bag.close();
}

}  // namespace rosbag_files
