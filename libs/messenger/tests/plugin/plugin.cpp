#include "plugin.h"

#include <memory>

namespace {

struct Hidden {
  int x;
};

gslam::Subscriber subscriber;
std::shared_ptr<const SharedPose> last_pose;

void subscribe(const gslam::Messenger& messenger) {
  subscriber = messenger.subscribe<SharedPose>(
      "pose", [](const std::shared_ptr<const SharedPose>& pose) { last_pose = pose; });
}
void subscribeOnce(const gslam::Messenger& messenger) {
  subscriber =
      messenger.subscribe<SharedPose>("pose", [](const std::shared_ptr<const SharedPose>& pose) {
        last_pose = pose;
        subscriber.unsubscribe();
      });
}
int last() {
  return last_pose != nullptr ? last_pose->x : -1;
}
void end() {
  subscriber.unsubscribe();
}
void publish(const gslam::Messenger& messenger, int x) {
  messenger.advertise<SharedPose>("pose").publish(SharedPose{x});
}
void publishHidden(const gslam::Messenger& messenger) {
  messenger.advertise<Hidden>("hidden").publish(Hidden{1});
}
void publishToDefault(int x) {
  publish(gslam::defaultMessenger(), x);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const Plugin* gslamTestPlugin();

extern "C" const Plugin* gslamTestPlugin() {
  static const Plugin plugin = {
      subscribe,       last, end, publish, publishHidden, subscribeOnce, gslam::setDefaultMessenger,
      publishToDefault};
  return &plugin;
}
