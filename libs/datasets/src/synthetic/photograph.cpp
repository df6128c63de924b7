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

class Photograph {
 public:
  Photograph(const Picture& picture, ImageKind kind, const Exposure& exposure)
      : picture_(picture), exposure_(exposure), channels_(kind == ImageKind::grey ? 1 : 3),
        is_bgr_(kind == ImageKind::bgr),
        noise_a_(static_cast<std::uint32_t>(exposure.key)),
        noise_b_(static_cast<std::uint32_t>(exposure.key >> 32)) {}

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
    for (int u = 0; u < picture_.width; ++u) {
      const std::size_t at = first + static_cast<std::size_t>(u);
      float du = 0, dv = 0;
      if (exposure_.seconds > 0) {
        du = picture_.move_u[at] * exposure_.seconds;
        dv = picture_.move_v[at] * exposure_.seconds;
      }
      const float length = std::max(std::fabs(du), std::fabs(dv));
      const bool is_sharp = length < 0.25F;
      const int count = is_sharp ? 1 : std::min(kMostSamples, 2 + static_cast<int>(length));
      std::array<float, 3> sum{};
      for (int k = 0; k < count && !is_sharp; ++k) {
        const float part = (static_cast<float>(k) + 0.5F) / static_cast<float>(count) - 0.5F;
        addSample(static_cast<float>(u) + part * du, static_cast<float>(v) + part * dv, sum);
      }
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
        planes[c][u] = is_sharp ? picture_.brightness[c][at] : sum[c] / static_cast<float>(count);
      }
    }
  }

  void addSample(float u, float v, std::array<float, 3>& sum) const {
    u = std::min(std::max(u, 0.0F), static_cast<float>(picture_.width - 1));
    v = std::min(std::max(v, 0.0F), static_cast<float>(picture_.height - 1));
    const int x = std::max(std::min(static_cast<int>(u), picture_.width - 2), 0);
    const int y = std::max(std::min(static_cast<int>(v), picture_.height - 2), 0);
    const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
    const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                    static_cast<std::size_t>(x);
    const std::size_t right = picture_.width > 1 ? 1 : 0;
    const std::size_t below = picture_.height > 1 ? static_cast<std::size_t>(picture_.width) : 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
      const float* const p = &picture_.brightness[c][at];
      const float upper = p[0] + fx * (p[right] - p[0]);
      const float lower = p[below] + fx * (p[below + right] - p[below]);
      sum[c] += upper + fy * (lower - upper);
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
    const NormalTable& normal = NormalTable::get();
    const auto first = static_cast<std::uint32_t>(v * picture_.width);
    const std::uint32_t key = noise_b_ + static_cast<std::uint32_t>(channel) * 0x68E31DA4U;
    for (int u = 0; u < picture_.width; ++u) {
      const std::uint32_t place = (first + static_cast<std::uint32_t>(u)) * 0x9E3779B9U;
      row[u] += exposure_.noise * normal(mix32(mix32(place ^ noise_a_) + key));
    }
  }

  const Picture& picture_;
  const Exposure& exposure_;
  int channels_;
  bool is_bgr_;
  std::uint32_t noise_a_, noise_b_;
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
