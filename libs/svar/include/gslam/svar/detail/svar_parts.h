// What readers and writers of formats see of the inside of a Svar.
#ifndef GSLAM_SVAR_DETAIL_SVAR_PARTS_H
#define GSLAM_SVAR_DETAIL_SVAR_PARTS_H

#include <gslam/svar/svar.h>

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

  static Svar string(Text text) { return Svar(text); }

  static bool boolean(const Svar& value) noexcept { return value.number_.integer != 0; }
  static std::int64_t integer(const Svar& value) noexcept { return value.number_.integer; }
  static double real(const Svar& value) noexcept { return value.number_.real; }
  static Text text(const Svar& value) noexcept { return value.asString(); }
  static const Elements& elements(const Svar& value) noexcept { return value.asArray(); }
  static const std::vector<Svar::Member>& members(const Svar& value) noexcept {
    return value.asObject().members();
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SVAR_PARTS_H
