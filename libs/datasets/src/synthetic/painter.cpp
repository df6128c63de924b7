#include "painter.h"

#include <algorithm>
#include <cmath>

#include "brush.h"
#include "patterns.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

Painter::Painter(std::uint64_t key)
    : key_(key), coarse_(keyOf(key, 1), 2, 7, 0.6F), fine_(keyOf(key, 2), 5, 8, 0.9F) {}

Texture Painter::paint(Material material, float width, float height, float texel) {
  const Brush brush(coarse_, fine_, keyOf(key_, 3, ++count_));
  const auto fill = [&](const auto& pattern) { return Texture(width, height, texel, pattern); };
  switch (material) {
    case Material::wallpaper:
      return fill(Wallpaper{brush});
    case Material::plaster:
      return fill(Plaster{brush});
    case Material::bricks:
      return fill(Bricks{brush});
    case Material::planks:
      return fill(Planks{brush});
    case Material::tiles:
      return fill(Tiles{brush});
    case Material::carpet:
      return fill(Carpet{brush, width, height});
    case Material::concrete:
      return fill(Concrete{brush});
    case Material::ceiling:
      return fill(Ceiling{brush});
    case Material::poster:
      return fill(Poster{brush, width, height});
    case Material::notices:
      return fill(Notices{brush});
    case Material::books:
      return fill(Books{brush});
    case Material::crate:
      return fill(Crate{brush});
    case Material::fabric:
      return fill(Fabric{brush});
    case Material::metal:
      return fill(Metal{brush});
    case Material::facade:
      return fill(Facade{brush, 0});
    case Material::shop:
      return fill(Facade{brush, 1});
    case Material::asphalt:
      return fill(Asphalt{brush, width, height});
    case Material::pavement:
      return fill(Pavement{brush});
    case Material::car:
      return fill(Car{brush});
    case Material::leaves:
      return fill(Leaves{brush});
    case Material::bark:
      return fill(Bark{brush});
    case Material::roof:
      return fill(Roof{brush});
    case Material::land:
      return fill(Land{brush});
  }
  return fill(Concrete{brush});
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
