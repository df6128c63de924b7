// A SLAM system in thirty lines, a dataset in memory, and a run of one on the other.
#include <gslam/core.h>

#include <iostream>
#include <memory>
#include <utility>
#include <vector>

// Believes that the body moves one metre forward from frame to frame.
class Optimist : public gslam::Slam {
 public:
  void configure(const gslam::SlamSetup& setup) override {
    step_ = setup.parameters.get<double>("step");
    pose_ = setup.messenger.advertise<gslam::TrackedPose>("pose");
  }

  void feed(const std::shared_ptr<const gslam::Frame>& frame) override {
    const gslam::SE3d T_world_body(gslam::SO3d(), {{step_ * double(frame->id), 0, 0}});
    pose_.publish({frame->id, frame->stamp, T_world_body, gslam::TrackingState::guessed});
  }

  std::shared_ptr<const gslam::Map> map() override { return nullptr; }
  void finish() override {}

 private:
  double step_ = 0;
  gslam::Publisher<gslam::TrackedPose> pose_;
};

int main() {
  std::vector<std::shared_ptr<const gslam::Frame>> frames;
  for (int i = 0; i < 5; ++i) {
    const auto frame = std::make_shared<gslam::Frame>();
    frame->id = std::uint64_t(i);
    frame->stamp = i * 50000000;  // nanoseconds
    frame->images.emplace_back();
    frame->images[0].image = gslam::Image(64, 48, gslam::PixelType::u8);
    frames.push_back(frame);
  }
  gslam::MemoryDataset dataset(gslam::DatasetInfo(), std::move(frames));

  const gslam::Messenger messenger;
  const gslam::Subscriber viewer =
      messenger.subscribe<gslam::TrackedPose>("/optimist/pose", [](const gslam::TrackedPose& pose) {
        std::cout << "frame " << pose.frame << " at " << pose.T_world_body << '\n';
      });

  Optimist slam;
  gslam::Player player(dataset, messenger);
  gslam::RunSetup setup;
  setup.name = "optimist";
  setup.parameters = gslam::Svar::object({{"step", 1.0}});
  const gslam::RunResult result = gslam::runSlam(slam, player, dataset, setup, messenger);
  std::cout << result.trajectory.size() << " poses, " << result.trajectory.length() << " m\n";
}
