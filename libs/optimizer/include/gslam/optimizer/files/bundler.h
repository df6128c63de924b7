#ifndef GSLAM_OPTIMIZER_FILES_BUNDLER_H
#define GSLAM_OPTIMIZER_FILES_BUNDLER_H

#include <gslam/optimizer/bundle.h>

#include <string>

/// @file
/// Output files of Bundler, version 0.3 (Snavely, Seitz, Szeliski, SIGGRAPH 2006).
///
/// Cameras and pixels are those of gslam/optimizer/files/bal.h, with rotation matrices; points have
/// colours, and lists of where they are seen: camera, number of the feature in its image, x and y.
///
/// Poses and cameras of a Bundle have the indices of the file, which are those of the list of
/// images. A camera with f = 0 was not registered: its pose is the identity, fixed, sees nothing,
/// and has a camera with f = 1.

namespace gslam {
inline namespace v1 {

/// Reads a file.
/// @param path  of the file
/// @return what is in it
/// @throws FileError when it cannot be read, ParseError as parseBundler()
GSLAM_OPTIMIZER_EXPORT Bundle readBundler(const std::string& path);

/// Reads text.
/// @param text  all of the file
/// @param name  what stands for it in errors
/// @return what is in it
/// @throws ParseError when the first line does not say v0.3, a number is missing, too much, not
///   finite or out of its range, a matrix is no rotation, or a camera that was not registered sees
///   something, naming line and column
GSLAM_OPTIMIZER_EXPORT Bundle parseBundler(const std::string& text, const std::string& name);

/// Writes a file, in one step. Fixed poses that see nothing are written as not registered; colours
/// are white and features are numbered by image where there are none. What else is fixed, names and
/// ids are not written.
/// @param bundle  as for writeBal()
/// @param path    of the file
/// @throws ArgumentError that says what the format cannot hold, FileError when it cannot be written
GSLAM_OPTIMIZER_EXPORT void writeBundler(const Bundle& bundle, const std::string& path);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_FILES_BUNDLER_H
