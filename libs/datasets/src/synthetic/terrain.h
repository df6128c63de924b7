// Hills: heights on a grid, two triangles a cell.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_TERRAIN_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_TERRAIN_H

#include <gslam/geometry/vec.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

class Terrain {
 public:
  /// A square around the origin, -half to half in x and y, of count x count cells.
  Terrain(float half, int count, const std::function<float(float x, float y)>& height);

  /// Height at a place inside.
  float height(float x, float y) const;
  /// Half the edge of the square.
  float half() const { return half_; }
  /// The greatest height.
  float top() const { return top_; }

  /// Where a ray meets the surface.
  /// @param origin, ray  world coordinates; the ray has length 1
  /// @param distance     result
  /// @param normal       result: of the triangle, length 1
  bool intersect(const Vec3f& origin, const Vec3f& ray, float& distance, Vec3f& normal) const;

 private:
  float corner(int i, int j) const {
    return heights_[static_cast<std::size_t>(j * (count_ + 1) + i)];
  }
  bool hitCell(int i, int j, const Vec3f& origin, const Vec3f& ray, float from, float to,
               float& distance, Vec3f& normal) const;

  float half_, cell_, top_ = -1e9F, bottom_ = 1e9F;
  int count_;
  std::vector<float> heights_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_TERRAIN_H
