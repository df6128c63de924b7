#ifndef GSLAM_GEOMETRY_DETAIL_BATCH_OPERATIONS_H
#define GSLAM_GEOMETRY_DETAIL_BATCH_OPERATIONS_H

#include <gslam/base/error.h>
#include <gslam/geometry/detail/batch_elements.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <string>
#include <type_traits>

/// @file
/// What a batch may do to its elements, and by the functions of the classes what batch_formulas.h
/// has no formula for.

namespace gslam {
inline namespace v1 {
namespace detail {

/// From elements of type From to elements of type To.
template <class From, class To>
struct Operation {
  using Scalar = typename ElementFacts<To>::Scalar;
  static constexpr std::size_t kFrom = ElementFacts<From>::kNumbers;
  static constexpr std::size_t kTo = ElementFacts<To>::kNumbers;
  static constexpr bool kHasFormula = true;  // in batch_formulas.h
  static constexpr bool kIsFormulaForAll = true;

  /// One element by the functions of the classes; called where there is no formula for it.
  static void one(const Scalar*, Scalar*, std::size_t) noexcept {}
};

template <class G>
struct Exp : Operation<typename G::Tangent, G> {
  using T = typename G::Scalar;
  static constexpr bool kHasFormula = !std::is_same<G, SIM3<T>>::value;
  static constexpr bool kIsFormulaForAll = false;  // for angles up to half a turn

  /// @param index  of the element, for what is thrown
  static void one(const T* x, T* y, std::size_t index) {
    try {
      putNumbers(G::exp(elementOf<typename G::Tangent>(x)), y);
    } catch (const ArgumentError& e) {
      throw ArgumentError("element " + std::to_string(index) + " of tangents",
                          std::string("is refused: ") + e.what());
    }
  }
};

template <class G>
struct Log : Operation<G, typename G::Tangent> {
  using T = typename G::Scalar;
  static constexpr bool kHasFormula = !std::is_same<G, SIM3<T>>::value;

  static void one(const T* x, T* y, std::size_t) noexcept { putNumbers(elementOf<G>(x).log(), y); }
};

template <class G>
struct Inverse : Operation<G, G> {};

/// Of two elements side by side.
template <class G>
struct Compose : Operation<G, G> {
  static constexpr std::size_t kFrom = 2 * ElementFacts<G>::kNumbers;
};

/// Of a transform and a point side by side.
template <class G>
struct ActOnOne : Operation<G, typename G::Point> {
  static constexpr std::size_t kFrom = ElementFacts<G>::kNumbers + 3;
};

/// One transform for all points, as p' = A p + t.
template <class T>
struct ActOnAll : Operation<Vec<T, 3>, Vec<T, 3>> {
  Mat<T, 3, 3> a;
  Vec<T, 3> t;

  explicit ActOnAll(const SO3<T>& r) noexcept : a(r.matrix()), t{} {}
  explicit ActOnAll(const SE3<T>& pose) noexcept
      : a(pose.rotation().matrix()), t(pose.translation()) {}
  explicit ActOnAll(const SIM3<T>& s) noexcept
      : a(s.scale() * s.rotation().matrix()), t(s.translation()) {}
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_BATCH_OPERATIONS_H
