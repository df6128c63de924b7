#ifndef GSLAM_BASE_SPAN_H
#define GSLAM_BASE_SPAN_H

#include <gslam/base/error.h>

#include <cstddef>
#include <string>
#include <type_traits>

/// @file
/// A view of contiguous elements that somebody else owns.

namespace gslam {
inline namespace v1 {

template <class T>
class Span;

namespace detail {

template <class T>
struct IsSpan : std::false_type {};
template <class T>
struct IsSpan<Span<T>> : std::true_type {};

// A container whose data() points to elements that T* may point to: same type, perhaps more const.
template <class C, class T>
using EnableIfViewable = typename std::enable_if<
    !IsSpan<typename std::remove_cv<C>::type>::value &&
    std::is_convertible<
        typename std::remove_pointer<decltype(std::declval<C&>().data())>::type (*)[],
        T (*)[]>::value &&
    std::is_convertible<decltype(std::declval<C&>().size()), std::size_t>::value>::type;

}  // namespace detail

/// A pointer and a count: the C++11 stand-in for `std::span<T>`.
///
/// Cheap to copy; never owns. Like `std::string_view` it must not outlive what it views.
/// `Span<T>` converts to `Span<const T>`. Indexing is unchecked, `at` is checked.
/// Layout: two words, stable across plugin borders. Safe to share as far as its elements are.
template <class T>
class Span {
 public:
  /// @{
  /// As in std::span.
  using element_type = T;
  using value_type = typename std::remove_cv<T>::type;
  using size_type = std::size_t;
  using iterator = T*;
  /// @}

  /// Views nothing.
  constexpr Span() noexcept : data_(nullptr), size_(0) {}
  /// Views `size` elements from `data` on.
  constexpr Span(T* data, std::size_t size) noexcept : data_(data), size_(size) {}

  /// Views a C array.
  template <std::size_t N>
  constexpr Span(T (&array)[N]) noexcept  // NOLINT(google-explicit-constructor)
      : data_(array), size_(N) {}

  /// @{
  /// Views anything with contiguous `data()` and `size()`: vector, array, string, cv::Mat_ rows...
  /// A temporary binds to `Span<const T>` only for the length of the call it is an argument of.
  template <class C, class = detail::EnableIfViewable<C, T>>
  constexpr Span(C& container)  // NOLINT(google-explicit-constructor)
      : data_(container.data()), size_(container.size()) {}

  template <class C, class = detail::EnableIfViewable<const C, T>>
  constexpr Span(const C& container)  // NOLINT(google-explicit-constructor)
      : data_(container.data()), size_(container.size()) {}
  /// @}

  /// Views the same elements as const.
  template <class U, class = typename std::enable_if<std::is_convertible<U (*)[], T (*)[]>::value &&
                                                     !std::is_same<U, T>::value>::type>
  constexpr Span(const Span<U>& other) noexcept  // NOLINT(google-explicit-constructor)
      : data_(other.data()), size_(other.size()) {}

  /// @{
  /// As in std::span.
  constexpr T* data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr T* begin() const noexcept { return data_; }
  constexpr T* end() const noexcept { return data_ + size_; }
  /// @}

  /// @{
  /// Unchecked: the element must be there.
  constexpr T& operator[](std::size_t i) const noexcept { return data_[i]; }
  T& front() const noexcept { return data_[0]; }
  T& back() const noexcept { return data_[size_ - 1]; }
  /// @}

  /// @throws ArgumentError when `i >= size()`
  T& at(std::size_t i) const {
    if (i >= size_) fail("index", i);
    return data_[i];
  }

  /// The `count` elements from `offset` on.
  /// @throws ArgumentError when they are not all inside
  Span subspan(std::size_t offset, std::size_t count) const {
    if (offset > size_) fail("offset", offset);
    if (count > size_ - offset) fail("offset + count", offset, count);
    return Span(data_ + offset, count);
  }

  /// All elements from `offset` on.
  /// @throws ArgumentError when `offset > size()`
  Span subspan(std::size_t offset) const {
    if (offset > size_) fail("offset", offset);
    return Span(data_ + offset, size_ - offset);
  }

  /// @{
  /// The first or last `count` elements.
  /// @throws ArgumentError when there are fewer
  Span first(std::size_t count) const { return subspan(0, count); }
  Span last(std::size_t count) const {
    if (count > size_) fail("count", count);
    return Span(data_ + (size_ - count), count);
  }
  /// @}

 private:
  [[noreturn]] void fail(const char* name, std::size_t value) const {
    throw ArgumentError(name, "is " + std::to_string(value) + ", outside a span of " +
                                  std::to_string(size_) + " elements");
  }
  [[noreturn]] void fail(const char* name, std::size_t offset, std::size_t count) const {
    throw ArgumentError(name, "is " + std::to_string(offset) + " + " + std::to_string(count) +
                                  ", outside a span of " + std::to_string(size_) + " elements");
  }

  T* data_;
  std::size_t size_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_SPAN_H
