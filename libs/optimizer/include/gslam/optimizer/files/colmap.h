#ifndef GSLAM_OPTIMIZER_FILES_COLMAP_H
#define GSLAM_OPTIMIZER_FILES_COLMAP_H

#include <gslam/optimizer/bundle.h>

#include <string>

/// @file
/// Sparse models of COLMAP as text: cameras.txt, images.txt and points3D.txt of a folder
/// (Schoenberger, Frahm, CVPR 2016).
///
/// Camera models and what is free of them, as COLMAP's own bundle adjustment has it, focal lengths
/// and distortion:
///
/// | COLMAP | geometry::Camera |
/// | --- | --- |
/// | SIMPLE_PINHOLE, PINHOLE | pinhole |
/// | SIMPLE_RADIAL, RADIAL, OPENCV | radtan, 4 coefficients |
/// | FULL_OPENCV | radtan, 8 coefficients |
/// | OPENCV_FISHEYE, SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE | kannala_brandt |
/// | FOV | fov |
///
/// Where a model has one focal length, fy follows fx. COLMAP's pixels have the corner of the first
/// one at (0, 0); half a pixel is taken off. Ids of images, points and cameras, names of images and
/// colours are kept; features without a point are not, and features are numbered anew on writing.

namespace gslam {
inline namespace v1 {

/// Reads a model.
/// @param folder  with the three files
/// @return what is in it, observations in the order of points
/// @throws FileError when a file cannot be read, ParseError as parseColmap()
GSLAM_OPTIMIZER_EXPORT Bundle readColmap(const std::string& folder);

/// Reads text.
/// @param cameras  all of cameras.txt
/// @param images   all of images.txt
/// @param points   all of points3D.txt
/// @param name     what stands for the folder in errors
/// @return what is in it
/// @throws ParseError when a camera model is none of the above, a number is missing, too much, not
///   finite or out of its range, an id is there twice or not at all, or images and points do not
///   say the same of who sees what, naming file, line and column
GSLAM_OPTIMIZER_EXPORT Bundle parseColmap(const std::string& cameras, const std::string& images,
                                          const std::string& points, const std::string& name);

/// Writes a model into a folder, which is made where it is not there; each file in one step. A
/// camera gets the model with the fewest parameters that has all that are free or not 0. A pose
/// that sees nothing is left out where it is not known which camera is its own. Names and ids that
/// are not there are made up; what is fixed is not written.
/// @param bundle  each pose with one camera; no weights
/// @param folder  for the three files
/// @throws ArgumentError that says what the format cannot hold, FileError when it cannot be written
GSLAM_OPTIMIZER_EXPORT void writeColmap(const Bundle& bundle, const std::string& folder);

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_FILES_COLMAP_H
