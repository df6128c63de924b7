// Which type a topic carries, told also across shared libraries.
#ifndef GSLAM_MESSENGER_DETAIL_PAYLOAD_TYPE_H
#define GSLAM_MESSENGER_DETAIL_PAYLOAD_TYPE_H

#include <gslam/base/platform.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <typeinfo>

namespace gslam {
inline namespace v1 {
namespace detail {

/// A type as its type_info, size and alignment.
struct PayloadType {
  const std::type_info* info;
  std::size_t size;
  std::size_t align;
  bool is_flat;  ///< whether its size is all that it takes

  template <class T>
  static PayloadType of() noexcept {
    return {&typeid(T), sizeof(T), alignof(T), std::is_trivially_copyable<T>::value};
  }

  std::string name() const { return readableTypeName(info->name()); }
};

/// Whether two libraries may have different types of that name: those of an unnamed namespace, and
/// those that the compiler marks with a star as local to one library.
inline bool isLocalToLibrary(const char* name) noexcept {
  return name[0] == '*' || std::strstr(name, "_GLOBAL__N") != nullptr ||
         std::strstr(name, "{anonymous}") != nullptr ||
         std::strstr(name, "anonymous namespace") != nullptr;  // in brackets or quotes
}

/// The same type has one type_info in a program, but where plugins are loaded each may bring its
/// own: then the name tells, together with size and alignment.
inline bool operator==(const PayloadType& a, const PayloadType& b) noexcept {
  if (a.info == b.info) return true;
  const char* const name = a.info->name();
  return std::strcmp(name, b.info->name()) == 0 && !isLocalToLibrary(name) && a.size == b.size &&
         a.align == b.align;
}
inline bool operator!=(const PayloadType& a, const PayloadType& b) noexcept {
  return !(a == b);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_PAYLOAD_TYPE_H
