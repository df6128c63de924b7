#ifndef GSLAM_DATASETS_ROS_RECORDING_H
#define GSLAM_DATASETS_ROS_RECORDING_H

#include <gslam/core/trajectory.h>
#include <gslam/datasets_ros/export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// @file
/// Messages that ROS recorded: `.bag` of ROS 1, `.db3` and `.mcap` of ROS 2.

namespace gslam {
inline namespace v1 {

/// A topic of a recording.
struct RecordedTopic {
  std::string name;              ///< such as "/imu/data"
  std::string type;              ///< as it stands there: "sensor_msgs/Imu", "sensor_msgs/msg/Imu"
  std::string encoding;          ///< of messages: "ros1", "cdr", or another word of MCAP
  std::size_t count = 0;         ///< messages
  std::int64_t first_stamp = 0;  ///< nanoseconds, when the first message was received
  std::int64_t last_stamp = 0;   ///< nanoseconds, when the last message was received
};

/// Where a message is. Cheap: a recording of hours has some ten million bytes of them.
struct MessageRef {
  std::int64_t stamp = 0;    ///< nanoseconds, when it was received
  std::uint32_t topic = 0;   ///< place in Recording::topics()
  std::uint32_t file = 0;    ///< of those the recording has
  std::uint64_t block = 0;   ///< meant for the reader of the file
  std::uint64_t offset = 0;  ///< meant for the reader of the file
};

/// A recording that is open: what topics it has, where the messages are, and their bytes.
///
/// The messages are not loaded: there is an index of them, and the few blocks that were unpacked
/// last. Files are read, never written. Threads may share one.
class GSLAM_DATASETS_ROS_EXPORT Recording {
 public:
  /// Opens `.bag` (ROS 1; uncompressed, bz2, lz4), `.mcap` (uncompressed, lz4, zstd), `.db3` (ROS
  /// 2, sqlite), or a folder of these with `metadata.yaml`. A file that was not closed is looked
  /// through from its beginning, and what is whole in it is there.
  /// @throws FileError that names the file, and for damaged ones the byte
  static std::shared_ptr<const Recording> open(const std::string& path);
  virtual ~Recording();

  /// The path as it was given to open().
  virtual const std::string& path() const noexcept = 0;
  /// All topics, also those without a message, in the order of the recording.
  virtual const std::vector<RecordedTopic>& topics() const noexcept = 0;
  /// Place of a topic in topics(). @throws Error that lists all topics where there is none
  virtual std::size_t topic(const std::string& name) const = 0;
  /// What is wrong with the recording, a sentence for each.
  virtual const std::vector<std::string>& remarks() const noexcept = 0;

  /// The messages of some topics in the order they were received.
  /// @param topics  places in topics()
  virtual std::vector<MessageRef> messages(const std::vector<std::size_t>& topics) const = 0;
  /// All messages in the order they were received.
  virtual std::vector<MessageRef> messages() const = 0;

  /// The bytes of a message, as its topic's encoding has them.
  /// @throws FileError when they cannot be read, or are damaged
  virtual std::vector<std::uint8_t> read(const MessageRef& message) const = 0;
  /// The first bytes of a message, at least `size` of them unless it has fewer. Reads less of the
  /// file where it can, and then does not notice damage.
  virtual std::vector<std::uint8_t> readHead(const MessageRef& message, std::size_t size) const = 0;

 protected:
  Recording() = default;
};

/// Whether a path looks like a recording: its ending is .bag, .db3 or .mcap, or it is a folder with
/// such files of ROS 2. Reads at most metadata.yaml.
GSLAM_DATASETS_ROS_EXPORT bool isRecording(const std::string& path);

/// The poses of a topic.
///
/// The types are PoseStamped, PoseWithCovarianceStamped, TransformStamped, PointStamped (the
/// rotation is then the identity) of geometry_msgs, nav_msgs/Odometry, and tf2_msgs/TFMessage or
/// tf/tfMessage. Of transforms, one pair of frames is taken, which `topic` names as
/// "/tf:map.base_link" (`T_map_base_link`); it may be left out where there is only one.
///
/// Stamps are those of the messages, or where these are 0, when they were received.
/// @param recording  of any kind
/// @param topic      its name
/// @param remarks    unless null, gets a sentence for all that was skipped or assumed: poses that
///   are not finite, stamps that were there before
/// @throws Error when there is no such topic, it has no poses, or a message of it is damaged
GSLAM_DATASETS_ROS_EXPORT Trajectory readTrajectory(const Recording& recording,
                                                    const std::string& topic,
                                                    std::vector<std::string>* remarks = nullptr);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_RECORDING_H
