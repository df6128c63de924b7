#ifndef GSLAM_SVAR_FIELDS_H
#define GSLAM_SVAR_FIELDS_H

#include <gslam/svar/svar.h>

#include <cstddef>
#include <string>

/// @file
/// Structs whose fields are listed once, for both ways.

namespace gslam {
inline namespace v1 {
namespace detail {

template <class T>
class FieldWriter {
 public:
  explicit FieldWriter(const T& from) : from_(from) {}
  template <class Field, class Owner>  // T or one of its base classes
  void operator()(const char* name, Field Owner::*field) {
    object_.set("/" + escapeName(name), from_.*field);
  }
  Svar object() const { return object_; }

 private:
  const T& from_;
  Svar object_ = Svar::object();
};

template <class T>
class MemberReader {
 public:
  MemberReader(const Svar& object, T& into) : object_(object), into_(into) {}
  template <class Field, class Owner>  // T or one of its base classes
  void operator()(const char* name, Field Owner::*field) {
    names_ += (names_.empty() ? "" : ", ") + std::string(name);
    const Svar* const member = SvarParts::member(object_, name);
    if (member == nullptr) return;
    into_.*field = partAs<Field>(*member, name);
    ++found_;
  }
  bool foundAll() const { return found_ == object_.size(); }
  const std::string& names() const { return names_; }

 private:
  const Svar& object_;
  T& into_;
  std::string names_;
  std::size_t found_ = 0;
};

struct FieldNames {
  template <class Field>
  void operator()(const char* name, Field) {
    is_one = is_one || Text(name) == asked;
  }
  Text asked;
  bool is_one;
};

}  // namespace detail

/// SvarTraits of a struct as an object that has its fields as members:
///
///     namespace gslam {
///     template <>
///     struct SvarTraits<Camera> : SvarFields<Camera> {
///       template <class Visit>
///       static void fields(Visit& visit) {
///         visit("fx", &Camera::fx);
///         visit("model", &Camera::model);
///       }
///     };
///     }
///
/// A field that the object does not have keeps the value that `T()` gives it; a member that is no
/// field is an error, for it is most likely a name mistyped.
template <class T>
struct SvarFields {
  /// An object with all fields.
  static Svar toSvar(const T& from) {
    detail::FieldWriter<T> writer(from);
    SvarTraits<T>::fields(writer);
    return writer.object();
  }
  /// @throws SvarError for anything but an object, for a member that is no field, and for a member
  ///         whose type is not that of its field
  static T fromSvar(const Svar& value) {
    if (value.type() != SvarType::object) {
      detail::SvarParts::failType(value, detail::cppTypeName<T>());
    }
    T into = T();
    detail::MemberReader<T> reader(value, into);
    SvarTraits<T>::fields(reader);
    if (!reader.foundAll()) failUnknown(value, reader.names());
    return into;
  }

 private:
  [[noreturn]] static void failUnknown(const Svar& value, const std::string& names) {
    for (const Svar::Member& member : value.members()) {
      detail::FieldNames known = {member.first, false};
      SvarTraits<T>::fields(known);
      if (!known.is_one) {
        throw SvarError(member.first,
                        "is no field of " + detail::cppTypeName<T>() + ", which has " + names);
      }
    }
    throw SvarError("", "a field of " + detail::cppTypeName<T>() + " is listed twice");
  }
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_FIELDS_H
