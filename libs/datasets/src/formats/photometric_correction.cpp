#include "photometric_correction.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../reading/decode.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::size_t kLevels = 256;

template <class T>
std::vector<float> pixelsOf(const Image& image) {
  std::vector<float> values;
  values.reserve(std::size_t(image.width()) * std::size_t(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    const T* const row = image.row<T>(y);
    for (int x = 0; x < image.width(); ++x) values.push_back(static_cast<float>(row[x]));
  }
  return values;
}

std::uint8_t rounded(float value) {
  return static_cast<std::uint8_t>(std::min(value + 0.5F, 255.0F));
}

// Row by row; `store` makes a pixel of the value.
template <class T, class Store>
void correctRows(const Image& image, const std::vector<float>& response, const float* gain,
                 Image& result, const Store& store) {
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* const from = image.row<std::uint8_t>(y);
    T* const to = result.row<T>(y);
    for (int x = 0; x < image.width(); ++x) to[x] = store(response[from[x]] * *gain++);
  }
}

}  // namespace

PhotometricCorrection::PhotometricCorrection(std::vector<float> response,
                                             std::vector<float> vignette, int width, int height)
    : response_(std::move(response)), gain_(std::move(vignette)), width_(width), height_(height) {
  for (float& v : gain_) {
    if (!(v > 0)) ++dark_pixels_;
    v = v > 0 ? 1 / v : 0;
  }
}

Image PhotometricCorrection::apply(const Image& image, PixelType to,
                                   const std::string& name) const {
  const bool fits = image.width() == width_ && image.height() == height_ &&
                    image.type() == PixelType::u8 && image.channels() == 1;
  if (!fits) {
    throw FileError(name, "is " + image.text() + ", but the photometric calibration is for " +
                              std::to_string(width_) + " x " + std::to_string(height_) +
                              " 8-bit grey");
  }
  Image result(width_, height_, to);
  if (to == PixelType::u8) {
    correctRows<std::uint8_t>(image, response_, gain_.data(), result, rounded);
  } else {
    correctRows<float>(image, response_, gain_.data(), result, [](float value) { return value; });
  }
  return result;
}

std::vector<float> readResponse(const FileTree& tree, const std::string& file) {
  const std::string text = tree.text(file), name = tree.nameOf(file);
  detail::FieldReader in(text, name, "256 values of the inverse response, in one line");
  std::vector<double> values;
  while (in.nextLine()) {
    while (!in.isLineEnd()) {
      const char* const at = in.place();
      const double value = in.number("the inverse response");
      if (!values.empty() && value < values.back()) {
        in.fail(at, "value " + std::to_string(values.size()) +
                        " is less than the one before, expected values that do not fall");
      }
      values.push_back(value);
      if (values.size() > kLevels) in.endLine();
    }
  }
  if (values.size() != kLevels || !(values.back() > values.front())) {
    throw ParseError(name, 0, 0,
                     "has " + std::to_string(values.size()) + " values from " +
                         (values.empty() ? "none" : std::to_string(values.front())) +
                         " on, expected 256 that rise");
  }
  std::vector<float> response;
  const double least = values.front(), scale = 255 / (values.back() - values.front());
  for (double value : values) response.push_back(static_cast<float>((value - least) * scale));
  return response;
}

PhotometricCorrection readPhotometricCorrection(const FileTree& tree, const std::string& folder) {
  std::vector<float> response = readResponse(tree, joined(folder, "pcalib.txt"));
  const std::string file = joined(folder, "vignette.png");
  const Image image = readImage(tree, file);
  const bool is_u8 = image.type() == PixelType::u8, is_u16 = image.type() == PixelType::u16;
  if (image.channels() != 1 || !(is_u8 || is_u16)) {
    throw FileError(tree.nameOf(file), "is " + image.text() + ", expected grey of 8 or 16 bits");
  }
  std::vector<float> vignette =
      is_u8 ? pixelsOf<std::uint8_t>(image) : pixelsOf<std::uint16_t>(image);
  const float most = *std::max_element(vignette.begin(), vignette.end());
  if (!(most > 0)) throw FileError(tree.nameOf(file), "is black, expected a vignette");
  for (float& v : vignette) v /= most;
  return PhotometricCorrection(std::move(response), std::move(vignette), image.width(),
                               image.height());
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
