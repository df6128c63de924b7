// The PNG of a trajectory.
#include <gslam/base/error.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "trajectory_plot.h"

namespace app {
namespace {

const cv::Scalar kPaper(255, 255, 255), kGrid(232, 232, 232), kFrame(150, 150, 150),
    kInk(40, 40, 40), kPaleInk(110, 110, 110), kTruth(90, 90, 90),
    kNoError(200, 160, 120);                                        // blue, green, red
constexpr int kLeft = 120, kTop = 110, kRight = 250, kBottom = 90;  // pixels around the plot
constexpr int kLongSide = 1000, kShortSide = 560;                   // of the plot, pixels
constexpr int kShift = 4;  // bits behind the point of a pixel
constexpr double kMargin = 0.05;

// One line of text; OpenCV's letters are ASCII.
class Pen {
 public:
  Pen(cv::Mat& sheet, double scale, const cv::Scalar& colour)
      : sheet_(sheet), scale_(scale), colour_(colour) {}

  // Its middle is at a height; it lies right of `x` by a part of its width, which may be below 0.
  void write(std::string text, double x, double y, double part = 0) const {
    for (char& c : text) {
      if (c < 0x20 || c > 0x7E) c = '?';
    }
    const cv::Size size = sizeOf(text);
    cv::putText(sheet_, text, cv::Point(int(x + part * size.width), int(y) + size.height / 2),
                kFont, scale_, colour_, 1, cv::LINE_AA);
  }
  // The end of a text that is too wide: of paths that is what tells.
  std::string fitted(std::string text, int width) const {
    if (sizeOf(text).width <= width) return text;
    while (!text.empty() && sizeOf("..." + text).width > width) text.erase(0, 1 + text.size() / 16);
    return "..." + text;
  }

 private:
  static constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  cv::Size sizeOf(const std::string& text) const {
    int base = 0;
    return cv::getTextSize(text, kFont, scale_, 1, &base);
  }

  cv::Mat& sheet_;
  double scale_;
  cv::Scalar colour_;
};

// Colours of errors from 0 to a round number.
class ErrorColours {
 public:
  explicit ErrorColours(const std::vector<PlottedPose>& poses) {
    double most = 0;
    for (const PlottedPose& pose : poses) {
      if (!std::isfinite(pose.error)) continue;
      most = std::max(most, pose.error);
      has_errors_ = true;
    }
    if (!(most > 1e-9)) most = 1e-9;  // an estimate that is the truth
    is_centimetres_ = most < 1;
    step_ = roundStep(most / unit() / 5);
    steps_ = int(std::ceil(most / unit() / step_ - 1e-9));
    cv::Mat index(256, 1, CV_8U);
    // The ends of the map are too dark to be told apart.
    for (int i = 0; i < 256; ++i) index.at<std::uint8_t>(i, 0) = std::uint8_t(18 + i * 220 / 255);
    cv::applyColorMap(index, colours_, cv::COLORMAP_TURBO);
  }

  bool hasErrors() const { return has_errors_; }
  double unit() const { return is_centimetres_ ? 0.01 : 1; }  // metres
  const char* unitName() const { return is_centimetres_ ? "cm" : "m"; }
  double step() const { return step_; }  // between two numbers of the scale, in its unit
  int steps() const { return steps_; }

  // Of a part of the scale, 0 to 1.
  cv::Scalar at(double part) const {
    return colours_.at<cv::Vec3b>(int(255 * std::clamp(part, 0.0, 1.0)), 0);
  }
  cv::Scalar of(double error) const {
    return std::isfinite(error) ? at(error / (unit() * step_ * steps_)) : kNoError;
  }

