#ifndef GSLAM_SVAR_PATH_H
#define GSLAM_SVAR_PATH_H

#include <gslam/svar/error.h>
#include <gslam/svar/text.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

/// @file
/// Paths such as "camera.0.fx", "camera/0/fx" and "/camera/0/fx".

namespace gslam {
inline namespace v1 {
namespace detail {

/// Reads a path name by name. Begins at the first name; allocates for long names with a ~ only.
///
/// A slash anywhere makes slashes separate the names: then the path is a JSON pointer (RFC 6901)
/// whose first slash may be left out, and ~1 and ~0 stand for / and ~. Else dots do.
class PathReader {
 public:
  /// Nothing is checked yet.
  explicit PathReader(Text path) : path_(path), begin_(path.begin()) {
    const bool slashes = !path.empty() && std::memchr(path.begin(), '/', path.size()) != nullptr;
    separator_ = slashes ? '/' : '.';
    pointer_ = slashes && *path.begin() == '/';
    if (pointer_) ++begin_;
    end_ = nextSeparator();
  }

  /// @throws SvarError when the path or a name is empty (only behind a first slash a name may be),
  ///         or a ~ stands for nothing
  void check() const {
    if (path_.empty()) throw SvarError("", "the path is empty, expected such as \"camera.0.fx\"");
    for (const char* p = path_.begin(); p != path_.end() && !pointer_; ++p) {
      const bool nothing_after = p + 1 == path_.end() || p[1] == separator_;
      if (*p == separator_ && (p == path_.begin() || nothing_after)) failEmptyName();
    }
    if (separator_ == '/' && hasBadEscape(path_.begin(), path_.end())) {
      throw SvarError(path_.str(), "expected ~0 or ~1, as which ~ and / are written in a path");
    }
  }

  /// Whether check() would refuse the current name.
  bool isMalformed() const noexcept {
    return begin_ == end_ ? !pointer_ : separator_ == '/' && hasBadEscape(begin_, end_);
  }

  /// The current name, which must not be malformed; valid until next().
  Text name() {
    const Text raw(begin_, static_cast<std::size_t>(end_ - begin_));
    if (separator_ == '.' || raw.empty() || std::memchr(begin_, '~', raw.size()) == nullptr) {
      return raw;
    }
    unescaped_.clear();
    for (const char* p = begin_; p != end_; ++p) {
      unescaped_.push_back(*p != '~' ? *p : *++p == '1' ? '/' : '~');
    }
    return unescaped_;
  }
  bool isLast() const noexcept { return end_ == path_.end(); }

  /// What stands before the current name: "camera.0" at "fx", empty at the first.
  Text parent() const noexcept {
    const std::size_t before = static_cast<std::size_t>(begin_ - path_.begin());
    return Text(path_.begin(), before == 0 ? 0 : before - 1);
  }

  /// Must not be called at the last name.
  void next() noexcept {
    begin_ = end_ + 1;
    end_ = nextSeparator();
  }

 private:
  static bool hasBadEscape(const char* p, const char* end) noexcept {
    for (; p != end; ++p) {
      if (*p == '~' && (p + 1 == end || (p[1] != '0' && p[1] != '1'))) return true;
    }
    return false;
  }
  const char* nextSeparator() const noexcept {
    const char* p = begin_;
    while (p != path_.end() && *p != separator_) ++p;
    return p;
  }
  [[noreturn]] void failEmptyName() const {
    throw SvarError(path_.str(), separator_ == '.'
                                     ? "expected names with single dots between them, "
                                       "such as \"a.0.b\""
                                     : "expected names with single slashes between "
                                       "them, such as \"a/0/b\"");
  }

  Text path_;
  const char* begin_;
  const char* end_ = nullptr;
  char separator_ = '.';
  bool pointer_ = false;
  std::string unescaped_;
};

/// False where the name is not an index as JSON pointers have it: digits without a zero before
/// them. An index too large for size_t becomes its maximum, which no array reaches.
inline bool parseIndex(Text name, std::size_t& index) noexcept {
  const std::size_t top = std::numeric_limits<std::size_t>::max();
  index = 0;
  for (const char c : name) {
    if (c < '0' || c > '9') return false;
    const std::size_t digit = static_cast<std::size_t>(c - '0');
    index = index > (top - digit) / 10 ? top : index * 10 + digit;
  }
  return !name.empty() && (name.size() == 1 || *name.data() != '0');
}

/// A name as it stands in a JSON pointer.
inline std::string escapeName(Text name) {
  std::string escaped;
  for (const char c : name) {
    if (c == '~' || c == '/') {
      escaped += c == '~' ? "~0" : "~1";
    } else {
      escaped.push_back(c);
    }
  }
  return escaped;
}

/// One path behind another, either of which may be empty.
inline std::string joinPaths(const std::string& outer, const std::string& inner) {
  if (outer.empty() || inner.empty()) return outer.empty() ? inner : outer;
  return outer + (outer.find('/') != std::string::npos ? '/' : '.') + inner;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_PATH_H
