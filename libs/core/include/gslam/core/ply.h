#ifndef GSLAM_CORE_PLY_H
#define GSLAM_CORE_PLY_H

#include <gslam/base/detail/new_file.h>
#include <gslam/base/span.h>
#include <gslam/core/detail/binary_file.h>
#include <gslam/core/detail/ply_reader.h>
#include <gslam/core/detail/ply_writer.h>
#include <gslam/core/map.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Maps for programs that show or edit clouds of points: PLY, the format of the Stanford Graphics
/// Lab (G. Turk, "The PLY polygon file format", 1994).

namespace gslam {
inline namespace v1 {

/// What goes into a PLY file.
struct PlyOptions {
  bool is_binary = true;      ///< little-endian; otherwise text
  bool has_keyframes = true;  ///< an element "keyframe": time in seconds, x y z qx qy qz qw of the
                              ///< body
  double frustum_depth = 0;   ///< above 0: a pyramid of that height for each camera of each
                              ///< keyframe, of vertices behind the points, whose property
                              ///< "frustum" is 1, and of elements "edge"
};

/// Writes the points of a map, in the order of their ids, into a file, in one step. Positions are
/// double; normals and colours are written where any point has one: 0 0 0 and white stand for those
/// that are not known.
/// @throws FileError when it cannot be written
inline void savePly(const std::string& path, const Map& map,
                    const PlyOptions& options = PlyOptions()) {
  detail::NewFile file(path);
  detail::PlyWriter<detail::NewFile>(map, options.is_binary, options.has_keyframes,
                                     options.frustum_depth, file)
      .write();
  file.commit();
}

/// The vertices of a PLY file, as text or in either order of bytes: positions, and where there are
/// any, normals and colours (of floats 0 to 1, of 16 bits without sign 0 to 65535, otherwise 0 to
/// 255). All else in it is skipped, also the vertices of pyramids that savePly() added.
/// @param bytes   all of the file
/// @param source  what stands for the file's name in errors
/// @throws ParseError when it breaks the rules of the format, ends too early or has no vertices
inline std::vector<MapPoint> parsePly(Span<const std::uint8_t> bytes, const std::string& source) {
  return detail::PlyReader(bytes, source).points();
}

/// parsePly() of a file.
/// @throws FileError when it cannot be read, ParseError as parsePly()
inline std::vector<MapPoint> loadPly(const std::string& path) {
  detail::ByteSource source(path);
  return parsePly(detail::readAll(source), path);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_PLY_H
