#include "rays.h"

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

// Planes around directions that are less than 80 degrees from their mean.
class BoundsMaker {
 public:
  void add(const Vec3f& bearing) { bearings_.push_back(bearing); }

  TileBounds make() const {
    TileBounds bounds;
    Vec3f axis{};
    for (const Vec3f& bearing : bearings_) axis += bearing;
    if (axis.norm() < 1e-3F) {
      bounds.is_wide = !bearings_.empty();
      return bounds;
    }
    axis = axis.normalized();
    const Vec3f side = std::fabs(axis[0]) < 0.9F ? Vec3f{{1, 0, 0}} : Vec3f{{0, 1, 0}};
    const Vec3f right = side - axis * axis.dot(side);
    const Vec3f e1 = right.normalized(), e2 = axis.cross(e1);
    float least[2] = {1e9F, 1e9F}, most[2] = {-1e9F, -1e9F};
    for (const Vec3f& bearing : bearings_) {
      const float forward = bearing.dot(axis);
      if (forward < 0.17F) {
        bounds.is_wide = true;
        return bounds;
      }
      const float at[2] = {bearing.dot(e1) / forward, bearing.dot(e2) / forward};
      for (int k = 0; k < 2; ++k) {
        least[k] = std::min(least[k], at[k]);
        most[k] = std::max(most[k], at[k]);
      }
    }
    // A pixel more on each side, because edges are sampled between the rays.
    const float slack_1 = 0.1F * (most[0] - least[0]) + 1e-4F;
    const float slack_2 = 0.16F * (most[1] - least[1]) + 1e-4F;
    bounds.normals = {{(e1 - (least[0] - slack_1) * axis).normalized(),
                       ((most[0] + slack_1) * axis - e1).normalized(),
                       (e2 - (least[1] - slack_2) * axis).normalized(),
                       ((most[1] + slack_2) * axis - e2).normalized()}};
    return bounds;
  }

 private:
  std::vector<Vec3f> bearings_;
};

void addTile(const RayTile& tile, BoundsMaker& maker) {
  for (int i = 0; i < kTileSize; ++i) {
    if (tile.pitch[i] > 0) maker.add({{tile.x[i], tile.y[i], tile.z[i]}});
  }
}

}  // namespace

Rays::Rays(const Camera& camera)
    : width_(camera.width()),
      height_(camera.height()),
      columns_((width_ + kTileWidth - 1) / kTileWidth),
      rows_((height_ + kTileHeight - 1) / kTileHeight),
      tiles_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  parallelFor(0, static_cast<std::size_t>(rows_), [&](std::size_t row) {
    for (int column = 0; column < columns_; ++column) fill(camera, column, static_cast<int>(row));
  });
}

void Rays::fill(const Camera& camera, int column, int row) {
  RayTile& tile = tiles_[index(column, row)];
  for (int i = 0; i < kTileSize; ++i) {
    const int u = std::min(column * kTileWidth + i % kTileWidth, width_ - 1);
    const int v = std::min(row * kTileHeight + i / kTileWidth, height_ - 1);
    Vec3d bearing = {{0, 0, 1}};
    Mat<double, 3, 2> slope{};
    const bool is_seen = camera.unproject({{double(u), double(v)}}, bearing, &slope);
    if (!is_seen) slope = {};
    tile.x[i] = static_cast<float>(bearing[0]);
    tile.y[i] = static_cast<float>(bearing[1]);
    tile.z[i] = static_cast<float>(bearing[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      tile.du[k][i] = static_cast<float>(slope(k, 0));
      tile.dv[k][i] = static_cast<float>(slope(k, 1));
    }
    const double pitch = std::max(slope.col(0).norm(), slope.col(1).norm());
    tile.pitch[i] = is_seen ? std::max(static_cast<float>(pitch), 1e-6F) : 0;
  }
  BoundsMaker maker;
  addTile(tile, maker);
  tile.bounds = maker.make();
}

TileBounds Rays::bounds(int column, int row, int columns, int rows) const {
  BoundsMaker maker;
  for (int r = row; r < std::min(row + rows, rows_); ++r) {
    for (int c = column; c < std::min(column + columns, columns_); ++c) addTile(tile(c, r), maker);
  }
  return maker.make();
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
