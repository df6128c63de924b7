// A program that is its own isolation worker.
//
//   worker PLUGIN          feeds a frame to an isolated SLAM system; 0 when its pose came back
//   worker PLUGIN hang     prints the number of the child process and hangs in feed()
#include <gslam/core/isolation_worker.h>

#include <chrono>
#include <exception>
#include <iostream>
#include <memory>
#include <string>

namespace {

int run(const std::string& plugin, bool is_to_hang) {
  gslam::IsolationOptions options;
  options.slam = plugin + ":toy";
  options.feed_limit = std::chrono::milliseconds(is_to_hang ? 0 : 20000);
  gslam::IsolatedSlam slam(options);
  gslam::SlamSetup setup;
  setup.parameters =
      gslam::Svar::object({{"where", "feed"}, {"at", 1}, {"how", is_to_hang ? "hang" : ""}});
  std::size_t poses = 0;
  const gslam::Subscriber subscriber = setup.messenger.subscribe<gslam::TrackedPose>(
      "pose", [&](const gslam::TrackedPose&) { ++poses; });
  slam.configure(setup);
  std::cout << slam.processNumber() << std::endl;
  const std::shared_ptr<gslam::Frame> frame = std::make_shared<gslam::Frame>();
  frame->id = 1;
  slam.feed(frame);
  slam.finish();
  return poses == 1 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (gslam::isIsolationWorker(argc, argv)) return gslam::runIsolationWorker(argc, argv);
  try {
    return argc < 2 ? 2 : run(argv[1], argc > 2);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
