#include <gslam/evaluation.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

// Stands for a SLAM system: it thinks for a while, and keeps a little of each frame.
class Thinker : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    pose_ = setup.messenger.advertise<gslam::TrackedPose>("pose");
  }
  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    kept_.push_back(std::make_unique<double>(1e-9 * double(frame->stamp)));
    pose_.publish({frame->id, frame->stamp, gslam::SE3d(), gslam::TrackingState::tracking});
  }
  std::shared_ptr<const gslam::Map> map() override { return nullptr; }
  void finish() override {}

 private:
  gslam::Publisher<gslam::TrackedPose> pose_;
  std::vector<std::unique_ptr<double>> kept_;
};

int main() {
  const auto tree = std::make_shared<gslam::ProcessTree>();  // this process and its children
  gslam::MeasuredSlam slam(std::make_shared<Thinker>(), {tree});
  slam.configure({});
  const gslam::AllocationCounts before = gslam::allocationCountsOf(tree->root());
  gslam::ResourceMonitor monitor(tree);
  for (std::uint64_t id = 0; id < 50; ++id) {
    const auto frame = std::make_shared<gslam::Frame>();
    frame->id = id;
    frame->stamp = std::int64_t(id) * 33000000;
    slam.feed(frame);
  }
  slam.finish();
  gslam::CostSource source;
  source.frames = slam.frames();
  source.resources = monitor.stop();
  source.allocations = gslam::allocatedBetween(before, gslam::allocationCountsOf(tree->root()));
  const gslam::Cost cost = gslam::costOf(source);
  std::printf("%s", gslam::costText(cost).c_str());
  return cost.results == 50 && cost.frame_ms.min >= 3 ? 0 : 1;
}
