// What readers and writers of formats, and the other files of Svar, see of its inside.
#include <gslam/svar/svar.h>  // includes this file, so that it comes before the guard

#ifndef GSLAM_SVAR_DETAIL_SVAR_PARTS_H
#define GSLAM_SVAR_DETAIL_SVAR_PARTS_H

namespace gslam {
inline namespace v1 {
namespace detail {

/// Makes arrays and objects from finished parts: as they are new, nothing can contain itself.
/// Reads what the type of a value is known to hold, without checking it again.
struct SvarParts {
  using Elements = std::vector<Svar>;
  using Members = OrderedMap<Svar>;

  static Svar array(Elements elements) {
    return Svar(SvarType::array, std::make_shared<Svar::Node<Elements>>(std::move(elements)));
  }
  /// No name may stand there twice.
  static Svar object(Members members) {
    return Svar(SvarType::object, std::make_shared<Svar::Node<Members>>(std::move(members)));
  }

  static Svar string(Text text) { return Svar(SvarType::string, text); }
  /// The data must be what the type says.
  static Svar make(SvarType type, std::shared_ptr<void> data) {
    return Svar(type, std::move(data));
  }

  static bool boolean(const Svar& value) noexcept { return value.number_.integer != 0; }
  static std::int64_t integer(const Svar& value) noexcept { return value.number_.integer; }
  static double real(const Svar& value) noexcept { return value.number_.real; }
  static Text text(const Svar& value) noexcept { return value.asString(); }
  static const Elements& elements(const Svar& value) noexcept { return value.asArray(); }
  static const std::vector<Svar::Member>& members(const Svar& value) noexcept {
    return value.asObject().members();
  }
  /// Null where the object has no such member.
  static const Svar* member(const Svar& object, Text name) noexcept {
    return object.asObject().find(name);
  }

  /// To be changed while nobody else can see the array.
  static Elements& ownElements(Svar& array) noexcept { return array.asArray(); }
  static Members& ownMembers(Svar& object) noexcept { return object.asObject(); }

  /// Null where the value is no native object.
  static const SvarNative* native(const Svar& value) noexcept {
    return value.type() == SvarType::native ? &value.asNative() : nullptr;
  }
  static std::string describe(const Svar& value) { return value.describe(); }
  [[noreturn]] static void failType(const Svar& value, const std::string& expected) {
    value.failType("", expected);
  }

  /// A copy in which the arrays and objects on the way of the path are new and may be written; what
  /// lies beside it is shared.
  static Svar thawed(const Svar& value, Text path);
  /// Freezes what is not frozen in place: what is new, so that nobody else can see it yet.
  static void seal(const Svar& value);
  /// As ==, but a NaN is the same as a NaN, and 0.0 is not -0.0.
  static bool same(const Svar& a, const Svar& b);
  /// What stands at the path, or null.
  static const Svar* find(const Svar& value, Text path) { return value.find(path); }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SVAR_PARTS_H
