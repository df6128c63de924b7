#include <gslam/svar.h>

#include <cstdio>
#include <thread>

int main() {
  gslam::SharedSvar config(gslam::Svar::object({{"fps", 30}, {"camera", gslam::Svar::object()}}));
  const auto& fps = config.bind<double>("fps");
  const gslam::Watch watch = config.watch("camera", [](const gslam::Svar& camera) {
    std::printf("camera is now %s\n", gslam::printJson(camera).c_str());
  });
  std::thread other([&] {
    config.set("camera.fx", 535.4);
    config.set("fps", 25);
  });
  other.join();
  std::printf("%g frames a second\n", fps.get());
  try {
    config.set("fps", "fast");
  } catch (const gslam::SvarError& error) {
    std::printf("%s\n", error.what());  // fps: expected double, found string "fast"
  }
}
