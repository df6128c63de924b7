// SvarTraits of the types that are known from the beginning, and the names of types in messages.
#include <gslam/svar/svar.h>  // includes this file, so that it comes before the guard

#ifndef GSLAM_SVAR_DETAIL_SVAR_TRAITS_H
#define GSLAM_SVAR_DETAIL_SVAR_TRAITS_H

#include <gslam/base/detail/indices.h>
#include <gslam/svar/detail/svar_parts.h>

#include <array>
#include <tuple>
#include <typeinfo>

namespace gslam {
inline namespace v1 {
namespace detail {

// --- names of types in messages

/// The name of a type as C++ has it, without const.
template <class T>
std::string cppTypeName() {
  return readableTypeName(typeid(T).name());
}

template <class T, class = void>
struct SvarTarget {
  static std::string name() { return cppTypeName<T>(); }
};
template <class T>
struct SvarTarget<T, typename std::enable_if<IsInteger<T>::value || IsReal<T>::value>::type> {
  static std::string name() { return numberName<T>(); }
};
template <class T>
struct SvarTarget<T, Void<decltype(SvarTraits<T>::name())>> {
  static std::string name() { return SvarTraits<T>::name(); }
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
template <>
struct SvarTarget<void> {
  static std::string name() { return "void"; }
};

/// "int32", "array of double", or what C++ calls it.
template <class T>
std::string svarTypeName() {
  return SvarTarget<T>::name();
}

// --- parts of values

/// The part as a T; errors have its name in front of their path.
template <class T>
T partAs(const Svar& part, const std::string& name) {
  try {
    return part.as<T>();
  } catch (const SvarError& error) {
    throw SvarError(joinPaths(name, error.path()), error.problem());
  }
}
template <class T>
T partAs(const Svar& part, std::size_t index) {
  try {
    return part.as<T>();
  } catch (const SvarError& error) {
    throw SvarError(joinPaths(std::to_string(index), error.path()), error.problem());
  }
}

/// @throws SvarError where the value is no array of that size
inline void checkSize(const Svar& value, std::size_t size) {
  const std::string expected = "array of " + std::to_string(size);
  if (value.type() != SvarType::array || value.size() != size) {
    SvarParts::failType(value, expected);
  }
}

// --- containers

template <class C>
auto addElement(C& container, typename C::value_type element, int)
    -> decltype(container.push_back(std::move(element)), void()) {
  container.push_back(std::move(element));
}
template <class C>
auto addElement(C& container, typename C::value_type element, long)
    -> decltype(container.insert(std::move(element)), void()) {
  container.insert(std::move(element));
}

template <class C, class = void>
struct CanAdd : std::false_type {};
template <class C>
struct CanAdd<
    C, Void<decltype(addElement(std::declval<C&>(), std::declval<typename C::value_type>(), 0))>>
    : std::true_type {};

template <class C>
auto reserve(C& container, std::size_t size, int) -> decltype(container.reserve(size), void()) {
  container.reserve(size);
}
template <class C>
void reserve(C&, std::size_t, long) {}

/// The bytes of a binary into a container of bytes; false where either is something else.
template <class C>
bool readBytes(const Svar& value, C& container, std::true_type) {
  if (value.type() != SvarType::binary) return false;
  for (const std::uint8_t byte : value.bytes()) addElement(container, byte, 0);
  return true;
}
template <class C>
bool readBytes(const Svar&, C&, std::false_type) {
  return false;
}

}  // namespace detail

/// std::vector, deque, list, set and all that have elements of one type. One of bytes
/// (std::uint8_t) is made from a binary, too.
template <class C>
struct SvarTraits<C, typename std::enable_if<detail::IsSequence<C>::value>::type> {
  using Element = typename C::value_type;
  /// "array of double"
  static std::string name() { return "array of " + detail::svarTypeName<Element>(); }
  /// An array.
  static Svar toSvar(const C& container) {
    static_assert(std::is_convertible<const Element&, Svar>::value,
                  "Svar does not know the elements of this: specialise gslam::SvarTraits");
    std::vector<Svar> elements;
    for (const auto& element : container) {
      elements.emplace_back(static_cast<const Element&>(element));
    }
    return detail::SvarParts::array(std::move(elements));
  }
  /// From an array.
  static C fromSvar(const Svar& value) {
    static_assert(detail::CanAdd<C>::value, "Svar can fill containers only, not views of them");
    C container;
    if (detail::readBytes(value, container, std::is_same<Element, std::uint8_t>())) {
      return container;
    }
    if (value.type() != SvarType::array) detail::SvarParts::failType(value, name());
    detail::reserve(container, value.size(), 0);
    std::size_t i = 0;
    for (const Svar& element : value) {
      detail::addElement(container, detail::partAs<Element>(element, i++), 0);
    }
    return container;
  }
};

/// std::map, unordered_map and their like, whose keys are text.
template <class C>
struct SvarTraits<C, typename std::enable_if<detail::IsTextMap<C>::value>::type> {
  using Mapped = typename C::mapped_type;
  /// "object of double"
  static std::string name() { return "object of " + detail::svarTypeName<Mapped>(); }
  /// An object whose members stand in the order of the map.
  /// @throws SvarError where a key stands there twice
  static Svar toSvar(const C& map) {
    std::vector<Svar::Member> list;
    for (const auto& entry : map) list.emplace_back(entry.first, Svar(entry.second));
    detail::SvarParts::Members members;
    const std::size_t repeat = members.assign(std::move(list)).second;
    if (repeat != members.members().size()) {
      throw SvarError(members.members()[repeat].first, "expected each name once, found it twice");
    }
    return detail::SvarParts::object(std::move(members));
  }
  /// From an object.
  static C fromSvar(const Svar& value) {
    if (value.type() != SvarType::object) detail::SvarParts::failType(value, name());
    C map;
    for (const Svar::Member& member : value.members()) {
      map.emplace(member.first, detail::partAs<Mapped>(member.second, member.first));
    }
    return map;
  }
};

namespace detail {

/// The parts of a std::pair, std::tuple or std::array, one by one.
template <class T, std::size_t size = std::tuple_size<T>::value>
struct TupleParts {
  template <std::size_t i>
  using Part = typename std::decay<decltype(std::get<i>(std::declval<const T&>()))>::type;

  template <std::size_t... I>
  static Svar toArray(const T& tuple, Indices<I...>) {
    (void)tuple;
    return Svar::array({Svar(std::get<I>(tuple))...});
  }
  template <std::size_t... I>
  static T fromArray(const Svar& value, Indices<I...>) {
    checkSize(value, size);
    return T{partAs<Part<I>>(value[I], I)...};
  }
};

}  // namespace detail

/// std::array, std::pair and std::tuple: arrays of exactly that size.
template <class T>
struct SvarTraits<T, typename std::enable_if<detail::IsTuple<T>::value>::type> {
  using Indices = typename detail::MakeIndices<std::tuple_size<T>::value>::Type;
  /// "array of 3"
  static std::string name() { return "array of " + std::to_string(std::tuple_size<T>::value); }
  /// An array.
  static Svar toSvar(const T& tuple) { return detail::TupleParts<T>::toArray(tuple, Indices()); }
  /// From an array of the same size.
  static T fromSvar(const Svar& value) {
    return detail::TupleParts<T>::fromArray(value, Indices());
  }
};

/// std::optional and its like: null stands for nothing.
template <class T>
struct SvarTraits<T, typename std::enable_if<detail::IsOptional<T>::value>::type> {
  using Value = typename std::decay<decltype(std::declval<const T&>().value())>::type;
  /// "double or null"
  static std::string name() { return detail::svarTypeName<Value>() + " or null"; }
  /// Null or the value.
  static Svar toSvar(const T& value) { return value.has_value() ? Svar(value.value()) : Svar(); }
  /// From null or the value.
  static T fromSvar(const Svar& value) { return value.isNull() ? T() : T(value.as<Value>()); }
};

namespace detail {

/// What a native value holds: the object, and what it was when it came.
class SvarNative {
 public:
  template <class T>
  explicit SvarNative(const std::shared_ptr<T>& object)
      : object_(std::const_pointer_cast<typename std::remove_const<T>::type>(object)),
        type_(typeid(T)),
        is_const_(std::is_const<T>::value) {}

  template <class T>
  bool holds() const noexcept {
    return type_ == typeid(T) && (std::is_const<T>::value || !is_const_);
  }
  const std::shared_ptr<void>& object() const noexcept { return object_; }
  // The first member of an object has its address, too.
  bool same(const SvarNative& other) const noexcept {
    return object_ == other.object_ && type_ == other.type_;
  }
  std::string typeName() const {
    return (is_const_ ? "const " : "") + readableTypeName(type_.name());
  }

 private:
  std::shared_ptr<void> object_;
  const std::type_info& type_;
  bool is_const_;
};

}  // namespace detail

/// std::shared_ptr: the object it points to becomes a native object, and null null. It is found
/// again as what it was when it came, be it more const; not as a base class.
template <class T>
struct SvarTraits<std::shared_ptr<T>> {
  /// "native Image"
  static std::string name() {
    return std::string("native ") + (std::is_const<T>::value ? "const " : "") +
           detail::cppTypeName<T>();
  }
  /// Shares the object.
  static Svar toSvar(const std::shared_ptr<T>& object) {
    if (object == nullptr) return Svar();
    return detail::SvarParts::make(SvarType::native, std::make_shared<detail::SvarNative>(object));
  }
  /// Shares the object.
  static std::shared_ptr<T> fromSvar(const Svar& value) {
    if (value.isNull()) return nullptr;
    const detail::SvarNative* const native = detail::SvarParts::native(value);
    if (native == nullptr || !native->holds<T>()) detail::SvarParts::failType(value, name());
    return std::static_pointer_cast<T>(native->object());
  }
};

inline const detail::SvarNative& Svar::asNative() const {
  return *static_cast<const detail::SvarNative*>(data_.get());
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SVAR_TRAITS_H
