// Points of one image or of space, as the robust loop goes through them.
#ifndef GSLAM_ESTIMATOR_ROBUST_POINT_SET_H
#define GSLAM_ESTIMATOR_ROBUST_POINT_SET_H

#include <gslam/base/span.h>
#include <gslam/estimator/estimate.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "robust/random_order.h"

namespace gslam {
inline namespace v1 {
namespace detail {

// Where points lie: their mean, and standard deviations along the axes of most, ..., least spread.
template <std::size_t N>
struct Spread {
  Vec<double, N> mean{};
  Vec<double, N> deviations{};
  Mat<double, N, N> axes{};  // of these deviations, in columns
};

// mask: only those that are not 0; null: all. Nothing there: zeros.
Spread<2> spreadOf(Span<const Vec2d> points, const std::uint8_t* mask = nullptr);
Spread<3> spreadOf(Span<const Vec3d> points, const std::uint8_t* mask = nullptr);

// The same without the two points that are farthest from the line (flat = 1) or the plane (flat =
// 2) that fits best: the other dimensions of a model fit one or two matches whatever they are. All
// points where there are fewer than a dozen.
Spread<2> coreSpreadOf(Span<const Vec2d> points, const std::uint8_t* mask, std::size_t flat);
Spread<3> coreSpreadOf(Span<const Vec3d> points, const std::uint8_t* mask, std::size_t flat);

// What points are whose deviations below `noise` mean nothing: Coincident, Collinear, for space
// Planar, or None. Rounding counts as noise, too: a billionth of the distance from the origin.
Degeneracy shapeOf(const Spread<2>& spread, double noise);
Degeneracy shapeOf(const Spread<3>& spread, double noise);

// What all points are together, to rounding. A few that are absurdly far away do not make a line of
// the others.
Degeneracy shapeOfAll(Span<const Vec2d> points);
Degeneracy shapeOfAll(Span<const Vec3d> points);

// Where most points lie, whatever a few others do.
template <std::size_t N>
struct Middle {
  Vec<double, N> centre{};  // medians
  double size = 1;          // median distance from there; never 0
  Vec<double, N> box{};     // sizes of the box around them, a few at each end left out
};

// From the first few hundred of the order, which is random.
Middle<2> middleOf(Span<const Vec2d> points, const RandomOrder& order);
Middle<3> middleOf(Span<const Vec3d> points, const RandomOrder& order);

// Probability that of a point anywhere in a box no coordinate is farther than the threshold from a
// given one; above that of a ball. A box may be flat: points on a plane are on it by no chance.
template <std::size_t N>
double chanceInBox(const Vec<double, N>& box, double threshold) {
  double chance = 1;
  for (std::size_t k = 0; k < N; ++k) {
    if (2 * threshold < box[k]) chance *= 2 * threshold / box[k];
  }
  return chance;
}

// Points in random order about their middle, so that float has digits enough.
template <std::size_t N>
struct PointSet {
  Middle<N> middle;
  double factor;  // of the points
  std::vector<Vec<double, N>> points;
  std::vector<float> columns[N];

  // is_scaled: to a size of 1.
  PointSet(Span<const Vec<double, N>> all, const RandomOrder& order, bool is_scaled)
      : middle(middleOf(all, order)), factor(is_scaled ? 1 / middle.size : 1), points(all.size()) {
    constexpr double kLargestFloat = 1e15;  // its powers are finite, too
    for (std::vector<float>& column : columns) column.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      points[i] = (all[order[i]] - middle.centre) * factor;
      for (std::size_t k = 0; k < N; ++k) {
        const double x = std::min(std::max(points[i][k], -kLargestFloat), kLargestFloat);
        columns[k][i] = static_cast<float>(x);
      }
    }
  }
  const Vec<double, N>& centre() const { return middle.centre; }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_ROBUST_POINT_SET_H
