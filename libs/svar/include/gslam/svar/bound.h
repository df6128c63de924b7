#ifndef GSLAM_SVAR_BOUND_H
#define GSLAM_SVAR_BOUND_H

#include <gslam/svar/svar.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

/// @file
/// A variable that follows one value of a SharedSvar.

namespace gslam {
inline namespace v1 {
namespace detail {

template <class T>
struct IsAtomic : std::integral_constant<bool, std::is_same<T, bool>::value ||
                                                   IsInteger<T>::value || IsReal<T>::value> {};

/// A value that one thread stores while others load it. Storing never throws: what could is in
/// make().
template <class T, bool is_atomic = IsAtomic<T>::value>
class SharedValue {
 public:
  using Made = T;
  static Made make(T value) noexcept { return value; }

  explicit SharedValue(T value) noexcept : value_(value) {}
  T load() const noexcept { return value_.load(std::memory_order_acquire); }
  /// Leaves the former value in `next`, or anything.
  void store(Made& next) noexcept { value_.store(next, std::memory_order_release); }

 private:
  std::atomic<T> value_;
};
template <class T>
class SharedValue<T, false> {
 public:
  using Made = std::shared_ptr<const T>;
  static Made make(T value) { return std::make_shared<const T>(std::move(value)); }

  explicit SharedValue(T value) : value_(make(std::move(value))) {}
  T load() const {
    Made now;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      now = value_;
    }
    return *now;
  }
  void store(Made& next) noexcept {
    const std::lock_guard<std::mutex> lock(mutex_);
    value_.swap(next);
  }

 private:
  mutable std::mutex mutex_;
  Made value_;
};

template <class T>
struct BoundState {
  explicit BoundState(T initial) : value(std::move(initial)) {}
  SharedValue<T> value;
  std::atomic<std::uint64_t> version{0};
};

}  // namespace detail

class SharedSvar;

/// A variable that always has the value at one path of a SharedSvar, for loops that read it often.
/// SharedSvar::bind() makes it.
///
/// For bool and numbers reading is one atomic load; for other types it takes a lock for a moment
/// and copies, so ask version() first. Copies are the same variable; when the SharedSvar is gone it
/// keeps the last value. Any number of threads may read it.
template <class T>
class Bound {
 public:
  /// The value now. Two reads in a row may give different ones.
  T get() const { return state_->value.load(); }
  /// The same.
  operator T() const { return get(); }  // NOLINT(google-explicit-constructor)

  /// Grows with each change of the value, before the change can be seen elsewhere; one atomic load.
  /// A value read after a version is at least as new.
  std::uint64_t version() const noexcept { return state_->version.load(std::memory_order_acquire); }

 private:
  friend class SharedSvar;
  explicit Bound(T initial) : state_(std::make_shared<detail::BoundState<T>>(std::move(initial))) {}
  using Made = typename detail::SharedValue<T>::Made;
  void store(Made& next) const noexcept {
    state_->value.store(next);
    state_->version.fetch_add(1, std::memory_order_release);
  }

  std::shared_ptr<detail::BoundState<T>> state_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_BOUND_H
