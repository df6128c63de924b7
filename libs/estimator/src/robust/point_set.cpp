#include "robust/point_set.h"

#include <gslam/geometry/detail/symmetric_eigen.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

template <std::size_t N>
Spread<N> computeSpread(Span<const Vec<double, N>> points, const std::uint8_t* mask) {
  Spread<N> result;
  double count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mask != nullptr && mask[i] == 0) continue;
    result.mean += points[i];
    ++count;
  }
  if (count == 0) return result;
  result.mean /= count;
  Mat<double, N, N> moments{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mask != nullptr && mask[i] == 0) continue;
    const Vec<double, N> d = points[i] - result.mean;
    for (std::size_t r = 0; r < N; ++r) {
      for (std::size_t c = r; c < N; ++c) moments(r, c) += d[r] * d[c];
    }
  }
  moments *= 1 / count;
  const SymmetricEigen<double, N> eigen(moments);
  for (std::size_t k = 0; k < N; ++k) {
    result.deviations[k] = std::sqrt(std::max(eigen.values[k], 0.0));
  }
  result.axes = eigen.vectors;
  return result;
}

template <std::size_t N>
Spread<N> computeCoreSpread(Span<const Vec<double, N>> points, const std::uint8_t* mask,
                            std::size_t flat) {
  constexpr std::ptrdiff_t kFewest = 12;
  std::vector<std::uint8_t> core(mask, mask + points.size());
  Spread<N> spread = computeSpread<N>(points, core.data());
  if (std::count(core.begin(), core.end(), 1) < kFewest) return spread;
  for (int left_out = 0; left_out < 2; ++left_out) {
    double largest = -1;
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (core[i] == 0) continue;
      const Vec<double, N> d = points[i] - spread.mean;
      double squared = 0;
      for (std::size_t k = flat; k < N; ++k) {
        const double along = d.dot(spread.axes.col(k));
        squared += along * along;
      }
      if (!(squared > largest)) continue;
      largest = squared;
      farthest = i;
    }
    core[farthest] = 0;
    spread = computeSpread<N>(points, core.data());
  }
  return spread;
}

template <std::size_t N>
double noiseFloor(const Spread<N>& spread, double noise) {
  // Squares of deviations lose half of the digits.
  return std::max({noise, 1e-7 * spread.deviations[0], 1e-9 * spread.mean.norm()});
}

template <std::size_t N>
Degeneracy computeShapeOfAll(Span<const Vec<double, N>> points) {
  constexpr double kAbsurd = 1e4;  // times the size of most
  const Degeneracy shape = shapeOf(computeSpread<N>(points, nullptr), 0);
  if (shape == Degeneracy::None) return shape;
  RandomOrder order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const Middle<N> middle = middleOf(points, order);
  std::vector<std::uint8_t> is_near(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    is_near[i] = (points[i] - middle.centre).norm() <= kAbsurd * middle.size ? 1 : 0;
  }
  return shapeOf(computeSpread<N>(points, is_near.data()), 0);
}

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The size of the interval of evenly spread values, of which a fiftieth is left out at each end.
double intervalOf(std::vector<double>& values) {
  const std::size_t n = values.size();
  const std::size_t left_out = n < 12 ? 0 : (n + 49) / 50;
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(left_out);
  const auto high = values.end() - static_cast<std::ptrdiff_t>(left_out + 1);
  std::nth_element(values.begin(), low, values.end());
  const double lowest = *low;
  if (high > low) std::nth_element(low + 1, high, values.end());
  const double kept = static_cast<double>(n - 2 * left_out);
  return (*high - lowest) * (kept + 1 + 2 * static_cast<double>(left_out)) / (kept + 1);
}

template <std::size_t N>
Middle<N> computeMiddle(Span<const Vec<double, N>> points, const RandomOrder& order) {
  constexpr std::size_t kMost = 255;
  const std::size_t n = std::min(order.size(), kMost);
  Middle<N> middle;
  if (n == 0) return middle;
  std::vector<double> values(n);
  for (std::size_t k = 0; k < N; ++k) {
    for (std::size_t i = 0; i < n; ++i) values[i] = points[order[i]][k];
    middle.centre[k] = medianOf(values);
    middle.box[k] = intervalOf(values);
  }
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    values[i] = (points[order[i]] - middle.centre).norm();
    if (std::isfinite(values[i])) largest = std::max(largest, values[i]);
  }
  middle.size = medianOf(values);
  // Half of them at one place.
  if (!(middle.size > 0) || !std::isfinite(middle.size)) middle.size = largest;
  if (!(middle.size > 0)) middle.size = 1;
  return middle;
}

}  // namespace

Degeneracy shapeOfAll(Span<const Vec2d> points) {
  return computeShapeOfAll<2>(points);
}
Degeneracy shapeOfAll(Span<const Vec3d> points) {
  return computeShapeOfAll<3>(points);
}

Middle<2> middleOf(Span<const Vec2d> points, const RandomOrder& order) {
  return computeMiddle<2>(points, order);
}
Middle<3> middleOf(Span<const Vec3d> points, const RandomOrder& order) {
  return computeMiddle<3>(points, order);
}

Spread<2> spreadOf(Span<const Vec2d> points, const std::uint8_t* mask) {
  return computeSpread<2>(points, mask);
}

Spread<3> spreadOf(Span<const Vec3d> points, const std::uint8_t* mask) {
  return computeSpread<3>(points, mask);
}

Spread<2> coreSpreadOf(Span<const Vec2d> points, const std::uint8_t* mask, std::size_t flat) {
  return computeCoreSpread<2>(points, mask, flat);
}

Spread<3> coreSpreadOf(Span<const Vec3d> points, const std::uint8_t* mask, std::size_t flat) {
  return computeCoreSpread<3>(points, mask, flat);
}

Degeneracy shapeOf(const Spread<2>& spread, double noise) {
  const double floor = noiseFloor(spread, noise);
  if (!(spread.deviations[0] > floor)) return Degeneracy::Coincident;
  return spread.deviations[1] > floor ? Degeneracy::None : Degeneracy::Collinear;
}

Degeneracy shapeOf(const Spread<3>& spread, double noise) {
  const double floor = noiseFloor(spread, noise);
  if (!(spread.deviations[0] > floor)) return Degeneracy::Coincident;
  if (!(spread.deviations[1] > floor)) return Degeneracy::Collinear;
  return spread.deviations[2] > floor ? Degeneracy::None : Degeneracy::Planar;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
