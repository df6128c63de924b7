#include <gslam/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hash.h"
#include "sensor_image.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kNearest = 0.05F;  // metres

class DepthRow {
 public:
  DepthRow(const Picture& picture, const Rays& rays, const DepthSensor& sensor)
      : picture_(picture),
        rays_(rays),
        sensor_(sensor),
        farthest_(sensor.is_float ? 1e30F : static_cast<float>(65535 * sensor.unit)) {
    if (sensor.farthest > 0) farthest_ = std::min(farthest_, sensor.farthest);
  }

  // Metres; 0 where there is none.
  void measure(int v, float* out) const {
    const int width = picture_.width;
    const float* const distance = &picture_.distance[static_cast<std::size_t>(v * width)];
    for (int column = 0; column < rays_.tileColumns(); ++column) {
      const RayTile& tile = rays_.tile(column, v / kTileHeight);
      const int first = v % kTileHeight * kTileWidth, u = column * kTileWidth;
      const int count = std::min(kTileWidth, width - u);
      for (int x = 0; x < count; ++x) {
        out[u + x] = tile.pitch[first + x] > 0 ? distance[u + x] * tile.z[first + x] : 0;
      }
    }
    cut(out);
    if (sensor_.noise > 0) {
      std::vector<float> scale(static_cast<std::size_t>(width));
      for (int u = 0; u < width; ++u) {
        scale[static_cast<std::size_t>(u)] = sensor_.noise * out[u] * out[u];
      }
      NormalTable::get().addTo(out, scale.data(), width, static_cast<std::uint32_t>(v * width),
                               sensor_.key);
      cut(out);
    }
    hide(v, out);
  }

 private:
  void cut(float* out) const {
    for (int u = 0; u < picture_.width; ++u) {
      out[u] = ((out[u] >= kNearest) & (out[u] <= farthest_)) ? out[u] : 0;
    }
  }

  void hide(int v, float* out) const {
    const Occluder& dark = sensor_.occluder;
    if (dark.radius <= 0) return;
    for (int u = 0; u < picture_.width; ++u) {
      const float x = static_cast<float>(u) - dark.u, y = static_cast<float>(v) - dark.v;
      if (x * x + y * y < dark.radius * dark.radius) out[u] = 0;
    }
  }

  const Picture& picture_;
  const Rays& rays_;
  const DepthSensor& sensor_;
  float farthest_;
};

}  // namespace

Image measureDepth(const Picture& picture, const Rays& rays, const DepthSensor& sensor) {
  Image image(picture.width, picture.height, sensor.is_float ? PixelType::f32 : PixelType::u16);
  const DepthRow depth(picture, rays, sensor);
  const auto scale = static_cast<float>(1 / sensor.unit);
  ParallelOptions options;
  options.threads = sensor.threads;
  options.grain = 16;
  parallelFor(
      0, static_cast<std::size_t>(picture.height),
      [&](std::size_t row) {
        const int v = static_cast<int>(row);
        if (sensor.is_float) return depth.measure(v, image.row<float>(v));
        std::vector<float> metres(static_cast<std::size_t>(picture.width));
        depth.measure(v, metres.data());
        std::uint16_t* const out = image.row<std::uint16_t>(v);
        for (std::size_t u = 0; u < metres.size(); ++u) {
          out[u] = static_cast<std::uint16_t>(
              static_cast<int>(std::min(metres[u] * scale + 0.5F, 65535.0F)));
        }
      },
      options);
  return image;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
