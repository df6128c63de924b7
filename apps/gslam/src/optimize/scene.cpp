#include "scene.h"

#include <gslam/base/detail/new_file.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace app {
namespace {

using gslam::Bundle;
using gslam::PoseGraph;
using gslam::SE2d;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::Vec3d;
using gslam::Vec3f;

Vec3f positionOf(const SE2d& pose) {
  return {static_cast<float>(pose.translation()[0]), static_cast<float>(pose.translation()[1]), 0};
}
template <class Pose>
Vec3f positionOf(const Pose& pose) {
  const Vec3d t = pose.translation();
  return t.cast<float>();
}

// Calls a function with the graph in its own type.
template <class Function>
void withGraph(const Problem& problem, const Function& function) {
  std::visit(function, std::get<1>(problem));
}

std::vector<std::uint8_t> posesThatSee(const Bundle& bundle) {
  std::vector<std::uint8_t> sees(bundle.T_world_body.size(), 0);
  for (const std::uint32_t pose : bundle.observation_pose) sees[pose] = 1;
  return sees;
}

SE3d cameraPose(const Bundle& bundle, std::size_t pose) {
  return bundle.T_body_camera.empty() ? bundle.T_world_body[pose]
                                      : bundle.T_world_body[pose] * bundle.T_body_camera[0];
}

void addPyramid(const SE3d& T_world_camera, double size, Scene& scene) {
  const double x = 0.7 * size, y = 0.5 * size;
  const Vec3d corners[] = {{-x, -y, size}, {x, -y, size}, {x, y, size}, {-x, y, size}};
  const Vec3f tip = positionOf(T_world_camera);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3f here = (T_world_camera * corners[i]).cast<float>();
    const Vec3f next = (T_world_camera * corners[(i + 1) % 4]).cast<float>();
    scene.lines.push_back({tip, here});
    scene.lines.push_back({here, next});
    scene.kinds.insert(scene.kinds.end(), 2, SceneLine::Camera);
  }
}

void addBundle(const Bundle& bundle, double camera_size, Scene& scene) {
  for (std::size_t i = 0; i < bundle.points.size(); ++i) {
    scene.points.push_back(bundle.points[i].cast<float>());
    std::array<std::uint8_t, 3> color = {200, 200, 200};
    for (std::size_t k = 0; k < 3 && !bundle.colors.empty(); ++k) {
      const float value = std::min(1.f, std::max(0.f, bundle.colors[i][k]));
      color[k] = static_cast<std::uint8_t>(std::lround(255 * value));
    }
    scene.colors.push_back(color);
  }
  const std::vector<std::uint8_t> sees = posesThatSee(bundle);
  for (std::size_t i = 0; i < sees.size(); ++i) {
    if (sees[i] != 0) addPyramid(cameraPose(bundle, i), camera_size, scene);
  }
}

template <class Group>
void addGraph(const PoseGraph<Group>& graph, Scene& scene) {
  for (const Group& pose : graph.T_world_body) {
    scene.points.push_back(positionOf(pose));
    scene.colors.push_back({230, 230, 230});
  }
  for (std::size_t i = 0; i < graph.from.size(); ++i) {
    const std::uint32_t from = graph.from[i], to = graph.to[i];
    scene.lines.push_back({scene.points[from], scene.points[to]});
    const bool follows = from + 1 == to || to + 1 == from;
    scene.kinds.push_back(follows ? SceneLine::Odometry : SceneLine::Loop);
  }
}

std::vector<Vec3f> positionsOf(const Problem& problem) {
  std::vector<Vec3f> positions;
  if (std::holds_alternative<Bundle>(problem)) {
    const Bundle& bundle = std::get<Bundle>(problem);
    const std::vector<std::uint8_t> sees = posesThatSee(bundle);
    for (const Vec3d& point : bundle.points) positions.push_back(point.cast<float>());
    for (std::size_t i = 0; i < sees.size(); ++i) {
      if (sees[i] != 0) positions.push_back(positionOf(bundle.T_world_body[i]));
    }
  } else {
    withGraph(problem, [&](const auto& graph) {
      for (const auto& pose : graph.T_world_body) positions.push_back(positionOf(pose));
    });
  }
  const auto isBad = [](const Vec3f& p) { return !std::isfinite(p.norm()); };
  positions.erase(std::remove_if(positions.begin(), positions.end(), isBad), positions.end());
  return positions;
}

