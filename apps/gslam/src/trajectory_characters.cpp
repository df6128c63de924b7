// The plot of a trajectory in a terminal.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "trajectory_plot.h"

namespace app {
namespace {

constexpr int kMostColumns = 60, kMostRows = 20;
constexpr double kHighLetter = 2;  // height of a letter, widths

// Dots of two kinds; a letter shows several.
class Canvas {
 public:
  Canvas(const PlotView& view, bool is_utf8)
      : view_(view), is_utf8_(is_utf8), across_(is_utf8 ? 2 : 1), down_(is_utf8 ? 4 : 1) {
    const double dot_width = 1.0 / across_, dot_height = kHighLetter / down_;
    // In widths of letters a metre, the same along both axes.
    scale_ = std::min((kMostColumns - dot_width) / std::max(view.width, 1e-12),
                      (kHighLetter * kMostRows - dot_height) / std::max(view.height, 1e-12));
    right_ = scale_ / dot_width;
    up_ = scale_ / dot_height;
    columns_ = std::clamp(int(std::lround(view.width * right_)) / across_ + 1, 1, kMostColumns);
    rows_ = std::clamp(int(std::lround(view.height * up_)) / down_ + 1, 1, kMostRows);
    truth_.assign(std::size_t(columns_ * across_ * rows_ * down_), false);
    estimate_ = truth_;
  }

  void drawTruth(const PlotStroke& stroke) { draw(stroke, truth_, is_utf8_ ? 4 : 1); }
  void drawEstimate(const PlotStroke& stroke) { draw(stroke, estimate_, 1); }
  // @return whether there was no mark yet
  bool mark(const PlotPoint& point, char letter) {
    const Mark added = {column(point.right) / across_, row(point.up) / down_, letter};
    for (const Mark& mark : marks_) {
      if (mark.column == added.column && mark.row == added.row) return false;
    }
    marks_.push_back(added);
    return true;
  }

  std::string line(int row) const {
    std::string text;
    for (int column = 0; column < columns_; ++column) text += letter(column, row);
    return text;
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  struct Mark {
    int column, row;
    char letter;
  };

  // Of dots; the first is on the left and at the top.
  int column(double right) const {
    const long at = std::lround((right - view_.left) * right_);
    return int(std::clamp(at, 0L, long(columns_ * across_ - 1)));
  }
  int row(double up) const {
    const long at = std::lround((view_.bottom + view_.height - up) * up_);
    return int(std::clamp(at, 0L, long(rows_ * down_ - 1)));
  }
  std::size_t place(int column, int row) const {
    return std::size_t(row * columns_ * across_ + column);
  }

  // Each `every`-th dot of the way.
  void draw(const PlotStroke& stroke, std::vector<bool>& dots, int every) {
    double way = 0;  // in dots, since the last that was set
    for (std::size_t i = 0; i < stroke.size(); ++i) {
      const PlotPoint& to = stroke[i];
      if (i == 0) dots[place(column(to.right), row(to.up))] = true;
      if (i == 0) continue;
      const PlotPoint& from = stroke[i - 1];
      const double length = std::hypot((to.right - from.right) * right_, (to.up - from.up) * up_);
      const int parts = int(std::ceil(2 * length)) + 1;
      for (int part = 1; part <= parts; ++part) {
        way += length / parts;
        if (every > 1 && way < every) continue;
        way = 0;
        const double t = double(part) / parts;
        dots[place(column(from.right + t * (to.right - from.right)),
                   row(from.up + t * (to.up - from.up)))] = true;
      }
    }
  }

  std::string letter(int column, int row) const {
    for (const Mark& mark : marks_) {
      if (mark.column == column && mark.row == row) return std::string(1, mark.letter);
    }
    if (is_utf8_) return braille(column, row);
    if (estimate_[place(column, row)]) return "#";
    return truth_[place(column, row)] ? "." : " ";
  }

  // U+2800 and a bit for each dot, in three bytes of UTF-8.
  std::string braille(int column, int row) const {
    static constexpr int kBits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    int code = 0;
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 2; ++x) {
        const std::size_t dot = place(2 * column + x, 4 * row + y);
        if (truth_[dot] || estimate_[dot]) code |= kBits[y][x];
      }
    }
    if (code == 0) return " ";
    return {'\xE2', char(0xA0 | (code >> 6)), char(0x80 | (code & 0x3F))};
  }

  PlotView view_;
  bool is_utf8_;
  int across_, down_;  // dots of a letter
  double scale_ = 1, right_ = 1, up_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<bool> truth_, estimate_;
  std::vector<Mark> marks_;
};

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

std::string framed(const Canvas& canvas, bool is_utf8) {
  const std::string side = is_utf8 ? "│" : "|",
                    edge = repeated(is_utf8 ? "─" : "-", canvas.columns());
  std::string text = is_utf8 ? "┌" + edge + "┐\n" : "+" + edge + "+\n";
  for (int row = 0; row < canvas.rows(); ++row) text += side + canvas.line(row) + side + '\n';
  return text + (is_utf8 ? "└" + edge + "┘\n" : "+" + edge + "+\n");
}

std::string rangeText(int axis, const char* direction, double from, double size) {
  const double step = std::pow(10, std::floor(std::log10(std::max(size, 0.01))) - 2);
  return std::string(1, axisName(axis)) + direction + numberText(from, step) + " to " +
         numberText(from + size, step) + " m";
}

}  // namespace

std::string plotText(const TrajectoryPlot& plot, bool is_utf8) {
  const PlotView view = viewOf(plot);
  if (view.is_empty) return "plot         there are no poses\n";
  Canvas canvas(view, is_utf8);
  const std::vector<PlotStroke> truth = strokesOf(plot.truth, view, 0);
  const std::vector<PlotStroke> estimate = strokesOf(plot.estimate, view, plot.lost_after);
  for (const PlotStroke& stroke : truth) canvas.drawTruth(stroke);
  for (const PlotStroke& stroke : estimate) canvas.drawEstimate(stroke);
  const std::vector<PlotStroke>& way = truth.empty() ? estimate : truth;
  canvas.mark(way.front().front(), 'S');
  const bool has_end = canvas.mark(way.back().back(), 'E');
  return framed(canvas, is_utf8) + rangeText(view.right, " to the right: ", view.left, view.width) +
         ", " + rangeText(view.up, " up: ", view.bottom, view.height) + "; " +
         (is_utf8 ? "dotted: truth, solid: estimate" : ".: truth, #: estimate") +
         (has_end ? ", S: start, E: end\n" : ", S: start and end\n");
}

// As setlocale() would, which the program does not call.
bool isUtf8Environment() {
  for (const char* const name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* const value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    std::string locale;
    for (const char* c = value; *c != '\0'; ++c) {
      if (*c != '-') locale += char(std::tolower(static_cast<unsigned char>(*c)));
    }
    return locale.find("utf8") != std::string::npos;
  }
  return false;
}

}  // namespace app
