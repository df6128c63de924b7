#include "scenes.h"

#include <gslam/geometry/random.h>
#include <gslam/optimizer/files.h>

#include <cstdlib>
#include <map>
#include <random>
#include <utility>
#include <variant>

namespace {

// Of the file of this name; empty: there is none.
std::string dataPath(const std::string& name) {
  const char* const folder = std::getenv("GSLAM_TEST_DATA");
  return folder == nullptr ? "" : std::string(folder) + "/" + name;
}

BundleArrays readRealBundle() {
  const std::string path = dataPath("bundle_adjustment/problem-49-7776-pre.txt");
  BundleArrays arrays;
  if (path.empty()) return arrays;
  gslam::Bundle bundle = gslam::readBal(path);
  arrays.T_world_body = std::move(bundle.T_world_body);
  arrays.points = std::move(bundle.points);
  arrays.cameras = std::move(bundle.cameras);
  arrays.camera_freedom = std::move(bundle.camera_freedom);
  arrays.observation_pose = std::move(bundle.observation_pose);
  arrays.observation_point = std::move(bundle.observation_point);
  arrays.observation_camera = std::move(bundle.observation_camera);
  arrays.pixels = std::move(bundle.pixels);
  return arrays;
}

}  // namespace

const BundleArrays& realBundle() {
  static const BundleArrays arrays = readRealBundle();
  return arrays;
}

bool hasFreeLenses(const BundleArrays& arrays) {
  return !arrays.camera_freedom.empty() && arrays.cameras.size() == arrays.T_world_body.size();
}

Lens lensOf(const gslam::Camera& camera) {
  const std::vector<double> all = camera.parameters();
  Lens lens;
  lens.numbers = {all[0], all.size() > 4 ? all[4] : 0, all.size() > 5 ? all[5] : 0};
  lens.centre = {all[2], all[3]};
  return lens;
}

void setView(BundleArrays& arrays, std::size_t pose, const gslam::SE3d& T_camera_world,
             const std::array<double, 3>& lens) {
  arrays.T_world_body[pose] = T_camera_world.inverse();
  if (!hasFreeLenses(arrays)) return;
  gslam::Camera& camera = arrays.cameras[pose];
  std::vector<double> all = camera.parameters();
  all[0] = all[1] = lens[0];
  all[4] = lens[1];
  all[5] = lens[2];
  camera = gslam::Camera::fromParameters(camera.modelName(), camera.width(), camera.height(), all);
}

PoseScene poseScene(std::size_t points) {
  std::mt19937 generator(11);
  const auto off = [&](double reach) { return gslam::randomUniform(generator, -reach, reach); };
  PoseScene scene;
  scene.cameras = {gslam::Camera::fromParameters("pinhole", 640, 480, {500, 500, 319.5, 239.5})};
  scene.truth = gslam::SE3d(gslam::SO3d::exp({0.1, 0.2, 0}), {1, 2, 3});
  scene.start = scene.truth * gslam::SE3d::exp({0.05, -0.05, 0.05, 0.01, 0.01, -0.02});
  while (scene.points.size() < points) {
    const gslam::Vec3d seen = {off(2), off(2), 6 + off(2)};
    gslam::Vec2d pixel;
    if (!scene.cameras[0].project(seen, pixel)) continue;
    scene.points.push_back(scene.truth * seen);
    scene.pixels.push_back(pixel + gslam::Vec2d{off(0.8), off(0.8)});
  }
  return scene;
}

const gslam::PoseGraph<gslam::SE3d>& realGraph(const std::string& name) {
  static std::map<std::string, gslam::PoseGraph<gslam::SE3d>> graphs;
  const auto found = graphs.find(name);
  if (found != graphs.end()) return found->second;
  gslam::PoseGraph<gslam::SE3d>& graph = graphs[name];
  const std::string path = dataPath("pose_graphs/" + name + ".g2o");
  if (path.empty()) return graph;
  graph = std::get<gslam::PoseGraph<gslam::SE3d>>(gslam::readG2o(path));
  graph.pose_fixed.assign(graph.T_world_body.size(), 0);
  graph.pose_fixed[0] = 1;
  initializePoses(graph.problem());
  return graph;
}