 private:
  bool has_errors_ = false, is_centimetres_ = true;
  double step_ = 1;
  int steps_ = 1;
  cv::Mat colours_;
};

class Picture {
 public:
  explicit Picture(const TrajectoryPlot& plot)
      : plot_(plot), view_(viewOf(plot)), colours_(plot.estimate) {
    const double aspect = std::clamp(view_.height / std::max(view_.width, 1e-12), 0.01, 100.0);
    plot_size_.width = aspect < 1 ? kLongSide : std::max(kShortSide, int(kLongSide / aspect));
    plot_size_.height = aspect > 1 ? kLongSide : std::max(kShortSide, int(kLongSide * aspect));
    const double of_plot = 1 - 2 * kMargin;
    scale_ = of_plot * std::min(plot_size_.width / std::max(view_.width, 1e-12),
                                plot_size_.height / std::max(view_.height, 1e-12));
    sheet_ = cv::Mat(plot_size_.height + kTop + kBottom, plot_size_.width + kLeft + kRight, CV_8UC3,
                     kPaper);
  }

  cv::Mat draw() {
    drawGrid();
    drawEstimate();
    drawTruth();
    drawEnds();
    drawLegend();
    if (view_.is_empty) {
      Pen(sheet_, 0.8, kPaleInk)
          .write("no poses", kLeft + plot_size_.width / 2, kTop + plot_size_.height / 2, -0.5);
    }
    const int width = sheet_.cols - kLeft - 20;
    const Pen large(sheet_, 0.85, kInk), small(sheet_, 0.5, kPaleInk);
    large.write(large.fitted(plot_.title, width), kLeft, 38);
    small.write(small.fitted(plot_.subtitle, width), kLeft, 76);
    return sheet_;
  }

 private:
  // Pixels, the middle of the poses in the middle of the plot.
  double x(double right) const {
    return kLeft + 0.5 * plot_size_.width + scale_ * (right - (view_.left + 0.5 * view_.width));
  }
  double y(double up) const {
    return kTop + 0.5 * plot_size_.height - scale_ * (up - (view_.bottom + 0.5 * view_.height));
  }
  cv::Point fine(const PlotPoint& p) const {
    const double ones = 1 << kShift;
    return cv::Point(int(std::lround(ones * x(p.right))), int(std::lround(ones * y(p.up))));
  }

  void drawGrid() {
    const double step = roundStep(110 / scale_);
    const Pen pen(sheet_, 0.5, kInk);
    const cv::Rect place(cv::Point(kLeft, kTop), plot_size_);
    const double half_width = 0.5 * plot_size_.width / scale_;
    const double half_height = 0.5 * plot_size_.height / scale_;
    const double middle = view_.left + 0.5 * view_.width;
    const double level = view_.bottom + 0.5 * view_.height;
    const double first = std::ceil((middle - half_width) / step);
    for (int i = 0; (first + i) * step <= middle + half_width; ++i) {
      const int at = int(std::lround(x((first + i) * step)));
      cv::line(sheet_, {at, place.y}, {at, place.br().y}, kGrid, 1);
      pen.write(numberText((first + i) * step, step), at, place.br().y + 22, -0.5);
    }
    const double lowest = std::ceil((level - half_height) / step);
    for (int i = 0; (lowest + i) * step <= level + half_height; ++i) {
      const int at = int(std::lround(y((lowest + i) * step)));
      cv::line(sheet_, {place.x, at}, {place.br().x, at}, kGrid, 1);
      pen.write(numberText((lowest + i) * step, step), place.x - 12, at, -1);
    }
    cv::rectangle(sheet_, place, kFrame, 1);
    const Pen name(sheet_, 0.6, kInk);
    name.write(std::string(1, axisName(view_.right)) + " [m]", place.x + place.width / 2,
               place.br().y + 58, -0.5);
    name.write(std::string(1, axisName(view_.up)) + " [m]", place.x - 12, place.y - 18, -1);
  }

  // A stroke of one pose is a dot.
  void drawEstimate() {
    for (const PlotStroke& stroke : strokesOf(plot_.estimate, view_, plot_.lost_after)) {
      if (stroke.size() == 1) dot(stroke.front(), 3, colours_.of(stroke.front().error));
      for (std::size_t i = 1; i < stroke.size(); ++i) {
        const double error = 0.5 * (stroke[i - 1].error + stroke[i].error);
        cv::line(sheet_, fine(stroke[i - 1]), fine(stroke[i]), colours_.of(error), 5, cv::LINE_AA,
                 kShift);
      }
    }
  }

