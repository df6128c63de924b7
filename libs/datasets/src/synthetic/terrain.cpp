#include "terrain.h"

#include <algorithm>
#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {
namespace {

constexpr float kSlack = 1e-4F;  // of a cell: neighbours share their borders

// The piece of the ray that is within low <= origin + t ray <= high.
void clip(float origin, float ray, float low, float high, float& from, float& to) {
  if (std::fabs(ray) < 1e-9F) {
    if (origin < low || origin > high) to = -1;
    return;
  }
  const float a = (low - origin) / ray, b = (high - origin) / ray;
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
}

}  // namespace

Terrain::Terrain(float half, int count, const std::function<float(float, float)>& height)
    : half_(half), cell_(2 * half / static_cast<float>(count)), count_(count) {
  for (int j = 0; j <= count; ++j) {
    for (int i = 0; i <= count; ++i) {
      const float h = height(static_cast<float>(i) * cell_ - half_,  //
                             static_cast<float>(j) * cell_ - half_);
      heights_.push_back(h);
      top_ = std::max(top_, h);
      bottom_ = std::min(bottom_, h);
    }
  }
}

float Terrain::height(float x, float y) const {
  const float gx = (x + half_) / cell_, gy = (y + half_) / cell_;
  const int i = std::min(std::max(static_cast<int>(gx), 0), count_ - 1);
  const int j = std::min(std::max(static_cast<int>(gy), 0), count_ - 1);
  const float u = gx - static_cast<float>(i), v = gy - static_cast<float>(j);
  const float h00 = corner(i, j), h11 = corner(i + 1, j + 1);
  if (u >= v) return h00 + u * (corner(i + 1, j) - h00) + v * (h11 - corner(i + 1, j));
  return h00 + v * (corner(i, j + 1) - h00) + u * (h11 - corner(i, j + 1));
}

bool Terrain::intersect(const Vec3f& origin, const Vec3f& ray, float& distance,
                        Vec3f& normal) const {
  float from = 0, to = 1e9F;
  clip(origin[0], ray[0], -half_, half_, from, to);
  clip(origin[1], ray[1], -half_, half_, from, to);
  clip(origin[2], ray[2], bottom_ - 0.01F, top_ + 0.01F, from, to);
  if (from >= to) return false;
  const auto cellOf = [this](float x) {
    return std::min(std::max(static_cast<int>((x + half_) / cell_), 0), count_ - 1);
  };
  int i = cellOf(origin[0] + from * ray[0]), j = cellOf(origin[1] + from * ray[1]);
  const int step_i = ray[0] > 0 ? 1 : -1, step_j = ray[1] > 0 ? 1 : -1;
  const float inverse_x = std::fabs(ray[0]) > 1e-9F ? 1 / ray[0] : 1e9F;
  const float inverse_y = std::fabs(ray[1]) > 1e-9F ? 1 / ray[1] : 1e9F;
  while (from < to && i >= 0 && j >= 0 && i < count_ && j < count_) {
    const float border_x = static_cast<float>(i + (step_i > 0)) * cell_ - half_;
    const float border_y = static_cast<float>(j + (step_j > 0)) * cell_ - half_;
    const float leave_x = std::fabs((border_x - origin[0]) * inverse_x);
    const float leave_y = std::fabs((border_y - origin[1]) * inverse_y);
    const float leave = std::min(leave_x, leave_y);
    if (hitCell(i, j, origin, ray, from, leave, distance, normal)) return true;
    from = leave;
    if (leave_x < leave_y) {
      i += step_i;
    } else {
      j += step_j;
    }
  }
  return false;
}

bool Terrain::hitCell(int i, int j, const Vec3f& origin, const Vec3f& ray, float from, float to,
                      float& distance, Vec3f& normal) const {
  const float h00 = corner(i, j), h10 = corner(i + 1, j), h01 = corner(i, j + 1);
  const float h11 = corner(i + 1, j + 1);
  const float lowest = std::min(origin[2] + from * ray[2], origin[2] + to * ray[2]);
  if (lowest > std::max(std::max(h00, h10), std::max(h01, h11)) + 0.01F) return false;
  const float x = static_cast<float>(i) * cell_ - half_, y = static_cast<float>(j) * cell_ - half_;
  bool found = false;
  for (int half = 0; half < 2; ++half) {  // below the diagonal, then above it
    const float slope_x = (half == 0 ? h10 - h00 : h11 - h01) / cell_;
    const float slope_y = (half == 0 ? h11 - h10 : h01 - h00) / cell_;
    const float rate = ray[2] - slope_x * ray[0] - slope_y * ray[1];
    if (rate > -1e-9F) continue;  // from below
    const float above = origin[2] - h00 - slope_x * (origin[0] - x) - slope_y * (origin[1] - y);
    const float t = -above / rate;
    const float u = (origin[0] + t * ray[0] - x) / cell_, v = (origin[1] + t * ray[1] - y) / cell_;
    if (t <= 0 || u < -kSlack || v < -kSlack || u > 1 + kSlack || v > 1 + kSlack) continue;
    if (half == 0 ? v > u + kSlack : u > v + kSlack) continue;
    if (found && t >= distance) continue;
    found = true;
    distance = t;
    const float scale = 1 / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
    normal = {{-slope_x * scale, -slope_y * scale, scale}};
  }
  return found;
}

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam
