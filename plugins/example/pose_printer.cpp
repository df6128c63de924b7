#include "pose_printer.h"

#include <condition_variable>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>

namespace example {
namespace {

class PosePrinter : public gslam::Application {
 public:
  int run(const gslam::ApplicationSetup& setup) override {
    const auto every = setup.parameters.get<std::uint64_t>("every");
    if (every == 0) throw gslam::ArgumentError("every", "is 0, expected 1 frame or more");
    const gslam::Subscriber poses =
        setup.messenger.subscribeAny("/*/pose", [every](const gslam::AnyMessage& message) {
          if (!message.is<gslam::TrackedPose>()) return;
          const auto pose = message.as<gslam::TrackedPose>();
          if (pose->frame % every != 0) return;
          std::cout << message.topic() << ' ' << pose->frame << ' ' << pose->T_world_body << '\n';
        });
    std::unique_lock<std::mutex> lock(mutex_);
    stopped_.wait(lock, [this] { return is_stopped_; });
    return 0;
  }

  void stop() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_stopped_ = true;
    stopped_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool is_stopped_ = false;
};

}  // namespace

gslam::ApplicationFactory posePrinterFactory() {
  gslam::ApplicationFactory factory;
  factory.name = "pose_printer";
  factory.description = "Prints the poses of all SLAM systems";
  factory.parameters = gslam::Svar::object({{"every", 20}});
  factory.help = gslam::Svar::object({{"every", "one of so many poses is printed"}});
  factory.make = [] { return std::unique_ptr<gslam::Application>(new PosePrinter); };
  return factory;
}

}  // namespace example