  // Thin, and above the estimate, so that both are seen where they are the same.
  void drawTruth() {
    for (const PlotStroke& stroke : strokesOf(plot_.truth, view_, 0)) {
      if (stroke.size() == 1) dot(stroke.front(), 2, kTruth);
      for (std::size_t i = 1; i < stroke.size(); ++i) {
        cv::line(sheet_, fine(stroke[i - 1]), fine(stroke[i]), kTruth, 1, cv::LINE_AA, kShift);
      }
    }
  }

  void dot(const PlotPoint& point, int radius, const cv::Scalar& colour) {
    cv::circle(sheet_, fine(point), radius << kShift, colour, cv::FILLED, cv::LINE_AA, kShift);
  }

  void drawStart(const cv::Point& at) {
    cv::circle(sheet_, at, 10, kPaper, cv::FILLED, cv::LINE_AA);
    cv::circle(sheet_, at, 10, kInk, 2, cv::LINE_AA);
  }
  void drawEnd(const cv::Point& at) { cv::circle(sheet_, at, 6, kInk, cv::FILLED, cv::LINE_AA); }

  // Smaller than the start, so that both are seen where they are the same.
  void drawEnds() {
    const std::vector<PlotStroke> truth = strokesOf(plot_.truth, view_, 0);
    const std::vector<PlotStroke> strokes =
        truth.empty() ? strokesOf(plot_.estimate, view_, plot_.lost_after) : truth;
    if (strokes.empty()) return;
    const PlotPoint &start = strokes.front().front(), &end = strokes.back().back();
    drawStart(cv::Point(int(std::lround(x(start.right))), int(std::lround(y(start.up)))));
    drawEnd(cv::Point(int(std::lround(x(end.right))), int(std::lround(y(end.up)))));
  }

  void drawLegend() {
    const int left = kLeft + plot_size_.width + 30, text = left + 45;
    const Pen pen(sheet_, 0.5, kInk);
    int at = kTop + 15;
    drawStart({left + 15, at});
    pen.write("start", text, at);
    drawEnd({left + 15, at += 32});
    pen.write("end", text, at);
    at += 32;
    cv::line(sheet_, {left, at}, {left + 30, at}, kTruth, 1, cv::LINE_AA);
    pen.write("ground truth", text, at);
    at += 32;
    if (!colours_.hasErrors()) return;
    pen.write(std::string("estimate, error [") + colours_.unitName() + "]", left, at);
    drawScale({left, at + 25}, pen);
  }

  void drawScale(const cv::Point& corner, const Pen& pen) {
    const cv::Size size(30, 300);
    for (int row = 0; row < size.height; ++row) {
      const cv::Point from(corner.x, corner.y + row);
      cv::line(sheet_, from, from + cv::Point(size.width, 0),
               colours_.at(1 - double(row) / (size.height - 1)), 1);
    }
    for (int i = 0; i <= colours_.steps(); ++i) {
      const int at = corner.y + int(std::lround(size.height * (1 - double(i) / colours_.steps())));
      cv::line(sheet_, {corner.x + size.width, at}, {corner.x + size.width + 6, at}, kInk, 1);
      pen.write(numberText(i * colours_.step(), colours_.step()), corner.x + size.width + 15, at);
    }
  }

  const TrajectoryPlot& plot_;
  PlotView view_;
  ErrorColours colours_;
  cv::Size plot_size_;
  double scale_ = 1;  // pixels a metre
  cv::Mat sheet_;
};

}  // namespace

void writePlot(const TrajectoryPlot& plot, const std::string& path) {
  std::vector<unsigned char> bytes;
  try {
    cv::imencode(".png", Picture(plot).draw(), bytes);
  } catch (const cv::Exception& error) {
    throw gslam::FileError(path, std::string("cannot be made a PNG: ") + error.what());
  }
  const char* const kProblem = "cannot be written; choose a file in a folder that is there";
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) throw gslam::FileError(path, kProblem, errno);
  const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int error = errno;
  if (std::fclose(file) != 0) throw gslam::FileError(path, kProblem, errno);
  if (!is_written) throw gslam::FileError(path, kProblem, error);
}

}  // namespace app
