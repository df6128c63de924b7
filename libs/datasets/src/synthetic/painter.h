// Paints the textures: bricks, planks, posters, facades, fields.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_PAINTER_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_PAINTER_H

#include <cstdint>

#include "noise_field.h"
#include "texture.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

enum class Material {
  wallpaper,
  plaster,
  bricks,
  planks,
  tiles,
  carpet,
  concrete,
  ceiling,
  poster,
  notices,
  books,
  crate,
  fabric,
  metal,
  facade,
  shop,
  asphalt,
  pavement,
  car,
  leaves,
  bark,
  roof,
  land
};

/// Every material has details of a few pixels as it is mostly seen, and no two textures are equal.
/// May be used by one thread; painting uses several.
class Painter {
 public:
  explicit Painter(std::uint64_t key);

  /// @param width, height  metres
  /// @param texel          metres
  Texture paint(Material material, float width, float height, float texel);

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
  NoiseField coarse_, fine_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_PAINTER_H
