#include "features/grey_image.h"

#include <algorithm>
#include <iterator>
#include <opencv2/imgproc.hpp>

namespace visual {
namespace {

using gslam::CameraImage;
using gslam::Image;
using gslam::ImageKind;
using gslam::PixelType;

constexpr double kWhites[] = {1, 255, 1023, 4095, 16383, 65535};

int channelsOf(ImageKind kind) noexcept {
  if (kind == ImageKind::rgb || kind == ImageKind::bgr) return 3;
  return kind == ImageKind::rgba || kind == ImageKind::bgra ? 4 : 1;
}

// The least white that few of the numbers are above; those that are no number count as black.
template <class T>
double whiteOf(const Image& image, std::size_t first) {
  const std::size_t width = std::size_t(image.width()) * std::size_t(image.channels());
  std::size_t above[std::size(kWhites)] = {};
  for (int y = 0; y < image.height(); ++y) {
    const T* const row = image.row<T>(y);
    for (std::size_t i = first; i < std::size(kWhites); ++i) {
      const T white = T(kWhites[i]);
      std::uint32_t count = 0;
      for (std::size_t x = 0; x < width; ++x) count += row[x] > white ? 1U : 0U;
      above[i] += count;
    }
  }
  const std::size_t most = width * std::size_t(image.height()) / 1000;
  std::size_t i = first;
  while (i + 1 < std::size(kWhites) && above[i] > most) ++i;
  return kWhites[i];
}

// The pixels as OpenCV has them, without a share in them.
cv::Mat headerOf(const Image& image) {
  return cv::Mat(image.height(), image.width(), CV_MAKETYPE(int(image.type()), image.channels()),
                 const_cast<std::uint8_t*>(image.bytes()), image.stride());
}

std::string sizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

// To 8 bits. OpenCV rounds to the nearest and limits what is too large; NaN is black.
void scaleToBytes(const cv::Mat& from, double white, cv::Mat& bytes) {
  from.convertTo(bytes, CV_8U, 255 / white);
}

}  // namespace

void GreyRange::widen(const Image& image) {
  if (image.empty()) return;
  double white = 255;
  if (image.type() == PixelType::u16) white = whiteOf<std::uint16_t>(image, 1);
  if (image.type() == PixelType::f32) white = whiteOf<float>(image, 0);
  white_ = std::max(white_, white);
}

bool GreyImage::accepts(const CameraImage& image, std::string& problem) const {
  const std::string name = "the image of camera '" + image.name + "' ";
  const Image& pixels = image.image;
  if (!gslam::isPhotographic(image.kind)) {
    problem = name + "is of kind " + gslam::imageKindName(image.kind) + ", expected brightness";
  } else if (pixels.empty()) {
    problem = name + "is missing";
  } else if (pixels.width() != width_ || pixels.height() != height_) {
    problem = name + "has " + sizeText(pixels.width(), pixels.height()) + " pixels, expected " +
              sizeText(width_, height_) + " as before";
  } else if (pixels.channels() != channelsOf(image.kind)) {
    problem = name + "has " + std::to_string(pixels.channels()) + " channels, expected " +
              std::to_string(channelsOf(image.kind)) + " for kind " +
              gslam::imageKindName(image.kind);
  } else if (pixels.type() != PixelType::u8 && pixels.type() != PixelType::u16 &&
             pixels.type() != PixelType::f32) {
    problem =
        name + "has pixels of " + gslam::pixelTypeName(pixels.type()) + ", expected u8, u16 or f32";
  } else {
    return true;
  }
  return false;
}

const cv::Mat& GreyImage::make(const CameraImage& image, const GreyRange& range) {
  const cv::Mat pixels = headerOf(image.image);
  if (image.image.type() == PixelType::u8) {
    single_ = pixels;
  } else {
    scaleToBytes(pixels, range.white(), bytes_);
    single_ = bytes_;
  }
  switch (image.kind) {
    case ImageKind::rgb:
      cv::cvtColor(single_, grey_, cv::COLOR_RGB2GRAY);
      return grey_;
    case ImageKind::bgr:
      cv::cvtColor(single_, grey_, cv::COLOR_BGR2GRAY);
      return grey_;
    case ImageKind::rgba:
      cv::cvtColor(single_, grey_, cv::COLOR_RGBA2GRAY);
      return grey_;
    case ImageKind::bgra:
      cv::cvtColor(single_, grey_, cv::COLOR_BGRA2GRAY);
      return grey_;
    case ImageKind::bayer:
      // 1 2 1 both ways: half green, a quarter red, a quarter blue at each pixel of any mosaic.
      cv::GaussianBlur(single_, grey_, cv::Size(3, 3), 0, 0, cv::BORDER_REFLECT_101);
      return grey_;
    default:
      return single_;
  }
}

}  // namespace visual
