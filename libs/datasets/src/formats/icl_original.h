// ICL-NUIM as POV-Ray wrote it.
#ifndef GSLAM_DATASETS_SRC_FORMATS_ICL_ORIGINAL_H
#define GSLAM_DATASETS_SRC_FORMATS_ICL_ORIGINAL_H

#include <gslam/core/image.h>
#include <gslam/geometry/se3.h>

#include <cstdint>
#include <string>

#include "../reading/file_tree.h"
#include "../reading/sequence.h"

namespace gslam {
inline namespace v1 {
namespace reading {

constexpr std::int64_t kIclRate = 30;  ///< frames a second, of both forms

/// A camera as a .txt file of POV-Ray's has it.
struct PovCamera {
  SE3d T_world_camera;  ///< right-handed: y points down in both
  double fx_by_width = 0;
  double fy_by_height = 0;
};

/// @param unit  metres that 1 stands for
/// @throws FileError, ParseError
PovCamera readPovCamera(const FileTree& tree, const std::string& file, double unit);

/// Depth along the optical axis, f32 in metres, of a file with the distance of each pixel along its
/// ray; 0 where nothing was hit.
/// @param camera  pinhole, of the size of the depth image
/// @throws FileError, ParseError
Image readRayDistances(const FileTree& tree, const std::string& file, const Camera& camera,
                       double unit);

/// Sets up frames and images of such a folder.
/// @param unit  metres that 1 stands for; 0: the usual ones
void openIclOriginal(Sequence& sequence, const std::shared_ptr<const FileTree>& tree,
                     const std::string& folder, bool wants_depth, double unit);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_ICL_ORIGINAL_H
