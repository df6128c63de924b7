#ifndef GSLAM_OPTIMIZER_FILES_G2O_H
#define GSLAM_OPTIMIZER_FILES_G2O_H

#include <gslam/optimizer/files/any_pose_graph.h>

#include <string>

/// @file
/// Pose graphs in the text format of g2o (Kuemmerle et al., ICRA 2011).
///
/// | line | what follows |
/// | --- | --- |
/// | VERTEX_SE2 | id x y angle |
/// | EDGE_SE2 | ids, x y angle, and the upper triangle of the information, row by row |
/// | VERTEX_SE3:QUAT | id x y z qx qy qz qw |
/// | EDGE_SE3:QUAT | ids, x y z qx qy qz qw, upper triangle |
/// | VERTEX_SIM3:QUAT | id x y z qx qy qz qw scale |
/// | EDGE_SIM3:QUAT | ids, x y z qx qy qz qw scale, upper triangle |
/// | FIX | ids of vertices that stay |
/// | # | a comment |
///
/// An edge from a to b has the pose of b in a. In space g2o's information is of (translation,
/// vector part of the quaternion), half a rotation vector: what is read is divided by 4 in the
/// block of the rotation and by 2 beside it, what is written is multiplied, both without rounding.
/// g2o has no text format for SIM3 with quaternions: the lines above are those that SLAM systems
/// write, poses are bodies in the world, and the information is of (translation, vector part of the
/// quaternion, log of the scale) in the same way.

namespace gslam {
inline namespace v1 {

/// Reads a file.
/// @param path  of the file
/// @return the graph, of the kind that the file has
/// @throws FileError when it cannot be read, ParseError as parseG2o()
GSLAM_OPTIMIZER_EXPORT AnyPoseGraph readG2o(const std::string& path);

/// Reads text. Vertices keep their order. Where there is no vertex at all, poses come from
/// initializePoses(), in the order of their ids.
/// @param text  all of the file
/// @param name  what stands for it in errors
/// @return the graph, of the kind that the text has
/// @throws ParseError when a line is none of the above, vertices are of different kinds, an id is
///   there twice or not at all, a number is missing, too much or not finite, a quaternion is far
///   from length 1, or an information is not positive semi-definite, naming line and column
GSLAM_OPTIMIZER_EXPORT AnyPoseGraph parseG2o(const std::string& text, const std::string& name);

/// Writes a file, in one step. Numbers read back to the same bits, but angles in the plane, which
/// may differ in the last one. Which edges are robust is not written.
/// @param graph  of any kind, without priors
/// @param path   of the file
/// @throws ArgumentError for priors and sizes that differ, FileError when it cannot be written
GSLAM_OPTIMIZER_EXPORT void writeG2o(const AnyPoseGraph& graph, const std::string& path);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_FILES_G2O_H
