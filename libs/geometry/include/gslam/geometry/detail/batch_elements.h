#ifndef GSLAM_GEOMETRY_DETAIL_BATCH_ELEMENTS_H
#define GSLAM_GEOMETRY_DETAIL_BATCH_ELEMENTS_H

#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstring>
#include <type_traits>

/// @file
/// Where the elements of a batch stand in memory: in rows (an array of structures), in columns (a
/// structure of arrays), or two of them side by side.

namespace gslam {
inline namespace v1 {
namespace detail {

/// What an element is made of: `kNumbers` of type Scalar in a row.
template <class E>
struct ElementFacts {
  using Scalar = typename E::Scalar;
  static constexpr std::size_t kNumbers = sizeof(E) / sizeof(Scalar);
};
template <class T, std::size_t N>
struct ElementFacts<Vec<T, N>> {
  using Scalar = T;
  static constexpr std::size_t kNumbers = N;
};

template <class E>
struct ElementFacts<const E> : ElementFacts<E> {};

template <class E>
struct IsRow
    : std::integral_constant<
          bool, sizeof(E) == ElementFacts<E>::kNumbers * sizeof(typename ElementFacts<E>::Scalar) &&
                    std::is_trivially_copyable<E>::value && std::is_standard_layout<E>::value> {};

/// The element with these numbers, which came out of one.
template <class E>
E elementOf(const typename ElementFacts<E>::Scalar* numbers) noexcept {
  static_assert(IsRow<E>::value, "an element is its numbers and nothing else");
  E element;
  std::memcpy(static_cast<void*>(&element), numbers, sizeof(E));
  return element;
}
template <class E>
void putNumbers(const E& element, typename ElementFacts<E>::Scalar* numbers) noexcept {
  static_assert(IsRow<E>::value, "an element is its numbers and nothing else");
  std::memcpy(numbers, &element, sizeof(E));
}

/// K numbers of each element in a row. T may be const.
template <class T, std::size_t K>
struct Rows {
  static constexpr std::size_t kNumbers = K;
  T* first;

  void get(std::size_t i, typename std::remove_const<T>::type* numbers) const noexcept {
    for (std::size_t k = 0; k < K; ++k) numbers[k] = first[i * K + k];
  }
  void set(std::size_t i, const T* numbers) const noexcept {
    for (std::size_t k = 0; k < K; ++k) first[i * K + k] = numbers[k];
  }
};

/// K arrays.
template <class T, std::size_t K>
struct Columns {
  static constexpr std::size_t kNumbers = K;
  T* column[K];

  void get(std::size_t i, typename std::remove_const<T>::type* numbers) const noexcept {
    for (std::size_t k = 0; k < K; ++k) numbers[k] = column[k][i];
  }
  void set(std::size_t i, const T* numbers) const noexcept {
    for (std::size_t k = 0; k < K; ++k) column[k][i] = numbers[k];
  }
};

/// The numbers of one and of the other.
template <class A, class B>
struct Both {
  static constexpr std::size_t kNumbers = A::kNumbers + B::kNumbers;
  A a;
  B b;

  template <class T>
  void get(std::size_t i, T* numbers) const noexcept {
    a.get(i, numbers);
    b.get(i, numbers + A::kNumbers);
  }
};

/// Room for W elements that are laid out as those of View are.
template <class View, std::size_t W>
struct Room;

template <class T, std::size_t K, std::size_t W>
struct Room<Rows<T, K>, W> {
  using Scalar = typename std::remove_const<T>::type;
  Scalar numbers[W * K];

  Rows<T, K> view() noexcept { return {numbers}; }
  void put(std::size_t i, const Scalar* from) noexcept { Rows<Scalar, K>{numbers}.set(i, from); }
};

template <class T, std::size_t K, std::size_t W>
struct Room<Columns<T, K>, W> {
  using Scalar = typename std::remove_const<T>::type;
  Scalar numbers[K][W];

  Columns<T, K> view() noexcept {
    Columns<T, K> v;
    for (std::size_t k = 0; k < K; ++k) v.column[k] = numbers[k];
    return v;
  }
  void put(std::size_t i, const Scalar* from) noexcept {
    for (std::size_t k = 0; k < K; ++k) numbers[k][i] = from[k];
  }
};

template <class A, class B, std::size_t W>
struct Room<Both<A, B>, W> {
  Room<A, W> a;
  Room<B, W> b;

  Both<A, B> view() noexcept { return {a.view(), b.view()}; }
  template <class T>
  void put(std::size_t i, const T* from) noexcept {
    a.put(i, from);
    b.put(i, from + A::kNumbers);
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_BATCH_ELEMENTS_H
