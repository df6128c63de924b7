#ifndef GSLAM_GEOMETRY_MEAN_H
#define GSLAM_GEOMETRY_MEAN_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/geometry/detail/rotation_matrix.h>
#include <gslam/geometry/nearest_rotation.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

/// @file
/// Means of many rotations or poses.

namespace gslam {
inline namespace v1 {

/// What the search for a mean came to.
enum class MeanStatus {
  unique,        ///< found, and there is no other
  ambiguous,     ///< found one, but a rotation is a quarter turn or more away: there may be others
  not_converged  ///< not found; the elements are spread too far
};

/// A sentence for people.
/// @param status  what mean() said
inline const char* meanStatusText(MeanStatus status) {
  static const char* const texts[] = {
      "found the only mean",
      "found a mean that need not be the only one: a rotation is a quarter turn or more away",
      "found no mean: the elements are spread too far"};
  const std::size_t index = static_cast<std::size_t>(status);
  return index < sizeof(texts) / sizeof(texts[0]) ? texts[index] : "no status of a mean";
}

/// What mean() found.
template <class G>
struct Mean {
  G value;                         ///< the mean; where not converged, the last guess
  MeanStatus status;               ///< whether it is one
  int iterations;                  ///< steps it took
  typename G::Scalar last_length;  ///< length of the last step in the tangent space

  /// Whether a mean was found.
  bool isConverged() const noexcept { return status != MeanStatus::not_converged; }
};

namespace detail {

/// The weights, or equal ones, divided by their sum.
template <class T>
std::vector<T> meanWeights(std::size_t count, Span<const T> weights) {
  if (count == 0) throw ArgumentError("elements", "are none, expected one or more");
  if (weights.empty()) return std::vector<T>(count, 1 / static_cast<T>(count));
  if (weights.size() != count) {
    throw ArgumentError("weights", "are " + std::to_string(weights.size()) +
                                       ", expected as many as elements, " + std::to_string(count));
  }
  T sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(weights[i] >= 0)) {
      throw ArgumentError("weight", "number " + std::to_string(i) + " is " +
                                        numberText(weights[i]) + ", expected 0 or more");
    }
    sum += weights[i];
  }
  if (!(sum > 0 && sum <= std::numeric_limits<T>::max())) {
    throw ArgumentError("weights",
                        "have the sum " + numberText(sum) + ", expected a finite one above 0");
  }
  std::vector<T> normalized(weights.begin(), weights.end());
  for (T& weight : normalized) weight /= sum;
  return normalized;
}

// The rotations of the elements, to start from.
template <class T>
const SO3<T>& rotationOf(const SO3<T>& r) noexcept {
  return r;
}
template <class T>
const SO2<T>& rotationOf(const SO2<T>& r) noexcept {
  return r;
}
template <class G>
auto rotationOf(const G& g) noexcept -> decltype(g.rotation()) {
  return g.rotation();
}

template <class G, class T>
NearestRotation<T> chordalMean(Span<const G> elements, const std::vector<T>& weights,
                               const SO3<T>*) {
  Mat<T, 3, 3> sum{};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    sum += weights[i] * rotationOf(elements[i]).matrix();
  }
  return nearestRotation(sum);
}

template <class T>
struct PlanarMean {
  SO2<T> rotation;
  bool is_unique;
};
template <class G, class T>
PlanarMean<T> chordalMean(Span<const G> elements, const std::vector<T>& weights, const SO2<T>*) {
  Vec<T, 2> sum{};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const SO2<T>& r = rotationOf(elements[i]);
    sum += weights[i] * Vec<T, 2>{{r.cosine(), r.sine()}};
  }
  if (!(sum.norm() > 16 * std::numeric_limits<T>::epsilon()))
    return {rotationOf(elements[0]), false};
  return {SO2<T>::fromComplex(sum[0], sum[1]), true};
}

// The first guess: means of the parts, each as if the others were not there.
template <class G, class Rotation>
struct MeanStart;
template <class R>
struct MeanStart<R, R> {
  static R of(const R& rotation, Span<const R>, const std::vector<typename R::Scalar>&) {
    return rotation;
  }
};
template <class G, class R, class T>
typename R::Point meanTranslation(Span<const G> elements, const std::vector<T>& weights) {
  typename R::Point sum{};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (weights[i] > 0) sum += weights[i] * elements[i].translation();
  }
  return sum;
}
template <class T>
struct MeanStart<SE2<T>, SO2<T>> {
  static SE2<T> of(const SO2<T>& r, Span<const SE2<T>> elements, const std::vector<T>& weights) {
    return SE2<T>(r, meanTranslation<SE2<T>, SO2<T>>(elements, weights));
  }
};
template <class T>
struct MeanStart<SE3<T>, SO3<T>> {
  static SE3<T> of(const SO3<T>& r, Span<const SE3<T>> elements, const std::vector<T>& weights) {
    return SE3<T>(r, meanTranslation<SE3<T>, SO3<T>>(elements, weights));
  }
};
template <class T>
struct MeanStart<SIM3<T>, SO3<T>> {
  static SIM3<T> of(const SO3<T>& r, Span<const SIM3<T>> elements, const std::vector<T>& weights) {
    T log_scale = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (weights[i] > 0) log_scale += weights[i] * std::log(elements[i].scale());
    }
    return SIM3<T>(r, meanTranslation<SIM3<T>, SO3<T>>(elements, weights), std::exp(log_scale));
  }
};

}  // namespace detail

