#ifndef GSLAM_GEOMETRY_BATCH_H
#define GSLAM_GEOMETRY_BATCH_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/geometry/detail/batch_kernels.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <string>
#include <type_traits>

/// @file
/// Rotations, poses, similarities and points by the thousand: what SO3, SE3 and SIM3 do with one,
/// for all elements of arrays, by the best SIMD variant of the machine (see gslam/base/simd.h).
///
///     transformPoints(T_world_camera, points, points);         // one transform, in place
///     composeMany<SE3d>(T_world_body, T_body_camera, poses);   // N products
///     expMany<SE3d>(tangents, poses);
///
/// Elements stand in arrays of structures, `Span<const Vec3d>`, or in structures of arrays,
/// `Arrays<const double, 3>`, which is the faster one of the two. Any number of them, at any
/// address that is right for T; none is fine.
///
/// Results are those of the classes up to rounding: the bounds that SO3 and SE3 state hold here,
/// too, and the two differ by a few epsilon. They are the same bits in every place of an array, in
/// place or not, and from rows or arrays, on one machine with one variant. exp and log of SIM3 go
/// through its class one by one.
///
/// In place: an output may be an input of the call. They must not overlap in any other way.
///
/// Errors: ArgumentError where sizes differ, before anything is written. expMany throws one, too,
/// for an element that the class' exp refuses, and names the first; what was written before stays.
/// All other functions hand on what is not finite as IEEE says.
///
/// Thread-safety: functions of their arguments; threads may work on parts of the same arrays.

