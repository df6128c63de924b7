#include "visual_slam.h"

#include <gslam/base/log.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "features/view_maker.h"
#include "options.h"
#include "pipeline.h"
#include "scene/frame_log.h"
#include "tracking/feature_picture.h"

namespace visual {
namespace {

using gslam::TrackedPose;
using gslam::TrackingState;

class VisualSlam : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    const Options options = readOptions(setup.parameters);
    maker_ = makeViewMaker(setup.sensors, options);
    pipeline_ = options.threaded ? makeThreadedPipeline(options, maker_->eye())
                                 : makeSequentialPipeline(options, maker_->eye());
    rig_ = setup.sensors;
    pose_ = setup.messenger.advertise<TrackedPose>("pose");
    map_ = setup.messenger.advertise<gslam::Map>("map");
    image_ = setup.messenger.advertise<gslam::CameraImage>("image");
  }

  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    std::string problem;
    std::shared_ptr<const View> view = maker_->make(*frame, problem);
    if (view == nullptr) {
      GSLAM_LOG(warning) << "frame " << frame->id << ": " << problem;
      view = emptyView(*frame);
    }
    const Tracked tracked = pipeline_->step(view);
    if (pipeline_->hasRestarted()) log_.loseAll();
    log_.add(*view, tracked);
    if (tracked.state != before_) {
      GSLAM_LOG(info) << "frame " << frame->id << ": " << trackingStateName(tracked.state)
                      << (tracked.reason.empty() ? "" : ", ") << tracked.reason;
      before_ = tracked.state;
    }
    pose_.publish({frame->id, frame->stamp, tracked.T_world_body, tracked.state});
    if (image_.subscriberCount() > 0) {
      image_.publish(drawFeatures(*frame, *view, maker_->eye(), tracked));
    }
    if (tracked.is_keyframe_due && map_.subscriberCount() > 0) map_.publish(map());
  }

  std::shared_ptr<const gslam::Map> map() override {
    gslam::Map map = pipeline_->scene()->map;
    map.setRig(rig_);
    return std::make_shared<const gslam::Map>(std::move(map));
  }

  // The poses of all frames as the last state of the map has them.
  void finish() override {
    pipeline_->finish();
    for (const TrackedPose& pose : log_.poses(*pipeline_->scene())) pose_.publish(pose);
    if (map_.subscriberCount() > 0) map_.publish(map());
  }

 private:
  // What is seen in a frame whose images cannot be used.
  static std::shared_ptr<const View> emptyView(const gslam::Frame& frame) {
    const auto view = std::make_shared<View>();
    view->frame = frame.id;
    view->stamp = frame.stamp;
    view->content = std::make_shared<const gslam::KeyframeContent>();
    return view;
  }

  std::unique_ptr<ViewMaker> maker_;
  std::unique_ptr<Pipeline> pipeline_;
  FrameLog log_;
  gslam::SensorRig rig_;
  TrackingState before_ = TrackingState::starting;
  gslam::Publisher<TrackedPose> pose_;
  gslam::Publisher<gslam::Map> map_;
  gslam::Publisher<gslam::CameraImage> image_;
};

}  // namespace

gslam::SlamFactory visualFactory() {
  gslam::SlamFactory factory;
  factory.name = "visual";
  factory.description = "Features, keyframes, loops: for a camera, a stereo pair or RGB-D";
  factory.parameters = defaultParameters();
  factory.help = parameterHelp();
  factory.needs.cameras = 1;
  factory.make = [] { return std::unique_ptr<gslam::Slam>(new VisualSlam); };
  return factory;
}

}  // namespace visual
