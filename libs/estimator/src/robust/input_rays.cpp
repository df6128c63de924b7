#include "robust/input_rays.h"

#include <cmath>
#include <string>

#include "robust/input_check.h"

namespace gslam {
inline namespace v1 {
namespace detail {

bool normalise(const char* name, Span<const Vec3d> from, std::vector<Vec3d>& to,
               EstimateSummary& summary) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double norm = from[i].norm();
    if (!(norm > 0 && std::isfinite(norm))) {
      return refuseInput(std::string(name) + "[" + std::to_string(i) + "] has no direction",
                         summary);
    }
    to[i] = from[i] / norm;
  }
  return true;
}

bool checkCamera(const char* name, const Camera& camera, EstimateSummary& summary) {
  if (camera.isValid()) return true;
  return refuseInput(std::string(name) + " is none, expected one with a model", summary);
}

bool unprojectPixel(const Camera& camera, const Vec2d& pixel, Vec3d& bearing,
                    Mat<double, 3, 2>& by_pixel) {
  if (!camera.unproject(pixel, bearing, &by_pixel)) return false;
  double sum = bearing.squaredNorm();
  for (const double d : by_pixel.values) sum += d * d;
  const Vec3d across = by_pixel.col(0).cross(by_pixel.col(1));
  return std::isfinite(sum) && across.squaredNorm() > 0;
}

Participants::Participants(const std::vector<std::uint8_t>& is_in, const EstimateOptions& options)
    : all_(is_in.size()), options_(options) {
  for (std::size_t i = 0; i < all_; ++i) {
    if (is_in[i] != 0) indices_.push_back(static_cast<std::uint32_t>(i));
  }
  if (size() == all_ || options.quality.empty()) return;
  quality_ = pick(options.quality);
  options_.quality = quality_;
}

void Participants::restore(EstimateSummary& summary) const {
  if (size() == all_) return;
  std::vector<std::uint8_t> inliers(all_);
  for (std::size_t i = 0; i < summary.inliers.size(); ++i) {
    inliers[indices_[i]] = summary.inliers[i];
  }
  summary.inliers = inliers;
  summary.inlier_ratio = static_cast<double>(summary.inlier_count) / static_cast<double>(all_);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
