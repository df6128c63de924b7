#ifndef GSLAM_OPTIMIZER_SRC_FILES_COLMAP_CAMERAS_H
#define GSLAM_OPTIMIZER_SRC_FILES_COLMAP_CAMERAS_H

#include <gslam/optimizer/bundle_problem.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// COLMAP's camera models as those of geometry.

namespace gslam {
inline namespace v1 {
namespace detail {

struct ColmapModel {
  const char* name;        // of COLMAP
  const char* ours;        // of geometry::Camera
  std::size_t our_count;   // parameters of ours
  std::size_t parameters;  // of COLMAP's: focal lengths, cx, cy, and then the first of ours
  bool has_one_focal;
};

// Those that are supported; of each of ours, those with the fewest parameters first.
const std::vector<ColmapModel>& colmapModels();
// Null where there is none of this name.
const ColmapModel* colmapModelNamed(std::string_view name);
// "SIMPLE_PINHOLE, PINHOLE, ..."
std::string colmapModelNames();

// @throws ArgumentError when a value or size cannot be
Camera cameraOfColmap(const ColmapModel& model, int width, int height,
                      const std::vector<double>& values);
CameraFreedom freedomOfColmap(const ColmapModel& model);

struct ColmapCamera {
  const char* model;
  std::vector<double> values;
};
// @throws ArgumentError when COLMAP has no such model
ColmapCamera colmapCameraOf(const Camera& camera, const CameraFreedom& freedom, std::size_t index);

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FILES_COLMAP_CAMERAS_H
