#ifndef GSLAM_OPTIMIZER_SRC_FILES_TEXT_WRITER_H
#define GSLAM_OPTIMIZER_SRC_FILES_TEXT_WRITER_H

#include <gslam/base/detail/new_file.h>

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

// A text file of numbers, each in the fewest digits that read back to the same bits. It appears
// when it is whole.

namespace gslam {
inline namespace v1 {
namespace detail {

class TextWriter {
 public:
  explicit TextWriter(const std::string& path) : file_(path) { buffer_.reserve(kFull + 4096); }

  TextWriter& operator<<(std::string_view text) {
    buffer_.append(text);
    if (buffer_.size() >= kFull) flush();
    return *this;
  }
  TextWriter& operator<<(char c) { return *this << std::string_view(&c, 1); }
  template <class Number, class = std::enable_if_t<std::is_arithmetic<Number>::value>>
  TextWriter& operator<<(Number number) {
    char digits[32];
    const auto written = std::to_chars(digits, digits + sizeof digits, number);
    return *this << std::string_view(digits, static_cast<std::size_t>(written.ptr - digits));
  }
  // Numbers with a space before each.
  template <class Numbers>
  TextWriter& list(const Numbers& numbers, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) *this << ' ' << numbers[i];
    return *this;
  }

  void commit() {
    flush();
    file_.commit();
  }

 private:
  static constexpr std::size_t kFull = 1 << 20;

  void flush() {
    file_.write(buffer_.data(), buffer_.size());
    buffer_.clear();
  }

  NewFile file_;
  std::string buffer_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FILES_TEXT_WRITER_H
