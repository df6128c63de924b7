#include "pixels.h"

#include <gslam/base/error.h>
#include <gslam/core/opencv.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "row.h"

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

std::string nameOf(const CameraSensor& camera) {
  return "image of camera '" + camera.name + "'";
}

[[noreturn]] void fail(const CameraSensor& camera, const std::string& problem) {
  throw ArgumentError(nameOf(camera), problem);
}

void checkSize(const CameraImage& image, const CameraSensor& sensor) {
  const Camera& model = sensor.camera;
  const Image& pixels = image.image;
  if (!model.isValid() || (model.width() == pixels.width() && model.height() == pixels.height())) {
    return;
  }
  fail(sensor, "is " + pixels.text() + ", but the camera has " + std::to_string(model.width()) +
                   " x " + std::to_string(model.height()));
}

int expectedChannels(ImageKind kind) {
  switch (kind) {
    case ImageKind::grey:
    case ImageKind::infrared:
    case ImageKind::depth:
      return 1;
    case ImageKind::rgb:
    case ImageKind::bgr:
      return 3;
    case ImageKind::rgba:
    case ImageKind::bgra:
      return 4;
    default:
      return 0;
  }
}

// The pixels, u8, or u16 of one channel.
cv::Mat photograph(const CameraImage& image, const CameraSensor& camera) {
  checkSize(image, camera);
  const int channels = image.kind == ImageKind::depth ? 0 : expectedChannels(image.kind);
  if (channels == 0) {
    fail(camera, std::string("is of kind ") + imageKindName(image.kind) +
                     ", expected brightness or colour");
  }
  const bool is_wide = image.image.type() == PixelType::u16 && channels == 1;
  if (image.image.channels() != channels || (image.image.type() != PixelType::u8 && !is_wide)) {
    fail(camera, "is " + image.image.text() + " of kind " + imageKindName(image.kind) +
                     ", expected " + std::to_string(channels) + " channels of u8" +
                     (channels == 1 ? " or u16" : ""));
  }
  return toOpenCv(image.image);
}

int greyCode(ImageKind kind) {
  switch (kind) {
    case ImageKind::rgb:
      return cv::COLOR_RGB2GRAY;
    case ImageKind::rgba:
      return cv::COLOR_RGBA2GRAY;
    case ImageKind::bgra:
      return cv::COLOR_BGRA2GRAY;
    default:
      return cv::COLOR_BGR2GRAY;
  }
}

int bgrCode(ImageKind kind) {
  switch (kind) {
    case ImageKind::rgb:
      return cv::COLOR_RGB2BGR;
    case ImageKind::rgba:
      return cv::COLOR_RGBA2BGR;
    case ImageKind::bgra:
      return cv::COLOR_BGRA2BGR;
    default:
      return cv::COLOR_GRAY2BGR;
  }
}

void halveBits(cv::Mat& mat, const CameraSensor& camera, Notes& notes) {
  if (mat.depth() != CV_16U) return;
  cv::Mat narrow(mat.size(), CV_8U);
  for (int y = 0; y < mat.rows; ++y) {
    const std::uint16_t* const from = mat.ptr<std::uint16_t>(y);
    std::uint8_t* const to = narrow.ptr<std::uint8_t>(y);
    for (int x = 0; x < mat.cols; ++x) to[x] = static_cast<std::uint8_t>(from[x] >> 8);
  }
  mat = narrow;
  notes.remark("camera '" + camera.name + "': of 16 bits a pixel the upper 8 were taken");
}

Bytes png(const cv::Mat& mat) {
  Bytes bytes;
  try {
    if (!cv::imencode(".png", mat, bytes)) throw Error("an image could not be made a PNG");
  } catch (const cv::Exception& error) {
    throw Error(std::string("an image could not be made a PNG: ") + error.what());
  }
  return bytes;
}

cv::Mat grey(const CameraImage& image, const CameraSensor& camera, Notes& notes) {
  cv::Mat mat = photograph(image, camera);
  if (mat.channels() == 1) return mat;
  cv::Mat result;
  cv::cvtColor(mat, result, greyCode(image.kind));
  notes.remark("camera '" + camera.name + "': colour was made grey");
  return result;
}

}  // namespace

Bytes greyPng(const CameraImage& image, const CameraSensor& camera, Notes& notes) {
  cv::Mat mat = grey(image, camera, notes);
  halveBits(mat, camera, notes);
  return png(mat);
}

Bytes grey16Png(const CameraImage& image, const CameraSensor& camera, Notes& notes) {
  const cv::Mat mat = grey(image, camera, notes);
  if (mat.depth() == CV_16U) return png(mat);
  cv::Mat wide;
  mat.convertTo(wide, CV_16U, 256);
  notes.remark("camera '" + camera.name + "': 8 bits a pixel became the upper 8 of 16");
  return png(wide);
}

Bytes colourPng(const CameraImage& image, const CameraSensor& camera, Notes& notes) {
  cv::Mat mat = photograph(image, camera);
  halveBits(mat, camera, notes);
  if (image.kind == ImageKind::bgr) return png(mat);
  if (mat.channels() == 1) {
    notes.remark("camera '" + camera.name + "': grey is written as colour, three times the same");
  }
  cv::Mat bgr;
  cv::cvtColor(mat, bgr, bgrCode(image.kind));
  return png(bgr);
}

Bytes depthPng(const CameraImage& image, const CameraSensor& camera, double units, Notes& notes) {
  checkSize(image, camera);
  const PixelType type = image.image.type();
  if (image.kind != ImageKind::depth || image.image.channels() != 1 ||
      (type != PixelType::u16 && type != PixelType::f32)) {
    fail(camera, "is " + image.image.text() + " of kind " + imageKindName(image.kind) +
                     ", expected depth as u16 or f32");
  }
  const double scale = image.depth_scale != 0 ? image.depth_scale : camera.depth_scale;
  if (!(scale > 0) || !std::isfinite(scale)) {
    fail(camera, "has the depth scale " + numberText(scale) + ", expected metres of a pixel");
  }
  cv::Mat from, to(image.image.height(), image.image.width(), CV_16U);
  toOpenCv(image.image).convertTo(from, CV_64F, scale * units);
  std::size_t too_far = 0;
  for (int y = 0; y < from.rows; ++y) {
    for (int x = 0; x < from.cols; ++x) {
      const double value = std::round(from.at<double>(y, x));
      const bool is_there = value > 0;  // not so for NaN
      if (is_there && std::isfinite(value) && value > 65535) ++too_far;
      to.at<std::uint16_t>(y, x) =
          is_there && value <= 65535 ? static_cast<std::uint16_t>(value) : std::uint16_t(0);
    }
  }
  notes.count("depth pixels", "farther than " + numberText(65535 / units) + " m", too_far);
  return png(to);
}

Bytes whitePng(int width, int height) {
  return png(cv::Mat(height, width, CV_16U, 65535.0));
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
