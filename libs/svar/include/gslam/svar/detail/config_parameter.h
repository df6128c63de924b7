// What is declared of one parameter.
#ifndef GSLAM_SVAR_DETAIL_CONFIG_PARAMETER_H
#define GSLAM_SVAR_DETAIL_CONFIG_PARAMETER_H

#include <gslam/svar/detail/value_of_text.h>
#include <gslam/svar/shared.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// JSON where there is one, without the zeros of whole doubles; else what it is.
inline std::string textOfValue(const Svar& value) {
  try {
    const std::string text = printJson(value);
    const std::size_t point = text.size() < 2 ? 0 : text.size() - 2;
    return value.type() == SvarType::real && text.compare(point, 2, ".0") == 0
               ? text.substr(0, point)
               : text;
  } catch (const SvarError&) {
    return SvarParts::describe(value);
  }
}

/// What stands for a value of that type in the help: "INT32", "DOUBLE,..."
template <class T, bool is_list = IsList<T>::value>
struct Placeholder {
  static std::string text() {
    std::string name = std::is_same<T, Svar>::value ? "value" : svarTypeName<T>();
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return name;
  }
};
template <class T>
struct Placeholder<T, true> {
  static std::string text() { return Placeholder<typename T::value_type>::text() + ",..."; }
};

/// Type, range and choices of a parameter.
class ParameterRule : public SvarRule {
 public:
  template <class T>
  static std::unique_ptr<ParameterRule> make(const std::string& path, Presence presence) {
    return std::unique_ptr<ParameterRule>(new ParameterRule(path, presence, &convert<T>));
  }

  std::unique_ptr<SvarTaking> check(const Svar& value) const override {
    Svar converted;
    try {
      converted = convert_(value);
    } catch (const SvarError& error) {
      throw SvarError(joinPaths(path(), error.path()), error.problem());
    }
    const bool good = is_inside_ == nullptr || is_inside_(value, low_, high_);
    bool chosen = choices_.size() == 0;
    for (const Svar& choice : choices_) chosen = chosen || choice == converted;
    if (good && chosen) return nullptr;
    throw SvarError(path(), "expected " + limits() + ", found " + SvarParts::describe(value));
  }

  template <class T>
  void setRange(const T& low, const T& high) {
    low_ = Svar(low);
    high_ = Svar(high);
    is_inside_ = &isInside<T>;
  }
  void setChoices(const Svar& choices) { choices_ = choices; }
  const Svar& choices() const { return choices_; }

  /// "1 to 120", "one of "a", "b"", or nothing.
  std::string limits() const {
    if (is_inside_ != nullptr) return textOfValue(low_) + " to " + textOfValue(high_);
    std::string text;
    for (const Svar& choice : choices_) text += (text.empty() ? "" : ", ") + textOfValue(choice);
    return text.empty() ? "" : "one of " + text;
  }

 private:
  using Convert = Svar (*)(const Svar&);
  using IsInside = bool (*)(const Svar&, const Svar&, const Svar&);

  ParameterRule(const std::string& path, Presence presence, Convert conversion)
      : SvarRule(path, presence), convert_(conversion) {}

  template <class T>
  static Svar convert(const Svar& value) {
    return Svar(value.as<T>());
  }
  template <class T>
  static bool isInside(const Svar& value, const Svar& low, const Svar& high) {
    const T it = value.as<T>();
    return low.as<T>() <= it && it <= high.as<T>();  // NaN is not
  }

  Convert convert_;
  IsInside is_inside_ = nullptr;
  Svar low_;
  Svar high_;
  Svar choices_;
};

/// One parameter as it was declared, and where its value came from.
struct Parameter {
  std::string name;
  std::string help;
  std::string group;
  std::string short_name;   // may be empty
  std::string placeholder;  // of a value, in the help
  bool is_bool = false;
  bool is_open = false;  // a Svar, inside of which anything may be given
  bool is_required = false;
  Svar default_value;
  Svar (*read)(const std::string& text) = nullptr;
  ParameterRule* rule = nullptr;  // lives in the SharedSvar

  std::string origin = "default";
  Svar given;  // what came from there
};

/// A value that was given, and how errors call the place where it was.
struct Given {
  Parameter* parameter;
  std::string path;  // the parameter's name, or a place inside of it
  Svar value;
  std::string place;
};

/// All parameters in the order of their declaration.
using Parameters = std::vector<std::unique_ptr<Parameter>>;

inline bool isLetter(char c) noexcept {
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'z';
}

/// Letters, digits, - and _, with single dots between; the first is a letter, and none behind a dot
/// is a dash.
inline bool isParameterName(const std::string& name) {
  bool at_begin = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool begins = isLetter(c) || (i > 0 && (isDigit(c) || c == '_'));
    const bool goes_on = begins || c == '-' || c == '.';
    if (at_begin ? !begins : !goes_on) return false;
    at_begin = c == '.';
  }
  return !at_begin;
}

/// Names that differ in - and _ only are the same for those who type them.
inline std::string withUnderscores(std::string name) {
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

/// Whether the name begins with the other, be it with - or _.
inline bool beginsWithName(const std::string& name, const std::string& other) noexcept {
  if (name.size() < other.size()) return false;
  for (std::size_t i = 0; i < other.size(); ++i) {
    const bool dashes = (name[i] == '-' || name[i] == '_') && (other[i] == '-' || other[i] == '_');
    if (name[i] != other[i] && !dashes) return false;
  }
  return true;
}

/// Whether both mean the same parameter.
inline bool sameName(const std::string& a, const std::string& b) noexcept {
  return a.size() == b.size() && beginsWithName(a, b);
}

/// Whether the name is that of a place inside of the other, as camera.fx is inside of camera.
inline bool liesInside(const std::string& name, const std::string& other) noexcept {
  return name.size() > other.size() && name[other.size()] == '.' && beginsWithName(name, other);
}

/// Null where no parameter has that name.
inline Parameter* findParameter(const Parameters& parameters, const std::string& name) noexcept {
  for (const std::unique_ptr<Parameter>& one : parameters) {
    const bool is_short = !one->short_name.empty() && sameName(one->short_name, name);
    if (is_short || sameName(one->name, name)) return one.get();
  }
  return nullptr;
}

/// The open parameter that the name lies in, such as slam for slam.features, or null.
inline Parameter* findOpenParameter(const Parameters& parameters,
                                    const std::string& name) noexcept {
  for (const std::unique_ptr<Parameter>& one : parameters) {
    if (one->is_open && liesInside(name, one->name)) return one.get();
  }
  return nullptr;
}

/// The same name with that of the open parameter as it was declared.
inline std::string pathInside(const Parameter& open, const std::string& name) {
  return open.name + name.substr(open.name.size());
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_CONFIG_PARAMETER_H