/// The chordal mean of rotations: the rotation with the least sum of squared chordal distances,
/// that is, the one nearest to the mean of the matrices. (R. Hartley, J. Trumpf, Y. Dai, H. Li,
/// "Rotation averaging", IJCV 103, 2013, section 5.3)
/// @param rotations  one or more
/// @param weights    as many, 0 or more, not all 0; none: all equal
/// @return the mean, and how far the mean of the matrices is from a rotation
/// @throws ArgumentError when there are none, or the weights are wrong
template <class T>
NearestRotation<T> chordalMean(Span<const SO3<T>> rotations, Span<const T> weights = {}) {
  return detail::chordalMean(rotations, detail::meanWeights(rotations.size(), weights),
                             static_cast<const SO3<T>*>(nullptr));
}
/// @copydoc chordalMean(Span<const SO3<T>>, Span<const T>)
template <class T>
NearestRotation<T> chordalMean(const std::vector<SO3<T>>& rotations,
                               const std::vector<T>& weights = {}) {
  return chordalMean(Span<const SO3<T>>(rotations), Span<const T>(weights));
}

/// The element m with sum of w_i log(m^-1 x_i) = 0.
///
/// Of rotations it has the least sum of squared angles (Karcher's or Fréchet's mean). Of poses and
/// similarities there is no distance that both sides of a product leave as it is; m is the mean
/// that needs none, and has the same property: the mean of a x_i b is a m b, and that of the
/// inverses m^-1. The order of the elements makes no difference but by rounding.
///
/// Found by m <- m exp(sum of w_i log(m^-1 x_i)) from the chordal mean on, until the steps are
/// rounding, at most 100. Where all rotations are less than a quarter turn away from the mean, it
/// is the only one.
///
/// Sources: H. Karcher, Comm. Pure Appl. Math. 30, 1977; J. Manton, "A globally convergent
/// numerical algorithm for computing the centre of mass on compact Lie groups", ICARCV 2004; X.
/// Pennec, V. Arsigny, "Exponential barycenters of the canonical Cartan connection and invariant
/// means on Lie groups", 2012.
/// @param elements  one or more of SO2, SO3, SE2, SE3 or SIM3
/// @param weights   as many, 0 or more, not all 0; none: all equal
/// @throws ArgumentError when there are none, or the weights are wrong
template <class G>
Mean<G> mean(Span<const G> elements, Span<const typename G::Scalar> weights = {}) {
  using T = typename G::Scalar;
  using Rotation = typename std::decay<decltype(detail::rotationOf(elements[0]))>::type;
  constexpr int kMostSteps = 100;
  const T epsilon = std::numeric_limits<T>::epsilon();
  const std::vector<T> w = detail::meanWeights(elements.size(), weights);
  const auto start = detail::chordalMean(elements, w, static_cast<const Rotation*>(nullptr));
  Mean<G> result{detail::MeanStart<G, Rotation>::of(start.rotation, elements, w),
                 MeanStatus::not_converged, 0, std::numeric_limits<T>::infinity()};
  for (bool found = false; !found && result.iterations < kMostSteps; ++result.iterations) {
    const G back = result.value.inverse();
    typename G::Tangent step{};
    T farthest = 0;
    T widest = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (w[i] == 0) continue;
      const G way = back * elements[i];
      const typename G::Tangent log = way.log();
      step += w[i] * log;
      farthest = std::fmax(farthest, log.norm());
      widest = std::fmax(widest, std::fabs(detail::rotationOf(way).angle()));
    }
    const T length = step.norm();
    // The steps are rounding when they no longer shrink, which happens early far from the origin.
    const bool stays = length >= result.last_length;
    found = length <= 4 * epsilon * (1 + farthest) ||
            (stays && length <= std::sqrt(epsilon) * (1 + farthest));
    result.last_length = length;
    if (!(length <= std::numeric_limits<T>::max())) break;
    result.value = (result.value * G::exp(step)).normalized();
    if (!found) continue;
    const T quarter = T(1.57079632679489661923);
    const bool narrow = widest < quarter * (1 - 64 * epsilon);
    result.status = start.is_unique && narrow ? MeanStatus::unique : MeanStatus::ambiguous;
  }
  return result;
}
/// @copydoc mean(Span<const G>, Span<const typename G::Scalar>)
template <class G>
Mean<G> mean(const std::vector<G>& elements, const std::vector<typename G::Scalar>& weights = {}) {
  return mean(Span<const G>(elements), Span<const typename G::Scalar>(weights));
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_MEAN_H
