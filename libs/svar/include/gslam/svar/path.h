#ifndef GSLAM_SVAR_PATH_H
#define GSLAM_SVAR_PATH_H

#include <gslam/svar/error.h>
#include <gslam/svar/text.h>

#include <cstddef>
#include <limits>
#include <string>

/// @file
/// Paths such as "camera.0.fx": names and indices with dots between them.

namespace gslam {
inline namespace v1 {
namespace detail {

/// Reads a path name by name, without allocating. Begins at the first name.
class PathReader {
 public:
  /// @throws SvarError when the path, or a name in it, is empty
  explicit PathReader(Text path) : path_(path), begin_(path.begin()), end_(nextDot()) {
    if (path.empty()) throw SvarError("", "the path is empty, expected such as \"camera.0.fx\"");
    for (const char* p = path.begin(); p != path.end(); ++p) {
      const bool nothingAfter = p + 1 == path.end() || p[1] == '.';
      if (*p == '.' && (p == path.begin() || nothingAfter)) failEmptyName();
    }
  }

  Text name() const noexcept { return Text(begin_, static_cast<std::size_t>(end_ - begin_)); }
  bool isLast() const noexcept { return end_ == path_.end(); }

  /// What stands before the current name: "camera.0" at "fx", empty at the first.
  Text parent() const noexcept {
    const std::size_t before = static_cast<std::size_t>(begin_ - path_.begin());
    return Text(path_.begin(), before == 0 ? 0 : before - 1);
  }

  /// Must not be called at the last name.
  void next() {
    begin_ = end_ + 1;
    end_ = nextDot();
  }

 private:
  const char* nextDot() const {
    const char* p = begin_;
    while (p != path_.end() && *p != '.') ++p;
    return p;
  }
  [[noreturn]] void failEmptyName() const {
    throw SvarError(path_.str(), "expected names with single dots between them, such as \"a.0.b\"");
  }

  Text path_;
  const char* begin_;
  const char* end_;
};

/// False where the name is not made of digits. An index too large for size_t becomes its maximum,
/// which no array reaches.
inline bool parseIndex(Text name, std::size_t& index) noexcept {
  const std::size_t top = std::numeric_limits<std::size_t>::max();
  index = 0;
  for (const char c : name) {
    if (c < '0' || c > '9') return false;
    const std::size_t digit = static_cast<std::size_t>(c - '0');
    index = index > (top - digit) / 10 ? top : index * 10 + digit;
  }
  return !name.empty();
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_PATH_H
