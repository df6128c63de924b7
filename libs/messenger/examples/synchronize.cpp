// An image with the IMU sample that is nearest in time.
#include <gslam/messenger.h>

#include <cstdint>
#include <iostream>

struct Image {
  std::int64_t stamp;  // nanoseconds
};
struct Imu {
  std::int64_t stamp;
};

int main() {
  const gslam::Messenger messenger;
  const gslam::Synchronizer<Image, Imu> pairs(
      messenger, {"/camera", "/imu"}, gslam::approximateTime(), 100,
      [](const Image& image, const Imu& imu) {
        std::cout << "image at " << image.stamp << ", IMU at " << imu.stamp << " ns\n";
      });

  const gslam::Publisher<Image> camera = messenger.advertise<Image>("/camera");
  const gslam::Publisher<Imu> imu = messenger.advertise<Imu>("/imu");
  const std::int64_t millisecond = 1000000;
  for (std::int64_t t = 0; t <= 100; ++t) {
    if (t % 33 == 0) camera.publish(Image{t * millisecond});
    if (t % 5 == 0) imu.publish(Imu{t * millisecond});
  }
  std::cout << pairs.dropped(1) << " IMU samples dropped\n";
}
