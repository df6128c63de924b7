#include "render.h"

#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "shade.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kMostMotion = 20000;  // pixels a second

std::size_t pixelCount(const Rays& rays) {
  return static_cast<std::size_t>(rays.width()) * static_cast<std::size_t>(rays.height());
}

Vec3f bearingOf(const RayTile& tile, int i) {
  return {{tile.x[i], tile.y[i], tile.z[i]}};
}

}  // namespace

Renderer::Renderer(std::shared_ptr<const Rays> rays)
    : rays_(std::move(rays)),
      block_columns_((rays_->tileColumns() + kBlock - 1) / kBlock),
      block_rows_((rays_->tileRows() + kBlock - 1) / kBlock),
      candidates_(static_cast<std::size_t>(rays_->tileColumns()) *
                  static_cast<std::size_t>(rays_->tileRows())),
      primitive_(pixelCount(*rays_)) {
  for (int row = 0; row < block_rows_; ++row) {
    for (int column = 0; column < block_columns_; ++column) {
      block_bounds_.push_back(rays_->bounds(column * kBlock, row * kBlock, kBlock, kBlock));
    }
  }
  picture_.width = rays_->width();
  picture_.height = rays_->height();
  picture_.distance.resize(pixelCount(*rays_));
}

const Picture& Renderer::render(const Scene& scene, const SE3d& T_world_camera, double seconds,
                                const CameraMotion& motion, const RenderOptions& options) {
  picture_.is_colour = options.colour;
  for (std::size_t c = 0; c < (options.colour ? 3U : 1U); ++c) {
    picture_.brightness[c].resize(pixelCount(*rays_));
  }
  if (options.motion) {
    picture_.move_u.resize(pixelCount(*rays_));
    picture_.move_v.resize(pixelCount(*rays_));
  }
  const View view(scene, T_world_camera, seconds);
  ParallelOptions parallel;
  parallel.threads = options.threads;
  parallelFor(
      0, block_bounds_.size(), [&](std::size_t block) { traceBlock(view, block); }, parallel);
  parallelFor(
      0, static_cast<std::size_t>(rays_->tileRows()),
      [&](std::size_t row) {
        for (int column = 0; column < rays_->tileColumns(); ++column) {
          shadePixels(view, column, static_cast<int>(row));
          if (options.motion) {
            setMotion(rays_->tile(column, static_cast<int>(row)), motion, column,
                      static_cast<int>(row));
          }
        }
      },
      parallel);
  return picture_;
}

void Renderer::traceBlock(const View& view, std::size_t block) {
  const int first_column = static_cast<int>(block) % block_columns_ * kBlock;
  const int first_row = static_cast<int>(block) / block_columns_ * kBlock;
  std::vector<std::int32_t> in_block;
  for (std::size_t k = 0; k < view.primitives.size(); ++k) {
    if (View::mayBeInside(view.primitives[k], block_bounds_[block])) {
      in_block.push_back(static_cast<std::int32_t>(k));
    }
  }
  TileHits hits;
  for (int row = first_row; row < std::min(first_row + kBlock, rays_->tileRows()); ++row) {
    for (int column = first_column; column < std::min(first_column + kBlock, rays_->tileColumns());
         ++column) {
      const RayTile& tile = rays_->tile(column, row);
      std::vector<std::int32_t>& in_tile = candidates_[rays_->index(column, row)];
      in_tile.clear();
      for (const std::int32_t k : in_block) {
        if (View::mayBeInside(view.primitives[static_cast<std::size_t>(k)], tile.bounds)) {
          in_tile.push_back(k);
        }
      }
      trace(view, tile, in_tile, hits);
      for (int i = 0; i < kTileSize; ++i) {
        const int u = column * kTileWidth + i % kTileWidth, v = row * kTileHeight + i / kTileWidth;
        if (u >= picture_.width || v >= picture_.height) continue;
        const auto at = static_cast<std::size_t>(v * picture_.width + u);
        picture_.distance[at] = hits.distance[i];
        primitive_[at] = hits.primitive[i];
      }
    }
  }
}

void Renderer::shadePixels(const View& view, int column, int row) {
  const RayTile& tile = rays_->tile(column, row);
  const std::vector<std::int32_t>& candidates = candidates_[rays_->index(column, row)];
  const int first_u = column * kTileWidth, first_v = row * kTileHeight;
  if (shadeUniform(view, tile, first_u, first_v, candidates)) return;
  for (int i = 0; i < kTileSize; ++i) {
    const int u = first_u + i % kTileWidth, v = first_v + i / kTileWidth;
    if (u >= picture_.width || v >= picture_.height) continue;
    store(static_cast<std::size_t>(v * picture_.width + u),
          shadePixel(view, tile, i, u, v, candidates));
  }
}

void Renderer::store(std::size_t at, const Colour& colour) {
  picture_.brightness[0][at] = picture_.is_colour ? colour.r : greyOf(colour);
  if (!picture_.is_colour) return;
  picture_.brightness[1][at] = colour.g;
  picture_.brightness[2][at] = colour.b;
}

