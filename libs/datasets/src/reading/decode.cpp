#include "decode.h"

#include <gslam/base/error.h>
#include <gslam/core/opencv.h>

#include <new>
#include <opencv2/imgcodecs.hpp>

#include "whole_image.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t(1) << 28;

// A few bytes can ask for gigabytes.
void checkHead(const std::vector<std::uint8_t>& bytes, const std::string& name,
               const ImageShape* expected) {
  std::uint32_t width = 0, height = 0;
  if (!readImageSize(bytes, width, height)) return;
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (std::uint64_t(width) * height > kMostPixels) {
    throw FileError(name, "has " + size + " pixels, expected at most 2^28");
  }
  if (expected == nullptr) return;
  if (std::int64_t(width) == expected->width && std::int64_t(height) == expected->height) return;
  throw FileError(name, "is " + size + ", but the camera's first image is " +
                            std::to_string(expected->width) + " x " +
                            std::to_string(expected->height));
}

}  // namespace

Image decodeImage(const std::vector<std::uint8_t>& bytes, const std::string& name,
                  const ImageShape* expected) {
  if (bytes.empty()) throw FileError(name, "is empty, expected an image");
  if (!isWholeImage(bytes)) throw FileError(name, "ends early, expected a whole image");
  checkHead(bytes, name, expected);
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw FileError(name, std::string("cannot be decoded as an image: ") + error.err);
  } catch (const std::bad_alloc&) {
    throw FileError(name, "is too large for the memory that there is");
  }
  if (pixels.empty()) throw FileError(name, "cannot be decoded, expected an image");
  Image image = fromOpenCv(pixels);
  if (expected != nullptr) checkShape(image, *expected, name);
  return image;
}

Image readImage(const FileTree& tree, const std::string& file, const ImageShape* expected) {
  return decodeImage(tree.read(file), tree.nameOf(file), expected);
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
