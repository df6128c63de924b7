#include "decode.h"

#include <gslam/base/error.h>
#include <gslam/core/opencv.h>

#include <opencv2/imgcodecs.hpp>

#include "whole_image.h"

namespace gslam {
inline namespace v1 {
namespace reading {
Image decodeImage(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (bytes.empty()) throw FileError(name, "is empty, expected an image");
  if (!isWholeImage(bytes)) throw FileError(name, "ends early, expected a whole image");
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw FileError(name, std::string("cannot be decoded as an image: ") + error.err);
  }
  if (pixels.empty()) throw FileError(name, "cannot be decoded, expected an image");
  return fromOpenCv(pixels);
}

Image readImage(const FileTree& tree, const std::string& file) {
  return decodeImage(tree.read(file), tree.nameOf(file));
}

ImageKind kindOf(const Image& image, const std::string& name) {
  switch (image.channels()) {
    case 1:
      return ImageKind::grey;
    case 3:
      return ImageKind::bgr;
    case 4:
      return ImageKind::bgra;
    default:
      throw FileError(name,
                      "has " + std::to_string(image.channels()) + " channels, expected 1, 3 or 4");
  }
}

ImageShape shapeOf(const Image& image) {
  return {image.width(), image.height(), image.type(), image.channels()};
}

void checkShape(const Image& image, const ImageShape& shape, const std::string& name) {
  const bool is_same = image.width() == shape.width && image.height() == shape.height &&
                       image.type() == shape.type && image.channels() == shape.channels;
  if (is_same) return;
  throw FileError(name, "is " + image.text() + ", but the camera's first image is " +
                            std::to_string(shape.width) + " x " + std::to_string(shape.height) +
                            " " + pixelTypeName(shape.type) + " x " +
                            std::to_string(shape.channels));
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
