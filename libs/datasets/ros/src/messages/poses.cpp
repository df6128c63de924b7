#include "poses.h"

#include <gslam/base/error.h>
#include <gslam/core/stamp.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "decode.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

enum class PoseType { pose, with_covariance, transform, point, odometry, transforms, none };

PoseType poseTypeOf(const std::string& plain) {
  if (plain == "geometry_msgs/PoseStamped") return PoseType::pose;
  if (plain == "geometry_msgs/PoseWithCovarianceStamped") return PoseType::with_covariance;
  if (plain == "geometry_msgs/TransformStamped") return PoseType::transform;
  if (plain == "geometry_msgs/PointStamped") return PoseType::point;
  if (plain == "nav_msgs/Odometry") return PoseType::odometry;
  if (plain == "tf2_msgs/TFMessage" || plain == "tf/tfMessage") return PoseType::transforms;
  return PoseType::none;
}

PoseType poseTypeOf(const Recording& recording, std::size_t topic) {
  return poseTypeOf(plainType(recording.topics()[topic].type));
}

using FramePair = std::pair<std::string, std::string>;

std::string textOf(const FramePair& pair) {
  return pair.first + "." + pair.second;
}

std::set<FramePair> framePairs(const Recording& recording, std::size_t topic) {
  std::set<FramePair> pairs;
  for (const MessageRef& ref : recording.messages({topic})) {
    for (const TransformStamped& one : readMessage<TfMessage>(recording, ref).transforms) {
      pairs.emplace(one.header.frame_id, one.child_frame_id);
    }
  }
  return pairs;
}

FramePair choosePair(const Recording& recording, std::size_t topic, const std::string& wanted) {
  const std::set<FramePair> pairs = framePairs(recording, topic);
  const std::string name = recording.topics()[topic].name;
  std::string names;
  for (const FramePair& pair : pairs) {
    if (wanted == textOf(pair)) return pair;
    names += (names.empty() ? "" : ", ") + name + ":" + textOf(pair);
  }
  if (wanted.empty() && pairs.size() == 1) return *pairs.begin();
  const std::string found = "; there are: " + (names.empty() ? "none" : names);
  if (wanted.empty()) {
    throw FileError(recording.path(), "topic '" + name +
                                          "' has transforms between several frames, expected a "
                                          "pair of them behind its name" +
                                          found);
  }
  throw FileError(recording.path(),
                  "topic '" + name + "' has no transform '" + wanted + "'" + found);
}

bool isFinite(const Pose& pose) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(pose.position.begin(), pose.position.end(), finite) &&
         std::all_of(pose.orientation.begin(), pose.orientation.end(), finite);
}

