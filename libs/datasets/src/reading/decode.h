// Image files to pixels.
#ifndef GSLAM_DATASETS_SRC_READING_DECODE_H
#define GSLAM_DATASETS_SRC_READING_DECODE_H

#include <gslam/core/frame.h>
#include <gslam/core/image.h>
#include <gslam/datasets/export.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "file_tree.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// The images of one camera: what its first one is like, so are all.
struct ImageShape {
  int width = 0;
  int height = 0;
  PixelType type = PixelType::u8;
  int channels = 1;
};

/// The pixels of an image file as they are stored: u8, u16 or f32; grey, blue-green-red or with
/// opacity. A rotation that EXIF asks for is not done: cameras are calibrated without it.
/// @param bytes     all of the file
/// @param name      what errors call it
/// @param expected  unless null: what the image must be like. A PNG or JPEG of another size is
///                  refused before it is decoded.
/// @throws FileError when it is empty, no image, ends early, has more than 2^28 pixels, or is not
/// as
///   expected
GSLAM_DATASETS_EXPORT Image decodeImage(const std::vector<std::uint8_t>& bytes,
                                        const std::string& name,
                                        const ImageShape* expected = nullptr);

/// The same of a file in a tree.
Image readImage(const FileTree& tree, const std::string& file,
                const ImageShape* expected = nullptr);

/// What pixels with that many channels mean: grey, bgr or bgra.
/// @throws FileError for another number
GSLAM_DATASETS_EXPORT ImageKind kindOf(const Image& image, const std::string& name);

GSLAM_DATASETS_EXPORT ImageShape shapeOf(const Image& image);

/// @throws FileError when an image has not that shape
GSLAM_DATASETS_EXPORT void checkShape(const Image& image, const ImageShape& shape,
                                      const std::string& name);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_DECODE_H
