#ifndef GSLAM_DATASETS_CONTACT_SHEET_H
#define GSLAM_DATASETS_CONTACT_SHEET_H

#include <gslam/core/dataset.h>
#include <gslam/core/image.h>
#include <gslam/datasets/export.h>

#include <cstddef>
#include <string>

/// @file
/// A dataset at a glance: a grid of its frames in one picture.

namespace gslam {
inline namespace v1 {

/// What a contact sheet looks like.
struct ContactSheetOptions {
  std::size_t frames = 20;  ///< most frames on it, 1 to 1000, spread evenly over the dataset
  int width = 1600;         ///< pixels of the sheet, 64 to 16384
  int columns = 0;          ///< frames side by side; 0: as many as keep an image 200 pixels wide
};

/// Draws a grid of frames. Each has the images of all its cameras side by side, above them its id
/// and stamp, below the names of the cameras. Depth and disparity are in false colours, from near
/// in red to far in blue, with one scale for the whole sheet, which the name says; black is no
/// depth. A frame that cannot be read has its place, and says so.
///
/// @param dataset  is moved by seek(); of a device or one of unknown length the next frames are
/// taken
/// @param options  what it looks like
/// @return red, green, blue
/// @throws ArgumentError when an option is out of range
/// @throws Error when there is no frame, or none can be read
GSLAM_DATASETS_EXPORT Image
drawContactSheet(Dataset& dataset, const ContactSheetOptions& options = ContactSheetOptions());

/// The same as a PNG file.
/// @throws FileError when it cannot be written; and as drawContactSheet()
GSLAM_DATASETS_EXPORT void writeContactSheet(
    Dataset& dataset, const std::string& path,
    const ContactSheetOptions& options = ContactSheetOptions());

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_CONTACT_SHEET_H
