#include <gslam/base/error.h>
#include <gslam/core/opencv.h>
#include <gslam/core/stamp.h>
#include <gslam/datasets/contact_sheet.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "export/export_folder.h"

namespace gslam {
inline namespace v1 {
namespace {

const cv::Scalar kPaper(40, 40, 40), kInk(230, 230, 230), kPaleInk(160, 160, 160),
    kAlarm(80, 110, 255);    // blue, green, red
constexpr int kGap = 6;      // pixels between frames
constexpr int kStrip = 16;   // pixels of a line of text
constexpr int kTileGap = 2;  // pixels between the images of a frame
constexpr int kLeastTile = 200;

// What has a place on the sheet: a frame, or why there is none.
struct Cell {
  std::shared_ptr<const Frame> frame;
  std::string failure;
};

void checkRange(const char* name, long long value, long long least, long long most) {
  if (value >= least && value <= most) return;
  throw ArgumentError(name, "is " + std::to_string(value) + ", expected " + std::to_string(least) +
                                " to " + std::to_string(most));
}

Cell readCell(Dataset& dataset) {
  Cell cell;
  try {
    cell.frame = dataset.next();
  } catch (const Error& error) {
    cell.failure = error.what();
  }
  return cell;
}

std::vector<Cell> readCells(Dataset& dataset, std::size_t most) {
  const std::size_t total = dataset.info().is_live ? 0 : dataset.info().frame_count;
  const std::size_t count = total == 0 ? most : std::min(most, total);
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < count; ++i) {
    if (total != 0) dataset.seek(count == 1 ? 0 : i * (total - 1) / (count - 1));
    cells.push_back(readCell(dataset));
    if (cells.back().frame != nullptr || !cells.back().failure.empty()) continue;
    cells.pop_back();  // the end
    break;
  }
  if (cells.empty()) throw Error("a contact sheet needs frames, and the dataset has none");
  const bool is_seen = std::any_of(cells.begin(), cells.end(),
                                   [](const Cell& cell) { return cell.frame != nullptr; });
  if (!is_seen) throw Error("no frame can be read: " + cells.front().failure);
  return cells;
}

// The pixels in a type that OpenCV has operations for: of half floats it has hardly any, and with
// some it calls what is not there.
cv::Mat pixelsOf(const CameraImage& image) {
  cv::Mat mat = toOpenCv(image.image);
  if (image.image.type() != PixelType::f16) return mat;
  const cv::Mat halves(mat.rows, mat.cols, CV_MAKETYPE(CV_16S, mat.channels()), mat.data, mat.step);
  cv::Mat floats;
  cv::convertFp16(halves, floats);
  return floats;
}

bool isRange(ImageKind kind) {
  return kind == ImageKind::depth || kind == ImageKind::disparity;
}

// Metres, or pixels of disparity; not positive or NaN where there is none.
cv::Mat distances(const CameraImage& image) {
  cv::Mat result;
  const bool has_scale = image.kind == ImageKind::depth && image.depth_scale > 0;
  cv::Mat pixels = pixelsOf(image);
  if (pixels.channels() > 1) cv::extractChannel(pixels, pixels, 0);
  pixels.convertTo(result, CV_32F, has_scale ? image.depth_scale : 1);
  return result;
}

// The range of all images of a kind without the outer two hundredths.
struct Range {
  float near = 0, far = 0;
};

Range rangeOf(const std::vector<Cell>& cells, ImageKind kind) {
  std::vector<float> values;
  for (const Cell& cell : cells) {
    if (cell.frame == nullptr) continue;
    for (const CameraImage& image : cell.frame->images) {
      if (image.kind != kind || image.image.empty() || image.image.type() > PixelType::f16)
        continue;
      const cv::Mat d = distances(image);
      const int step = std::max(1, int(std::sqrt(double(d.total()) / 4000)));
      for (int y = 0; y < d.rows; y += step) {
        for (int x = 0; x < d.cols; x += step) {
          const float value = d.at<float>(y, x);
          if (value > 0 && std::isfinite(value)) values.push_back(value);
        }
      }
    }
  }
  if (values.empty()) return Range();
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 50;
  return {values[cut], values[values.size() - 1 - cut]};
}

// A number with two digits behind the point, whatever the locale.
std::string shortText(double value) {
  const long long hundredths = std::llround(value * 100);
  const std::string rest = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + (rest.size() < 2 ? ".0" : ".") + rest;
}

cv::Mat paintRange(const CameraImage& image, const Range& range) {
  const cv::Mat d = distances(image);
  cv::Mat index(d.size(), CV_8U), colours;
  const float width = std::max(range.far - range.near, 1e-6F);
  for (int y = 0; y < d.rows; ++y) {
    for (int x = 0; x < d.cols; ++x) {
      const float part = (d.at<float>(y, x) - range.near) / width;
      const float clipped = part > 0 ? std::min(part, 1.F) : 0.F;  // 0 for NaN
      // Of depth, what is near is red; of disparity what is large, which is near, too.
      const float warm = image.kind == ImageKind::depth ? 1 - clipped : clipped;
      index.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::lround(20 + 225 * warm));
    }
  }
  cv::applyColorMap(index, colours, cv::COLORMAP_TURBO);
  for (int y = 0; y < d.rows; ++y) {
    for (int x = 0; x < d.cols; ++x) {
      const float value = d.at<float>(y, x);
      if (!(value > 0) || !std::isfinite(value)) colours.at<cv::Vec3b>(y, x) = cv::Vec3b(0, 0, 0);
    }
  }
  return colours;
}

// To 8 bits; what is not of 8 bits is stretched over them.
cv::Mat narrowed(const cv::Mat& mat) {
  cv::Mat result;
  if (mat.depth() == CV_8U) return mat;
  if (mat.depth() == CV_16U) {
    mat.convertTo(result, CV_8U, 1.0 / 256);
  } else {
    cv::normalize(mat.reshape(1), result, 0, 255, cv::NORM_MINMAX, CV_8U);
    result = result.reshape(mat.channels());
  }
  return result;
}

cv::Mat paintPhotograph(const CameraImage& image) {
  cv::Mat pixels = narrowed(pixelsOf(image));
  cv::Mat bgr;
  switch (pixels.channels()) {
    case 1:
      cv::cvtColor(pixels, bgr, cv::COLOR_GRAY2BGR);
      return bgr;
    case 3:
      if (image.kind == ImageKind::bgr) return pixels;
      cv::cvtColor(pixels, bgr, cv::COLOR_RGB2BGR);
      return bgr;
    case 4:
      cv::cvtColor(pixels, bgr,
                   image.kind == ImageKind::bgra ? cv::COLOR_BGRA2BGR : cv::COLOR_RGBA2BGR);
      return bgr;
    default:
      cv::extractChannel(pixels, bgr, 0);
      cv::cvtColor(bgr, bgr, cv::COLOR_GRAY2BGR);
      return bgr;
  }
}

// Labels get colours that differ for numbers that are near.
cv::Mat paintLabels(const CameraImage& image) {
  cv::Mat numbers, colours;
  pixelsOf(image).convertTo(numbers, CV_32S);
  if (numbers.channels() > 1) cv::extractChannel(numbers, numbers, 0);
  cv::Mat index(numbers.size(), CV_8U);
  for (int y = 0; y < numbers.rows; ++y) {
    for (int x = 0; x < numbers.cols; ++x) {
      const unsigned number = static_cast<unsigned>(numbers.at<int>(y, x));
      index.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(number * 97);
    }
  }
  cv::applyColorMap(index, colours, cv::COLORMAP_HSV);
  return colours;
}

class Sheet {
 public:
  Sheet(std::vector<Cell> cells, const ContactSheetOptions& options)
      : cells_(std::move(cells)),
        depth_(rangeOf(cells_, ImageKind::depth)),
        disparity_(rangeOf(cells_, ImageKind::disparity)) {
    measure(options);
  }

