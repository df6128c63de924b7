#ifndef GSLAM_SVAR_TEXT_H
#define GSLAM_SVAR_TEXT_H

#include <gslam/svar/bytes.h>
#include <gslam/svar/error.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

/// @file
/// The parameter type of names and paths.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Borrowed characters: takes a literal, `std::string` or `std::string_view` without allocating.
/// Only for parameters: it must not outlive what it views.
class Text {
 public:
  /// @throws SvarError for a null pointer
  Text(const char* text)  // NOLINT(google-explicit-constructor)
      : data_(text), size_(text != nullptr ? std::strlen(text) : refuse()) {}

  /// Not from nullptr, nor from the literal 0, which could be meant for an index.
  Text(std::nullptr_t) = delete;  // NOLINT(google-explicit-constructor)

  Text(const char* data, std::size_t size) noexcept : data_(data), size_(size) {}

  template <class S, class = typename std::enable_if<std::is_convertible<
                         decltype(std::declval<const S&>().data()), const char*>::value>::type>
  Text(const S& text) noexcept  // NOLINT(google-explicit-constructor)
      : data_(text.data()), size_(text.size()) {}

  const char* data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  const char* begin() const noexcept { return data_; }
  const char* end() const noexcept { return data_ + size_; }
  std::string str() const { return std::string(data_, size_); }

  friend bool operator==(Text a, Text b) noexcept {
    return a.size_ == b.size_ && sameBytes(a.data_, b.data_, a.size_);
  }

 private:
  [[noreturn]] static std::size_t refuse() {
    throw SvarError("", "expected text, found a null pointer");
  }

  const char* data_;
  std::size_t size_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_TEXT_H
