#include <gslam/base/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hash.h"
#include "sensor_image.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kMiddleGrey = 112;
constexpr float kOccluderGrey = 22;
constexpr int kMostSamples = 16;
constexpr std::uint64_t kChannelStep = 0x68E31DA4B5297A4DU;

class Photograph {
 public:
  Photograph(const Picture& picture, ImageKind kind, const Exposure& exposure)
      : picture_(picture),
        exposure_(exposure),
        channels_(kind == ImageKind::grey ? 1 : 3),
        is_bgr_(kind == ImageKind::bgr) {}

  void makeRow(int v, std::uint8_t* out) const {
    const auto width = static_cast<std::size_t>(picture_.width);
    std::vector<float> light(width * 3);
    float* const planes[3] = {light.data(), light.data() + width, light.data() + 2 * width};
    smear(v, planes);
    for (int c = 0; c < channels_; ++c) {
      develop(v, planes[c]);
      addNoise(v, c, planes[c]);
      const int to = is_bgr_ ? 2 - c : c;
      for (std::size_t u = 0; u < width; ++u) {
        const float x = std::min(std::max(planes[c][u] + 0.5F, 0.0F), 255.0F);
        out[u * static_cast<std::size_t>(channels_) + static_cast<std::size_t>(to)] =
            static_cast<std::uint8_t>(x);
      }
    }
  }

 private:
  // The mean along the way of each pixel's light while the shutter is open, around its middle.
  void smear(int v, float* const* planes) const {
    const auto first = static_cast<std::size_t>(v) * static_cast<std::size_t>(picture_.width);
    for (int c = 0; c < channels_; ++c) {
      const std::vector<float>& plane = picture_.brightness[static_cast<std::size_t>(c)];
      std::copy_n(plane.begin() + static_cast<std::ptrdiff_t>(first), picture_.width, planes[c]);
    }
    if (exposure_.seconds <= 0 || picture_.width < 2 || picture_.height < 2) return;
    for (int u = 0; u < picture_.width; ++u) {
      const std::size_t at = first + static_cast<std::size_t>(u);
      const float du = picture_.move_u[at] * exposure_.seconds;
      const float dv = picture_.move_v[at] * exposure_.seconds;
      const float length = std::max(std::fabs(du), std::fabs(dv));
      if (length < 0.3F) continue;
      const int count = std::min(kMostSamples, 2 + static_cast<int>(length));
      const float step = 1 / static_cast<float>(count);
      std::array<float, 3> sum{};
      for (int k = 0; k < count; ++k) {
        const float part = (static_cast<float>(k) + 0.5F) * step - 0.5F;
        addSample(static_cast<float>(u) + part * du, static_cast<float>(v) + part * dv, sum);
      }
      for (int c = 0; c < channels_; ++c) planes[c][u] = sum[static_cast<std::size_t>(c)] * step;
    }
  }

  void addSample(float u, float v, std::array<float, 3>& sum) const {
    // Below the last whole number, so that there are four pixels around it.
    u = std::min(std::max(u, 0.0F), static_cast<float>(picture_.width) - 1.001F);
    v = std::min(std::max(v, 0.0F), static_cast<float>(picture_.height) - 1.001F);
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
    const std::ptrdiff_t width = picture_.width;
    for (int c = 0; c < channels_; ++c) {
      const float* const p =
          picture_.brightness[static_cast<std::size_t>(c)].data() + y * width + x;
      const float upper = p[0] + fx * (p[1] - p[0]);
      const float lower = p[width] + fx * (p[width + 1] - p[width]);
      sum[static_cast<std::size_t>(c)] += upper + fy * (lower - upper);
    }
  }

  void develop(int v, float* row) const {
    const float half_u = 0.5F * static_cast<float>(picture_.width);
    const float half_v = 0.5F * static_cast<float>(picture_.height);
    const float scale = exposure_.vignette / (half_u * half_u + half_v * half_v);
    const float dv = static_cast<float>(v) - half_v;
    const float contrast = exposure_.contrast, ground = kMiddleGrey * (1 - contrast);
    for (int u = 0; u < picture_.width; ++u) {
      const float du = static_cast<float>(u) - half_u;
      const float fall = 1 - scale * (du * du + dv * dv);
      row[u] = (row[u] * contrast + ground) * (exposure_.gain * fall);
    }
    const Occluder& dark = exposure_.occluder;
    if (dark.radius <= 0) return;
    for (int u = 0; u < picture_.width; ++u) {
      const float x = static_cast<float>(u) - dark.u, y = static_cast<float>(v) - dark.v;
      const float inside = dark.radius - std::sqrt(x * x + y * y);
      const float part = std::min(std::max(inside / 12 + 0.5F, 0.0F), 1.0F);  // out of focus
      row[u] += part * (kOccluderGrey - row[u]);
    }
  }

  void addNoise(int v, int channel, float* row) const {
    if (exposure_.noise <= 0) return;
    const std::vector<float> scale(static_cast<std::size_t>(picture_.width), exposure_.noise);
    const std::uint64_t key = exposure_.key + static_cast<std::uint64_t>(channel) * kChannelStep;
    NormalTable::get().addTo(row, scale.data(), picture_.width,
                             static_cast<std::uint32_t>(v * picture_.width), key);
  }

  const Picture& picture_;
  const Exposure& exposure_;
  int channels_;
  bool is_bgr_;
};

}  // namespace

Image photograph(const Picture& picture, ImageKind kind, const Exposure& exposure) {
  Image image(picture.width, picture.height, PixelType::u8, kind == ImageKind::grey ? 1 : 3);
  const Photograph photograph(picture, kind, exposure);
  ParallelOptions options;
  options.threads = exposure.threads;
  options.grain = 16;
  parallelFor(
      0, static_cast<std::size_t>(picture.height),
      [&](std::size_t v) {
        photograph.makeRow(static_cast<int>(v), image.bytes(static_cast<int>(v)));
      },
      options);
  return image;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
