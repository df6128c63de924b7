#include <gslam/svar/config.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  gslam::Config config("player [options] DIR", "Plays a sequence to a SLAM system.");
  config.arg<double>("fps", 30, "frames a second").range(1, 120).shortName("f");
  config.arg<bool>("realtime", false, "pace frames by their stamps");
  config.arg<std::string>("camera.model", "pinhole", "how points are projected")
      .choices({"pinhole", "fisheye"})
      .group("Camera");
  try {
    const gslam::CommandLine line = config.parse(argc, argv);
    if (!line.answer.empty()) return std::fputs(line.answer.c_str(), stdout) < 0;

    const auto& fps = config.bind<double>("fps");  // follows the value; as cheap as an atomic
    std::printf("%g frames a second, said by %s\n", fps.get(), config.origin("fps").c_str());
    config.set("fps", 15);  // from any thread
    std::printf("%g frames a second\n", fps.get());
    config.set("fps", 500);
  } catch (const gslam::Error& error) {
    std::printf("%s\n", error.what());  // fps: expected 1 to 120, found int 500
  }
}
