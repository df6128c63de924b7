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
      : picture_(picture), rays_(rays), sensor_(sensor),
        farthest_(sensor.is_float ? 1e30F : static_cast<float>(65535 * sensor.unit)),
        noise_a_(static_cast<std::uint32_t>(sensor.key)),
        noise_b_(static_cast<std::uint32_t>(sensor.key >> 32)) {
    if (sensor.farthest > 0) farthest_ = std::min(farthest_, sensor.farthest);
  }

  // Metres; 0 where there is none.
  void measure(int v, float* out) const {
    for (int column = 0; column < rays_.tileColumns(); ++column) {
      const RayTile& tile = rays_.tile(column, v / kTileHeight);
      const int first = v % kTileHeight * kTileWidth, u = column * kTileWidth;
      const int count = std::min(kTileWidth, picture_.width - u);
      for (int x = 0; x < count; ++x) out[u + x] = at(tile, first + x, u + x, v);
    }
  }

 private:
  float at(const RayTile& tile, int i, int u, int v) const {
    const int place = v * picture_.width + u;
    float depth = picture_.distance[static_cast<std::size_t>(place)] * tile.z[i];
    const bool is_seen = depth >= kNearest && depth <= farthest_ && tile.pitch[i] > 0;
    if (!is_seen || isHidden(u, v)) return 0;
    if (sensor_.noise > 0) {
      const std::uint32_t key = static_cast<std::uint32_t>(place) * 0x9E3779B9U ^ noise_a_;
      depth += sensor_.noise * depth * depth * NormalTable::get()(mix32(mix32(key) + noise_b_));
      if (!(depth >= kNearest && depth <= farthest_)) return 0;
    }
    return depth;
  }

  bool isHidden(int u, int v) const {
    if (sensor_.occluder.radius <= 0) return false;
    const float x = static_cast<float>(u) - sensor_.occluder.u;
    const float y = static_cast<float>(v) - sensor_.occluder.v;
    return x * x + y * y < sensor_.occluder.radius * sensor_.occluder.radius;
  }

  const Picture& picture_;
  const Rays& rays_;
  const DepthSensor& sensor_;
  float farthest_;
  std::uint32_t noise_a_, noise_b_;
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