namespace gslam {
inline namespace v1 {

/// K arrays that somebody else owns, of the same length: number k of element i is
/// `component(k)[i]`.
///
/// The components stand in the order in which they stand in the element itself: x y z of points and
/// rotation vectors, x y z w of rotations (unit quaternions; this is not checked), qx qy qz qw tx
/// ty tz of SE3, these and the scale of SIM3, (translation, rotation[, log scale]) of tangents.
///
/// `Arrays<T, K>` converts to `Arrays<const T, K>`. Cheap to copy; safe to share as far as the
/// elements are.
template <class T, std::size_t K>
class Arrays {
 public:
  /// `Arrays<double, 3>({x, y, z}, n)`
  /// @param components  where each of the K arrays begins
  /// @param size        number of elements
  /// @throws ArgumentError when there are elements and an array is missing (null)
  Arrays(T* const (&components)[K], std::size_t size) : size_(size) {
    for (std::size_t k = 0; k < K; ++k) {
      columns_.column[k] = components[k];
      if (components[k] == nullptr && size != 0) {
        throw ArgumentError("component " + std::to_string(k),
                            "is null, expected " + std::to_string(K) + " arrays");
      }
    }
  }

  /// Views the same elements as const.
  template <class U, class = typename std::enable_if<std::is_same<const U, T>::value>::type>
  Arrays(const Arrays<U, K>& other) noexcept  // NOLINT(google-explicit-constructor)
      : size_(other.size()) {
    for (std::size_t k = 0; k < K; ++k) columns_.column[k] = other.component(k);
  }

  /// Number of elements.
  std::size_t size() const noexcept { return size_; }
  /// Array number k, unchecked.
  T* component(std::size_t k) const noexcept { return columns_.column[k]; }
  /// For the functions below.
  const detail::Columns<T, K>& columns() const noexcept { return columns_; }

 private:
  detail::Columns<T, K> columns_;
  std::size_t size_;
};

/// Elements of type E as arrays: `ArraysOf<SE3d>` is `Arrays<double, 7>`, `ArraysOf<const Vec3d>`
/// is `Arrays<const double, 3>`.
template <class E>
using ArraysOf = Arrays<typename std::conditional<std::is_const<E>::value,
                                                  const typename detail::ElementFacts<E>::Scalar,
                                                  typename detail::ElementFacts<E>::Scalar>::type,
                        detail::ElementFacts<E>::kNumbers>;

namespace detail {

template <class E>
Rows<const typename ElementFacts<E>::Scalar, ElementFacts<E>::kNumbers> viewOf(Span<const E> s) {
  static_assert(IsRow<E>::value, "an element is its numbers and nothing else");
  return {reinterpret_cast<const typename ElementFacts<E>::Scalar*>(s.data())};
}
template <class E>
Rows<typename ElementFacts<E>::Scalar, ElementFacts<E>::kNumbers> viewOf(Span<E> s) {
  static_assert(IsRow<E>::value, "an element is its numbers and nothing else");
  return {reinterpret_cast<typename ElementFacts<E>::Scalar*>(s.data())};
}
template <class T, std::size_t K>
const Columns<T, K>& viewOf(const Arrays<T, K>& a) {
  return a.columns();
}

inline void checkSameSize(const char* names, std::size_t in, std::size_t out) {
  if (in == out) return;
  throw ArgumentError(names, "have " + std::to_string(in) + " and " + std::to_string(out) +
                                 " elements, expected the same number");
}

template <class Op, class In, class Out>
void runUnary(const Op& op, const char* names, const In& in, const Out& out) {
  checkSameSize(names, in.size(), out.size());
  runBatch(op, viewOf(in), viewOf(out), in.size());
}

template <class Op, class A, class B, class Out>
void runBinary(const Op& op, const char* a_and_b, const char* a_and_out, const A& a, const B& b,
               const Out& out) {
  checkSameSize(a_and_b, a.size(), b.size());
  checkSameSize(a_and_out, a.size(), out.size());
  const auto view_a = viewOf(a);
  const auto view_b = viewOf(b);
  runBatch(op,
           Both<typename std::remove_const<decltype(view_a)>::type,
                typename std::remove_const<decltype(view_b)>::type>{view_a, view_b},
           viewOf(out), a.size());
}

}  // namespace detail

/// @{
/// out[i] = transform * in[i]: one transform of many points.
/// @tparam G         SO3, SE3 or SIM3, deduced
/// @param transform  R_a_b, T_a_b or S_a_b
/// @param in         points in frame b
/// @param out        the same points in frame a
/// @throws ArgumentError when the sizes differ
template <class G>
void transformPoints(const G& transform, Span<const typename G::Point> in,
                     Span<typename G::Point> out) {
  detail::runUnary(detail::ActOnAll<typename G::Scalar>(transform), "in and out", in, out);
}
template <class G>
void transformPoints(const G& transform, ArraysOf<const typename G::Point> in,
                     ArraysOf<typename G::Point> out) {
  detail::runUnary(detail::ActOnAll<typename G::Scalar>(transform), "in and out", in, out);
}
/// @}

/// @{
/// out[i] = transforms[i] * in[i]: each point has a transform of its own.
/// @tparam G          SO3, SE3 or SIM3, to be named
/// @param transforms  R_a_b, T_a_b or S_a_b of each point
/// @param in          points in their frames b
/// @param out         the same points in their frames a
/// @throws ArgumentError when the sizes differ
template <class G>
void transformPoints(Span<const G> transforms, Span<const typename G::Point> in,
                     Span<typename G::Point> out) {
  detail::runBinary(detail::ActOnOne<G>(), "transforms and in", "transforms and out", transforms,
                    in, out);
}
template <class G>
void transformPoints(ArraysOf<const G> transforms, ArraysOf<const typename G::Point> in,
                     ArraysOf<typename G::Point> out) {
  detail::runBinary(detail::ActOnOne<G>(), "transforms and in", "transforms and out", transforms,
                    in, out);
}
/// @}

/// @{
/// out[i] = a[i] * b[i].
/// @tparam G   SO3, SE3 or SIM3, to be named
/// @param a    T_a_b
/// @param b    T_b_c
/// @param out  T_a_c
/// @throws ArgumentError when the sizes differ
template <class G>
void composeMany(Span<const G> a, Span<const G> b, Span<G> out) {
  detail::runBinary(detail::Compose<G>(), "a and b", "a and out", a, b, out);
}
template <class G>
void composeMany(ArraysOf<const G> a, ArraysOf<const G> b, ArraysOf<G> out) {
  detail::runBinary(detail::Compose<G>(), "a and b", "a and out", a, b, out);
}
/// @}

/// @{
/// out[i] = in[i].inverse().
/// @tparam G   SO3, SE3 or SIM3, to be named
/// @param in   T_a_b
/// @param out  T_b_a
/// @throws ArgumentError when the sizes differ
template <class G>
void inverseMany(Span<const G> in, Span<G> out) {
  detail::runUnary(detail::Inverse<G>(), "in and out", in, out);
}
template <class G>
void inverseMany(ArraysOf<const G> in, ArraysOf<G> out) {
  detail::runUnary(detail::Inverse<G>(), "in and out", in, out);
}
/// @}

/// @{
/// out[i] = G::exp(tangents[i]).
/// @tparam G        SO3, SE3 or SIM3, to be named
/// @param tangents  as those of G
/// @param out       the transforms
/// @throws ArgumentError when the sizes differ, and where G::exp throws; it names the first such
/// element
template <class G>
void expMany(Span<const typename G::Tangent> tangents, Span<G> out) {
  detail::runUnary(detail::Exp<G>(), "tangents and out", tangents, out);
}
template <class G>
void expMany(ArraysOf<const typename G::Tangent> tangents, ArraysOf<G> out) {
  detail::runUnary(detail::Exp<G>(), "tangents and out", tangents, out);
}
/// @}

/// @{
/// tangents[i] = in[i].log().
/// @tparam G        SO3, SE3 or SIM3, to be named
/// @param in        the transforms
/// @param tangents  as those of G
/// @throws ArgumentError when the sizes differ
template <class G>
void logMany(Span<const G> in, Span<typename G::Tangent> tangents) {
  detail::runUnary(detail::Log<G>(), "in and tangents", in, tangents);
}
template <class G>
void logMany(ArraysOf<const G> in, ArraysOf<typename G::Tangent> tangents) {
  detail::runUnary(detail::Log<G>(), "in and tangents", in, tangents);
}
/// @}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_BATCH_H
