#include <gslam/messenger.h>

#include <iostream>
#include <memory>

struct Pose {
  double x, y, z;
};

int main() {
  gslam::Messenger messenger;
  const gslam::Subscriber subscriber =
      messenger.subscribe<Pose>("/slam/pose", [](const std::shared_ptr<const Pose>& pose) {
        std::cout << "pose at x = " << pose->x << " m\n";
      });

  const gslam::Publisher<Pose> publisher = messenger.advertise<Pose>("/slam/pose");
  for (int i = 0; i < 3; ++i) publisher.publish(Pose{0.1 * i, 0.0, 0.0});

  try {
    messenger.advertise<int>("/slam/pose");
  } catch (const gslam::TypeMismatch& error) {
    std::cout << "refused: " << error.what() << '\n';
  }
}