  // Blue, green, red.
  cv::Mat draw() const {
    cv::Mat sheet(rows_ * (cell_height_ + kGap) + kGap, width_, CV_8UC3, kPaper);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const int column = int(i) % columns_, row = int(i) / columns_;
      const cv::Rect place(kGap + column * (cell_width_ + kGap), kGap + row * (cell_height_ + kGap),
                           cell_width_, cell_height_);
      drawCell(sheet(place), cells_[i]);
    }
    return sheet;
  }

 private:
  void measure(const ContactSheetOptions& options) {
    double aspect = 0;  // of the tallest image
    for (const Cell& cell : cells_) {
      if (cell.frame == nullptr) continue;
      tiles_ = std::max(tiles_, int(std::min<std::size_t>(cell.frame->images.size(), 64)));
      for (const CameraImage& image : cell.frame->images) {
        if (image.image.empty()) continue;
        aspect = std::max(aspect, double(image.image.height()) / image.image.width());
      }
    }
    if (aspect == 0) aspect = 0.75;
    const int count = int(cells_.size());
    width_ = options.width;
    columns_ = options.columns > 0 ? options.columns : width_ / (tiles_ * kLeastTile);
    columns_ = std::clamp(columns_, 1, count);
    rows_ = (count + columns_ - 1) / columns_;
    const int for_cells = width_ - kGap * (columns_ + 1);
    cell_width_ = for_cells / columns_;
    tile_width_ = (cell_width_ - kTileGap * (tiles_ - 1)) / tiles_;
    if (tile_width_ < 16) {
      throw ArgumentError("width", "is " + std::to_string(width_) + ", too small for " +
                                       std::to_string(columns_ * tiles_) + " images side by side");
    }
    tile_height_ = int(std::lround(std::min(tile_width_ * std::min(aspect, 8.0), 8192.0)));
    tile_height_ = std::max(tile_height_, 1);
    cell_height_ = tile_height_ + 2 * kStrip;
    const double height = double(rows_) * (cell_height_ + kGap);
    if (height * width_ > 4e8) {
      throw ArgumentError("frames", "make a sheet of " + std::to_string(width_) + " x " +
                                        std::to_string(std::llround(height)) +
                                        " pixels, which is too large");
    }
  }

