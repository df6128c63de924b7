#ifndef GSLAM_CORE_PARAMETERS_H
#define GSLAM_CORE_PARAMETERS_H

#include <gslam/base/error.h>
#include <gslam/svar/detail/nearest_name.h>
#include <gslam/svar/error.h>
#include <gslam/svar/svar.h>

#include <string>
#include <vector>

/// @file
/// The parameters that a user gives to a dataset, a SLAM system or an application.

namespace gslam {
inline namespace v1 {
namespace detail {

// Whether a value may stand where the default has another: the same type, a whole number for a
// real one, anything for a null.
inline bool mayReplace(const Svar& standard, const Svar& given) noexcept {
  return standard.type() == given.type() || standard.isNull() ||
         (standard.type() == SvarType::real && given.type() == SvarType::integer);
}

inline void checkParameters(const Svar& defaults, const Svar& given, const std::string& path) {
  for (const Svar::Member& member : given.members()) {
    const std::string name = path + member.first;
    std::vector<std::string> names;
    const Svar* standard = nullptr;
    for (const Svar::Member& known : defaults.members()) {
      names.push_back(known.first);
      if (known.first == member.first) standard = &known.second;
    }
    if (standard == nullptr) {
      throw SvarError(name, "is no parameter of it" + suggestion(nearestName(member.first, names)));
    }
    if (!mayReplace(*standard, member.second)) {
      throw SvarError(name, std::string("expected ") + standard->typeName() + ", found " +
                                member.second.typeName());
    }
    if (standard->type() == SvarType::object && standard->size() > 0) {
      checkParameters(*standard, member.second, name + ".");
    }
  }
}

}  // namespace detail

/// The defaults with the values that a user gave laid over them, as an independent value.
/// @param defaults  of SlamFactory::parameters and its like: an object, or null for none
/// @param given     an object with some of them, or null. An empty object or a null among the
///   defaults takes anything.
/// @throws SvarError for a value that has no default, with the name that is near, or whose type is
///   another (a whole number may stand for a real one)
inline Svar completeParameters(const Svar& defaults, const Svar& given) {
  detail::checkParameters(defaults, given, "");
  const Svar standard = defaults.isNull() ? Svar::object() : defaults;
  return standard.merged(given.isNull() ? Svar::object() : given);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_PARAMETERS_H