// A whole tile that sees one surface; its edges may be on the tile's border only.
bool Renderer::shadeUniform(const View& view, const RayTile& tile, int first_u, int first_v,
                            const std::vector<std::int32_t>& candidates) {
  if (first_u + kTileWidth > picture_.width || first_v + kTileHeight > picture_.height) {
    return false;
  }
  const auto width = static_cast<std::size_t>(picture_.width);
  const std::size_t first =
      static_cast<std::size_t>(first_v) * width + static_cast<std::size_t>(first_u);
  const std::int32_t k = primitive_[first];
  if (k < 0) return false;
  float distances[kTileSize];
  for (std::size_t y = 0; y < kTileHeight; ++y) {
    for (std::size_t x = 0; x < kTileWidth; ++x) {
      if (primitive_[first + y * width + x] != k) return false;
      distances[y * kTileWidth + x] = picture_.distance[first + y * width + x];
    }
  }
  TileShades shades;
  const SeenPrimitive& primitive = view.primitives[static_cast<std::size_t>(k)];
  detail::synthetic::shadeTile(view, primitive, tile, distances, shades);
  const Surface& surface = primitive.from->surface;
  for (int i = 0; i < kTileSize; ++i) {
    const int x = i % kTileWidth, y = i / kTileWidth;
    const bool is_border = x == 0 || y == 0 || x == kTileWidth - 1 || y == kTileHeight - 1;
    const std::size_t at =
        first + static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
    if (!(tile.pitch[i] > 0)) {
      store(at, {0, 0, 0});
    } else if (is_border && isEdge(first_u + x, first_v + y)) {
      store(at, shadeEdge(view, tile, i, candidates));
    } else {
      store(at, mixed(surface.dark, surface.bright, shades.part[i]) * shades.light[i]);
    }
  }
  return true;
}

Colour Renderer::shadePixel(const View& view, const RayTile& tile, int i, int u, int v,
                            const std::vector<std::int32_t>& candidates) const {
  if (!(tile.pitch[i] > 0)) return {0, 0, 0};
  if (isEdge(u, v)) return shadeEdge(view, tile, i, candidates);
  const auto at = static_cast<std::size_t>(v * picture_.width + u);
  const std::int32_t k = primitive_[at];
  const Vec3f ray = bearingOf(tile, i);
  if (k < 0) return shadeSky(view, ray);
  return shade(view, view.primitives[static_cast<std::size_t>(k)], ray, picture_.distance[at],
               tile.pitch[i]);
}

bool Renderer::isEdge(int u, int v) const {
  const auto at = static_cast<std::size_t>(v * picture_.width + u);
  const auto width = static_cast<std::size_t>(picture_.width);
  const std::int32_t k = primitive_[at];
  return (u > 0 && primitive_[at - 1] != k) ||
         (u + 1 < picture_.width && primitive_[at + 1] != k) ||
         (v > 0 && primitive_[at - width] != k) ||
         (v + 1 < picture_.height && primitive_[at + width] != k);
}

// The mean of four places within the pixel.
Colour Renderer::shadeEdge(const View& view, const RayTile& tile, int i,
                           const std::vector<std::int32_t>& candidates) const {
  const Vec3f du = {{tile.du[0][i], tile.du[1][i], tile.du[2][i]}};
  const Vec3f dv = {{tile.dv[0][i], tile.dv[1][i], tile.dv[2][i]}};
  Colour sum{0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    const Vec3f beside = bearingOf(tile, i) + (k % 2 == 0 ? -0.25F : 0.25F) * du +
                         (k / 2 == 0 ? -0.25F : 0.25F) * dv;
    const Vec3f ray = beside / std::sqrt(beside.squaredNorm());
    float distance = 0;
    const std::int32_t found = traceOne(view, ray, candidates, distance);
    sum = sum + (found < 0 ? shadeSky(view, ray)
                           : shade(view, view.primitives[static_cast<std::size_t>(found)], ray,
                                   distance, tile.pitch[i]));
  }
  return sum * 0.25F;
}

// The bearing b of a point at rest changes by -w x b - v / distance, and in its own direction;
// du and dv say how many pixels that is.
void Renderer::setMotion(const RayTile& tile, const CameraMotion& motion, int column, int row) {
  const Vec3f v_camera = motion.velocity, w = motion.turning;
  const int columns = std::min(kTileWidth, picture_.width - column * kTileWidth);
  const int rows = std::min(kTileHeight, picture_.height - row * kTileHeight);
  for (int y = 0; y < rows; ++y) {
    const int first = (row * kTileHeight + y) * picture_.width + column * kTileWidth;
    const float* const distance = &picture_.distance[static_cast<std::size_t>(first)];
    float* const move_u = &picture_.move_u[static_cast<std::size_t>(first)];
    float* const move_v = &picture_.move_v[static_cast<std::size_t>(first)];
    for (int x = 0; x < columns; ++x) {
      const int i = y * kTileWidth + x;
      const float near = 1 / distance[x];
      const float bx = tile.x[i], by = tile.y[i], bz = tile.z[i];
      const float cx = -(w[1] * bz - w[2] * by) - near * v_camera[0];
      const float cy = -(w[2] * bx - w[0] * bz) - near * v_camera[1];
      const float cz = -(w[0] * by - w[1] * bx) - near * v_camera[2];
      const float ux = tile.du[0][i], uy = tile.du[1][i], uz = tile.du[2][i];
      const float vx = tile.dv[0][i], vy = tile.dv[1][i], vz = tile.dv[2][i];
      const float uu = ux * ux + uy * uy + uz * uz, vv = vx * vx + vy * vy + vz * vz;
      const float uv = ux * vx + uy * vy + uz * vz;
      const float cu = cx * ux + cy * uy + cz * uz, cv = cx * vx + cy * vy + cz * vz;
      const float scale = 1 / std::max(uu * vv - uv * uv, 1e-24F);
      move_u[x] = std::min(std::max((vv * cu - uv * cv) * scale, -kMostMotion), kMostMotion);
      move_v[x] = std::min(std::max((uu * cv - uv * cu) * scale, -kMostMotion), kMostMotion);
    }
  }
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
