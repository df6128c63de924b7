#ifndef GSLAM_GEOMETRY_TEXT_H
#define GSLAM_GEOMETRY_TEXT_H

#include <gslam/base/error.h>
#include <gslam/geometry/se2.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/sim3.h>
#include <gslam/geometry/so2.h>
#include <gslam/geometry/so3.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

/// @file
/// Rotations and poses as text that gives them back.
///
///     SO2  cosine sine                 SE2   tx ty cosine sine
///     SO3  qx qy qz qw                 SE3   tx ty tz qx qy qz qw
///                                      SIM3  tx ty tz qx qy qz qw scale
///
/// Numbers have a decimal point, whatever the locale of the program is. What is not finite is
/// printed as nan or inf, and not read.

namespace gslam {
inline namespace v1 {
namespace detail {

// The numbers of a group, and how it is made of them.
template <class G>
struct TextForm;

template <class T>
struct TextForm<SO2<T>> {
  static constexpr std::size_t kCount = 2;
  static const char* names() { return "cosine sine"; }
  static SO2<T> of(const T* v) { return SO2<T>::fromComplex(v[0], v[1]); }
  static Vec<T, 2> numbers(const SO2<T>& r) { return {{r.data()[0], r.data()[1]}}; }
};
template <class T>
struct TextForm<SO3<T>> {
  static constexpr std::size_t kCount = 4;
  static const char* names() { return "qx qy qz qw"; }
  static SO3<T> of(const T* v) { return SO3<T>::fromQuaternion(v[0], v[1], v[2], v[3]); }
  static Vec<T, 4> numbers(const SO3<T>& r) { return r.quaternion(); }
};
template <class T>
struct TextForm<SE2<T>> {
  static constexpr std::size_t kCount = 4;
  static const char* names() { return "tx ty cosine sine"; }
  static SE2<T> of(const T* v) { return SE2<T>(TextForm<SO2<T>>::of(v + 2), {{v[0], v[1]}}); }
  static Vec<T, 4> numbers(const SE2<T>& pose) {
    const Vec<T, 2> r = TextForm<SO2<T>>::numbers(pose.rotation());
    return {{pose.translation()[0], pose.translation()[1], r[0], r[1]}};
  }
};
template <class T>
struct TextForm<SE3<T>> {
  static constexpr std::size_t kCount = 7;
  static const char* names() { return "tx ty tz qx qy qz qw"; }
  static SE3<T> of(const T* v) { return SE3<T>(TextForm<SO3<T>>::of(v + 3), {{v[0], v[1], v[2]}}); }
  static Vec<T, 7> numbers(const SE3<T>& pose) {
    Vec<T, 7> v;
    v.setSegment(0, pose.translation());
    v.setSegment(3, pose.rotation().quaternion());
    return v;
  }
};
template <class T>
struct TextForm<SIM3<T>> {
  static constexpr std::size_t kCount = 8;
  static const char* names() { return "tx ty tz qx qy qz qw scale"; }
  static SIM3<T> of(const T* v) { return SIM3<T>(TextForm<SE3<T>>::of(v), v[7]); }
  static Vec<T, 8> numbers(const SIM3<T>& s) {
    Vec<T, 8> v;
    v.setSegment(0, TextForm<SE3<T>>::numbers(s.rigid()));
    v[7] = s.scale();
    return v;
  }
};

/// Numbers to text and back, in the classic locale.
class NumberText {
 public:
  NumberText() {
    out_.imbue(std::locale::classic());
    in_.imbue(std::locale::classic());
  }

  /// With as few digits as give the number back: digits10 of its type, or one or two more.
  template <class T>
  std::string print(T value) {
    for (int digits = std::numeric_limits<T>::digits10;; ++digits) {
      out_.str(std::string());
      out_.precision(digits);
      out_ << value;
      std::string text = out_.str();
      T again = 0;
      if (digits >= std::numeric_limits<T>::max_digits10 || !std::isfinite(value)) return text;
      if (read(text, again) && again == value) return text;
    }
  }

  /// Whether the text, which must have the form of a number, is within the range of T.
  template <class T>
  bool read(const std::string& text, T& value) {
    in_.clear();
    in_.str(text);
    in_ >> value;
    // Some standard libraries call numbers next to 0 failures, and read them all the same.
    return !in_.fail() || std::fabs(value) < 1;
  }

  /// Whether the text is a decimal number such as -1.5e-3, and nothing else.
  static bool isNumber(const std::string& text) {
    std::size_t at = 0;
    skipSign(text, at);
    std::size_t digits = skipDigits(text, at);
    if (at < text.size() && text[at] == '.') digits += skipDigits(text, ++at);
    if (digits == 0) return false;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
      skipSign(text, ++at);
      if (skipDigits(text, at) == 0) return false;
    }
    return at == text.size();
  }

 private:
  static void skipSign(const std::string& text, std::size_t& at) {
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  }
  static std::size_t skipDigits(const std::string& text, std::size_t& at) {
    const std::size_t first = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at - first;
  }

  std::ostringstream out_;
  std::istringstream in_;
};

}  // namespace detail

/// The numbers with a blank between them. fromText() gives them back to the bit, but that it mends
/// the norm of a quaternion or complex number that is off by more than 2 epsilon of T, as long
/// products' are; write what normalized() gives, and nothing changes.
/// @param element  of SO2, SO3, SE2, SE3 or SIM3
template <class G>
std::string toText(const G& element) {
  using Form = detail::TextForm<G>;
  detail::NumberText printer;
  const auto numbers = Form::numbers(element);
  std::string text;
  for (std::size_t i = 0; i < Form::kCount; ++i) {
    if (i != 0) text += ' ';
    text += printer.print(numbers[i]);
  }
  return text;
}

/// The rotation or pose of a text as toText() writes it. Blanks, tabs and ends of lines separate
/// the numbers; quaternions need not have norm 1.
///
///     const auto pose = gslam::fromText<gslam::SE3d>("1 2 3 0 0 0 1");
///
/// @param text  the numbers and nothing else
/// @throws ParseError when the text is empty, ends too early, goes on, has a word that is no
/// number,
///   or one that is not finite or beyond the range of T; it names the place and what was expected
/// @throws ArgumentError when the quaternion is zero or the scale is not above 0
template <class G>
G fromText(const std::string& text) {
  using T = typename G::Scalar;
  using Form = detail::TextForm<G>;
  static const char kBlanks[] = " \t\r\n";
  const auto refuse = [](std::size_t at, const std::string& problem) {
    throw ParseError("text", 1, at + 1, problem + ", expected " + Form::names());
  };
  detail::NumberText numbers;
  T values[Form::kCount];
  std::size_t at = text.find_first_not_of(kBlanks);
  if (at == std::string::npos) refuse(0, "is empty");
  for (std::size_t i = 0; i < Form::kCount; ++i) {
    if (at == std::string::npos) {
      refuse(text.size(), "ends after " + std::to_string(i) + " of " +
                              std::to_string(Form::kCount) + " numbers");
    }
    const std::size_t end = text.find_first_of(kBlanks, at);
    const std::string word = text.substr(at, end == std::string::npos ? end : end - at);
    if (!detail::NumberText::isNumber(word)) refuse(at, "'" + word + "' is no finite number");
    if (!numbers.read(word, values[i])) refuse(at, word + " is too large");
    at = text.find_first_not_of(kBlanks, end);
  }
  if (at != std::string::npos) refuse(at, "'" + text.substr(at, 20) + "' stands after the end");
  return Form::of(values);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_TEXT_H
