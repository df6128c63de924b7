// What callers give, made ready for problems: bearings of length 1, and only what has a bearing.
#ifndef GSLAM_ESTIMATOR_ROBUST_INPUT_RAYS_H
#define GSLAM_ESTIMATOR_ROBUST_INPUT_RAYS_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/estimator/options.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Bearings of length 1; refuses one without a direction.
bool normalise(const char* name, Span<const Vec3d> from, std::vector<Vec3d>& to,
               EstimateSummary& summary);

// Refuses Camera().
bool checkCamera(const char* name, const Camera& camera, EstimateSummary& summary);

// Bearing of a pixel with its derivative; false where there is none that can be used.
bool unprojectPixel(const Camera& camera, const Vec2d& pixel, Vec3d& bearing,
                    Mat<double, 3, 2>& by_pixel);

// The matches that take part; the others are outliers. Where all do, the options are the caller's.
class Participants {
 public:
  // @param is_in  1 for each match that takes part
  Participants(const std::vector<std::uint8_t>& is_in, const EstimateOptions& options);

  std::size_t size() const { return indices_.size(); }
  // The caller's number of each.
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  const EstimateOptions& options() const { return options_; }

  template <class T>
  std::vector<T> pick(Span<const T> all) const {
    std::vector<T> picked;
    picked.reserve(size());
    for (const std::uint32_t i : indices_) picked.push_back(all[i]);
    return picked;
  }
  // Makes the mask that of all matches again.
  void restore(EstimateSummary& summary) const;

 private:
  std::size_t all_;
  std::vector<std::uint32_t> indices_;
  std::vector<float> quality_;
  EstimateOptions options_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_INPUT_RAYS_H