double normOf(const Quadruple& q) {
  return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

SE3d toSe3(const Pose& pose) {
  const Quadruple& q = pose.orientation;
  return SE3d(SO3d::fromQuaternion(q[0], q[1], q[2], q[3]),
              {pose.position[0], pose.position[1], pose.position[2]});
}

// Collects the poses of a topic, and says what it does not take.
class Collector {
 public:
  Collector(const Recording& recording, const PoseTopic& topic, reading::Remarks& remarks,
            bool by_header)
      : recording_(recording),
        topic_(topic),
        name_(recording.topics()[topic.topic].name),
        remarks_(remarks),
        by_header_(by_header) {}

  PoseList run() {
    const PoseType type = poseTypeOf(recording_, topic_.topic);
    for (const MessageRef& ref : recording_.messages({topic_.topic})) take(type, ref);
    removeTwins();
    return std::move(list_);
  }

 private:
  void take(PoseType type, const MessageRef& ref) {
    if (type == PoseType::pose) {
      const auto message = readMessage<PoseStamped>(recording_, ref);
      add(message.header, "", message.pose, ref);
    } else if (type == PoseType::with_covariance) {
      const auto message = readMessage<PoseWithCovarianceStamped>(recording_, ref);
      add(message.header, "", message.pose, ref, &message.covariance);
    } else if (type == PoseType::odometry) {
      const auto message = readMessage<Odometry>(recording_, ref);
      add(message.header, message.child_frame_id, message.pose, ref, &message.covariance);
    } else if (type == PoseType::transform) {
      const auto message = readMessage<TransformStamped>(recording_, ref);
      add(message.header, message.child_frame_id, message.transform, ref);
    } else if (type == PoseType::point) {
      takePoint(ref);
    } else {
      takeTransforms(ref);
    }
  }

  void takePoint(const MessageRef& ref) {
    remarks_.say("topic " + name_ + " has positions alone: rotations were set to the identity");
    const auto message = readMessage<PointStamped>(recording_, ref);
    Pose pose;
    pose.position = message.point;
    pose.orientation = {0, 0, 0, 1};
    add(message.header, "", pose, ref);
  }

  void takeTransforms(const MessageRef& ref) {
    for (const TransformStamped& one : readMessage<TfMessage>(recording_, ref).transforms) {
      if (one.header.frame_id != topic_.parent || one.child_frame_id != topic_.child) continue;
      add(one.header, one.child_frame_id, one.transform, ref);
    }
  }

  void add(const Header& header, const std::string& child, const Pose& pose, const MessageRef& ref,
           const std::array<double, 36>* covariance = nullptr) {
    RecordedPose added;
    added.stamp = by_header_ && header.stamp != 0 ? header.stamp : ref.stamp;
    if (by_header_ && header.stamp == 0) {
      remarks_.say("messages of " + name_ + " have no stamp: when they were received was taken");
    }
    if (!isFinite(pose) || !(normOf(pose.orientation) > 1e-6)) {
      remarks_.skip("poses of " + name_ + " that are not finite, or have no rotation,",
                    "at " + secondsText(added.stamp) + " s");
      return;
    }
    if (std::fabs(normOf(pose.orientation) - 1) > 1e-3) {
      remarks_.say("some quaternions of " + name_ + " are not of length 1: they were normalised");
    }
    if (list_.poses.empty()) {
      list_.parent = header.frame_id;
      list_.child = child;
    }
    added.pose = toSe3(pose);
    if (covariance != nullptr) addCovariance(*covariance, added);
    list_.poses.push_back(added);
  }

  // Many drivers leave it zero, or fill in what is no covariance.
  void addCovariance(const std::array<double, 36>& values, RecordedPose& added) {
    if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0; })) return;
    Mat<double, 6, 6> covariance;
    std::copy(values.begin(), values.end(), covariance.data());
    try {
      added.uncertain = PoseWithCovariance<SE3d>::fromCovarianceInWorldAxes(added.pose, covariance);
      added.has_covariance = true;
    } catch (const ArgumentError& error) {
      remarks_.skip("covariances of " + name_ + " that are none",
                    "at " + secondsText(added.stamp) + " s: " + error.what());
    }
  }

  void removeTwins() {
    std::vector<RecordedPose>& poses = list_.poses;
    const auto earlier = [](const RecordedPose& a, const RecordedPose& b) {
      return a.stamp < b.stamp;
    };
    if (!std::is_sorted(poses.begin(), poses.end(), earlier)) {
      remarks_.say("poses of " + name_ + " are out of order: they were sorted by their stamps");
      std::stable_sort(poses.begin(), poses.end(), earlier);
    }
    const auto end =
        std::unique(poses.begin(), poses.end(), [&](const RecordedPose& a, const RecordedPose& b) {
          if (a.stamp != b.stamp) return false;
          remarks_.skip("poses of " + name_ + " with the stamp of another",
                        "at " + secondsText(b.stamp) + " s");
          return true;
        });
    poses.erase(end, poses.end());
  }

  const Recording& recording_;
  const PoseTopic& topic_;
  std::string name_;
  reading::Remarks& remarks_;
  bool by_header_;
  PoseList list_;
};

}  // namespace

bool isPoseType(const std::string& plain_type) {
  return poseTypeOf(plain_type) != PoseType::none;
}

PoseTopic findPoseTopic(const Recording& recording, const std::string& name) {
  const std::size_t colon = name.find(':');
  PoseTopic result;
  result.topic = recording.topic(name.substr(0, colon));
  const RecordedTopic& topic = recording.topics()[result.topic];
  const PoseType type = poseTypeOf(recording, result.topic);
  if (type == PoseType::none) {
    throw FileError(recording.path(),
                    "topic '" + topic.name + "' is of type " + topic.type +
                        ", which has no poses, expected PoseStamped, PoseWithCovarianceStamped, "
                        "TransformStamped, PointStamped, Odometry or TFMessage");
  }
  if (type == PoseType::transforms) {
    const std::string wanted = colon == std::string::npos ? "" : name.substr(colon + 1);
    std::tie(result.parent, result.child) = choosePair(recording, result.topic, wanted);
  } else if (colon != std::string::npos) {
    throw FileError(recording.path(), "topic '" + topic.name + "' is of type " + topic.type +
                                          ", which has one pair of frames: take '" +
                                          name.substr(colon) + "' from its name");
  }
  return result;
}

PoseList readPoses(const Recording& recording, const PoseTopic& topic, reading::Remarks& remarks,
                   bool by_header) {
  return Collector(recording, topic, remarks, by_header).run();
}

Trajectory trajectoryOf(const PoseList& list) {
  std::vector<StampedPose> poses;
  poses.reserve(list.poses.size());
  for (const RecordedPose& one : list.poses) poses.push_back({one.stamp, one.pose});
  return Trajectory(std::move(poses));
}

}  // namespace ros

Trajectory readTrajectory(const Recording& recording, const std::string& topic,
                          std::vector<std::string>* remarks) {
  reading::Remarks said;
  const ros::PoseTopic found = ros::findPoseTopic(recording, topic);
  Trajectory trajectory = ros::trajectoryOf(ros::readPoses(recording, found, said));
  if (remarks != nullptr) {
    const std::vector<std::string> sentences = said.sentences();
    remarks->insert(remarks->end(), sentences.begin(), sentences.end());
  }
  return trajectory;
}

}  // namespace v1
}  // namespace gslam
