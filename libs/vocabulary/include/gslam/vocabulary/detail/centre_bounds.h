// The nearest centre of each row again and again, while the centres move less and less.
#ifndef GSLAM_VOCABULARY_DETAIL_CENTRE_BOUNDS_H
#define GSLAM_VOCABULARY_DETAIL_CENTRE_BOUNDS_H

#include <gslam/base/simd.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/l2.h>
#include <gslam/vocabulary/detail/tree_view.h>
#include <gslam/vocabulary/detail/visit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// The squares of the L2 distances from a float descriptor to all rows of a visit.
using DistancesFunction = void (*)(const DescriptorFormat& format, std::size_t stride,
                                   const Visit& visit, float* distances);

inline void distancesScalar(const DescriptorFormat& format, std::size_t stride, const Visit& visit,
                            float* distances) {
  const float* const query = reinterpret_cast<const float*>(visit.query);
  for (std::uint32_t c = 0; c < visit.count; ++c) {
    const float* const row = reinterpret_cast<const float*>(visit.rows + c * stride);
    float sum = 0;
    for (std::size_t i = 0; i < format.size; ++i) {
      const float difference = query[i] - row[i];
      sum += difference * difference;
    }
    distances[c] = sum;
  }
}

// Of rows of float32.
inline SimdKernel<DistancesFunction> distancesKernel() {
  return SimdKernel<DistancesFunction>(distancesScalar, GSLAM_IF_X86(distancesSse4<FloatRowsSse4>),
                                       GSLAM_IF_X86(distancesAvx2<FloatRowsAvx2>),
                                       GSLAM_IF_X86(distancesAvx512<FloatRowsAvx512>),
                                       GSLAM_IF_ARM64(distancesNeon<FloatRowsNeon>));
}

// Rows of floats whose nearest centre cannot have changed are not looked at: for each there is a
// bound of the distance to its centre from above, and of that to all others from below, which give
// way as the centres move (G. Hamerly, "Making k-means even faster", SDM 2010). The bounds have
// room for all rounding, so the result is that of nearestRows().
class CentreBounds {
 public:
  explicit CentreBounds(const DescriptorFormat& format)
      : format_(format),
        stride_(strideOf(format)),
        // that of a sum of squares, see settle(); more than that of its root
        error_(static_cast<float>(format.size + 4) * 1.2e-7f) {}

  // Of so many rows nothing is known.
  void begin(std::size_t rows, std::uint32_t clusters) {
    distances_ = distancesKernel().active();
    clusters_ = clusters;
    above_.assign(rows, std::numeric_limits<float>::max());
    below_.assign(rows, 0.0f);
    shifts_.assign(clusters, 0.0f);
    other_shifts_.assign(clusters, 0.0f);
  }

  // The centres are about to be assigned to anew.
  void moveCentres(const std::uint8_t* before, const std::uint8_t* now) {
    for (std::uint32_t k = 0; k < clusters_; ++k) {
      const double square = exactDistance(format_, before + k * stride_, now + k * stride_);
      shifts_[k] = static_cast<float>(std::sqrt(square) * (1 + 1e-6));
    }
    for (std::uint32_t k = 0; k < clusters_; ++k) {
      other_shifts_[k] = 0;
      for (std::uint32_t j = 0; j < clusters_; ++j) {
        if (j != k) other_shifts_[k] = std::max(other_shifts_[k], shifts_[j]);
      }
    }
  }

  // Of row number i, whose nearest centre was `label`: the nearest now.
  std::uint32_t nearest(std::size_t i, const std::uint8_t* row, const std::uint8_t* centres,
                        std::uint32_t label) noexcept {
    above_[i] = (above_[i] + shifts_[label]) * kUp;
    below_[i] = std::max(0.0f, (below_[i] - other_shifts_[label]) * kDown);
    if (above_[i] < below_[i]) return label;
    float distances[64];
    distances_(format_, stride_, Visit{row, centres + label * stride_, 1, 0}, distances);
    above_[i] = std::sqrt(distances[0]) * (1 + error_);
    if (above_[i] < below_[i]) return label;
    return search(i, Visit{row, centres, clusters_, 0});
  }

 private:
  // Two roundings to floats are less than this.
  static constexpr float kUp = 1 + 2.4e-7f;
  static constexpr float kDown = 1 - 2.4e-7f;

  std::uint32_t search(std::size_t i, const Visit& visit) noexcept {
    float distances[64];
    distances_(format_, stride_, visit, distances);
    const std::uint32_t best = settle(format_, stride_, visit, distances).index;
    float second = std::numeric_limits<float>::max();
    for (std::uint32_t k = 0; k < clusters_; ++k) {
      if (k != best) second = std::min(second, distances[k]);
    }
    above_[i] = std::sqrt(distances[best]) * (1 + error_);
    below_[i] = std::sqrt(second) * (1 - error_);
    return best;
  }

  const DescriptorFormat format_;
  const std::size_t stride_;
  const float error_;
  DistancesFunction distances_ = nullptr;
  std::uint32_t clusters_ = 0;
  std::vector<float> above_, below_;          // of each row
  std::vector<float> shifts_, other_shifts_;  // of each centre: its own, the most of any other
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_CENTRE_BOUNDS_H
