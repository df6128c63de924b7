// Function bodies of svar.h, which says what they do: making, reading and writing.
#ifndef GSLAM_SVAR_SVAR_IMPL_H
#define GSLAM_SVAR_SVAR_IMPL_H

#include <gslam/svar/svar.h>

#include <cstdio>
#include <cstdlib>

namespace gslam {
inline namespace v1 {

// --- making

inline Svar::Svar(const char* value) : Svar(detail::Text(value)) {}

inline Svar Svar::array(std::initializer_list<Svar> elements) {
  return Svar(SvarType::array, std::make_shared<Node<Array>>(Array(elements)));
}

inline Svar Svar::object(std::initializer_list<Member> members) {
  Svar made(SvarType::object, std::make_shared<Node<Object>>(Object()));
  for (const Member& member : members) {
    if (made.child(member.first) != nullptr) {
      throw SvarError(member.first, "expected each name once, found it twice");
    }
    made.asObject().insert(member.first, member.second);
  }
  return made;
}

// --- converting

inline bool Svar::read(bool& out) const {
  if (type_ != SvarType::boolean) return false;
  out = number_.integer != 0;
  return true;
}

inline bool Svar::read(std::string& out) const {
  if (type_ != SvarType::string) return false;
  out = asString().str();
  return true;
}

inline bool Svar::read(Svar& out) const {
  out = *this;
  return true;
}

template <class T>
bool Svar::read(T& out) const {
  if (type_ == SvarType::integer) return detail::convertNumber(number_.integer, out);
  return type_ == SvarType::real && detail::convertNumber(number_.real, out);
}

namespace detail {

template <class T>
struct SvarTarget {
  static_assert(IsInteger<T>::value || IsReal<T>::value,
                "Svar reads bool, integers (char is none), float, double, std::string and Svar");
  static std::string name() { return numberName<T>(); }
};
template <>
struct SvarTarget<bool> {
  static std::string name() { return "bool"; }
};
template <>
struct SvarTarget<std::string> {
  static std::string name() { return "string"; }
};
template <>
struct SvarTarget<Svar> {
  static std::string name() { return "any value"; }
};

}  // namespace detail

template <class T>
T Svar::readOrThrow(detail::Text path) const {
  T out = T();
  if (!read(out)) failType(path, detail::SvarTarget<T>::name());
  return out;
}

template <class T>
bool Svar::is() const {
  static_assert(sizeof(detail::SvarTarget<T>) != 0, "");  // says what T may be
  T ignored = T();
  return read(ignored);
}

template <class T>
T Svar::as() const {
  return readOrThrow<T>("");
}

// --- reading

inline const char* Svar::typeName() const noexcept {
  static const char* const names[] = {"null", "bool", "int", "double", "string", "array", "object"};
  return names[static_cast<std::size_t>(type_)];
}

inline std::size_t Svar::size() const {
  if (isNull()) return 0;
  if (!isContainer()) failType("", "array or object");
  return type_ == SvarType::array ? asArray().size() : asObject().members().size();
}

inline Svar::const_iterator Svar::begin() const {
  if (isNull()) return nullptr;
  if (type_ != SvarType::array) failType("", "array");
  return asArray().data();
}

inline Svar::const_iterator Svar::end() const {
  return isNull() ? nullptr : begin() + size();
}

inline Span<const Svar::Member> Svar::members() const {
  if (isNull()) return Span<const Member>();
  if (type_ != SvarType::object) failType("", "object");
  return asObject().members();
}

inline Svar Svar::operator[](detail::Text name) const {
  const Svar* const member = type_ == SvarType::object ? child(name) : nullptr;
  if (member == nullptr) failMissing(name.str(), "expected a member, found nothing", name, "");
  return *member;
}

template <class I, detail::EnableIf<detail::IsInteger<I>::value>>
Svar Svar::operator[](I index) const {
  const std::size_t i = static_cast<std::size_t>(index);  // far too large where it is negative
  if (type_ == SvarType::array && i < asArray().size()) return asArray()[i];
  const std::string name = std::to_string(index);
  failMissing(name, "expected an element, found nothing", name, "");
}

inline Svar* Svar::child(detail::Text name) const {
  std::size_t index = 0;
  if (type_ == SvarType::object) return asObject().find(name);
  const bool inside =
      type_ == SvarType::array && detail::parseIndex(name, index) && index < asArray().size();
  return inside ? &asArray()[index] : nullptr;
}

// Whether a part of that name may just be missing; else the type of this is wrong.
inline bool Svar::mayHave(detail::Text name) const {
  std::size_t ignored = 0;
  return isNull() || type_ == SvarType::object ||
         (type_ == SvarType::array && detail::parseIndex(name, ignored));
}

inline Svar::Walk Svar::walk(detail::Text path) const {
  Walk walk = {detail::PathReader(path), this, nullptr, false, false};
  for (;; walk.reader.next()) {
    if (walk.at->isContainer()) walk.container = walk.at;
    walk.shared = walk.shared || walk.at->isShared();
    const Svar* const next = walk.at->child(walk.reader.name());
    if (next == nullptr) return walk;
    walk.at = next;
    walk.found = walk.reader.isLast();
    if (walk.found) return walk;
  }
}

template <class T>
T Svar::get(detail::Text path) const {
  const Walk end = walk(path);
  if (!end.found) failMissing<T>(path, end);
  return end.at->readOrThrow<T>(path);
}

template <class T>
T Svar::get(detail::Text path, const typename std::common_type<T>::type& fallback) const {
  const Walk end = walk(path);
  if (end.found) return end.at->readOrThrow<T>(path);
  if (!end.at->mayHave(end.reader.name())) failMissing<T>(path, end);
  return fallback;
}

template <class T>
void Svar::failMissing(detail::Text path, const Walk& end) {
  end.at->failMissing(path.str(), "expected " + detail::SvarTarget<T>::name() + ", found nothing",
                      end.reader.name(), end.reader.parent());
}

// --- writing

inline Svar& Svar::makeChild(detail::Text name) {
  if (isNull()) *this = object();
  return asObject().insert(name, Svar());
}

inline void Svar::set(detail::Text path, Svar value) & {
  Walk end = walk(path);
  if (!end.found && !end.at->isNull() && end.at->type_ != SvarType::object) {
    end.at->failMissing(path.str(), "cannot be set", end.reader.name(), end.reader.parent());
  }
  // Nobody but a second handle can have put what is on the way into the value.
  if (end.shared && value.reaches(end.container->data_.get())) {
    throw SvarError(path.str(), "cannot be set: the " + value.describe() + " would contain itself");
  }
  Svar* place = const_cast<Svar*>(end.at);  // it is inside of this, which is not const
  while (!end.found) {
    place = &place->makeChild(end.reader.name());
    end.found = end.reader.isLast();
    if (!end.found) end.reader.next();
  }
  *place = std::move(value);
}

inline void Svar::push_back(Svar value) & {
  if (isNull()) *this = array();
  if (type_ != SvarType::array) failType("", "array");
  if (isShared() && value.reaches(data_.get())) {
    throw SvarError("", "cannot be appended: the " + value.describe() + " would contain itself");
  }
  asArray().push_back(std::move(value));
}

inline bool Svar::erase(detail::Text path) & {
  const Walk end = walk(path);
  if (!end.found) return false;
  if (end.container->type_ == SvarType::object) {
    return end.container->asObject().erase(end.reader.name());
  }
  Array& elements = end.container->asArray();
  elements.erase(elements.begin() + (end.at - elements.data()));
  return true;
}

// --- messages

// Type and value, short enough for a message: `int 30`, `string "abc"`, `array of 3`.
inline std::string Svar::describe() const {
  std::string name = typeName();
  if (isNull()) return name;
  if (isContainer()) return name + " of " + std::to_string(size());
  if (type_ == SvarType::boolean) return name + (number_.integer != 0 ? " true" : " false");
  if (type_ == SvarType::integer) return name + " " + std::to_string(number_.integer);
  if (type_ == SvarType::real) {
    char digits[32];
    for (int count = 15; count <= 17; ++count) {  // as few digits as say which double it is
      std::snprintf(digits, sizeof(digits), "%.*g", count, number_.real);
      if (std::strtod(digits, nullptr) == number_.real) break;
    }
    return name + " " + digits;
  }
  const std::string text = asString().str();
  std::size_t cut = 40;
  if (text.size() <= cut) return name + " \"" + text + "\"";
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0u) == 0x80u) --cut;
  return name + " \"" + text.substr(0, cut) + "...\"";  // cut between UTF-8 characters
}

inline void Svar::failType(detail::Text path, const std::string& expected) const {
  throw SvarError(path.str(), "expected " + expected + ", found " + describe());
}

inline void Svar::failMissing(const std::string& path, const std::string& problem,
                              detail::Text name, detail::Text where) const {
  throw SvarError(path, problem + ": no \"" + name.str() + "\" in " +
                            (where.empty() ? "the value" : where.str()) + " (" + describe() + ")");
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_SVAR_IMPL_H
