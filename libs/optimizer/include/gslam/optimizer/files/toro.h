#ifndef GSLAM_OPTIMIZER_FILES_TORO_H
#define GSLAM_OPTIMIZER_FILES_TORO_H

#include <gslam/optimizer/files/any_pose_graph.h>

#include <string>

/// @file
/// Pose graphs in the text format of TORO, often named .graph (Grisetti et al., "A tree
/// parameterization for efficiently computing maximum likelihood maps using gradient descent", RSS
/// 2007).
///
/// | line | what follows |
/// | --- | --- |
/// | VERTEX2, VERTEX | id x y angle |
/// | EDGE2, EDGE, ODOMETRY, EDGE_ODOMETRY | ids, x y angle, information xx xy yy aa xa ya |
/// | VERTEX3 | id x y z roll pitch yaw |
/// | EDGE3 | ids, x y z roll pitch yaw, upper triangle of the information, row by row |
/// | # | a comment |
///
/// An edge from a to b has the pose of b in a; a rotation is Rz(yaw) Ry(pitch) Rx(roll). The
/// information is taken as that of the tangent, which it is for small errors.

namespace gslam {
inline namespace v1 {

/// Reads a file.
/// @param path  of the file
/// @return the graph, in the plane or in space
/// @throws FileError when it cannot be read, ParseError as parseToro()
GSLAM_OPTIMIZER_EXPORT AnyPoseGraph readToro(const std::string& path);

/// Reads text. Where there is no vertex at all, poses come from initializePoses(), in the order of
/// their ids.
/// @param text  all of the file
/// @param name  what stands for it in errors
/// @return the graph, in the plane or in space
/// @throws ParseError as parseG2o()
GSLAM_OPTIMIZER_EXPORT AnyPoseGraph parseToro(const std::string& text, const std::string& name);

/// Writes a file, in one step. Angles may differ in the last bits when they are read back. Which
/// poses are fixed and which edges are robust is not written.
/// @param graph  in the plane or in space, without priors
/// @param path   of the file
/// @throws ArgumentError for SIM3, priors and sizes that differ, FileError when it cannot be
/// written
GSLAM_OPTIMIZER_EXPORT void writeToro(const AnyPoseGraph& graph, const std::string& path);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_FILES_TORO_H
