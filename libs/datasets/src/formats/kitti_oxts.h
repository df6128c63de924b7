// The OXTS unit of KITTI raw: an inertial unit fused with satellite positions.
#ifndef GSLAM_DATASETS_SRC_FORMATS_KITTI_OXTS_H
#define GSLAM_DATASETS_SRC_FORMATS_KITTI_OXTS_H

#include <gslam/core/detail/field_reader.h>
#include <gslam/core/sensor.h>
#include <gslam/core/trajectory.h>

#include <cstdint>
#include <string>
#include <vector>

#include "../reading/file_tree.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// Lines such as `2011-09-26 13:02:25.951199337`.
/// @return nanoseconds since 1970, as if they were UTC, exact
/// @throws ParseError
std::vector<std::int64_t> readDateTimes(const FileTree& tree, const std::string& file);

/// A file of oxts/data.
struct OxtsSample {
  ImuSample imu;
  GnssSample gnss;
  SO3d rotation;  ///< takes body (x forward, y left, z up) to east, north, up
};
/// @throws FileError, ParseError
OxtsSample readOxts(const FileTree& tree, const std::string& file, std::int64_t stamp);

/// Poses of the unit: x east, y north, z up, from where it was first. Samples have different
/// stamps.
Trajectory oxtsTrajectory(const std::vector<OxtsSample>& samples);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_KITTI_OXTS_H
