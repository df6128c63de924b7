#include <gslam/svar.h>

#include <cstdio>
#include <string>

int main() {
  using gslam::Svar;
  Svar config = Svar::object({{"fps", 30}, {"camera", Svar::object({{"fx", 535.4}})}});
  config.set("tracker.features", 1000);  // makes the object "tracker"

  const double fx = config.get<double>("camera.fx");
  const int levels = config.get<int>("tracker.levels", 8);  // not there: the default
  std::printf("fx %.1f, %d levels\n", fx, levels);

  for (const Svar::Member& member : config.members()) {
    std::printf("%s: %s\n", member.first.c_str(), member.second.typeName());
  }
  try {
    config.get<int>("camera.fx");
  } catch (const gslam::SvarError& error) {
    std::printf("%s\n", error.what());  // camera.fx: expected int32, found double 535.4
  }
}
