#include <gslam/svar_formats.h>

#include <cstdio>

int main() {
  const gslam::Svar camera = gslam::parseYaml(R"(
model: pinhole
k: [535.4, 539.2, 320.1, 247.6]
size: {width: 640, height: 480}
)",
                                              "camera.yaml");
  std::printf("fx %.1f\n", camera.get<double>("k.0"));
  std::printf("%s\n", gslam::printXml(camera).c_str());
  try {
    gslam::parseYaml("fps: 30\nfps: 20\n", "twice.yaml");
  } catch (const gslam::ParseError& error) {
    std::printf("%s\n", error.what());
  }
}
