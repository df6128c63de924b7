// The messages that are read, each described once for ROS 1 and ROS 2.
// Source: the .msg files of std_msgs, geometry_msgs, sensor_msgs, nav_msgs and tf2_msgs.
#ifndef GSLAM_DATASETS_ROS_SRC_MESSAGES_MESSAGES_H
#define GSLAM_DATASETS_ROS_SRC_MESSAGES_MESSAGES_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "../bytes/byte_reader.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// std_msgs/Header, with nanoseconds in one number.
struct Header {
  std::int64_t stamp = 0;
  std::string frame_id;
};
template <class Wire>
void describe(Wire& wire, Header& header) {
  std::uint32_t seconds = 0, nanoseconds = 0;
  if (Wire::is_ros1) {
    std::uint32_t sequence = 0;
    wire(sequence, seconds, nanoseconds);
    header.stamp = std::int64_t(seconds) * 1000000000 + nanoseconds;
  } else {
    std::int32_t signed_seconds = 0;
    wire(signed_seconds, nanoseconds);
    header.stamp = std::int64_t(signed_seconds) * 1000000000 + nanoseconds;
  }
  wire(header.frame_id);
}

using Triple = std::array<double, 3>;     // x y z
using Quadruple = std::array<double, 4>;  // x y z w

struct Pose {
  Triple position{};
  Quadruple orientation{};
};
template <class Wire>
void describe(Wire& wire, Pose& pose) {
  wire(pose.position, pose.orientation);
}

struct PoseStamped {
  Header header;
  Pose pose;
};
template <class Wire>
void describe(Wire& wire, PoseStamped& message) {
  wire(message.header, message.pose);
}

struct PoseWithCovarianceStamped {
  Header header;
  Pose pose;
  std::array<double, 36> covariance{};
};
template <class Wire>
void describe(Wire& wire, PoseWithCovarianceStamped& message) {
  wire(message.header, message.pose, message.covariance);
}

struct PointStamped {
  Header header;
  Triple point{};
};
template <class Wire>
void describe(Wire& wire, PointStamped& message) {
  wire(message.header, message.point);
}

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Pose transform;
};
template <class Wire>
void describe(Wire& wire, TransformStamped& message) {
  wire(message.header, message.child_frame_id, message.transform);
}

struct TfMessage {
  std::vector<TransformStamped> transforms;
};
template <class Wire>
void describe(Wire& wire, TfMessage& message) {
  wire(message.transforms);
}

struct Odometry {
  Header header;
  std::string child_frame_id;
  Pose pose;
  std::array<double, 36> covariance{};  // the twist behind it is not read
};
template <class Wire>
void describe(Wire& wire, Odometry& message) {
  wire(message.header, message.child_frame_id, message.pose, message.covariance);
}

struct ImuMessage {
  Header header;
  Quadruple orientation{};
  std::array<double, 9> orientation_covariance{};
  Triple angular_velocity{};
  std::array<double, 9> angular_velocity_covariance{};
  Triple linear_acceleration{};
  std::array<double, 9> linear_acceleration_covariance{};
};
template <class Wire>
void describe(Wire& wire, ImuMessage& message) {
  wire(message.header, message.orientation, message.orientation_covariance,
       message.angular_velocity, message.angular_velocity_covariance, message.linear_acceleration,
       message.linear_acceleration_covariance);
}

struct NavSatFix {
  Header header;
  std::int8_t status = 0;
  std::uint16_t service = 0;
  double latitude = 0, longitude = 0, altitude = 0;  // degrees, metres
  std::array<double, 9> covariance{};
  std::uint8_t covariance_type = 0;
};
template <class Wire>
void describe(Wire& wire, NavSatFix& message) {
  wire(message.header, message.status, message.service, message.latitude, message.longitude,
       message.altitude, message.covariance, message.covariance_type);
}

struct CameraInfo {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  std::uint32_t roi_x = 0, roi_y = 0, roi_height = 0, roi_width = 0;
  std::uint8_t do_rectify = 0;
};
template <class Wire>
void describe(Wire& wire, CameraInfo& message) {
  wire(message.header, message.height, message.width, message.distortion_model, message.d,
       message.k, message.r, message.p, message.binning_x, message.binning_y, message.roi_x,
       message.roi_y, message.roi_height, message.roi_width, message.do_rectify);
}

struct ImageMessage {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;
  Bytes data;  // views the message
};
template <class Wire>
void describe(Wire& wire, ImageMessage& message) {
  wire(message.header, message.height, message.width, message.encoding, message.is_bigendian,
       message.step, message.data);
}

struct CompressedImageMessage {
  Header header;
  std::string format;
  Bytes data;  // views the message
};
template <class Wire>
void describe(Wire& wire, CompressedImageMessage& message) {
  wire(message.header, message.format, message.data);
}

/// "sensor_msgs/Imu" of what ROS 2 calls "sensor_msgs/msg/Imu".
std::string plainType(const std::string& type);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MESSAGES_MESSAGES_H
