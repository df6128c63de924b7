#ifndef GSLAM_SVAR_TEXT_H
#define GSLAM_SVAR_TEXT_H

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

  /// Less than, equal to or greater than 0: the order of the bytes.
  int compare(Text other) const noexcept {
    const std::size_t common = size_ < other.size_ ? size_ : other.size_;
    const int order = common == 0 ? 0 : std::memcmp(data_, other.data_, common);
    if (order != 0 || size_ == other.size_) return order;
    return size_ < other.size_ ? -1 : 1;
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
