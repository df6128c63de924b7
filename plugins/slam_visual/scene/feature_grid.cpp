#include "scene/feature_grid.h"

#include <algorithm>
#include <cmath>

namespace visual {
namespace {

constexpr double kCellSize = 16;  // pixels

int cellOf(double at, int count) noexcept {
  return int(std::clamp(std::floor(at / kCellSize), 0.0, double(count - 1)));
}

}  // namespace

FeatureGrid::FeatureGrid(gslam::Span<const gslam::Feature> features, int width, int height)
    : columns_(std::max(1, int(std::ceil(width / kCellSize)))),
      rows_(std::max(1, int(std::ceil(height / kCellSize)))),
      begin_(std::size_t(columns_) * std::size_t(rows_) + 1, 0),
      entries_(features.size()) {
  const auto cell = [this](const gslam::Feature& feature) {
    return std::size_t(rowOf(feature.pixel[1])) * std::size_t(columns_) +
           std::size_t(columnOf(feature.pixel[0]));
  };
  for (const gslam::Feature& feature : features) ++begin_[cell(feature) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const gslam::Feature& f = features[i];
    entries_[next[cell(f)]++] = {f.pixel[0], f.pixel[1], f.octave, std::uint32_t(i)};
  }
}

int FeatureGrid::columnOf(double u) const noexcept {
  return cellOf(u, columns_);
}
int FeatureGrid::rowOf(double v) const noexcept {
  return cellOf(v, rows_);
}

void FeatureGrid::near(const gslam::Vec2d& pixel, double radius, int first, int last,
                       std::vector<std::uint32_t>& found) const {
  if (entries_.empty()) return;
  const double left = pixel[0] - radius, right = pixel[0] + radius;
  const double top = pixel[1] - radius, bottom = pixel[1] + radius;
  const int first_column = columnOf(left), last_column = columnOf(right);
  for (int row = rowOf(top), last_row = rowOf(bottom); row <= last_row; ++row) {
    const std::size_t cells = std::size_t(row) * std::size_t(columns_);
    const std::uint32_t end = begin_[cells + std::size_t(last_column) + 1];
    for (std::uint32_t i = begin_[cells + std::size_t(first_column)]; i < end; ++i) {
      const Entry& e = entries_[i];
      if (double(e.u) >= left && double(e.u) <= right && double(e.v) >= top &&
          double(e.v) <= bottom && e.octave >= first && e.octave <= last) {
        found.push_back(e.feature);
      }
    }
  }
}

}  // namespace visual
