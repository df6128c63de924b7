// How long to wait, when told any duration.
#ifndef GSLAM_MESSENGER_DETAIL_WAIT_TIME_H
#define GSLAM_MESSENGER_DETAIL_WAIT_TIME_H

#include <chrono>

namespace gslam {
inline namespace v1 {
namespace detail {

/// A duration that can be added to any clock's time: from 0 to 100 years, which is for ever.
template <class Rep, class Period>
std::chrono::nanoseconds waitTime(const std::chrono::duration<Rep, Period>& wish) {
  using Seconds = std::chrono::duration<double>;
  const std::chrono::nanoseconds longest = std::chrono::hours(24 * 36500);
  const Seconds wanted = wish;
  if (!(wanted.count() > 0)) return std::chrono::nanoseconds(0);  // not a number, too
  if (wanted >= Seconds(longest)) return longest;
  return std::chrono::duration_cast<std::chrono::nanoseconds>(wish);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_WAIT_TIME_H
