// The directions that the pixels of a camera look in, of any model, tile by tile.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_RAYS_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_RAYS_H

#include <gslam/geometry/camera.h>
#include <gslam/geometry/vec.h>

#include <array>
#include <cstddef>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

constexpr int kTileWidth = 16, kTileHeight = 8, kTileSize = kTileWidth * kTileHeight;

/// Four planes through the camera's centre, in front of which all rays of a tile are.
struct TileBounds {
  std::array<Vec3f, 4> normals{};  ///< inwards, length 1
  bool is_wide = false;            ///< too wide for planes: everything is inside
};

/// Bearings of kTileWidth x kTileHeight pixels, row by row; beyond the image the last ones again.
struct RayTile {
  float x[kTileSize], y[kTileSize], z[kTileSize];
  float du[3][kTileSize], dv[3][kTileSize];  ///< change of the bearing from pixel to pixel
  float pitch[kTileSize];                    ///< the larger of the lengths of both; 0: no bearing
  TileBounds bounds;
};

/// Immutable, shared by threads.
class Rays {
 public:
  explicit Rays(const Camera& camera);

  int width() const { return width_; }
  int height() const { return height_; }
  int tileColumns() const { return columns_; }
  int tileRows() const { return rows_; }
  const RayTile& tile(int column, int row) const { return tiles_[index(column, row)]; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  /// Bounds of the tiles [column, column + columns) x [row, row + rows), cut at the image's border.
  TileBounds bounds(int column, int row, int columns, int rows) const;

 private:
  void fill(const Camera& camera, int column, int row);

  int width_, height_, columns_, rows_;
  std::vector<RayTile> tiles_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_RAYS_H
