#include "replay.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "fault.h"
#include "known_cost.h"
#include "late_answers.h"
#include "options.h"
#include "poses.h"

namespace replay {
namespace {

using gslam::SE3d;
using gslam::TrackedPose;
using gslam::TrackingState;

constexpr std::uint64_t kFirstStray = std::uint64_t(1) << 40;

class Replay : public gslam::Slam {
 public:
  Replay() { failInConstructor(); }

  void configure(const gslam::SlamSetup& setup) override {
    late_.reset();
    map_ = gslam::Map();
    smooth_.clear();
    fed_ = tracked_ = 0;
    options_ = readOptions(setup.parameters);
    failIfAsked(options_.fault, FaultOptions::Call::configure);
    poses_.emplace(options_.poses);
    cost_.emplace(options_.cost);
    map_.setRig(setup.sensors);
    pose_topic_ = setup.messenger.advertise<TrackedPose>("pose");
    map_topic_ = setup.messenger.advertise<gslam::Map>("map");
    if (options_.latency.count() > 0) late_.emplace(pose_topic_, options_.latency);
  }

  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    failIfAsked(options_.fault, FaultOptions::Call::feed, frame->id);
    cost_->spend();
    if (options_.delay.count() > 0) std::this_thread::sleep_for(options_.delay);
    answer(*frame);
    ++fed_;
  }

  std::shared_ptr<const gslam::Map> map() override {
    return options_.keyframe_every == 0 ? nullptr : std::make_shared<gslam::Map>(map_);
  }

  void finish() override {
    failIfAsked(options_.fault, FaultOptions::Call::finish);
    if (late_) late_->wait();
    for (const TrackedPose& pose : smooth_) pose_topic_.publish(pose);
  }

 private:
  void answer(const gslam::Frame& frame) {
    if (fed_ == 0) first_stamp_ = frame.stamp;
    Answer answer = options_.losses.answerTo(frame.id, frame.stamp - first_stamp_);
    if (!answer.is_given) return;
    if (fed_ < options_.start_after) answer.state = TrackingState::starting;
    TrackedPose pose{frame.id, frame.stamp, SE3d(), answer.state};
    SE3d smooth;
    if (gslam::hasPose(answer.state) && !poses_->smooth(frame, smooth)) {
      pose.state = TrackingState::lost;  // the file says nothing of this time
    }
    if (gslam::hasPose(pose.state)) {
      pose.T_world_body = smooth;
      keep(pose);
      pose.T_world_body = poses_->withNoise(smooth, frame.id);
    }
    if (!answer.is_finite) {
      pose.T_world_body = SE3d(gslam::SO3d(), gslam::Vec3d{{std::nan(""), 0, 0}});
    }
    pose.stamp += options_.stamp_error;
    publish(pose);
    // A little later than the frame, so that they would count as poses between two of them.
    for (std::uint64_t i = 1; i <= options_.strays; ++i) {
      pose.frame = kFirstStray + i;
      pose.stamp += 1000000;
      publish(pose);
    }
  }

  void publish(const TrackedPose& pose) { late_ ? late_->add(pose) : pose_topic_.publish(pose); }

  // What a system knows better later: poses without noise, and keyframes of these.
  void keep(const TrackedPose& smooth) {
    if (options_.is_corrected) smooth_.push_back(smooth);
    if (options_.keyframe_every == 0 || tracked_++ % options_.keyframe_every != 0) return;
    const gslam::Keyframe keyframe{smooth.frame, smooth.stamp, smooth.T_world_body, nullptr};
    const gslam::KeyframeId id = map_.add(keyframe);
    gslam::MapPoint point;  // a metre ahead
    point.position = smooth.T_world_body * gslam::Vec3d{{1, 0, 0}};
    map_.add(point);
    if (std::uint32_t(id) > 0) connect(gslam::KeyframeId(std::uint32_t(id) - 1), id);
    map_topic_.publish(std::make_shared<const gslam::Map>(map_));
  }

  void connect(gslam::KeyframeId from, gslam::KeyframeId to) {
    gslam::PoseEdge edge;
    edge.from = from;
    edge.to = to;
    edge.T_from_to = map_.at(from).T_world_body.inverse() * map_.at(to).T_world_body;
    map_.add(edge);
  }

  Options options_;
  std::optional<Poses> poses_;
  std::optional<KnownCost> cost_;
  gslam::Publisher<TrackedPose> pose_topic_;
  gslam::Publisher<gslam::Map> map_topic_;
  gslam::Map map_;
  std::vector<TrackedPose> smooth_;
  std::uint64_t fed_ = 0;
  std::uint64_t tracked_ = 0;
  std::int64_t first_stamp_ = 0;
  std::optional<LateAnswers> late_;  // last: its thread ends before the rest goes
};

}  // namespace

gslam::SlamFactory replayFactory() {
  gslam::SlamFactory factory;
  factory.name = "replay";
  factory.description = "Answers with the poses of a file, with known errors, cost and faults";
  factory.parameters = defaultParameters();
  factory.help = parameterHelp();
  factory.needs.cameras = 0;
  factory.make = [] { return std::unique_ptr<gslam::Slam>(new Replay); };
  return factory;
}

}  // namespace replay
