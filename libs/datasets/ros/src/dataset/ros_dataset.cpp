// Recordings of ROS as datasets.
#include <gslam/base/error.h>
#include <gslam/core/associate.h>
#include <gslam/core/parameters.h>
#include <gslam/core/stamp.h>
#include <gslam/datasets_ros/ros_dataset.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <utility>

#include "camera_images.h"
#include "frame_tree.h"
#include "group_images.h"
#include "messages/decode.h"
#include "reading/sequence.h"
#include "samples.h"
#include "topics.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

constexpr double kImuFrameSeconds = 0.1;

struct Options {
  std::int64_t tolerance = 0;
  std::int64_t frame_every = 0;
  bool complete = false;
  bool by_header = true;
};

std::int64_t nanosecondsOf(const Svar& parameters, const char* name) {
  const double seconds = parameters.get<double>(name);
  if (!(seconds >= 0) || seconds > 1e6) {
    throw ArgumentError(name, "is " + std::to_string(seconds) + ", expected 0 to 1000000 s");
  }
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

Options optionsOf(const Svar& parameters) {
  Options options;
  options.tolerance = nanosecondsOf(parameters, "tolerance");
  options.frame_every = nanosecondsOf(parameters, "frame_every");
  options.complete = parameters.get<bool>("complete");
  const std::string stamps = parameters.get<std::string>("stamps");
  options.by_header = stamps == "header";
  if (!options.by_header && stamps != "received") {
    throw ArgumentError("stamps", "is '" + stamps + "', expected header or received");
  }
  return options;
}

// What Sequence::load needs, for as long as there is one.
struct Images {
  std::shared_ptr<const Recording> recording;
  std::vector<CameraImages> cameras;
  std::vector<ImageGroup> frames;

  Image load(std::size_t frame, std::size_t camera) const {
    const std::size_t image = frames[frame].images[camera];
    if (image == kNoImage) return Image();
    return loadImage(*recording, cameras[camera], cameras[camera].images[image].message);
  }
};

std::string nameOfRecording(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  const std::string name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

// Makes a sequence of a recording.
class Builder {
 public:
  Builder(const std::string& path, const Svar& parameters)
      : options_(optionsOf(parameters)),
        recording_(Recording::open(path)),
        topics_(chooseTopics(*recording_, parameters)),
        images_(std::make_shared<Images>()) {
    for (const std::string& remark : recording_->remarks()) remarks().say(remark);
    fixed_.addTopics(*recording_, topics_.transforms, remarks());
  }

  reading::Sequence run() {
    sequence_.info.name = nameOfRecording(recording_->path());
    sequence_.info.format = "ros";
    sequence_.info.clock = options_.by_header ? "ROS time of the message headers"
                                              : "ROS time when messages were received";
    readCameras();
    readSensors();
    readPoseTopics();
    chooseBody();
    placeSensors();
    if (topics_.cameras.empty()) {
      makeEmptyFrames();
    } else {
      makeFrames();
    }
    addTruth();
    addPriors();
    sayUnused();
    const std::shared_ptr<const Images> images = images_;
    sequence_.load = [images](std::size_t frame, std::size_t camera) {
      return images->load(frame, camera);
    };
    return std::move(sequence_);
  }

 private:
  reading::Remarks& remarks() noexcept { return sequence_.remarks; }
  const std::string& nameOf(std::size_t topic) const { return recording_->topics()[topic].name; }

  // --- what was recorded -------------------------------------------------------------------------

  void readCameras() {
    images_->recording = recording_;
    std::vector<CameraTopic> taken;
    std::exception_ptr first;
    for (const CameraTopic& topic : topics_.cameras) {
      try {
        images_->cameras.push_back(readCamera(*recording_, topic, options_.by_header, remarks()));
        taken.push_back(topic);
      } catch (const Error& error) {
        if (topics_.are_cameras_named) throw;
        if (!first) first = std::current_exception();
        remarks().say("camera '" + topic.name + "' was left out: " + error.what());
      }
    }
    if (taken.empty() && first) std::rethrow_exception(first);
    topics_.cameras = std::move(taken);
  }

  void readSensors() {
    if (topics_.imu != kNoTopic) {
      imu_ = readImu(*recording_, topics_.imu, options_.by_header, remarks());
      sequence_.imu = imu_.samples;
      sequence_.info.sensors.has_imu = !imu_.samples.empty();
    }
    if (topics_.gnss != kNoTopic) {
      gnss_ = readGnss(*recording_, topics_.gnss, options_.by_header, remarks());
      sequence_.gnss = gnss_.samples;
      sequence_.info.sensors.has_gnss = !gnss_.samples.empty();
    }
  }

  void readPoseTopics() {
    const bool by_header = options_.by_header;
    if (topics_.has_truth) truth_ = readPoses(*recording_, topics_.truth, remarks(), by_header);
    if (topics_.has_odometry) {
      odometry_ = readPoses(*recording_, topics_.odometry, remarks(), by_header);
    }
    if (!topics_.has_truth) remarks().say("there is no ground truth");
  }

  // --- the body ----------------------------------------------------------------------------------

  void chooseBody() {
    std::string what;
    if (topics_.imu != kNoTopic) {
      body_ = imu_.frame_id;
      what = "the inertial unit of " + nameOf(topics_.imu);
    } else if (!images_->cameras.empty()) {
      body_ = images_->cameras[0].frame_id;
      const bool is_beside = isBesideFrame(0);
      what = (is_beside ? "the frame of camera '" : "camera '") + images_->cameras[0].sensor.name +
             "'";
    } else if (topics_.has_odometry || topics_.has_truth) {
      body_ = topics_.has_odometry ? odometry_.child : truth_.child;
      what = "what " + nameOf(topics_.has_odometry ? topics_.odometry.topic : topics_.truth.topic) +
             " has the poses of";
    }
    if (!what.empty() && !body_.empty()) what += " (frame '" + body_ + "')";
    sequence_.info.body = what;
  }

  // T_body_frame, or the identity, which is said.
  SE3d placeOf(const std::string& frame, const std::string& what) {
    SE3d pose;
    if (frame == body_ && !frame.empty()) return pose;
    if (!frame.empty() && !body_.empty() && fixed_.find(body_, frame, pose)) return pose;
    remarks().say("where " + what +
                  " is on the body is not known: no static transform leads from '" + body_ +
                  "' to '" + frame + "', the identity was taken");
    return SE3d();
  }

  // Whether a rectified camera is not in its frame, but beside it: of a stereo pair the messages of
  // both name the frame of the left one, and the fourth column of P says where the right one is
  // (sensor_msgs/CameraInfo.msg).
  bool isBesideFrame(std::size_t place) const {
    const CameraImages& camera = images_->cameras[place];
    if (camera.offset == Vec3d{0, 0, 0}) return false;
    for (std::size_t i = 0; i < images_->cameras.size(); ++i) {
      const CameraImages& other = images_->cameras[i];
      if (i != place && other.frame_id == camera.frame_id) return true;
    }
    return false;
  }

  void placeBesideFrame(std::size_t place) {
    CameraImages& camera = images_->cameras[place];
    if (camera.offset == Vec3d{0, 0, 0}) return;
    if (isBesideFrame(place)) {
      SE3d& pose = camera.sensor.T_body_camera;
      pose = pose * SE3d(SO3d(), camera.offset);
      return;
    }
    remarks().say("the fourth column of P of camera '" + camera.sensor.name +
                  "' was not applied: no other camera is in its frame '" + camera.frame_id + "'");
  }

  void placeSensors() {
    SensorRig& rig = sequence_.info.sensors;
    for (std::size_t i = 0; i < images_->cameras.size(); ++i) {
      CameraImages& camera = images_->cameras[i];
      const bool is_body = topics_.imu == kNoTopic && i == 0;
      if (!is_body) {
        camera.sensor.T_body_camera =
            placeOf(camera.frame_id, "camera '" + camera.sensor.name + "'");
      }
      placeBesideFrame(i);
      rig.cameras.push_back(camera.sensor);
    }
    if (rig.has_gnss) rig.gnss_antenna = placeOf(gnss_.frame_id, "the antenna").translation();
  }

  // Poses of a frame as those of the body.
  SE3d bodyInPoses(const PoseList& list, const std::string& what) {
    SE3d T_child_body;
    if (list.child.empty()) {
      remarks().say("of which frame " + what + " has the poses is not said: the body was taken");
      return T_child_body;
    }
    return placeOf(list.child, "what " + what + " has the poses of").inverse();
  }

  void addTruth() {
    if (!topics_.has_truth) return;
    const SE3d T_child_body = bodyInPoses(truth_, nameOf(topics_.truth.topic));
    std::vector<StampedPose> poses;
    for (const RecordedPose& one : truth_.poses) {
      poses.push_back({one.stamp, one.pose * T_child_body});
    }
    sequence_.info.ground_truth = Trajectory(std::move(poses));
  }

  // --- frames ------------------------------------------------------------------------------------

  void makeFrames() {
    std::vector<std::vector<std::int64_t>> stamps;
    for (const CameraImages& camera : images_->cameras) {
      stamps.emplace_back();
      for (const StampedImage& image : camera.images) stamps.back().push_back(image.stamp);
      if (images_->cameras.size() > 1) checkDense(stamps.back(), camera.topic.images);
    }
    std::vector<ImageGroup> all = groupImages(stamps, options_.tolerance);
    std::size_t incomplete = 0;
    for (ImageGroup& group : all) {
      if (!isComplete(group)) ++incomplete;
      if (options_.complete && !isComplete(group)) continue;
      sequence_.stamps.push_back(group.stamp);
      images_->frames.push_back(std::move(group));
    }
    if (incomplete == 0) return;
    remarks().say(std::to_string(incomplete) + " of " + std::to_string(all.size()) +
                  " frames lack an image of a camera" +
                  (options_.complete ? ": they were skipped" : ""));
    if (!sequence_.stamps.empty()) return;
    throw FileError(recording_->path(),
                    "no frame has an image of each camera within the tolerance; "
                    "a larger `tolerance`, or fewer `images`, may help");
  }

  void checkDense(const std::vector<std::int64_t>& stamps, std::size_t topic) const {
    if (!isDense(stamps, options_.tolerance)) return;
    throw FileError(recording_->path(),
                    "topic " + nameOf(topic) +
                        " has more than 1000 messages within the `tolerance` of "
                        "one, which is " +
                        secondsText(options_.tolerance) + " s: a smaller one is needed");
  }

  // Stamps of frames where there are no images.
  void makeEmptyFrames() {
    std::vector<std::int64_t> stamps;
    std::string of;
    std::int64_t least = options_.frame_every;
    const auto take = [&](const auto& list, std::size_t topic) {
      if (!stamps.empty()) return;
      for (const auto& one : list) stamps.push_back(one.stamp);
      if (!stamps.empty()) of = nameOf(topic);
    };
    if (topics_.has_odometry) take(odometry_.poses, topics_.odometry.topic);
    if (topics_.has_truth) take(truth_.poses, topics_.truth.topic);
    if (topics_.gnss != kNoTopic) take(gnss_.samples, topics_.gnss);
    if (stamps.empty() && least == 0) least = std::llround(kImuFrameSeconds * 1e9);
    if (topics_.imu != kNoTopic) take(imu_.samples, topics_.imu);
    if (stamps.empty()) failEmpty();
    for (const std::int64_t stamp : stamps) {
      const bool is_first = sequence_.stamps.empty();
      if (!is_first && stamp <= sequence_.stamps.back()) continue;
      // They may be further apart than an int64 holds.
      const auto before = is_first ? stamp : sequence_.stamps.back();
      const std::uint64_t later = std::uint64_t(stamp) - std::uint64_t(before);
      if (!is_first && later < std::uint64_t(least)) continue;
      sequence_.stamps.push_back(stamp);
    }
    remarks().say("there are no images: frames are at the stamps of " + of);
  }

  [[noreturn]] void failEmpty() const {
    std::string names;
    for (const RecordedTopic& topic : recording_->topics()) {
      names += (names.empty() ? "" : ", ") + topic.name + " (" + topic.type + ", " +
               std::to_string(topic.count) + ")";
    }
    throw FileError(recording_->path(),
                    "has no images, poses, satellite positions or inertial samples that can be "
                    "read; its topics are: " +
                        (names.empty() ? "none" : names));
  }

  void addPriors() {
    if (!topics_.has_odometry) return;
    const SE3d T_child_body = bodyInPoses(odometry_, nameOf(topics_.odometry.topic));
    const PoseWithCovariance<SE3d> to_body(T_child_body);
    std::vector<std::int64_t> stamps;
    for (const RecordedPose& one : odometry_.poses) stamps.push_back(one.stamp);
    checkDense(stamps, topics_.odometry.topic);
    sequence_.priors.resize(sequence_.stamps.size());
    for (const StampPair& pair : associate(sequence_.stamps, stamps, options_.tolerance)) {
      const RecordedPose& one = odometry_.poses[pair.b];
      const PoseWithCovariance<SE3d> pose =
          one.has_covariance ? one.uncertain : PoseWithCovariance<SE3d>(one.pose);
      sequence_.priors[pair.a].is_known = true;
      sequence_.priors[pair.a].pose = pose * to_body;
    }
  }

  void sayUnused() {
    constexpr std::size_t kMost = 50;
    std::size_t count = 0;
    for (std::size_t i = 0; i < recording_->topics().size(); ++i) {
      if (isUsed(topics_, i) || ++count > kMost) continue;
      const RecordedTopic& topic = recording_->topics()[i];
      remarks().say("topic " + topic.name + " of type " + topic.type + " was not read (" +
                    std::to_string(topic.count) + " messages)");
    }
    if (count <= kMost) return;
    remarks().say(std::to_string(count - kMost) + " more topics were not read");
  }

  Options options_;
  std::shared_ptr<const Recording> recording_;
  ChosenTopics topics_;
  std::shared_ptr<Images> images_;
  FrameTree fixed_;
  ImuList imu_;
  GnssList gnss_;
  PoseList truth_, odometry_;
  std::string body_;  // its frame
  reading::Sequence sequence_;
};

Svar parametersOfRos() {
  Svar parameters = reading::commonParameters();
  for (const char* name : {"images", "camera_info", "imu", "gnss", "ground_truth", "odometry"}) {
    parameters.set(name, Svar());
  }
  parameters.set("tolerance", 0.01);
  parameters.set("complete", false);
  parameters.set("frame_every", 0.0);
  parameters.set("stamps", "header");
  return parameters;
}

}  // namespace
}  // namespace ros

DatasetFactory rosFactory() {
  DatasetFactory factory;
  factory.name = "ros";
  factory.description = "Recordings of ROS 1 (.bag) and ROS 2 (.db3, .mcap, folders of them)";
  factory.parameters = ros::parametersOfRos();
  factory.recognizes = isRecording;
  factory.open = [](const std::string& path, const Svar& given) {
    const Svar parameters = completeParameters(ros::parametersOfRos(), given);
    return reading::deliver(ros::Builder(path, parameters).run(), reading::prefetchOf(parameters));
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
