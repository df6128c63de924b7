// What is to be seen of a bundle or pose graph: points and lines.
#ifndef GSLAM_APPS_OPTIMIZE_SCENE_H
#define GSLAM_APPS_OPTIMIZE_SCENE_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "problem_file.h"

namespace app {

/// What a line is of.
enum class SceneLine : std::uint8_t {
  Camera,    ///< an edge of a camera's pyramid
  Odometry,  ///< an edge between poses that follow each other
  Loop       ///< another edge
};

/// Points and lines in space.
struct Scene {
  std::vector<gslam::Vec3f> points;
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< of points
  std::vector<std::array<gslam::Vec3f, 2>> lines;
  std::vector<SceneLine> kinds;  ///< of lines
};

/// Where to look from, so that most is seen, not the farthest of bad points.
struct SceneView {
  gslam::Vec3f centre{};
  float radius = 1;                                      ///< around the centre
  gslam::Mat3f R_view_world = gslam::Mat3f::identity();  ///< view: x right, y down, z away
};

/// A view of a problem as it is now.
SceneView viewOf(const Problem& problem);
/// The scene of a problem as it is now.
/// @param view  that says how large cameras are
Scene sceneOf(const Problem& problem, const SceneView& view);

/// The scene with no more points than these, thinned out evenly.
Scene thinned(Scene scene, std::size_t most_points);

/// Writes a PLY file: vertices, those of lines last, and edges; with colours.
/// @throws FileError when it cannot be written
void writeScenePly(const Scene& scene, const std::string& path);

}  // namespace app

#endif  // GSLAM_APPS_OPTIMIZE_SCENE_H