  void drawCell(cv::Mat place, const Cell& cell) const {
    if (cell.frame == nullptr) {
      write(place, 0, "cannot be read", kAlarm);
      write(place, kStrip, cell.failure, kPaleInk);
      return;
    }
    write(place, 0, "#" + std::to_string(cell.frame->id) + "  " + stampText(cell.frame->stamp),
          kInk);
    for (std::size_t i = 0; i < cell.frame->images.size() && int(i) < tiles_; ++i) {
      drawTile(place, int(i) * (tile_width_ + kTileGap), cell.frame->images[i]);
    }
  }

  // Seconds to the millisecond.
  static std::string stampText(std::int64_t stamp) {
    const std::string text = secondsText(stamp);
    return text.substr(0, text.size() - 6) + " s";
  }

  void drawTile(cv::Mat& place, int x, const CameraImage& image) const {
    cv::Mat below = place(cv::Rect(x, kStrip + tile_height_, tile_width_, kStrip));
    write(below, 0, titleOf(image), kPaleInk);
    cv::Mat tile = place(cv::Rect(x, kStrip, tile_width_, tile_height_));
    if (image.image.empty()) {
      write(tile, 0, "no image", kAlarm);
      return;
    }
    try {
      const cv::Mat painted = paint(image);
      const double scale =
          std::min(double(tile_width_) / painted.cols, double(tile_height_) / painted.rows);
      const cv::Size size(std::clamp(int(std::lround(painted.cols * scale)), 1, tile_width_),
                          std::clamp(int(std::lround(painted.rows * scale)), 1, tile_height_));
      const int method = scale > 1 || isRange(image.kind) || image.kind == ImageKind::label
                             ? cv::INTER_NEAREST
                             : cv::INTER_AREA;
      cv::Mat small;
      cv::resize(painted, small, size, 0, 0, method);
      small.copyTo(tile(cv::Rect((tile_width_ - size.width) / 2, (tile_height_ - size.height) / 2,
                                 size.width, size.height)));
    } catch (const std::exception&) {  // pixels that OpenCV has no operation for
      write(tile, 0, image.image.text(), kAlarm);
    }
  }

  cv::Mat paint(const CameraImage& image) const {
    if (image.kind == ImageKind::depth) return paintRange(image, depth_);
    if (image.kind == ImageKind::disparity) return paintRange(image, disparity_);
    if (image.kind == ImageKind::label) return paintLabels(image);
    return paintPhotograph(image);
  }

  std::string titleOf(const CameraImage& image) const {
    std::string title = image.name.empty() ? imageKindName(image.kind) : image.name;
    if (!isRange(image.kind)) return title;
    const bool is_depth = image.kind == ImageKind::depth;
    const Range& range = is_depth ? depth_ : disparity_;
    const char* const unit = is_depth && image.depth_scale > 0 ? " m" : is_depth ? "" : " px";
    return title + " " + shortText(range.near) + " to " + shortText(range.far) + unit;
  }

  // One line of text, cut where there is no more room; OpenCV's letters are ASCII.
  static void write(cv::Mat place, int y, std::string text, const cv::Scalar& colour) {
    const int font = cv::FONT_HERSHEY_SIMPLEX;
    const double scale = 0.38;
    for (char& c : text) {
      if (c < 0x20 || c > 0x7E) c = '?';
    }
    int base = 0;
    while (!text.empty() && cv::getTextSize(text, font, scale, 1, &base).width > place.cols) {
      text.resize(text.size() - 1 - text.size() / 16);
    }
    cv::putText(place, text, cv::Point(0, y + kStrip - 4), font, scale, colour, 1, cv::LINE_AA);
  }

  std::vector<Cell> cells_;
  Range depth_, disparity_;
  int tiles_ = 1;  // images of a frame
  int width_ = 0, columns_ = 0, rows_ = 0;
  int cell_width_ = 0, cell_height_ = 0, tile_width_ = 0, tile_height_ = 0;
};

cv::Mat drawSheet(Dataset& dataset, const ContactSheetOptions& options) {
  checkRange("frames", static_cast<long long>(std::min<std::size_t>(options.frames, 1000000)), 1,
             1000);
  checkRange("width", options.width, 64, 16384);
  checkRange("columns", options.columns, 0, 1000);
  return Sheet(readCells(dataset, options.frames), options).draw();
}

}  // namespace

Image drawContactSheet(Dataset& dataset, const ContactSheetOptions& options) {
  cv::Mat sheet = drawSheet(dataset, options);
  cv::cvtColor(sheet, sheet, cv::COLOR_BGR2RGB);
  return fromOpenCv(sheet).clone();
}

void writeContactSheet(Dataset& dataset, const std::string& path,
                       const ContactSheetOptions& options) {
  exporting::Bytes bytes;
  try {
    if (!cv::imencode(".png", drawSheet(dataset, options), bytes)) {
      throw FileError(path, "cannot be made a PNG");
    }
  } catch (const cv::Exception& error) {
    throw FileError(path, std::string("cannot be made a PNG: ") + error.what());
  }
  exporting::writeWholeFile(path, bytes.data(), bytes.size());
}

}  // namespace v1
}  // namespace gslam
