// Function bodies of svar.h, which says what they do: making, reading and writing.
#include <gslam/svar/svar.h>  // includes this file, so that it comes before the guard

#ifndef GSLAM_SVAR_DETAIL_SVAR_IMPL_H
#define GSLAM_SVAR_DETAIL_SVAR_IMPL_H

#include <gslam/svar/detail/svar_traits.h>

#include <cstdio>
#include <cstdlib>

namespace gslam {
inline namespace v1 {

// --- making

inline Svar::Svar(const char* value) : Svar(SvarType::string, detail::Text(value)) {}

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

inline Svar Svar::binary(const void* data, std::size_t size) {
  return Svar(SvarType::binary, detail::Text(static_cast<const char*>(data), size));
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

template <class T>
T Svar::readOrThrow(detail::Text path, std::true_type) const {
  T out = T();
  if (!read(out)) failType(path, detail::svarTypeName<T>());
  return out;
}

template <class T>
T Svar::readOrThrow(detail::Text path, std::false_type) const {
  static_assert(detail::HasFromSvar<T>::value,
                "Svar does not know how to make this type: specialise gslam::SvarTraits");
  try {
    return SvarTraits<T>::fromSvar(*this);
  } catch (const SvarError& error) {
    if (path.empty()) throw;
    throw SvarError(detail::joinPaths(path.str(), error.path()), error.problem());
  }
}

namespace detail {

template <class T>
bool canBe(const Svar& value) {
  try {
    value.as<T>();
    return true;
  } catch (const SvarError&) {
    return false;
  }
}

}  // namespace detail

template <class T>
bool Svar::is() const {
  return detail::canBe<T>(*this);
}

template <class T>
T Svar::as() const {
  return readOrThrow<T>("");
}

// --- reading

inline const char* Svar::typeName() const noexcept {
  static const char* const names[] = {"null",   "bool",     "int",    "double", "string",
                                      "binary", "function", "native", "array",  "object"};
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

inline Span<const std::uint8_t> Svar::bytes() const {
  if (type_ != SvarType::binary) failType("", "binary");
  return Span<const std::uint8_t>(static_cast<const std::uint8_t*>(data_.get()),
                                  static_cast<std::size_t>(number_.integer));
}

inline Svar Svar::operator[](detail::Text path) const {
  return get<Svar>(path);
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

// The member whose name is the whole path, or null; what begins with a slash is never a name.
inline const Svar* Svar::wholeName(detail::Text path) const {
  const bool pointer = !path.empty() && *path.data() == '/';
  return type_ == SvarType::object && !pointer ? asObject().find(path) : nullptr;
}

// What stands at the path, or null; null also for a malformed path, which walk() finds out.
inline const Svar* Svar::find(detail::Text path) const {
  const Svar* const whole = wholeName(path);
  if (whole != nullptr) return whole;
  const Svar* at = this;
  for (detail::PathReader reader(path); at != nullptr; reader.next()) {
    if (reader.isMalformed()) return nullptr;
    at = at->child(reader.name());
    if (reader.isLast()) break;
  }
  return at;
}

// The same, for writing and for messages.
inline Svar::Walk Svar::walk(detail::Text path) const {
  Walk walk(path, this);
  if (isContainer()) walk.container = this;
  walk.shared = isShared();
  const Svar* const whole = wholeName(path);
  if (whole != nullptr) {
    walk.at = whole;
    walk.found = true;
    return walk;
  }
  walk.reader.check();
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

inline bool Svar::contains(detail::Text path) const {
  if (find(path) != nullptr) return true;
  detail::PathReader(path).check();
  return false;
}

template <class T>
T Svar::get(detail::Text path) const {
  const Svar* const found = find(path);
  if (found == nullptr) failMissing<T>(path, walk(path));
  return found->readOrThrow<T>(path);
}

template <class T>
T Svar::get(detail::Text path, const typename std::common_type<T>::type& fallback) const {
  const Svar* const found = find(path);
  if (found != nullptr) return found->readOrThrow<T>(path);
  Walk end = walk(path);
  if (!end.at->mayHave(end.reader.name())) failMissing<T>(path, std::move(end));
  return fallback;
}

template <class T>
void Svar::failMissing(detail::Text path, Walk end) {
  end.at->failMissing(path.str(), "expected " + detail::svarTypeName<T>() + ", found nothing",
                      end.reader.name(), end.reader.parent());
}

// --- writing

inline void Svar::addChild(detail::Text name, Svar value) {
  if (!isNull()) {
    asObject().insert(name, std::move(value));
    return;
  }
  Svar made = object();
  made.asObject().insert(name, std::move(value));
  swap(made);
}

// Puts the objects that the rest of the path names around a value.
inline Svar Svar::wrapped(detail::PathReader rest, Svar value) {
  if (rest.isLast()) return value;
  Svar outermost;
  Svar* place = &outermost;
  while (!rest.isLast()) {
    rest.next();
    place->addChild(rest.name(), Svar());
    place = &place->asObject().members().back().second;
  }
  *place = std::move(value);
  return outermost;
}

// "/-" at the end of a path: the place behind the last element of an array.
inline bool Svar::isBehind(detail::Text path, const Walk& end) {
  return !end.found && end.at->type_ == SvarType::array && end.reader.isLast() &&
         path.size() >= 2 && detail::Text(path.end() - 2, 2) == detail::Text("/-", 2);
}

inline void Svar::checkWrite(detail::Text path, const Walk& end, const Svar& value) {
  if (end.container == nullptr) return;
  if (!end.container->isFrozen()) {
    // Nobody but a second handle can have put what is on the way into the value.
    if (!end.shared || !value.reaches(end.container->data_.get())) return;
    throw SvarError(path.str(), "cannot be set: the " + value.describe() + " would contain itself");
  }
  throw SvarError(path.str(), "cannot be changed: the " + end.container->describe() +
                                  " is frozen; clone() it first");
}

inline void Svar::set(detail::Text path, Svar value) & {
  Walk end = walk(path);
  const bool behind = isBehind(path, end);
  if (!end.found && !behind && !end.at->isNull() && end.at->type_ != SvarType::object) {
    end.at->failMissing(path.str(), "cannot be set", end.reader.name(), end.reader.parent());
  }
  checkWrite(path, end, value);
  if (behind) return end.at->asArray().push_back(std::move(value));
  Svar* const place = const_cast<Svar*>(end.at);  // it is inside of this, which is not const
  if (end.found) {
    *place = std::move(value);
  } else {
    // The last step, for it may move what the path views: a name in this object.
    place->addChild(end.reader.name(), wrapped(end.reader, std::move(value)));
  }
}

inline void Svar::push_back(Svar value) & {
  if (isNull()) *this = array();
  if (type_ != SvarType::array) failType("", "array");
  if (isFrozen()) {
    throw SvarError("", "cannot be changed: the " + describe() + " is frozen; clone() it first");
  }
  if (isShared() && value.reaches(data_.get())) {
    throw SvarError("", "cannot be appended: the " + value.describe() + " would contain itself");
  }
  asArray().push_back(std::move(value));
}

inline bool Svar::erase(detail::Text path) & {
  Walk end = walk(path);
  if (!end.found) return false;
  checkWrite(path, end, Svar());
  if (end.container->type_ == SvarType::array) {
    Array& elements = end.container->asArray();
    elements.erase(elements.begin() + (end.at - elements.data()));
    return true;
  }
  const bool whole = wholeName(path) == end.at;
  return end.container->asObject().erase(whole ? path : end.reader.name());
}

// --- messages

// Type and value, short enough for a message: `int 30`, `string "abc"`, `array of 3`.
inline std::string Svar::describe() const {
  std::string name = typeName();
  if (isNull()) return name;
  if (isContainer()) return name + " of " + std::to_string(size());
  if (type_ == SvarType::binary) return name + " of " + std::to_string(number_.integer) + " bytes";
  if (type_ == SvarType::function) return name + " " + asFunction().signature();
  if (type_ == SvarType::native) return name + " " + asNative().typeName();
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

#endif  // GSLAM_SVAR_DETAIL_SVAR_IMPL_H
