#ifndef GSLAM_SVAR_SVAR_H
#define GSLAM_SVAR_SVAR_H

#include <gslam/base/platform.h>
#include <gslam/base/span.h>
#include <gslam/svar/detail/shared_text.h>
#include <gslam/svar/detail/type_shape.h>
#include <gslam/svar/error.h>
#include <gslam/svar/number.h>
#include <gslam/svar/ordered_map.h>
#include <gslam/svar/path.h>
#include <gslam/svar/text.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// Svar: one value for parameters and configuration.

namespace gslam {
inline namespace v1 {

namespace detail {
struct SvarParts;
class SvarFunction;
class SvarNative;
}  // namespace detail

/// What a Svar holds.
enum class SvarType : unsigned char {
  null,
  boolean,
  integer,   ///< int64
  real,      ///< double
  string,    ///< bytes, by convention UTF-8
  binary,    ///< bytes that are no text
  function,  ///< anything that can be called
  native,    ///< a C++ object, held by a std::shared_ptr
  array,
  object  ///< named members in the order of insertion
};

/// How a type becomes a Svar and back: the one point to make an own type known.
///
///     namespace gslam {
///     template <>
///     struct SvarTraits<Camera> {
///       static Svar toSvar(const Camera& camera);
///       static Camera fromSvar(const Svar& value);  // throws SvarError where it is none
///     };
///     }
///
/// A struct whose fields are all known to Svar derives its traits from SvarFields instead. Known
/// from the beginning are std::vector and all containers like it, std::array, std::pair,
/// std::tuple, maps with text as keys, std::optional, and std::shared_ptr to any class (a native
/// object).
template <class T, class Enable = void>
struct SvarTraits {};

/// One value whose type is known at run time, for parameters and configuration.
///
/// **Sharing.** Null, bool, numbers, strings and binaries are values. An array or object is a
/// handle: copies of it are the same array, and a change through one is seen through all. clone()
/// makes an independent one. Functions and native objects are shared by all copies and clones. A
/// null shares nothing, so a null that becomes an object by set() does so in that one handle.
///
/// **Writing** goes through set(), push_back() and erase(), never through references: reading
/// creates nothing, and an array or object that would contain itself is refused. So comparing,
/// cloning and destroying always end, and none of them recurses, however deep the value is. What a
/// function captures and a native object holds is not looked into: a function that captures the
/// object it stands in keeps it alive for good.
///
/// **Paths** name what is inside: "camera.0.fx" or "camera/0/fx" is member "fx" of element 0 of
/// member "camera". A path with a slash anywhere is split at slashes only, and is a JSON pointer
/// (RFC 6901) whose first slash may be left out: in it ~1 and ~0 stand for / and ~, and
/// "/files/left.png" reaches a name with a dot. Unless it begins with a slash, a path first means
/// the member whose name is the whole path: "Camera.fx" finds a member of that name. A malformed
/// path is an SvarError. Names and paths are taken from literals, `std::string` or
/// `std::string_view`.
///
/// **Numbers** convert where the value stays the same: 3.0 is an int, 2.75 is not, 300 is no int8,
/// 2^53 + 1 is no double. The one exception is float, which takes a double by rounding, but not
/// beyond its range. A bool is no number, and text is never parsed.
///
/// **Threads.** Const functions may run at the same time, also on handles of the same array or
/// object. Writing while another thread reads or writes any handle of the same array or object is a
/// data race: give the other thread a frozen() value or a clone(), or use a SharedSvar.
class GSLAM_PUBLIC Svar {
 public:
  /// Name and value of a member of an object.
  using Member = std::pair<std::string, Svar>;
  /// Goes through the elements of an array; writing to the array invalidates it.
  using const_iterator = const Svar*;

  /// Null.
  Svar() noexcept : number_(std::int64_t(0)), type_(SvarType::null) {}
  /// Null.
  Svar(std::nullptr_t) noexcept : Svar() {}  // NOLINT(google-explicit-constructor)

  /// A bool. Nothing else, such as a pointer, converts to it.
  template <class T, detail::EnableIf<std::is_same<T, bool>::value> = 0>
  Svar(T value) noexcept  // NOLINT(google-explicit-constructor)
      : number_(std::int64_t(value ? 1 : 0)), type_(SvarType::boolean) {}

  /// An integer of any width; `char` is none.
  /// @throws SvarError for an unsigned value above the largest int64
  template <class T, detail::EnableIf<detail::IsInteger<T>::value> = 0>
  Svar(T value)  // NOLINT(google-explicit-constructor)
      : number_(detail::toInt64(value)), type_(SvarType::integer) {}

  /// A float or double.
  template <class T, detail::EnableIf<detail::IsReal<T>::value> = 0>
  Svar(T value) noexcept  // NOLINT(google-explicit-constructor)
      : number_(static_cast<double>(value)), type_(SvarType::real) {}

  /// A string, from a std::string or std::string_view.
  template <class S, detail::EnableIf<detail::IsText<S>::value> = 0>
  Svar(const S& value)  // NOLINT(google-explicit-constructor)
      : Svar(SvarType::string, detail::Text(value)) {}
  /// A string.
  /// @throws SvarError for a null pointer
  Svar(const char* value);  // NOLINT(google-explicit-constructor)

  /// What SvarTraits<T>::toSvar() makes of it.
  template <class T, detail::EnableIf<detail::HasToSvar<T>::value> = 0>
  Svar(const T& value)  // NOLINT(google-explicit-constructor)
      : Svar(SvarTraits<T>::toSvar(value)) {}

  /// A new array: `Svar::array({1, "two", 3.0})`.
  static Svar array(std::initializer_list<Svar> elements = {});
  /// A new object: `Svar::object({{"fps", 30}, {"name", "left"}})`.
  /// @throws SvarError when a name stands there twice
  static Svar object(std::initializer_list<Member> members = {});

  /// A copy of these bytes.
  static Svar binary(const void* data, std::size_t size);
  /// Something to call: a function, a lambda or another object with one operator(). Its parameters
  /// and result are anything that as<T>() knows, or references to native objects; one that takes a
  /// `Span<const Svar>` alone gets all arguments as they are.
  template <class F>
  static Svar function(F callable);

  /// The value in a file, whose kind its suffix tells: .json, and where GSLAM::svar_formats is
  /// linked and its header included .yaml, .yml and .xml.
  /// @throws FileError when it cannot be read or its suffix is unknown, ParseError when its content
  ///         is wrong
  static Svar load(const std::string& path);
  /// Writes the value to a file, whose kind its suffix tells as for load(). Whatever fails, the old
  /// file is still whole.
  /// @throws FileError when it cannot be written, SvarError for what the format does not have
  void save(const std::string& path) const;

  /// Shares an array or object, copies anything else.
  Svar(const Svar&) = default;
  /// Leaves null behind.
  Svar(Svar&& other) noexcept
      : number_(other.number_), type_(other.type_), data_(std::move(other.data_)) {
    other.type_ = SvarType::null;
  }
  /// Makes this handle hold the other value; what it held is unchanged in its other handles.
  Svar& operator=(Svar other) & noexcept {
    swap(other);
    return *this;
  }
  /// Exchanges what the two handles hold.
  void swap(Svar& other) noexcept {
    std::swap(number_, other.number_);
    std::swap(type_, other.type_);
    data_.swap(other.data_);
  }
  /// A copy that shares no array or object with this one. What is held n times inside becomes n
  /// clones.
  Svar clone() const;
  /// A copy that nobody can change: all arrays and objects in it refuse to be written, so threads
  /// may share it. What is frozen already is shared, not copied.
  Svar frozen() const;
  /// Whether this can be shared by threads as it is: true for all but arrays and objects that
  /// frozen() did not make.
  bool isFrozen() const noexcept;

  /// What is stored, whatever it may convert to.
  SvarType type() const noexcept { return type_; }
  /// "null", "bool", "int", "double", "string", "binary", "function", "native", "array" or
  /// "object".
  const char* typeName() const noexcept;
  /// Whether nothing is stored.
  bool isNull() const noexcept { return type_ == SvarType::null; }

  /// Whether as<T>() would succeed.
  template <class T>
  bool is() const;
  /// The value as a T: bool, an integer type, float, double, std::string, Svar (a handle), or any
  /// type that SvarTraits knows.
  /// @throws SvarError that names the type found and T, and the path where it is inside of this,
  ///         when the value is not exactly a T
  template <class T>
  T as() const;

  /// The number of elements or members; 0 for null.
  /// @throws SvarError for anything else
  std::size_t size() const;

  /// The bytes of a binary, which live as long as a copy of this value.
  /// @throws SvarError for anything else
  Span<const std::uint8_t> bytes() const;

  /// What stands at the path, as a handle.
  /// @throws SvarError when nothing stands there
  Svar operator[](detail::Text path) const;
  /// The element at that index from 0, as a handle.
  /// @throws SvarError when this is no array or has no such element
  template <class I, detail::EnableIf<detail::IsInteger<I>::value> = 0>
  Svar operator[](I index) const;

  /// Whether something, be it null, stands at the path.
  bool contains(detail::Text path) const;

  /// The value at the path as a T, by the rules of as<T>().
  /// @throws SvarError that names the whole path, T and what was found, when nothing stands there
  ///         or it is not exactly a T
  template <class T>
  T get(detail::Text path) const;
  /// The same, or `fallback` where nothing stands at the path. A null counts as something at the
  /// end of the path, and as an object without members on the way.
  /// @throws SvarError when what stands there is no T, or a value on the way cannot have such a
  ///         part (a member of a number, a name in an array)
  template <class T>
  T get(detail::Text path, const typename std::common_type<T>::type& fallback) const;

  /// Calls a function: `double d = f(1, "two").as<double>()`. May run in several threads at the
  /// same time as far as the callable may.
  /// @throws SvarError when this is no function, or the number or a type of the arguments is wrong;
  ///         and what the callable throws
  template <class... Args>
  Svar operator()(const Args&... args) const {
    const Svar list[] = {Svar(args)..., Svar()};  // an array cannot be empty
    return apply(Span<const Svar>(list, sizeof...(Args)));
  }
  /// The same with the arguments in a list.
  Svar apply(Span<const Svar> args) const;
  /// Types of the result and the parameters of a function, such as "double(int32, string)".
  /// @throws SvarError for anything else
  std::string signature() const;

  /// Puts the value at the path. Makes the objects that are missing on the way, also in place of
  /// nulls; never makes an array, and lengthens one only where the path ends in "/-".
  /// Nothing is changed where it throws SvarError.
  /// @throws SvarError when a value on the way can have no such part, would contain itself, or is
  ///         frozen
  void set(detail::Text path, Svar value) &;

  /// Appends to an array; a null becomes an array first.
  /// @throws SvarError when this is neither, or the array would contain itself or is frozen
  void push_back(Svar value) &;

  /// Removes what stands at the path; later elements move up. False where nothing stood there.
  /// @throws SvarError when it stands in something frozen
  bool erase(detail::Text path) &;

  /// First element of an array. A null is as an empty array.
  /// @throws SvarError for anything else
  const_iterator begin() const;
  /// Past the last element.
  /// @throws SvarError when this is neither array nor null
  const_iterator end() const;
  /// The members of an object in the order of insertion; writing to it invalidates them. A null is
  /// as an empty object.
  /// @throws SvarError for anything else
  Span<const Member> members() const;

  /// This with the other laid over it, as an independent value: objects are merged member by
  /// member, anything else (arrays, too) is replaced by what `over` has, be it null.
  Svar merged(const Svar& over) const;
  /// The JSON patch (RFC 6902) that makes `to` of this: an array of objects with "op" (add, remove
  /// or replace), "path" (a JSON pointer, "" for the whole value) and "value". Elements that stand
  /// at the beginning and end of both arrays are kept.
  Svar diff(const Svar& to) const;
  /// What a JSON patch (RFC 6902) makes of this, as an independent value.
  /// @throws SvarError when an operation is malformed or cannot be applied, or a "test" fails
  Svar patched(const Svar& patch) const;

  /// Same type and same value all the way down; 1 and 1.0 differ. The order of members does not
  /// count. NaN differs from itself, but an array or object equals itself whatever is inside, as a
  /// function or native object equals only itself.
  friend bool operator==(const Svar& a, const Svar& b) { return a.equals(b); }
  /// Not ==.
  friend bool operator!=(const Svar& a, const Svar& b) { return !a.equals(b); }
  /// Equal values have equal hashes, within one run of a program.
  std::size_t hash() const;

 private:
  friend struct detail::SvarParts;  // for readers and writers of formats

  using Array = std::vector<Svar>;
  using Object = detail::OrderedMap<Svar>;

  union Number {
    explicit Number(std::int64_t value) noexcept : integer(value) {}
    explicit Number(double value) noexcept : real(value) {}
    std::int64_t integer;  // also bool, as 0 or 1, and the size of a string or binary
    double real;
  };

  // What the handles of an array or object share. Its destructor does not recurse.
  template <class Parts>
  struct Node {
    explicit Node(Parts initial) : parts(std::move(initial)) {}
    ~Node() { releaseContainers(parts); }
    Parts parts;
    bool frozen = false;  // for good: set before a second handle exists; all inside is frozen, too
  };

  // How far a path leads.
  struct Walk {
    explicit Walk(detail::Text path, const Svar* start) : reader(path), at(start) {}
    detail::PathReader reader;        // at the name that was not found, or at the last
    const Svar* at;                   // the last value that was found
    const Svar* container = nullptr;  // the last array or object a name was looked up in
    bool shared = false;              // whether an array or object on the way has other handles
    bool found = false;               // whether the whole path was
  };

  Svar(SvarType string_or_binary, detail::Text text)
      : number_(static_cast<std::int64_t>(text.size())),
        type_(string_or_binary),
        data_(detail::makeSharedText(text)) {}
  Svar(SvarType type, std::shared_ptr<void> data) noexcept
      : number_(std::int64_t(0)), type_(type), data_(std::move(data)) {}

  // These are const as data_ is: a handle points to what it does not own alone.
  detail::Text asString() const noexcept {
    return detail::Text(static_cast<const char*>(data_.get()),
                        static_cast<std::size_t>(number_.integer));
  }
  Array& asArray() const { return static_cast<Node<Array>*>(data_.get())->parts; }
  Object& asObject() const { return static_cast<Node<Object>*>(data_.get())->parts; }
  detail::SvarFunction& asFunction() const;
  const detail::SvarNative& asNative() const;

  bool isContainer() const noexcept { return type_ >= SvarType::array; }
  bool isShared() const noexcept { return isContainer() && data_.use_count() > 1; }

  template <class F>
  static void forEachContainer(Array& parts, F f);
  template <class F>
  static void forEachContainer(Object& parts, F f);
  template <class F>
  void forEachContainer(F f) const;
  template <class Parts>
  static void releaseContainers(Parts& parts) noexcept;
  static std::vector<Svar>*& pendingOnThisThread() noexcept;

  using List = std::vector<const Svar*>;
  void setFrozen() const noexcept;
  void detach(bool freeze);
  Svar copied(bool freeze) const;
  bool reaches(const void* container) const;
  bool insertInto(List& sorted) const;
  bool equals(const Svar& other) const;
  std::uint64_t hashHead() const;
  static bool same(const Svar& a, const Svar& b);
  static bool equalHeads(const Svar& a, const Svar& b, List& todo);
  static bool equalParts(const Svar& a, const Svar& b, List& todo);

  bool read(bool& out) const;
  bool read(std::string& out) const;
  bool read(Svar& out) const;
  template <class T>
  bool read(T& out) const;
  template <class T>
  T readOrThrow(detail::Text path, std::true_type is_plain) const;
  template <class T>
  T readOrThrow(detail::Text path, std::false_type is_plain) const;
  template <class T>
  T readOrThrow(detail::Text path) const {
    return readOrThrow<T>(path, detail::IsPlain<T>());
  }

  const Svar* wholeName(detail::Text path) const;
  const Svar* find(detail::Text path) const;
  Svar* child(detail::Text name) const;
  bool mayHave(detail::Text name) const;
  void addChild(detail::Text name, Svar value);
  static Svar wrapped(detail::PathReader rest, Svar value);
  Walk walk(detail::Text path) const;
  static bool isBehind(detail::Text path, const Walk& end);
  static void checkWrite(detail::Text path, const Walk& end, const Svar& value);

  std::string describe() const;
  [[noreturn]] void failType(detail::Text path, const std::string& expected) const;
  template <class T>
  [[noreturn]] static void failMissing(detail::Text path, Walk end);
  [[noreturn]] void failMissing(const std::string& path, const std::string& problem,
                                detail::Text name, detail::Text where) const;

  Number number_;
  SvarType type_;
  std::shared_ptr<void> data_;  // characters (never changed), Array or Object, as type_ says
};

}  // namespace v1
}  // namespace gslam

namespace std {

/// Svar as a key of std::unordered_map and std::unordered_set.
template <>
struct hash<gslam::Svar> {
  /// As Svar::hash().
  std::size_t operator()(const gslam::Svar& value) const { return value.hash(); }
};

}  // namespace std

#include <gslam/svar/detail/svar_deep.h>
#include <gslam/svar/detail/svar_function.h>
#include <gslam/svar/detail/svar_impl.h>
#include <gslam/svar/detail/svar_patch.h>
#include <gslam/svar/detail/svar_traits.h>

#endif  // GSLAM_SVAR_SVAR_H
