#include <gslam/svar.h>

#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

struct Camera {
  double fx = 500;
  std::string model = "pinhole";
};

namespace gslam {
template <>
struct SvarTraits<Camera> : SvarFields<Camera> {
  template <class Visit>
  static void fields(Visit& visit) {
    visit("fx", &Camera::fx);
    visit("model", &Camera::model);
  }
};
}  // namespace gslam

int main() {
  using gslam::Svar;
  Svar value;
  value.set("k", std::vector<double>{535.4, 539.2, 320.1, 247.6});
  value.set("left", Camera());
  value.set("left.fx", 517);
  const std::vector<double> k = value.get<std::vector<double>>("k");
  const Camera camera = value.get<Camera>("left");
  std::printf("%zu numbers, fx %g, %s\n", k.size(), camera.fx, camera.model.c_str());

  value.set("scale", Svar::function([](double x, int times) { return x * times; }));
  value.set("shared", std::make_shared<std::map<int, int>>());  // any object, by pointer
  std::printf("%s = %g\n", value["scale"].signature().c_str(), value["scale"](1.5, 2).as<double>());
  try {
    value.set("left.fz", 1);
    value.get<Camera>("left");
  } catch (const gslam::SvarError& error) {
    std::printf("%s\n", error.what());  // left.fz: is no field of Camera, which has fx, model
  }
}
