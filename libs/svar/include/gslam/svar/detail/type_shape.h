// What a type looks like from outside: told by its members, so that no container's header is
// needed.
#ifndef GSLAM_SVAR_DETAIL_TYPE_SHAPE_H
#define GSLAM_SVAR_DETAIL_TYPE_SHAPE_H

#include <gslam/svar/number.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

namespace gslam {
inline namespace v1 {

class Svar;
template <class T, class Enable>
struct SvarTraits;

namespace detail {

template <class...>
struct MakeVoid {
  using type = void;
};
template <class... Ts>
using Void = typename MakeVoid<Ts...>::type;

/// std::string, std::string_view and their like.
template <class T, class = void>
struct IsText : std::false_type {};
template <class T>
struct IsText<T, Void<typename T::traits_type, decltype(std::declval<const T&>().data())>>
    : std::is_convertible<decltype(std::declval<const T&>().data()), const char*> {};

/// What Svar reads without SvarTraits.
template <class T>
struct IsPlain
    : std::integral_constant<bool, std::is_same<T, bool>::value || IsInteger<T>::value ||
                                       IsReal<T>::value || std::is_same<T, std::string>::value ||
                                       std::is_same<T, Svar>::value> {};

template <class T, class = void>
struct HasToSvar : std::false_type {};
template <class T>
struct HasToSvar<T, Void<decltype(SvarTraits<T, void>::toSvar(std::declval<const T&>()))>>
    : std::true_type {};
template <>  // without asking for SvarTraits while Svar is not complete
struct HasToSvar<Svar, void> : std::false_type {};

template <class T, class = void>
struct HasFromSvar : std::false_type {};
template <class T>
struct HasFromSvar<T, Void<decltype(SvarTraits<T, void>::fromSvar(std::declval<const Svar&>()))>>
    : std::true_type {};

/// Whether Svar::as<T>() compiles.
template <class T>
struct IsReadable : std::integral_constant<bool, IsPlain<T>::value || HasFromSvar<T>::value> {};

template <class T, class = void>
struct HasElements : std::false_type {};
template <class T>
struct HasElements<T, Void<typename T::value_type, decltype(std::declval<const T&>().begin()),
                           decltype(std::declval<const T&>().end())>>
    : std::integral_constant<bool, !IsText<T>::value> {};

template <class T, class = void>
struct IsMap : std::false_type {};
template <class T>
struct IsMap<T, Void<typename T::key_type, typename T::mapped_type>> : HasElements<T> {};

template <class T, class = void>
struct IsTuple : std::false_type {};
template <class T>
struct IsTuple<T, Void<decltype(std::tuple_size<T>::value)>> : std::true_type {};

/// A map whose keys are std::string. Others are neither maps nor sequences to Svar.
template <class T, bool = IsMap<T>::value>
struct IsTextMap : std::false_type {};
template <class T>
struct IsTextMap<T, true> : std::is_same<typename T::key_type, std::string> {};

/// Elements of one type, of which there may be any number.
template <class T>
struct IsSequence : std::integral_constant<bool, HasElements<T>::value && !IsMap<T>::value &&
                                                     !IsTuple<T>::value> {};

/// Elements of one type in a row, as many as the type says or any number.
template <class T>
struct IsList : std::integral_constant<bool, HasElements<T>::value && !IsMap<T>::value> {};

template <class T, class = void>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<T, Void<decltype(std::declval<const T&>().has_value()),
                          decltype(std::declval<const T&>().value())>> : std::true_type {};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_TYPE_SHAPE_H
