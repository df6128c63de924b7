#ifndef GSLAM_OPTIMIZER_FILES_BAL_H
#define GSLAM_OPTIMIZER_FILES_BAL_H

#include <gslam/optimizer/bundle.h>

#include <string>

/// @file
/// Text files of "Bundle adjustment in the large" (Agarwal et al., ECCV 2010).
///
/// The file has: numbers of cameras, points and observations; for each observation camera, point, x
/// and y; for each camera a rotation vector, a translation, f, k1 and k2; for each point x, y and
/// z. Its cameras look along -z with y up: P = R X + t, p = -P / P.z, and the pixel is
/// f (1 + k1 |p|^2 + k2 |p|^4) p, from the middle of the image.
///
/// In a Bundle each pose has a camera of its own, of the same index: radtan with 4 coefficients, fx
/// = fy, cx = cy = p1 = p2 = 0; fx, k1 and k2 are free and fy follows. Poses are turned to look
/// along +z with y down, and the y of pixels has the other sign. How large images are the file does
/// not say: they are 1 x 1.

namespace gslam {
inline namespace v1 {

/// Reads a file.
/// @param path  of the file, not compressed
/// @return what is in it
/// @throws FileError when it cannot be read, ParseError as parseBal()
GSLAM_OPTIMIZER_EXPORT Bundle readBal(const std::string& path);

/// Reads text.
/// @param text  all of the file
/// @param name  what stands for it in errors
/// @return what is in it
/// @throws ParseError when a number is missing, too much, not finite or out of its range, naming
///   line and column
GSLAM_OPTIMIZER_EXPORT Bundle parseBal(const std::string& text, const std::string& name);

/// Writes a file, in one step. Numbers read back to the same bits, but poses, which are turned and
/// may differ in the last bit: the cost is the same to 1e-14 of it. A camera that several poses
/// share is written for each of them; pixels are written from the principal point. What is fixed,
/// names, colours and ids are not written.
/// @param bundle  each pose with one camera, which is pinhole or radtan with fx = fy and no more
///   than k1 and k2; no weights
/// @param path    of the file
/// @throws ArgumentError that says what the format cannot hold, FileError when it cannot be written
GSLAM_OPTIMIZER_EXPORT void writeBal(const Bundle& bundle, const std::string& path);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_FILES_BAL_H
