#include "small/pose_tiles.h"

#include <algorithm>

#include "factors/is_before.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

// Points that are not seen from the start weigh -1. They stand at 0, since kernels multiply what
// comes of them by a weight of 0, which does not help where it overflows.
struct HidePoints {
  using Result = bool;
  const SE3d& T_camera_world;
  PoseTile& tile;

  void hide(std::size_t k) const {
    PoseBlock& block = tile.block;
    for (double* column : {block.x, block.y, block.z, block.u, block.v}) column[k] = 0;
    block.weight[k] = -1;
    block.right[k] = kNoRight;
  }

  template <class Model>
  bool operator()(const Model& model) const {
    const Mat<double, 3, 4> p = T_camera_world.matrix3x4();
    const PoseBlock& block = tile.block;
    for (std::size_t k = 0; k < tile.count; ++k) {
      Vec3d point;
      for (std::size_t r = 0; r < 3; ++r) {
        point[r] = p(r, 0) * block.x[k] + p(r, 1) * block.y[k] + p(r, 2) * block.z[k] + p(r, 3);
      }
      if (!IsBefore{point}(model)) hide(k);
    }
    return true;
  }
  bool none() const {
    for (std::size_t k = 0; k < tile.count; ++k) hide(k);
    return true;
  }
};

// Lanes that complete a register repeat the last observation, and weigh nothing.
void padTile(PoseTile& tile) {
  PoseBlock& block = tile.block;
  for (std::size_t k = tile.count; k % kPoseLanes != 0; ++k) {
    for (double* column : {block.x, block.y, block.z, block.u, block.v}) {
      column[k] = column[tile.count - 1];
    }
    block.weight[k] = -1;
    block.right[k] = kNoRight;
  }
}

}  // namespace

void PoseTiles::fill(std::size_t c, std::size_t begin, PoseTile& tile) const {
  std::size_t index[kPoseBlock];
  std::size_t i = begin, count = 0;
  for (; i < problem_.points.size() && count < kPoseBlock; ++i) {
    if (isOf(i, c)) index[count++] = i;
  }
  tile.begin = begin;
  tile.end = i;
  tile.count = count;
  if (count == 0) return;
  put(index, tile);
  (void)problem_.cameras[c].visit(HidePoints{cameraOfBody(problem_, c) * start_.inverse(), tile});
  padTile(tile);
}

// Column by column: loops that compilers make short.
void PoseTiles::put(const std::size_t* index, PoseTile& tile) const {
  PoseBlock& block = tile.block;
  for (std::size_t k = 0; k < tile.count; ++k) {
    const Vec3d& point = problem_.points[index[k]];
    block.x[k] = point[0], block.y[k] = point[1], block.z[k] = point[2];
  }
  for (std::size_t k = 0; k < tile.count; ++k) {
    const Vec2d& pixel = problem_.pixels[index[k]];
    block.u[k] = pixel[0], block.v[k] = pixel[1];
  }
  for (std::size_t k = 0; k < tile.count; ++k) {
    block.weight[k] = problem_.information.empty() ? 1.0 : problem_.information[index[k]];
  }
  if (problem_.right_u.empty()) return;
  for (std::size_t k = 0; k < tile.count; ++k) {
    const double right = problem_.right_u[index[k]];
    block.right[k] = right > kNoRight ? right : kNoRight;  // NaN is not
  }
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
