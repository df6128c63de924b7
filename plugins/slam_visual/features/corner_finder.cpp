#include "features/corner_finder.h"

#include <algorithm>
#include <opencv2/features2d.hpp>

namespace visual {
namespace {

constexpr int kCornerCell =
    35;                     // pixels: each cell of a level may have corners of its own threshold
constexpr int kAround = 4;  // pixels around a corner that FAST and its neighbours look at
constexpr int kTile = kCornerCell + 2 * kAround;
constexpr int kTileColumns = 16;

// The first pixel of part i, of `count` parts of `size` pixels.
int beginOf(int i, int size, int count) noexcept {
  return (i * size + count - 1) / count;
}

}  // namespace

cv::Rect CornerFinder::areaOf(const Pyramid& pyramid, int level) const noexcept {
  const cv::Mat& image = pyramid.level(level);
  const int width = image.cols - 2 * border_, height = image.rows - 2 * border_;
  return width < 1 || height < 1 ? cv::Rect() : cv::Rect(border_, border_, width, height);
}

void CornerFinder::find(const Pyramid& pyramid, std::size_t sheet) {
  tiles_.clear();
  for (int i = pyramid.firstOn(sheet); i < pyramid.endOf(sheet); ++i) {
    const cv::Rect area = areaOf(pyramid, i);
    Level& level = levels_[std::size_t(i)];
    level.spots.clear();
    level.strong = 0;
    level.columns = (area.width + kCornerCell - 1) / kCornerCell;
    level.rows = (area.height + kCornerCell - 1) / kCornerCell;
    level.has_corner.assign(std::size_t(level.columns) * std::size_t(level.rows), 0);
  }
  cv::FAST(pyramid.sheet(sheet), keys_, threshold_, true);
  keep(pyramid, sheet);
  if (least_threshold_ >= threshold_) return;
  for (int i = pyramid.firstOn(sheet); i < pyramid.endOf(sheet); ++i) collectEmpty(pyramid, i);
  if (tiles_.empty()) return;
  copyTiles(pyramid);
  findInTiles();
  for (int i = pyramid.firstOn(sheet); i < pyramid.endOf(sheet); ++i) sortFaint(i);
}

// Those that lie in the area of a level.
void CornerFinder::keep(const Pyramid& pyramid, std::size_t sheet) {
  for (int i = pyramid.firstOn(sheet); i < pyramid.endOf(sheet); ++i) {
    const cv::Rect area = areaOf(pyramid, i);
    if (area.empty()) continue;
    Level& level = levels_[std::size_t(i)];
    const cv::Rect& place = pyramid.place(i);
    // They are in the order of rows.
    const auto is_above = [](const cv::KeyPoint& key, int row) { return int(key.pt.y) < row; };
    const auto begin = std::lower_bound(keys_.begin(), keys_.end(), place.y + area.y, is_above);
    const auto end = std::lower_bound(begin, keys_.end(), place.y + area.y + area.height, is_above);
    for (auto key = begin; key != end; ++key) {
      const int u = int(key->pt.x) - place.x, v = int(key->pt.y) - place.y;
      if (u < area.x || u >= area.x + area.width) continue;
      level.spots.push_back({float(u), float(v), key->response});
      const int column = (u - area.x) * level.columns / area.width;
      const int row = (v - area.y) * level.rows / area.height;
      level.has_corner[std::size_t(row * level.columns + column)] = 1;
    }
    level.strong = level.spots.size();
  }
}

void CornerFinder::collectEmpty(const Pyramid& pyramid, int i) {
  const cv::Rect area = areaOf(pyramid, i);
  const Level& level = levels_[std::size_t(i)];
  for (int row = 0; row < level.rows; ++row) {
    const int top = beginOf(row, area.height, level.rows);
    const int bottom = beginOf(row + 1, area.height, level.rows);
    for (int column = 0; column < level.columns; ++column) {
      if (level.has_corner[std::size_t(row * level.columns + column)] != 0) continue;
      const int left = beginOf(column, area.width, level.columns);
      const int right = beginOf(column + 1, area.width, level.columns);
      tiles_.push_back({i, cv::Rect(area.x + left, area.y + top, right - left, bottom - top)});
    }
  }
}

void CornerFinder::copyTiles(const Pyramid& pyramid) {
  const int rows = (int(tiles_.size()) + kTileColumns - 1) / kTileColumns;
  if (tile_sheet_.rows < rows * kTile) {
    tile_sheet_ = cv::Mat::zeros(rows * kTile, kTileColumns * kTile, CV_8UC1);
  }
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const cv::Rect& cell = tiles_[i].cell;
    const cv::Rect from(cell.x - kAround, cell.y - kAround, cell.width + 2 * kAround,
                        cell.height + 2 * kAround);
    const cv::Rect to(int(i) % kTileColumns * kTile, int(i) / kTileColumns * kTile, from.width,
                      from.height);
    const cv::Mat source = pyramid.level(tiles_[i].level)(from);
    for (int y = 0; y < to.height; ++y) {
      std::copy_n(source.ptr(y), to.width, tile_sheet_.ptr(to.y + y) + to.x);
    }
  }
}

// What earlier images left on the sheet is not inside any cell, and not within reach of it.
void CornerFinder::findInTiles() {
  const int rows = (int(tiles_.size()) + kTileColumns - 1) / kTileColumns;
  cv::FAST(tile_sheet_.rowRange(0, rows * kTile), keys_, least_threshold_, true);
  for (const cv::KeyPoint& key : keys_) {
    const int u = int(key.pt.x), v = int(key.pt.y);
    const auto number = std::size_t(v / kTile * kTileColumns + u / kTile);
    if (number >= tiles_.size()) continue;
    const Tile& tile = tiles_[number];
    const int x = u % kTile - kAround, y = v % kTile - kAround;
    if (x < 0 || y < 0 || x >= tile.cell.width || y >= tile.cell.height) continue;
    levels_[std::size_t(tile.level)].spots.push_back(
        {float(tile.cell.x + x), float(tile.cell.y + y), key.response});
  }
}

// Which tiles lie side by side depends on the levels before: so must not the order.
void CornerFinder::sortFaint(int level) {
  Level& l = levels_[std::size_t(level)];
  std::sort(l.spots.begin() + std::ptrdiff_t(l.strong), l.spots.end(),
            [](const Spot& a, const Spot& b) { return a.v != b.v ? a.v < b.v : a.u < b.u; });
}

}  // namespace visual