// The value that a part of all is below.
float quantile(std::vector<float> values, double part) {
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

// Bundles are looked at by their first camera; planes from above; graphs in space aslant.
gslam::Mat3f directionOf(const Problem& problem) {
  if (std::holds_alternative<Bundle>(problem)) {
    const Bundle& bundle = std::get<Bundle>(problem);
    if (bundle.T_world_body.empty()) return gslam::Mat3f::identity();
    return cameraPose(bundle, 0).inverse().rotation().cast<float>().matrix();
  }
  const bool is_plane = std::get<1>(problem).index() == 0;
  const double tilt = is_plane ? 3.14159265358979 : 2.2;  // y of the world goes up
  return gslam::SO3d::exp({tilt, 0, 0}).cast<float>().matrix();
}

// Little-endian numbers, on any machine.
class PlyBytes {
 public:
  void add(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  void add(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) add(static_cast<std::uint8_t>(value >> shift));
  }
  void add(std::uint8_t value) { text_ += static_cast<char>(value); }
  void add(const Vec3f& point, const std::array<std::uint8_t, 3>& color) {
    for (const float value : point.values) add(value);
    for (const std::uint8_t value : color) add(value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

constexpr std::array<std::uint8_t, 3> kLineColors[] = {
    {90, 160, 255}, {120, 200, 120}, {255, 150, 60}};

}  // namespace

SceneView viewOf(const Problem& problem) {
  SceneView view;
  view.R_view_world = directionOf(problem);
  const std::vector<Vec3f> positions = positionsOf(problem);
  if (positions.empty()) return view;
  std::vector<float> values(positions.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::transform(positions.begin(), positions.end(), values.begin(),
                   [axis](const Vec3f& p) { return p[axis]; });
    view.centre[axis] = quantile(values, 0.5);
  }
  std::transform(positions.begin(), positions.end(), values.begin(),
                 [&](const Vec3f& p) { return (p - view.centre).norm(); });
  view.radius = std::max(1e-6f, 1.2f * quantile(values, 0.9));
  return view;
}

Scene sceneOf(const Problem& problem, const SceneView& view) {
  Scene scene;
  if (std::holds_alternative<Bundle>(problem)) {
    addBundle(std::get<Bundle>(problem), 0.03 * static_cast<double>(view.radius), scene);
  } else {
    withGraph(problem, [&](const auto& graph) { addGraph(graph, scene); });
  }
  return scene;
}

Scene thinned(Scene scene, std::size_t most_points) {
  const std::size_t stride = (scene.points.size() + most_points - 1) / most_points;
  if (stride < 2) return scene;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scene.points.size(); i += stride, ++kept) {
    scene.points[kept] = scene.points[i];
    scene.colors[kept] = scene.colors[i];
  }
  scene.points.resize(kept);
  scene.colors.resize(kept);
  return scene;
}

void writeScenePly(const Scene& scene, const std::string& path) {
  PlyBytes bytes;
  for (std::size_t i = 0; i < scene.points.size(); ++i) bytes.add(scene.points[i], scene.colors[i]);
  for (std::size_t i = 0; i < scene.lines.size(); ++i) {
    const auto& color = kLineColors[static_cast<std::size_t>(scene.kinds[i])];
    for (const Vec3f& end : scene.lines[i]) bytes.add(end, color);
  }
  for (std::size_t i = 0; i < scene.lines.size(); ++i) {
    bytes.add(static_cast<std::uint32_t>(scene.points.size() + 2 * i));
    bytes.add(static_cast<std::uint32_t>(scene.points.size() + 2 * i + 1));
  }
  const std::size_t vertices = scene.points.size() + 2 * scene.lines.size();
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar "
      "green\nproperty uchar blue\nelement edge " +
      std::to_string(scene.lines.size()) +
      "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  gslam::detail::writeTextFile(path, header + bytes.text());
}

}  // namespace app
