// Brings sets of messages to a callback.
#ifndef GSLAM_MESSENGER_DETAIL_SET_DELIVERY_H
#define GSLAM_MESSENGER_DETAIL_SET_DELIVERY_H

#include <gslam/base/detail/indices.h>
#include <gslam/messenger/detail/error_sink.h>
#include <gslam/messenger/detail/matcher.h>

#include <array>
#include <deque>
#include <mutex>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Takes messages from any thread, and calls back one set at a time, in order, without a lock.
template <std::size_t Topics>
class SetDelivery {
 public:
  using Set = MessageSet<Topics>;
  using Result = MatchResult<Topics>;
  using Names = std::array<std::string, Topics>;

  SetDelivery(std::unique_ptr<Matcher<Topics>> matcher, Names topics, std::size_t queue_size,
              std::shared_ptr<ErrorSink> errors)
      : topics_(std::move(topics)),
        queue_size_(queue_size),
        errors_(std::move(errors)),
        matcher_(std::move(matcher)) {}
  virtual ~SetDelivery() = default;
  SetDelivery(const SetDelivery&) = delete;
  SetDelivery& operator=(const SetDelivery&) = delete;

  /// One more message; calls back unless another thread, or this one, is about it already: who
  /// calls back goes on until no set is left.
  void receive(std::size_t topic, StampedMessage message) {
    Result result;  // destroyed without the lock
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (is_ended_) return;
      matcher_->add(topic, std::move(message), result);
      for (Set& set : result.sets) ready_.push_back({std::move(set), topic});
      while (ready_.size() > queue_size_) dropReady(result);
      count(result);
      if (is_calling_ || ready_.empty()) return;
      is_calling_ = true;
    }
    callAll();
  }

  /// Drops what waits for partners, and forgets all stamps.
  void reset() {
    Result result;
    const std::lock_guard<std::mutex> lock(mutex_);
    matcher_->clear(result);
    count(result);
  }

  /// No callback begins any more.
  void end() {
    Result result;
    std::deque<Ready> unused;
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ended_ = true;
    matcher_->clear(result);
    unused.swap(ready_);
  }

  std::size_t waiting(std::size_t topic) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return matcher_->waiting(checked(topic)) + ready_.size();
  }
  std::uint64_t dropped(std::size_t topic) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_[checked(topic)];
  }
  const std::string& topic(std::size_t topic) const { return topics_[checked(topic)]; }

 protected:
  virtual void call(const Set& set) = 0;

 private:
  struct Ready {
    Set set;
    std::size_t completed_by;  // topic
  };

  void callAll() {
    for (Ready next; take(next); next = Ready()) {
      errors_->guard(topics_[next.completed_by], [&] { call(next.set); });
    }
  }

  bool take(Ready& next) {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_calling_ = !ready_.empty();
    if (!is_calling_) return false;
    next = std::move(ready_.front());
    ready_.pop_front();
    return true;
  }

  void dropReady(Result& result) {
    for (std::size_t i = 0; i < Topics; ++i) {
      result.dropped.push_back({i, std::move(ready_.front().set[i])});
    }
    ready_.pop_front();
  }
  void count(const Result& result) {
    for (const typename Result::Dropped& one : result.dropped) ++dropped_[one.topic];
  }
  std::size_t checked(std::size_t topic) const {
    if (topic < Topics) return topic;
    throw ArgumentError(
        "topic", "is " + std::to_string(topic) + ", expected less than " + std::to_string(Topics));
  }

  const Names topics_;
  const std::size_t queue_size_;
  const std::shared_ptr<ErrorSink> errors_;
  mutable std::mutex mutex_;  // guards all below
  const std::unique_ptr<Matcher<Topics>> matcher_;
  std::deque<Ready> ready_;
  std::array<std::uint64_t, Topics> dropped_ = {{0}};  // by topic
  bool is_calling_ = false;
  bool is_ended_ = false;
};

/// Calls a function that takes `const Ts&...` or `std::shared_ptr<const Ts>...`.
template <class F, class... Ts>
class TypedSetDelivery final : public SetDelivery<sizeof...(Ts)> {
  using Base = SetDelivery<sizeof...(Ts)>;
  using Set = typename Base::Set;

 public:
  TypedSetDelivery(std::unique_ptr<Matcher<sizeof...(Ts)>> matcher, typename Base::Names topics,
                   std::size_t queue_size, std::shared_ptr<ErrorSink> errors, F callback)
      : Base(std::move(matcher), std::move(topics), queue_size, std::move(errors)),
        callback_(std::move(callback)) {}

 private:
  void call(const Set& set) override {
    call(callback_, set, 0, typename MakeIndices<sizeof...(Ts)>::Type());
  }
  // int is the better match for 0, where the call is possible. A generic lambda, which any call
  // fits, gets references.
  template <class Callback, std::size_t... Is>
  static auto call(Callback& f, const Set& set, int, Indices<Is...>)
      -> decltype(f(std::declval<const Ts&>()...), void()) {
    f(*static_cast<const Ts*>(set[Is].get())...);
  }
  template <class Callback, std::size_t... Is>
  static void call(Callback& f, const Set& set, long, Indices<Is...>) {
    f(static_cast<const std::shared_ptr<const Ts>&>(
        std::static_pointer_cast<const Ts>(set[Is]))...);
  }

  F callback_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_SET_DELIVERY_H
