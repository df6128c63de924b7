#ifndef GSLAM_MESSENGER_MESSAGE_STAMP_H
#define GSLAM_MESSENGER_MESSAGE_STAMP_H

#include <cstdint>
#include <limits>
#include <type_traits>

/// @file
/// The time of a message.

namespace gslam {
inline namespace v1 {
namespace detail {

/// @cond
// Of overloads that are possible the one with the highest rank is the best match.
template <int N>
struct Rank : Rank<N - 1> {};
template <>
struct Rank<0> {};
/// @endcond

/// Whether it counts something; bool does not.
template <class T>
struct IsCount {
  using Bare = typename std::decay<T>::type;
  static constexpr bool value = std::is_integral<Bare>::value && !std::is_same<Bare, bool>::value;
};

template <class Integer>
std::int64_t toNanoseconds(Integer count) noexcept {
  constexpr std::int64_t end = std::numeric_limits<std::int64_t>::max();
  const bool is_beyond = count > 0 && static_cast<std::uint64_t>(count) > std::uint64_t{end};
  return is_beyond ? end : static_cast<std::int64_t>(count);
}

template <class Seconds, class Nanoseconds>
std::int64_t toNanoseconds(Seconds seconds, Nanoseconds nanoseconds) noexcept {
  static_assert(IsCount<Seconds>::value && sizeof(Seconds) <= 4 && IsCount<Nanoseconds>::value &&
                    sizeof(Nanoseconds) <= 4,
                "header.stamp must have whole seconds and nanoseconds of 32 bits; for others "
                "specialise gslam::MessageStamp");
  return std::int64_t{seconds} * 1000000000 + std::int64_t{nanoseconds};
}

template <class T>
auto stampOf(const T& message, Rank<3>) ->
    typename std::enable_if<IsCount<decltype(message.stamp)>::value, std::int64_t>::type {
  return toNanoseconds(message.stamp);
}
template <class T>
auto stampOf(const T& message, Rank<2>)
    -> decltype(toNanoseconds(message.header.stamp.sec, message.header.stamp.nsec)) {
  return toNanoseconds(message.header.stamp.sec, message.header.stamp.nsec);
}
template <class T>
auto stampOf(const T& message, Rank<1>)
    -> decltype(toNanoseconds(message.header.stamp.sec, message.header.stamp.nanosec)) {
  return toNanoseconds(message.header.stamp.sec, message.header.stamp.nanosec);
}
template <class T>
std::int64_t stampOf(const T&, Rank<0>) {
  static_assert(sizeof(T) == 0,
                "the message has neither an integer member stamp, in nanoseconds, nor "
                "header.stamp with sec and nsec or nanosec; specialise gslam::MessageStamp");
  return 0;
}

}  // namespace detail

/// Tells the time of messages of type T. Specialise it for types that have neither
///
/// * `stamp`, an integer, in nanoseconds (unsigned ones beyond int64 count as its end), nor
/// * `header.stamp` with `sec` and `nsec` or `nanosec`, as ROS 1 and ROS 2 generate it.
///
///     template <>
///     struct gslam::MessageStamp<Scan> {
///       static std::int64_t nanoseconds(const Scan& scan) { return scan.microseconds * 1000; }
///     };
template <class T>
struct MessageStamp {
  /// The time of a message, in nanoseconds since whenever the clock of all messages began.
  static std::int64_t nanoseconds(const T& message) {
    return detail::stampOf(message, detail::Rank<3>());
  }
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_MESSAGE_STAMP_H
